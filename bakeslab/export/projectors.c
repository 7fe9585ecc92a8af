#include "export/projectors.h"

#include <math.h>
#include <stdlib.h>

#include "base/files.h"
#include "export/export_frame.h"
#include "file/slab_exr.h"
#include "slab/plane.h"
#include "slab/slab_resample.h"

enum { JUDGED = EXPORT_DISTANCES - 1 }; /* the distance at which the tolerance is kept */
enum { LEAST = 4, MOST = 32, MOST_TEXELS = 1 << 25, FILE_NAME_SIZE = SLAB_NAME_SIZE + 48 };
static const double least_aside = 0.05; /* of 1 + c.(x, y), by which Mitsuba divides */

/* ---- 1. Positions and directions ---- */

/* cos^4 bends most straight ahead: half the square of a step off, as a part. That gets a fifth of
 * the tolerance. */
static void choose_samples(const struct slab *slab, int most, double tolerance,
                           int samples[SLAB_AXES]) {
  double step = sqrt(0.4 * fmin(tolerance, 0.1));
  for (int k = 0; k < 2; ++k) {
    int st = SLAB_S + k;
    double parts = ceil(slab_spacing(slab, st) / step);
    int old = slab->samples[st];
    samples[k] = (int)fmax(1, round(most * plane_edge(slab, k) / plane_width(slab)));
    parts += fmod(parts, 2) == 0;
    samples[st] = (int)fmin(parts * old, MOST_TEXELS);
  }
}

static bool fits(const int samples[SLAB_AXES]) {
  double texels = 1;
  for (int k = 0; k < SLAB_AXES; ++k) texels *= samples[k];
  return texels <= MOST_TEXELS;
}

/* ---- 2. Texels ---- */

/* The middle of the window as it is seen from the position (a, b). */
static void middle_from(const struct slab *slab, const double from[2], double middle[2]) {
  for (int k = 0; k < 2; ++k)
    middle[k] =
        (slab->st_window[2 * k] + slab->st_window[2 * k + 1]) / 2 - slab_kappa(slab) * from[k];
}

/* Whether the light of all positions goes forward along n + c. */
static bool check_aside(const struct slab *slab) {
  for (int k = 0; k < 16; ++k) {
    double from[2], middle[2], forward = 1;
    for (int axis = 0; axis < 2; ++axis)
      from[axis] = ((k >> axis & 1) - 0.5) * plane_edge(slab, axis);
    middle_from(slab, from, middle);
    for (int axis = 0; axis < 2; ++axis)
      forward += middle[axis] * (slab->st_window[2 * axis + (k >> (2 + axis) & 1)] -
                                 slab_kappa(slab) * from[axis]);
    if (!(forward > least_aside)) return false;
  }
  return true;
}

static void make_view(struct slab *texels, int i, int j) {
  const double from[2] = {slab_position(texels, SLAB_U, i), slab_position(texels, SLAB_V, j)};
  double area = slab_spacing(texels, SLAB_U) * slab_spacing(texels, SLAB_V), middle[2];
  middle_from(texels, from, middle);
  for (int l = 0; l < texels->samples[SLAB_T]; ++l)
    for (int k = 0; k < texels->samples[SLAB_S]; ++k) {
      double x = slab_position(texels, SLAB_S, k) - slab_kappa(texels) * from[0];
      double y = slab_position(texels, SLAB_T, l) - slab_kappa(texels) * from[1];
      double tangent2 = 1 + x * x + y * y, forward = 1 + middle[0] * x + middle[1] * y;
      float *rgb = slab_at(texels, i, j, k, l);
      for (int c = 0; c < 3; ++c)
        rgb[c] = (float)(rgb[c] * area * forward / (tangent2 * tangent2 * M_PI));
    }
}

static enum result make(const struct slab *slab, const int samples[SLAB_AXES], struct slab *texels,
                        struct error *error) {
  enum result result = slab_resample(slab, samples, texels, error);
  if (result != RESULT_OK) return result;
  for (int j = 0; j < samples[SLAB_V]; ++j)
    for (int i = 0; i < samples[SLAB_U]; ++i) make_view(texels, i, j);
  return RESULT_OK;
}

/* ---- 3. The error ---- */

/* At (x, y, z) before the aperture and facing it, as Mitsuba adds it up. */
static void irradiance(const void *of, int which, const double at[3], double rgb[3]) {
  const struct slab *texels = of;
  double kappa = slab_kappa(texels);
  (void)which;
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int j = 0; j < texels->samples[SLAB_V]; ++j)
    for (int i = 0; i < texels->samples[SLAB_U]; ++i) {
      const double from[2] = {slab_position(texels, SLAB_U, i), slab_position(texels, SLAB_V, j)};
      double x = (at[0] - from[0]) / at[2], y = (at[1] - from[1]) / at[2], texel[3], middle[2];
      slab_lookup(texels, from[0], from[1], x + kappa * from[0], y + kappa * from[1], texel);
      middle_from(texels, from, middle);
      double weight = M_PI / (1 + middle[0] * x + middle[1] * y) / at[2] / at[2];
      for (int c = 0; c < 3; ++c) rgb[c] += weight * texel[c];
    }
}

static double error_at(const struct slab *slab, const struct slab *texels, double widths) {
  double error = 0;
  plane_errors(slab, widths * plane_width(slab), 1, irradiance, texels, 1, &error);
  return error;
}

static enum result refuse(const struct projectors *tried, const int next[SLAB_AXES],
                          struct error *error) {
  const int *n = tried->texels.samples;
  if (!tried->texels.rgb)
    return result_fail(error, RESULT_BAD,
                       "its window is too wide for projectors: a picture would be %dx%d texels; "
                       "leave out --plain",
                       next[SLAB_S], next[SLAB_T]);
  return result_fail(error, RESULT_BAD,
                     "%dx%d projectors, the most that fit, err %.2g %% %g aperture widths away: "
                     "leave out --plain, or give a --tolerance above that",
                     n[SLAB_U], n[SLAB_V], 100 * tried->error[JUDGED], export_distances[JUDGED]);
}

enum result projectors_make(const struct slab *slab, double tolerance,
                            struct projectors *projectors, struct error *error) {
  int samples[SLAB_AXES];
  *projectors = (struct projectors){0};
  if (!check_aside(slab))
    return result_fail(error, RESULT_BAD,
                       "its window, slopes %g to %g and %g to %g, lies too far aside for "
                       "projectors: leave out --plain",
                       slab->st_window[0], slab->st_window[1], slab->st_window[2],
                       slab->st_window[3]);
  for (int most = LEAST; most <= MOST; most *= 2) {
    choose_samples(slab, most, tolerance, samples);
    if (!fits(samples)) break;
    slab_free(&projectors->texels);
    enum result result = make(slab, samples, &projectors->texels, error);
    if (result != RESULT_OK) return result;
    projectors->error[JUDGED] = error_at(slab, &projectors->texels, export_distances[JUDGED]);
    if (projectors->error[JUDGED] > tolerance) continue;
    for (int k = 0; k < JUDGED; ++k)
      projectors->error[k] = error_at(slab, &projectors->texels, export_distances[k]);
    return RESULT_OK;
  }
  return refuse(projectors, samples, error);
}

void projectors_free(struct projectors *projectors) {
  slab_free(&projectors->texels);
}

/* ---- Files ---- */

static bool is_lit(const struct slab *texels, int i, int j) {
  for (int l = 0; l < texels->samples[SLAB_T]; ++l) {
    const float *row = slab_at(texels, i, j, 0, l);
    for (int k = 0; k < 3 * texels->samples[SLAB_S]; ++k)
      if (row[k] != 0) return true;
  }
  return false;
}

int projectors_lit(const struct projectors *projectors) {
  const int *samples = projectors->texels.samples;
  int lit = 0;
  for (int k = 0; k < samples[SLAB_U] * samples[SLAB_V]; ++k)
    lit += is_lit(&projectors->texels, k % samples[SLAB_U], k / samples[SLAB_U]);
  return lit;
}

static void name_file(const char *stem, int i, int j, char name[FILE_NAME_SIZE]) {
  snprintf(name, FILE_NAME_SIZE, "%s_%02d_%02d.exr", stem, i, j);
}

static enum result write_view(const struct slab *texels, int i, int j, float *rgb, const char *path,
                              struct error *error) {
  const struct picture picture = {
      .width = texels->samples[SLAB_S], .height = texels->samples[SLAB_T], .rgb = rgb};
  for (int l = 0; l < picture.height; ++l)
    for (int k = 0; k < 3 * picture.width; ++k)
      rgb[3 * picture.width * l + k] = slab_at(texels, i, j, 0, l)[k];
  return slab_exr_write(path, &picture, 0, NULL, error);
}

enum result projectors_write(const struct projectors *projectors, const char *stem,
                             const char *folder, struct error *error) {
  const struct slab *texels = &projectors->texels;
  const int *samples = texels->samples;
  float *rgb = calloc((size_t)samples[SLAB_S] * (size_t)samples[SLAB_T], 3 * sizeof *rgb);
  enum result result = RESULT_OK;
  if (!rgb) return result_no_memory(error);
  for (int k = 0; k < samples[SLAB_U] * samples[SLAB_V] && result == RESULT_OK; ++k) {
    int i = k % samples[SLAB_U], j = k / samples[SLAB_U];
    char name[FILE_NAME_SIZE];
    if (!is_lit(texels, i, j)) continue;
    name_file(stem, i, j, name);
    char *path = files_join(folder, name);
    result = path ? write_view(texels, i, j, rgb, path, error) : result_no_memory(error);
    free(path);
  }
  free(rgb);
  return result;
}

/* Pictures keep their orientation: the columns turn both axes, which a projector turns, too. */
static void put_view(const struct slab *texels, int i, int j, const char *stem, FILE *out) {
  const double from[2] = {slab_position(texels, SLAB_U, i), slab_position(texels, SLAB_V, j)};
  double half[2], middle[2], lamp[4][3], there[4][3];
  char name[FILE_NAME_SIZE];
  middle_from(texels, from, middle);
  for (int k = 0; k < 2; ++k)
    half[k] = (texels->st_window[2 * k + 1] - texels->st_window[2 * k]) / 2;
  half[1] *= (double)texels->samples[SLAB_S] / texels->samples[SLAB_T]; /* fov is that of x */
  for (int c = 0; c < 3; ++c) {
    double u = texels->u[c] / plane_edge(texels, SLAB_U);
    double v = texels->v[c] / plane_edge(texels, SLAB_V);
    lamp[0][c] = -half[0] * u;
    lamp[1][c] = -half[1] * v;
    lamp[2][c] = texels->normal[c] + middle[0] * u + middle[1] * v;
    lamp[3][c] = texels->center[c] + from[0] * u + from[1] * v;
  }
  for (int k = 0; k < 4; ++k) export_y_up(lamp[k], there[k]);
  name_file(stem, i, j, name);
  fputs(
      "\n  <emitter type=\"projector\">\n    <transform name=\"to_world\">\n      <matrix value=\"",
      out);
  export_put_matrix(there[0], there[1], there[2], there[3], out);
  fprintf(out,
          "\"/>\n      <matrix value=\"$place\"/>\n    </transform>\n"
          "    <float name=\"fov\" value=\"90\"/>\n    <float name=\"scale\" value=\"$gain\"/>\n"
          "    <texture type=\"bitmap\" name=\"irradiance\">\n"
          "      <string name=\"filename\" value=\"%s\"/>\n"
          "      <boolean name=\"raw\" value=\"true\"/>\n"
          "      <string name=\"wrap_mode\" value=\"clamp\"/>\n    </texture>\n  </emitter>",
          name);
}

void projectors_put(const struct projectors *projectors, const char *stem, FILE *out) {
  const int *samples = projectors->texels.samples;
  for (int k = 0; k < samples[SLAB_U] * samples[SLAB_V]; ++k)
    if (is_lit(&projectors->texels, k % samples[SLAB_U], k / samples[SLAB_U]))
      put_view(&projectors->texels, k % samples[SLAB_U], k / samples[SLAB_U], stem, out);
}
