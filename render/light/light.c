#include "light/light.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/kelvin.h"
#include "base/vector.h"
#include "file/slab_file.h"

/* Relative error of a matrix that is meant to be a similarity: people print it with a few
 * digits. */
static const double matrix_tolerance = 1e-6;

static void rotate(const double matrix[4][3], const double from[3], double to[3]) {
  for (int c = 0; c < 3; ++c)
    to[c] = from[0] * matrix[0][c] + from[1] * matrix[1][c] + from[2] * matrix[2][c];
}

/* Makes `along` perpendicular to the unit `axis` and unit; false where it has no such part. */
static bool straighten(double along[3], const double axis[3]) {
  double part = vector_dot(along, axis), length = vector_length(along);
  for (int c = 0; c < 3; ++c) along[c] -= part * axis[c];
  return vector_length(along) > 1e-9 * length && vector_normalise(along);
}

/* The rotation that takes the page's normal to `forward` and its v as nearly to `up` as it can:
 * rows are the images of x, y and z. */
static void find_rotation(const struct slab *page, const double forward[3], const double up[3],
                          double matrix[4][3]) {
  double from[3][3], to[3][3];
  memcpy(from[0], page->normal, sizeof from[0]);
  memcpy(from[1], page->v, sizeof from[1]);
  memcpy(to[0], forward, sizeof to[0]);
  memcpy(to[1], up, sizeof to[1]);
  vector_normalise(from[0]);
  straighten(from[1], from[0]);
  if (!straighten(to[1], to[0])) { /* up is along the light: any other axis */
    int least = 0;
    for (int c = 1; c < 3; ++c)
      if (fabs(forward[c]) < fabs(forward[least])) least = c;
    for (int c = 0; c < 3; ++c) to[1][c] = c == least;
    straighten(to[1], to[0]);
  }
  vector_cross(from[0], from[1], from[2]);
  vector_cross(to[0], to[1], to[2]);
  for (int row = 0; row < 3; ++row)
    for (int c = 0; c < 3; ++c)
      matrix[row][c] = from[0][row] * to[0][c] + from[1][row] * to[1][c] + from[2][row] * to[2][c];
}

static enum result check_matrix(const char *text, double matrix[4][3], double *scale,
                                struct error *error) {
  double length[3];
  for (int row = 0; row < 3; ++row) length[row] = vector_length(matrix[row]);
  double across[3];
  vector_cross(matrix[0], matrix[1], across);
  double volume = fabs(vector_dot(across, matrix[2])), box = length[0] * length[1] * length[2];
  if (!(volume > 1e-9 * box))
    return result_fail(error, RESULT_BAD, "--light %s: the matrix is singular", text);
  *scale = cbrt(volume);
  for (int row = 0; row < 3; ++row) {
    const double *other = matrix[(row + 1) % 3];
    if (fabs(length[row] / *scale - 1) > matrix_tolerance ||
        fabs(vector_dot(matrix[row], other)) > matrix_tolerance * *scale * *scale)
      return result_fail(error, RESULT_BAD,
                         "--light %s: the matrix must turn, mirror, move and scale evenly: other "
                         "distortions leave no light slab",
                         text);
  }
  return RESULT_OK;
}

static enum result place(const char *text, const struct light_text *where, struct light *light,
                         struct error *error) {
  static const double still[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double forward[3], scale = 1;
  enum result result = RESULT_OK;
  memcpy(light->matrix, still, sizeof still);
  memcpy(light->matrix[3], where->at, sizeof where->at);
  memcpy(forward, light->pages[0].slab.normal, sizeof forward);
  if (where->has_matrix) {
    memcpy(light->matrix, where->matrix, sizeof where->matrix);
    result = check_matrix(text, light->matrix, &scale, error);
  } else if (where->has_toward) {
    vector_subtract(where->toward, where->at, forward);
    if (!vector_normalise(forward))
      result = result_fail(error, RESULT_BAD, "--light %s: toward= is at=: no direction", text);
  }
  if (result == RESULT_OK && where->has_up && !(vector_length(where->up) > 0))
    result = result_fail(error, RESULT_BAD, "--light %s: up= has no direction", text);
  if (result == RESULT_OK && (where->has_toward || where->has_up))
    find_rotation(&light->pages[0].slab, forward, where->up, light->matrix);
  for (int row = 0; row < 3; ++row)
    for (int c = 0; c < 3; ++c) light->matrix[row][c] *= where->scale;
  light->scale = scale * where->scale;
  return result;
}

/* ---- Gain ---- */

static int find_channel(const struct light *light, const char *name) {
  int n = 0;
  while (n < light->channel_count && strcmp(light->channels[n].name, name) != 0) ++n;
  return n;
}

void light_set_channel(struct light *light, int channel, double gain) {
  light->channels[channel].gain = gain;
  for (int page = 0; page < light->count; ++page)
    if (find_channel(light, light->pages[page].slab.channel) == channel)
      light->pages[page].gain = gain;
}

/* What a channel is called that is not there: one line. */
static enum result no_channel(const char *text, const struct light *light, const char *name,
                              struct error *error) {
  char known[256] = "";
  size_t used = 0;
  for (int n = 0; n < light->channel_count && used < sizeof known; ++n)
    used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", n ? ", " : ": it has ",
                             light->channels[n].name);
  return result_fail(error, RESULT_BAD, "--light %s: gain.%s=: %s has no channel %s%s", text, name,
                     light->path, name, used ? known : "; all of its bulbs are together");
}

/* Finds the slab's channels and sets their gains. */
static enum result set_channels(const char *text, const struct light_text *where,
                                struct light *light, struct error *error) {
  for (int page = 0; page < light->count; ++page) {
    const char *name = light->pages[page].slab.channel;
    int n = find_channel(light, name);
    light->pages[page].gain = 1;
    if (!*name || n < light->channel_count) continue;
    if (n == LIGHT_CHANNELS)
      return result_fail(error, RESULT_BAD, "%s: has more than %d channels", light->path, n);
    strcpy(light->channels[light->channel_count++].name, name);
    light_set_channel(light, n, 1);
  }
  for (int k = 0; k < where->channel_count; ++k) {
    const struct light_channel *asked = &where->channels[k];
    int n = find_channel(light, asked->name);
    if (n == light->channel_count) return no_channel(text, light, asked->name, error);
    light_set_channel(light, n, asked->gain);
  }
  return RESULT_OK;
}

/* Of 127 exponents that floats have above 1; the rest is for sums. */
enum { UNIT = 100 };

static void set_unit(struct light_page *page) {
  size_t count = 3 * slab_sample_count(&page->slab);
  float peak = 0, *samples = page->slab.rgb;
  for (size_t k = 0; k < count; ++k) {
    if (fabsf(samples[k]) < FLT_MIN) samples[k] = 0;
    peak = fmaxf(peak, fabsf(samples[k]));
  }
  page->unit = peak > 0 ? ldexp(1, ilogbf(peak) > 0 ? ilogbf(peak) - UNIT : -UNIT) : 1;
}

enum result light_page_set_samples(struct light_page *page, struct error *error) {
  for (int k = 0; k < 2; ++k) {
    struct light_axis *axis = &page->axes[k];
    axis->near_count = page->slab.samples[k ? SLAB_V : SLAB_U];
    axis->far_count = page->slab.samples[k ? SLAB_T : SLAB_S];
    axis->near_step = 2 * axis->half / axis->near_count;
    axis->far_step = (axis->far_high - axis->far_low) / axis->far_count;
  }
  set_unit(page);
  free(page->lit);
  page->lit = lit_rows(&page->slab);
  return page->lit ? RESULT_OK : result_no_memory(error);
}

void light_page_free(struct light_page *page) {
  free(page->lit);
  slab_free(&page->slab);
}

/* Places the page. False where the result is not finite. */
static bool set_frame(const double matrix[4][3], struct light_page *page) {
  const double *axes[3] = {page->slab.u, page->slab.v, page->slab.normal};
  rotate(matrix, page->slab.center, page->center);
  bool finite = true;
  for (int c = 0; c < 3; ++c) {
    page->center[c] += matrix[3][c];
    rotate(matrix, axes[c], page->frame[c]);
    finite = vector_normalise(page->frame[c]) && finite;
    finite = isfinite(page->center[c]) && finite;
  }
  return finite;
}

static enum result set_page(const char *text, const struct light *light, struct light_page *page,
                            struct error *error) {
  const struct slab *slab = &page->slab;
  bool finite = set_frame(light->matrix, page);
  for (int k = 0; k < 2; ++k) {
    struct light_axis *axis = &page->axes[k];
    axis->half = light->scale * vector_length(k ? slab->v : slab->u) / 2;
    axis->far_low = slab->st_window[2 * k];
    axis->far_high = slab->st_window[2 * k + 1];
    axis->kappa = slab_kappa(slab) / light->scale;
  }
  enum result result = light_page_set_samples(page, error);
  if (result != RESULT_OK) return result;
  for (int k = 0; k < 2; ++k) {
    const struct light_axis *axis = &page->axes[k];
    finite = finite && axis->near_step > 0 && isfinite(axis->half) && isfinite(axis->kappa);
  }
  if (finite) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "--light %s: placed beyond what numbers can hold", text);
}

/* Scales between these are thought to be meant as sizes. */
static const double least_resize = 0.1, most_resize = 10;

static enum result set_gain(const struct light_text *where, struct light *light,
                            struct error *error) {
  double colour[3] = {1, 1, 1}, flux[3], luminance = 0;
  if (where->kelvin > 0) kelvin_colour(where->kelvin, colour);
  for (int c = 0; c < 3; ++c) light->gain[c] = where->gain[c] * colour[c];
  if (!(where->lumens > 0)) return RESULT_OK;
  for (int page = 0; page < light->count; ++page) {
    enum result result = slab_flux(&light->pages[page].slab, flux, error);
    if (result != RESULT_OK) return result;
    luminance +=
        0.2126 * flux[0] * colour[0] + 0.7152 * flux[1] * colour[1] + 0.0722 * flux[2] * colour[2];
  }
  double metres = where->metres > 0 ? where->metres : light->pages[0].slab.metres_per_unit;
  double factor = where->lumens / (luminance * pow(light->scale * metres, 2));
  light->measured = true;
  light->resized =
      !(where->metres > 0) && (light->scale < least_resize || light->scale > most_resize);
  for (int c = 0; c < 3; ++c) light->gain[c] *= factor;
  if (luminance > 0 && isfinite(factor)) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "%s: it gives no light, so that no gain makes %g lumens of it; leave out "
                     "lumens=",
                     light->path, where->lumens);
}

enum result light_load(const char *text, struct light *light, struct error *error) {
  struct light_text where;
  struct slab *slabs = NULL;
  *light = (struct light){0};
  enum result result = light_text_parse(text, &where, error);
  if (result != RESULT_OK) return result;
  light->path = where.path;
  result = slab_file_load_all(where.path, &slabs, &light->count, error);
  if (result == RESULT_OK) {
    light->pages = calloc((size_t)light->count, sizeof *light->pages);
    if (!light->pages) result = result_no_memory(error);
  }
  for (int page = 0; light->pages && page < light->count; ++page)
    light->pages[page].slab = slabs[page];
  if (light->pages)
    free(slabs); /* the pages have taken over what they own */
  else
    slab_file_free_all(slabs, light->count);
  if (result == RESULT_OK) result = place(text, &where, light, error);
  if (result == RESULT_OK) result = set_channels(text, &where, light, error);
  for (int page = 0; page < light->count && result == RESULT_OK; ++page)
    result = set_page(text, light, &light->pages[page], error);
  if (result == RESULT_OK) result = set_gain(&where, light, error);
  if (result != RESULT_OK) light_free(light);
  return result;
}

void light_free(struct light *light) {
  for (int page = 0; light->pages && page < light->count; ++page)
    light_page_free(&light->pages[page]);
  free(light->pages);
  free(light->path);
  *light = (struct light){0};
}

const char *light_unit(const struct light *light) {
  return light->measured ? "cd/m2" : light->pages[0].slab.radiance_unit;
}

int light_pages(const struct light *lights, int count) {
  int pages = 0;
  for (int l = 0; l < count; ++l) pages += lights[l].count;
  return pages;
}

bool light_move(struct light *light, const double matrix[4][3]) {
  bool finite = true;
  for (int page = 0; page < light->count; ++page)
    finite = set_frame(matrix, &light->pages[page]) && finite;
  if (finite) memcpy(light->matrix, matrix, sizeof light->matrix);
  for (int page = 0; !finite && page < light->count; ++page)
    set_frame(light->matrix, &light->pages[page]);
  return finite;
}

void light_page_corners(const struct light_page *page, double corners[4][3]) {
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c)
      corners[k][c] = page->center[c] + (k & 1 ? 1 : -1) * page->axes[0].half * page->frame[0][c] +
                      (k & 2 ? 1 : -1) * page->axes[1].half * page->frame[1][c];
}

/* Where the ray meets the page's front: the distance and the point (a, b) in scene units. */
static double meet(const struct light_page *page, const double origin[3], const double direction[3],
                   double point[2]) {
  double to_center[3], along = vector_dot(direction, page->frame[2]);
  if (!(along < 0)) return INFINITY;
  vector_subtract(page->center, origin, to_center);
  double distance = vector_dot(to_center, page->frame[2]) / along;
  if (!(distance > 0)) return INFINITY;
  for (int axis = 0; axis < 2; ++axis) {
    point[axis] = distance * vector_dot(direction, page->frame[axis]) -
                  vector_dot(to_center, page->frame[axis]);
    if (!(fabs(point[axis]) <= page->axes[axis].half)) return INFINITY;
  }
  return distance;
}

static void add_radiance(const struct light *light, const struct light_page *page,
                         const double direction[3], const double point[2], double rgb[3]) {
  double seen[3], st[2], along = vector_dot(direction, page->frame[2]);
  for (int axis = 0; axis < 2; ++axis)
    st[axis] =
        vector_dot(direction, page->frame[axis]) / along + page->axes[axis].kappa * point[axis];
  slab_lookup(&page->slab, point[0] / light->scale, point[1] / light->scale, st[0], st[1], seen);
  for (int c = 0; c < 3; ++c) rgb[c] += light->gain[c] * page->gain * seen[c];
}

double light_seen(const struct light *lights, int count, const double origin[3],
                  const double direction[3], double limit, double rgb[3]) {
  double nearest = INFINITY, point[2] = {0};
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int l = 0; l < count; ++l)
    for (int page = 0; page < lights[l].count; ++page)
      nearest = fmin(nearest, meet(&lights[l].pages[page], origin, direction, point));
  if (!(nearest < limit)) return INFINITY;
  /* Pages that share a rectangle add up. */
  for (int l = 0; l < count; ++l)
    for (int page = 0; page < lights[l].count; ++page)
      if (meet(&lights[l].pages[page], origin, direction, point) <= nearest * (1 + 1e-9))
        add_radiance(&lights[l], &lights[l].pages[page], direction, point, rgb);
  return nearest;
}
