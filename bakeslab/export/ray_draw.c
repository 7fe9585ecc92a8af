#include "export/ray_draw.h"

#include <math.h>
#include <stdlib.h>

#include "slab/plane.h"

struct ray_draw {
  const struct slab *slabs;
  int count;
  size_t samples; /* of all pages */
  double *until;  /* running sum of luminance times the volume of a cell, in each page's order */
  uint64_t rays, seed;
  double flux, scale;
};

/* SplitMix64 (Steele, Lea and Flood, 2014). */
static double uniform(uint64_t *state) {
  uint64_t z = *state += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

/* A place from the hat of sample `index`: triangular towards neighbours, flat towards an end. */
static double draw_place(const struct slab *slab, int axis, int index, uint64_t *state) {
  double cell = slab_spacing(slab, axis), side = uniform(state), far = uniform(state);
  bool end = side < 0.5 ? index == 0 : index == slab->samples[axis] - 1;
  far = end ? far / 2 : 1 - sqrt(1 - far);
  return slab_position(slab, axis, index) + (side < 0.5 ? -far : far) * cell;
}

/* Steps 1 and 2; flux is not yet scaled. */
static void draw_ray(const struct ray_draw *draw, uint64_t k, double ray[7]) {
  uint64_t state = draw->seed;
  double shift = uniform(&state), golden = 0.6180339887498949;
  state = draw->seed + 1 + 8 * k * 0x9e3779b97f4a7c15u;
  double place = fmod(shift + golden * (double)k, 1) * draw->until[draw->samples - 1];
  size_t low = 0, high = draw->samples - 1;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (draw->until[middle] > place)
      high = middle;
    else
      low = middle + 1;
  }
  const struct slab *slab = draw->slabs;
  while (low >= slab_sample_count(slab)) low -= slab_sample_count(slab++);
  int at[SLAB_AXES];
  double abst[SLAB_AXES], kappa = slab_kappa(slab), length = 0;
  slab_locate(slab, low, at);
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    abst[axis] = draw_place(slab, axis, at[axis], &state);
  double p = abst[SLAB_S] - kappa * abst[SLAB_U], q = abst[SLAB_T] - kappa * abst[SLAB_V];
  for (int c = 0; c < 3; ++c) {
    double u = slab->u[c] / plane_edge(slab, SLAB_U), v = slab->v[c] / plane_edge(slab, SLAB_V);
    ray[c] = (slab->center[c] + abst[SLAB_U] * u + abst[SLAB_V] * v) * slab->metres_per_unit;
    ray[3 + c] = slab->normal[c] + p * u + q * v;
    length += ray[3 + c] * ray[3 + c];
  }
  for (int c = 0; c < 3; ++c) ray[3 + c] /= sqrt(length);
  ray[6] = 1 / (length * length);
}

static enum result add_page(struct ray_draw *draw, const struct slab *slab, size_t *at, double *sum,
                            struct error *error) {
  double rgb[3], cell = slab->metres_per_unit * slab->metres_per_unit;
  for (int axis = 0; axis < SLAB_AXES; ++axis) cell *= slab_spacing(slab, axis);
  for (size_t k = 0; k < slab_sample_count(slab); ++k) {
    double luminance = slab_luminance(slab->rgb + 3 * k);
    if (luminance < 0)
      return result_fail(error, RESULT_BAD,
                         "it holds negative light (luminance %g), of which no ray can be drawn",
                         luminance);
    *sum += luminance * cell;
    draw->until[(*at)++] = *sum;
  }
  enum result result = slab_flux_metric(slab, rgb, error);
  draw->flux += 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  return result;
}

enum result ray_draw_open(const struct slab *slabs, int count, uint64_t rays, uint64_t seed,
                          struct ray_draw **made, struct error *error) {
  struct ray_draw *draw = *made = calloc(1, sizeof *draw);
  if (!draw) return result_no_memory(error);
  *draw = (struct ray_draw){.slabs = slabs, .count = count, .rays = rays, .seed = seed};
  for (int k = 0; k < count; ++k) draw->samples += slab_sample_count(&slabs[k]);
  draw->until = calloc(draw->samples, sizeof *draw->until);
  if (!draw->until) return result_no_memory(error);
  size_t at = 0;
  double sum = 0, ray[7], all = 0;
  for (int k = 0; k < count; ++k) {
    enum result result = add_page(draw, &slabs[k], &at, &sum, error);
    if (result != RESULT_OK) return result;
  }
  if (!(sum > 0 && draw->flux > 0))
    return result_fail(error, RESULT_BAD, "all radiance is zero: the lamp gives no light");
  for (uint64_t k = 0; k < rays; ++k) {
    draw_ray(draw, k, ray);
    all += ray[6];
  }
  draw->scale = draw->flux / all;
  return RESULT_OK;
}

void ray_draw_close(struct ray_draw *draw) {
  if (draw) free(draw->until);
  free(draw);
}

double ray_draw_flux(const struct ray_draw *draw) {
  return draw->flux;
}

void ray_draw_ray(const struct ray_draw *draw, uint64_t k, double ray[7]) {
  draw_ray(draw, k, ray);
  ray[6] *= draw->scale;
}
