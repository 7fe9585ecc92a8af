/* slab_resample.c - box means, interpolation and cropping. In memory a slab is
 * [v][t][u][s][rgb], so each axis is the middle one of outer x n x inner. */
#include "slab/slab_resample.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Old samples first .. first + count - 1, with weights that sum to 1. */
struct taps {
  int first, count;
  const double *weights;
};

/* New cell `index` covers [index, index + 1) old / new, in old cells. */
static struct taps mean_taps(int old, int new, int index, double *weights) {
  /* In units of 1/new of an old cell all limits are integers: no rounding. */
  int64_t low = (int64_t)index * old, high = low + old;
  struct taps taps = {.first = (int)(low / new), .weights = weights};
  for (int64_t cell = taps.first; cell * new < high; ++cell) {
    int64_t from = cell * new > low ? cell *new : low;
    int64_t to = (cell + 1) * new < high ? (cell + 1) * new : high;
    weights[taps.count++] = (double)(to - from) / old;
  }
  return taps;
}

static struct taps linear_taps(int old, int new, int index, double *weights) {
  double position = (index + 0.5) * old / new - 0.5;
  position = position < 0 ? 0 : position > old - 1 ? old - 1 : position;
  struct taps taps = {.first = (int)position, .count = 1, .weights = weights};
  weights[0] = 1;
  if (taps.first + 1 < old) {
    weights[1] = position - taps.first;
    weights[0] = 1 - weights[1];
    taps.count = 2;
  }
  return taps;
}

/* One axis: `in` is outer x old x inner floats, `out` outer x new x inner. */
static enum result change_axis(const float *in, float *out, size_t outer, int old, int new,
                               size_t inner, struct error *error) {
  double *weights = calloc((size_t)old + 2, sizeof *weights);
  double *sum = calloc(inner, sizeof *sum);
  if (!weights || !sum) {
    free(weights);
    free(sum);
    return result_no_memory(error);
  }
  for (int index = 0; index < new; ++index) {
    struct taps taps = (new < old ? mean_taps : linear_taps)(old, new, index, weights);
    for (size_t o = 0; o < outer; ++o) {
      memset(sum, 0, inner * sizeof *sum);
      for (int tap = 0; tap < taps.count; ++tap) {
        const float *from = in + (o * (size_t)old + (size_t)(taps.first + tap)) * inner;
        for (size_t k = 0; k < inner; ++k) sum[k] += taps.weights[tap] * (double)from[k];
      }
      float *to = out + (o * (size_t) new + (size_t)index) * inner;
      for (size_t k = 0; k < inner; ++k) to[k] = (float)sum[k];
    }
  }
  free(weights);
  free(sum);
  return RESULT_OK;
}

/* Replaces the slab's samples by those with `count` along one axis. */
static enum result resample_axis(struct slab *slab, int axis, int count, struct error *error) {
  static const int order[SLAB_AXES] = {SLAB_V, SLAB_T, SLAB_U, SLAB_S}; /* slowest first */
  struct slab next = *slab;
  next.rgb = NULL;
  next.samples[axis] = count;
  enum result result = slab_alloc(&next, error);
  if (result != RESULT_OK) return result;
  size_t outer = 1, inner = 3;
  bool before = true;
  for (int k = 0; k < SLAB_AXES; ++k) {
    if (order[k] == axis)
      before = false;
    else if (before)
      outer *= (size_t)slab->samples[order[k]];
    else
      inner *= (size_t)slab->samples[order[k]];
  }
  result = change_axis(slab->rgb, next.rgb, outer, slab->samples[axis], count, inner, error);
  float *old = result == RESULT_OK ? slab->rgb : next.rgb;
  if (result == RESULT_OK) *slab = next;
  free(old);
  return result;
}

enum result slab_resample(const struct slab *in, const int samples[SLAB_AXES], struct slab *out,
                          struct error *error) {
  struct slab slab = {0};
  enum result result = slab_copy_geometry(in, &slab, error);
  if (result == RESULT_OK) result = slab_alloc(&slab, error);
  if (result == RESULT_OK) memcpy(slab.rgb, in->rgb, slab_sample_count(in) * 3 * sizeof(float));
  /* Shrink first, so that the axes that grow handle less. */
  for (int grow = 0; grow < 2; ++grow)
    for (int axis = 0; axis < SLAB_AXES && result == RESULT_OK; ++axis) {
      int old = slab.samples[axis];
      if (grow ? samples[axis] > old : samples[axis] < old)
        result = resample_axis(&slab, axis, samples[axis], error);
    }
  if (result == RESULT_OK)
    *out = slab;
  else
    slab_free(&slab);
  return result;
}

/* Moves centre, edges and window to the range of samples. */
static void crop_geometry(const struct slab *in, const int first[SLAB_AXES],
                          const int end[SLAB_AXES], struct slab *out) {
  double *edges[2] = {out->u, out->v};
  const double *old_edges[2] = {in->u, in->v};
  for (int axis = 0; axis < SLAB_AXES; ++axis) out->samples[axis] = end[axis] - first[axis];
  for (int k = 0; k < 2; ++k) {
    double n = in->samples[SLAB_U + k];
    double shift = ((first[SLAB_U + k] + end[SLAB_U + k]) / n - 1) / 2; /* in edges */
    double share = out->samples[SLAB_U + k] / n;
    for (int c = 0; c < 3; ++c) {
      out->center[c] += shift * old_edges[k][c];
      edges[k][c] *= share;
    }
    double low = in->st_window[2 * k], spacing = slab_spacing(in, SLAB_S + k);
    /* Slopes are as seen from the centre, which has moved by `shift`. */
    double seen = slab_kappa(in) * shift * in->samples[SLAB_U + k] * slab_spacing(in, SLAB_U + k);
    out->st_window[2 * k] = low + first[SLAB_S + k] * spacing - seen;
    out->st_window[2 * k + 1] = end[SLAB_S + k] == in->samples[SLAB_S + k]
                                    ? in->st_window[2 * k + 1] - seen
                                    : low + end[SLAB_S + k] * spacing - seen;
  }
}

enum result slab_crop(const struct slab *in, const int first[SLAB_AXES], const int end[SLAB_AXES],
                      struct slab *out, struct error *error) {
  static const char *const names[SLAB_AXES] = {"u", "v", "s", "t"};
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    if (first[axis] < 0 || end[axis] > in->samples[axis] || first[axis] >= end[axis])
      return result_fail(error, RESULT_BAD, "cannot crop %s to %d:%d, there are samples 0:%d",
                         names[axis], first[axis], end[axis], in->samples[axis]);
  struct slab slab = {0};
  enum result result = slab_copy_geometry(in, &slab, error);
  if (result == RESULT_OK) {
    crop_geometry(in, first, end, &slab);
    result = slab_alloc(&slab, error);
  }
  if (result != RESULT_OK) {
    slab_free(&slab);
    return result;
  }
  for (int j = 0; j < slab.samples[SLAB_V]; ++j)
    for (int l = 0; l < slab.samples[SLAB_T]; ++l)
      for (int i = 0; i < slab.samples[SLAB_U]; ++i)
        memcpy(slab_at(&slab, i, j, 0, l),
               slab_at(in, i + first[SLAB_U], j + first[SLAB_V], first[SLAB_S], l + first[SLAB_T]),
               3 * sizeof(float) * (size_t)slab.samples[SLAB_S]);
  *out = slab;
  return RESULT_OK;
}
