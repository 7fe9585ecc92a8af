/* ray_estimate.c - samples on the page's grid, or on the coarsest that meets a tolerance.
 *
 * 1. Estimate the samples of the page's own grid, the finest.
 * 2. Of coarser ones, halved along u and v, along s and t, or both, the blur is the difference
 *    between their interpolation and the finest samples. What the finest lose themselves is
 *    extrapolated from one halving and two, as in slab_accuracy.c: with b and c the integrals of
 *    the squared difference, (b + x) / x = (c + x) / (b + x).
 * 3. From the fewest samples to the most, estimate those whose blur leaves hope, by the same rays;
 *    the first whose error is within the tolerance is taken, else that of the least. */
#include "import/rays/ray_estimate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/rays/ray_etendue.h"
#include "import/rays/ray_samples.h"
#include "slab/slab_resample.h"

struct ray_estimate {
  struct ray_bins bins;
  double tolerance, whole;
};

enum result ray_estimate_new(const struct slab *page, bool coloured, double tolerance, int threads,
                             struct ray_estimate **out, struct error *error) {
  struct ray_estimate *estimate = calloc(1, sizeof *estimate);
  *out = NULL;
  if (!estimate) return result_no_memory(error);
  estimate->tolerance = tolerance;
  enum result result = ray_boxes_check(page->samples, error);
  if (result == RESULT_OK) result = ray_bins_new(page, coloured, &estimate->bins, error);
  estimate->bins.threads = threads;
  if (result == RESULT_OK)
    *out = estimate;
  else
    free(estimate);
  return result;
}

void ray_estimate_free(struct ray_estimate *estimate) {
  if (estimate) ray_bins_free(&estimate->bins);
  free(estimate);
}

bool ray_estimate_add(struct ray_estimate *estimate, const double abst[SLAB_AXES],
                      const double rgb[3]) {
  return ray_bins_add(&estimate->bins, abst, rgb);
}

void ray_estimate_whole(struct ray_estimate *estimate, double flux) {
  estimate->whole = flux;
}

/* ---- Step 2 ---- */

enum { MOST_HALVINGS = 2, GRIDS = (MOST_HALVINGS + 1) * (MOST_HALVINGS + 1) };

/* Squared error by blur of the grids with that many halvings of u and v and of s and t, relative;
 * INFINITY where the page's samples cannot be halved. */
struct blurs {
  double square[MOST_HALVINGS + 1][MOST_HALVINGS + 1];
};

static void find_halvings(int uv, int st, int halvings[SLAB_AXES]) {
  halvings[SLAB_U] = halvings[SLAB_V] = uv;
  halvings[SLAB_S] = halvings[SLAB_T] = st;
}

/* The relative squared difference of the interpolated means from the finest samples. */
static enum result find_blur(const struct slab *finest, const double *etendue,
                             const int halvings[SLAB_AXES], double *square, struct error *error) {
  int samples[SLAB_AXES], at[SLAB_AXES];
  struct slab coarse;
  double sum = 0, all = 0;
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    samples[axis] = finest->samples[axis] >> halvings[axis];
  enum result result = slab_resample(finest, samples, &coarse, error);
  if (result != RESULT_OK) return result;
  for (size_t n = 0; n < slab_sample_count(finest); ++n) {
    double place[SLAB_AXES], rgb[3], luminance = slab_luminance(finest->rgb + 3 * n);
    slab_locate(finest, n, at);
    for (int axis = 0; axis < SLAB_AXES; ++axis)
      place[axis] = slab_position(finest, axis, at[axis]);
    slab_lookup(&coarse, place[0], place[1], place[2], place[3], rgb);
    double difference = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2] - luminance;
    sum += etendue[n] * difference * difference;
    all += etendue[n] * luminance * luminance;
  }
  slab_free(&coarse);
  *square = sum / all;
  return RESULT_OK;
}

/* What the finest samples lose, by the blur of half of them and of a quarter. Its square grows
 * twofold with a halving at edges, and 16 times where light is smooth. */
static double left_over(double half, double quarter) {
  double ratio = isfinite(quarter) ? (quarter - half) / half : 2;
  return half > 0 ? half / (fmin(fmax(ratio, 2), 16) - 1) : 0;
}

static enum result find_blurs(const struct ray_estimate *estimate, const struct slab *finest,
                              struct blurs *blurs, struct error *error) {
  double *etendue = ray_etendue(finest), (*square)[MOST_HALVINGS + 1] = blurs->square;
  enum result result = etendue ? RESULT_OK : result_no_memory(error);
  for (int n = 0; n < GRIDS && result == RESULT_OK; ++n) {
    int uv = n / (MOST_HALVINGS + 1), st = n % (MOST_HALVINGS + 1), halvings[SLAB_AXES];
    find_halvings(uv, st, halvings);
    square[uv][st] = n ? INFINITY : 0;
    if (n && ray_bins_halves(&estimate->bins, halvings))
      result = find_blur(finest, etendue, halvings, &square[uv][st], error);
  }
  free(etendue);
  if (result != RESULT_OK) return result;
  double left = 0;
  if (isfinite(square[1][0])) left += left_over(square[1][0], square[2][0]);
  if (isfinite(square[0][1])) left += left_over(square[0][1], square[0][2]);
  for (int n = 0; n < GRIDS; ++n) square[n / (MOST_HALVINGS + 1)][n % (MOST_HALVINGS + 1)] += left;
  return RESULT_OK;
}

/* ---- Step 3 ---- */

/* The best slab so far, and what it tells. */
struct best {
  struct slab slab;
  struct ray_estimate_told told;
};

static void tell_blur(double square, struct ray_estimate_told *told) {
  told->blur = sqrt(square);
  told->error = hypot(told->noise, told->blur);
}

static enum result try_grid(const struct ray_estimate *estimate, int uv, int st, double blur,
                            struct best *one, struct error *error) {
  int halvings[SLAB_AXES];
  struct ray_bins bins;
  find_halvings(uv, st, halvings);
  enum result result = ray_bins_coarser(&estimate->bins, halvings, &bins, error);
  if (result != RESULT_OK) return result;
  result = ray_samples(&bins, estimate->whole, &one->slab, &one->told, error);
  ray_bins_free(&bins);
  if (result == RESULT_OK) tell_blur(blur, &one->told);
  return result;
}

/* `best` is the finest grid's. */
static enum result coarsen(const struct ray_estimate *estimate, struct best *best,
                           struct error *error) {
  /* halvings of uv and st, from the fewest samples to the most */
  static const int order[GRIDS - 1][2] = {{2, 2}, {2, 1}, {1, 2}, {2, 0},
                                          {1, 1}, {0, 2}, {1, 0}, {0, 1}};
  struct blurs blurs = {.square = {{0}}};
  enum result result = find_blurs(estimate, &best->slab, &blurs, error);
  if (result != RESULT_OK) return result;
  tell_blur(blurs.square[0][0], &best->told);
  bool met = false;
  for (int n = 0; n < GRIDS - 1 && !met && result == RESULT_OK; ++n) {
    double blur = blurs.square[order[n][0]][order[n][1]];
    struct best one = {0};
    if (!(sqrt(blur) < fmax(best->told.error, estimate->tolerance))) continue;
    result = try_grid(estimate, order[n][0], order[n][1], blur, &one, error);
    if (result != RESULT_OK) break;
    met = one.told.error <= estimate->tolerance;
    if (met || one.told.error < best->told.error) {
      slab_free(&best->slab);
      *best = one;
    } else {
      slab_free(&one.slab);
    }
  }
  return result;
}

enum result ray_estimate_finish(struct ray_estimate *estimate, struct slab *slab,
                                struct ray_estimate_told *told, struct error *error) {
  struct best best = {0};
  enum result result = ray_samples(&estimate->bins, estimate->whole, &best.slab, &best.told, error);
  if (result != RESULT_OK) return result;
  if (estimate->tolerance > 0 && estimate->bins.rays > 0) result = coarsen(estimate, &best, error);
  if (result != RESULT_OK) {
    slab_free(&best.slab);
    return result;
  }
  *slab = best.slab;
  *told = best.told;
  return RESULT_OK;
}
