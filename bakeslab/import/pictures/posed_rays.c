#include "import/pictures/posed_rays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Half cells that a picture meets: a hash table of them, and a list in the order in which
 * they were met first, which does not depend on the table ---- */

struct bin {
  uint64_t key;
  int page;
  double pixels, at[SLAB_AXES], rgb[3], weight;
};

struct bins {
  struct bin *bin;
  size_t count, room; /* room: a power of two */
  uint32_t *slot;     /* 2 * room of them: number of a bin + 1, or 0 */
};

static size_t find_slot(const struct bins *bins, uint64_t key) {
  size_t mask = 2 * bins->room - 1;
  size_t slot = (size_t)((key * 0x9e3779b97f4a7c15) >> 32) & mask;
  while (bins->slot[slot] && bins->bin[bins->slot[slot] - 1].key != key) slot = (slot + 1) & mask;
  return slot;
}

static enum result grow(struct bins *bins, struct error *error) {
  size_t room = bins->room ? 2 * bins->room : 4096;
  uint32_t *slot = room <= UINT32_MAX / 2 ? calloc(2 * room, sizeof *slot) : NULL;
  struct bin *bin = slot ? realloc(bins->bin, room * sizeof *bin) : NULL;
  if (!bin) {
    free(slot);
    return result_no_memory(error);
  }
  free(bins->slot);
  *bins = (struct bins){bin, bins->count, room, slot};
  for (size_t n = 0; n < bins->count; ++n)
    bins->slot[find_slot(bins, bin[n].key)] = (uint32_t)n + 1;
  return RESULT_OK;
}

/* The bin of a key, new or not; NULL without memory. */
static struct bin *find_bin(struct bins *bins, uint64_t key, int page, struct error *error) {
  if (bins->count == bins->room && grow(bins, error) != RESULT_OK) return NULL;
  size_t slot = find_slot(bins, key);
  if (!bins->slot[slot]) {
    bins->bin[bins->count] = (struct bin){.key = key, .page = page};
    bins->slot[slot] = (uint32_t)++bins->count;
  }
  return &bins->bin[bins->slot[slot] - 1];
}

/* ---- Pixels ---- */

/* Places in samples; false outside the window. */
static bool find_place(const struct slab *slab, const double abst[SLAB_AXES],
                       double at[SLAB_AXES]) {
  double kappa = slab_kappa(slab);
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    double x = axis < SLAB_S ? abst[axis] : abst[axis] + kappa * abst[axis - SLAB_S];
    double half = 0.5 * slab->samples[axis];
    at[axis] = (x - slab_position(slab, axis, 0)) / slab_spacing(slab, axis);
    if (!(fabs(at[axis] + 0.5 - half) <= half * (1 + 1e-9))) return false;
  }
  return true;
}

static uint64_t find_key(const struct slab *slab, int page, const double at[SLAB_AXES]) {
  uint64_t key = (uint64_t)page;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    int halves = 2 * slab->samples[axis], half = (int)floor(2 * (at[axis] + 0.5));
    key = key * (uint64_t)halves + (uint64_t)(half < 0 ? 0 : half < halves ? half : halves - 1);
  }
  return key;
}

/* The solid angle of a pixel in the direction in which its camera looks, `direction`. */
static double solid_angle(const struct pose *pose, const double direction[3]) {
  double square = 0;
  for (int n = 0; n < 3; ++n) square += direction[n] * direction[n];
  return 1 / (pose->focal[0] * pose->focal[1] * square * sqrt(square));
}

/* Of a camera above the page's plane; one below does not see its light. */
static double find_height(const struct slab *slab, const double origin[3]) {
  double height = 0;
  for (int n = 0; n < 3; ++n) height += (origin[n] - slab->center[n]) * slab->normal[n];
  return height;
}

/* Of the flux through the page that the pixel stands for: its area there, in lamp units, times the
 * fourth power of the cosine. */
static double flux_weight(double height, const double abst[4], double solid) {
  double cosine = 1 / sqrt(1 + abst[2] * abst[2] + abst[3] * abst[3]);
  double distance = height / cosine;
  return solid * distance * distance * cosine * cosine * cosine;
}

struct sight {
  const struct pose *pose;
  const struct picture *picture;
  const double *vignetting;
};

static double fall_off(const struct sight *sight, int column, int row) {
  const double *k = sight->vignetting;
  double width = sight->picture->width, height = sight->picture->height;
  double x = 2 * column + 1 - width, y = 2 * row + 1 - height;
  double square = (x * x + y * y) / (width * width + height * height);
  return 1 + square * (k[0] + square * (k[1] + square * k[2]));
}

static enum result add_pixel(struct posed_rays *rays, const struct sight *sight, int column,
                             int row, struct bins *bins, struct error *error) {
  size_t pixel = (size_t)row * (size_t)sight->picture->width + (size_t)column;
  const float *rgb = sight->picture->rgb + 3 * pixel;
  double look[3], abst[SLAB_AXES], at[SLAB_AXES], fall = fall_off(sight, column, row);
  struct ray ray = {0};
  poses_look(sight->pose, column + 0.5, row + 0.5, look);
  double solid = solid_angle(sight->pose, look), light = solid * slab_luminance(rgb) / fall;
  for (int n = 0; n < 3; ++n) {
    ray.origin[n] = sight->pose->origin[n];
    ray.direction[n] = -look[n];
  }
  if (!(fall > 0 && isfinite(fall)))
    return result_fail(error, RESULT_BAD, "column %d, row %d: --vignetting makes its factor %g",
                       column, row, fall);
  rays->seen += light;
  int page = ray_pages_find(rays->pages, &ray, abst);
  const struct slab *slab = &rays->pages->page[page < 0 ? 0 : page].geometry;
  double height = find_height(slab, ray.origin);
  if (page < 0 || !(height > 0)) {
    rays->missed += light;
    return RESULT_OK;
  }
  if (!find_place(slab, abst, at)) {
    rays->beyond += light;
    return RESULT_OK;
  }
  struct bin *bin = find_bin(bins, find_key(slab, page, at), page, error);
  if (!bin) return RESULT_MEMORY;
  ++bin->pixels;
  bin->weight += flux_weight(height, abst, solid);
  for (int n = 0; n < SLAB_AXES; ++n) bin->at[n] += at[n];
  for (int c = 0; c < 3; ++c) bin->rgb[c] += (double)rgb[c] / fall;
  return RESULT_OK;
}

/* The means of bins as rays. */
static enum result add_bins(struct posed_rays *rays, const struct bins *bins, uint32_t source,
                            struct error *error) {
  for (size_t n = 0; n < bins->count; ++n) {
    const struct bin *bin = &bins->bin[n];
    size_t count = rays->page[bin->page].count, room = rays->page[bin->page].room;
    if (count == room) {
      room = room ? 2 * room : 4096;
      struct rebin_ray *more = realloc(rays->page[bin->page].ray, room * sizeof *more);
      if (!more) return result_no_memory(error);
      rays->page[bin->page].ray = more;
      rays->page[bin->page].room = room;
    }
    struct rebin_ray *ray = &rays->page[bin->page].ray[count];
    *ray = (struct rebin_ray){.weight = (float)bin->weight, .source = source};
    for (int k = 0; k < SLAB_AXES; ++k) ray->at[k] = (float)(bin->at[k] / bin->pixels);
    for (int c = 0; c < 3; ++c) ray->rgb[c] = (float)(bin->rgb[c] / bin->pixels);
    ++rays->page[bin->page].count;
  }
  return RESULT_OK;
}

enum result posed_rays_add(struct posed_rays *rays, const struct pose *pose,
                           const struct picture *picture, const double vignetting[3],
                           uint32_t source, struct error *error) {
  struct pose complete = *pose;
  struct bins bins = {0};
  struct sight sight = {&complete, picture, vignetting};
  enum result result = RESULT_OK;
  poses_complete(&complete, picture->width, picture->height);
  for (int row = 0; row < picture->height && result == RESULT_OK; ++row)
    for (int column = 0; column < picture->width && result == RESULT_OK; ++column)
      result = add_pixel(rays, &sight, column, row, &bins, error);
  if (result == RESULT_OK) result = add_bins(rays, &bins, source, error);
  free(bins.bin);
  free(bins.slot);
  return result;
}

void posed_rays_free(struct posed_rays *rays) {
  for (int n = 0; n < RAY_PAGES_MOST; ++n) free(rays->page[n].ray);
  *rays = (struct posed_rays){0};
}
