/* rebin.c
 *
 * 1. Splat: a ray adds its radiance to the 16 samples around it, by the weights that they have in
 *    the interpolation at its place; a sample is the weighted mean of what it got.
 * 2. Fill what no ray touched (rebin_levels.h).
 * 3. Such means blur, and lean to the side on which rays happen to lie. So interpolate the samples
 *    at each ray, rebin by how much the ray is brighter than that, and multiply by it. Repeated,
 *    this tends to the samples whose interpolation tells the rays best; they stay positive, and
 *    keep the rays' light, which adding the differences and cutting off what is negative does not
 *    (the iteration of W. H. Richardson, J. Opt. Soc. Am. 62, 1972, and L. B. Lucy, Astron. J. 79,
 *    1974).
 * 4. Where rays are few or noisy, to fit them best is not the truth. So first leave out the rays
 *    of every 8th source, and see after how many rounds these are told best; then do that with all
 *    rays. What was left out also tells the error. */
#include "import/pictures/rebin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/pictures/rebin_levels.h"

enum { CORNERS = 16, PATIENCE = 3 }; /* rounds that may be worse before the search ends */

struct work {
  const struct rebin_ray *rays;
  size_t count, nodes;
  struct rebin_levels levels;
  float *value; /* rgb of the nodes of level 0, so far */
  double *sums; /* of each source: by weight, what is wrong and what there is */
  uint32_t sources;
  bool *held_out;        /* of each source */
  bool leave_out, first; /* first: nothing is known yet */
};

/* Marks the last of every few sources that have rays; none of a single one. */
static void hold_out(struct work *work) {
  uint32_t found = 0, number = 0;
  for (size_t k = 0; k < work->count; ++k) work->held_out[work->rays[k].source] = true;
  for (uint32_t k = 0; k < work->sources; ++k) found += work->held_out[k];
  uint32_t period = found < REBIN_HELD_OUT ? found : REBIN_HELD_OUT;
  for (uint32_t k = 0; k < work->sources; ++k)
    if (work->held_out[k]) work->held_out[k] = ++number % period == 0 && found > 1;
}

/* The nodes around a ray, and their weights in the interpolation; constant in border cells. */
static void find_corners(const int size[SLAB_AXES], const struct rebin_ray *ray,
                         size_t node[CORNERS], float weight[CORNERS]) {
  node[0] = 0;
  weight[0] = 1;
  for (int axis = 0, count = 1; axis < SLAB_AXES; ++axis, count *= 2) {
    float last = (float)(size[axis] - 1), at = fminf(fmaxf(ray->at[axis], 0), last);
    int low = (int)at;
    float share = at - (float)low;
    int high = low + (low + 1 < size[axis]);
    for (int c = 0; c < count; ++c) {
      size_t before = node[c] * (size_t)size[axis];
      node[c + count] = before + (size_t)high;
      weight[c + count] = weight[c] * share;
      node[c] = before + (size_t)low;
      weight[c] *= 1 - share;
    }
  }
}

static void interpolate(const struct work *work, const size_t node[CORNERS],
                        const float weight[CORNERS], float rgb[3]) {
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int n = 0; n < CORNERS; ++n)
    for (size_t c = 0; c < 3; ++c) rgb[c] += weight[n] * work->value[3 * node[n] + c];
}

/* The radiance of each ray, and after the first round by how much it is that of the values there,
 * splatted into level 0. */
static void splat(struct work *work) {
  float *level = work->levels.node[0];
  memset(level, 0, work->nodes * REBIN_NODE * sizeof *level);
  for (size_t k = 0; k < work->count; ++k) {
    const struct rebin_ray *ray = &work->rays[k];
    size_t node[CORNERS];
    float weight[CORNERS], rgb[3], told[3];
    if (work->leave_out && work->held_out[ray->source]) continue;
    find_corners(work->levels.size[0], ray, node, weight);
    interpolate(work, node, weight, rgb);
    for (int c = 0; c < 3; ++c)
      told[c] = work->first ? ray->rgb[c] : rgb[c] > 0 ? ray->rgb[c] / rgb[c] : 1;
    for (int n = 0; n < CORNERS; ++n) {
      float *to = level + REBIN_NODE * node[n];
      for (int c = 0; c < 3; ++c) to[c] += weight[n] * told[c];
      to[3] += weight[n];
    }
  }
}

static void do_round(struct work *work) {
  splat(work);
  rebin_levels_fill(&work->levels);
  for (size_t n = 0; n < work->nodes; ++n)
    for (size_t c = 0; c < 3; ++c) {
      float filled = work->levels.node[0][REBIN_NODE * n + c], *value = &work->value[3 * n + c];
      *value = work->first ? filled : *value * filled;
    }
  work->first = false;
}

/* How well the rays that were held out are told. */
static void judge(struct work *work, struct rebin_report *report) {
  double wrong = 0, all = 0, wrong_means = 0, means = 0;
  memset(work->sums, 0, 2 * (size_t)work->sources * sizeof *work->sums);
  for (size_t k = 0; k < work->count; ++k) {
    const struct rebin_ray *ray = &work->rays[k];
    size_t node[CORNERS];
    float weight[CORNERS], rgb[3];
    if (!work->held_out[ray->source]) continue;
    find_corners(work->levels.size[0], ray, node, weight);
    interpolate(work, node, weight, rgb);
    double truth = slab_luminance(ray->rgb), off = slab_luminance(rgb) - truth;
    double flux = (double)ray->weight;
    wrong += flux * off * off;
    all += flux * truth * truth;
    work->sums[2 * ray->source] += flux * off;
    work->sums[2 * ray->source + 1] += flux * truth;
  }
  for (size_t k = 0; k < work->sources; ++k) {
    wrong_means += work->sums[2 * k] * work->sums[2 * k];
    means += work->sums[2 * k + 1] * work->sums[2 * k + 1];
  }
  report->error = all > 0 ? sqrt(wrong / all) : NAN;
  report->mean_error = means > 0 ? sqrt(wrong_means / means) : NAN;
}

static void restart(struct work *work) {
  memset(work->value, 0, 3 * work->nodes * sizeof *work->value);
  work->first = true;
}

/* Finds the number of rounds, and leaves the errors. */
static void choose_rounds(struct work *work, struct rebin_report *report) {
  work->leave_out = true;
  restart(work);
  for (int round = 1; round <= REBIN_ROUNDS && round <= report->rounds + PATIENCE; ++round) {
    struct rebin_report told = {.rounds = round};
    do_round(work);
    judge(work, &told);
    if (round == 1 || told.error < report->error) *report = told;
  }
  work->leave_out = false;
}

/* Copies the values into the slab's raster, and says which samples rays touch. */
static void deliver(struct work *work, struct slab *slab, bool *known) {
  const int *size = slab->samples;
  int at[SLAB_AXES];
  size_t n = 0;
  splat(work); /* for its weights */
  for (at[0] = 0; at[0] < size[0]; ++at[0])
    for (at[1] = 0; at[1] < size[1]; ++at[1])
      for (at[2] = 0; at[2] < size[2]; ++at[2])
        for (at[3] = 0; at[3] < size[3]; ++at[3], ++n) {
          float *rgb = slab_at(slab, at[0], at[1], at[2], at[3]);
          memcpy(rgb, work->value + 3 * n, 3 * sizeof *rgb);
          if (known) known[(rgb - slab->rgb) / 3] = work->levels.node[0][REBIN_NODE * n + 3] > 0;
        }
}

enum result rebin(const struct rebin_ray *rays, size_t count, struct slab *slab, bool *known,
                  struct rebin_report *report, struct error *error) {
  struct work work = {.rays = rays, .count = count};
  *report = (struct rebin_report){.error = NAN, .mean_error = NAN};
  for (size_t k = 0; k < count; ++k)
    if (rays[k].source >= work.sources) work.sources = rays[k].source + 1;
  enum result result = rebin_levels_make(slab->samples, &work.levels, error);
  if (result == RESULT_OK) {
    work.nodes = rebin_levels_nodes(&work.levels, 0);
    work.value = calloc(work.nodes, 3 * sizeof *work.value);
    work.sums = calloc(2 * (size_t)work.sources + 1, sizeof *work.sums);
    work.held_out = calloc((size_t)work.sources + 1, sizeof *work.held_out);
    if (!work.value || !work.sums || !work.held_out) result = result_no_memory(error);
  }
  if (result == RESULT_OK) {
    hold_out(&work);
    choose_rounds(&work, report);
  }
  if (result == RESULT_OK && slab->rgb) {
    restart(&work);
    for (int round = 0; round < report->rounds; ++round) do_round(&work);
    deliver(&work, slab, known);
  }
  rebin_levels_free(&work.levels);
  free(work.value);
  free(work.sums);
  free(work.held_out);
  return result;
}
