/* bake_cut.c - how a round is cut into batches, whoever renders them; see bake_plan.h.
 *
 * Each batch takes a part of what is left, within bounds, so that they get smaller and many
 * processes end together (guided self-scheduling: Polychronopoulos and Kuck, IEEE Transactions on
 * Computers C-36, 1987). The least are about alike, and their number is a multiple of BATCH_EVEN,
 * for a few processes to end together; less than two of them, but more than HALVED, is cut in two.
 *
 * A POV-Ray process costs 0.03 CPU seconds whatever it renders, which is some 1 % of the least
 * batch of a usual lamp. With interreflection or photons (dear) it costs as much as a million rays,
 * which it takes to sample those anew: then the least are as large as the others' largest, but
 * that a round of two of them is cut in four all the same.
 *
 * Costs are in rays; a camera costs some too, since POV-Ray finds a mesh camera's face by a linear
 * search through the meshes. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_plan.h"

enum {
  LEAST_COST = 1 << 19,
  LEAST_COST_FEW = 1 << 20, /* of a small round, which few processes render */
  MOST_COST = 1 << 21,
  LEAST_COST_DEAR = 1 << 21,
  MOST_COST_DEAR = 1 << 22,
  BATCH_PART = 64, /* of what is left */
  HALVED = 1 << 16,
  CAMERA_COST = 256,
  BATCH_EVEN = 4,
  BATCH_FRAMES = 512
};

static size_t batch_cost(const struct bake_batch *batch) {
  return batch->rays + CAMERA_COST * batch->count;
}

/* Of the batches of a round of so much. */
static size_t least_cost(size_t round, bool dear) {
  if (dear) return LEAST_COST_DEAR;
  return round < (size_t)BATCH_PART * LEAST_COST_FEW ? LEAST_COST_FEW : LEAST_COST;
}

/* The cost of a batch when so much is left; of batches that get smaller. */
static size_t part_cost(size_t left, bool dear) {
  size_t most = dear ? MOST_COST_DEAR : MOST_COST, part = left / BATCH_PART;
  return part < most ? part : most;
}

/* The batches alike that so much is cut into. */
static size_t cut(size_t cost, size_t least, bool dear) {
  size_t batches = (cost + least - 1) / least;
  if (batches > 2 || (batches > 1 && dear))
    return (batches + BATCH_EVEN - 1) / BATCH_EVEN * BATCH_EVEN;
  return cost > HALVED && !dear ? 2 : batches;
}

/* What is left of a round, and the cost at which the next batch is full. */
struct cutter {
  size_t left, full, least;
  bool dear, even; /* only batches alike are left */
};

static void next_cut(struct cutter *cutter) {
  size_t part = part_cost(cutter->left, cutter->dear);
  if (cutter->even) return;
  cutter->even = part <= cutter->least;
  size_t batches = cutter->even ? cut(cutter->left, cutter->least, cutter->dear) : 0;
  cutter->full = !cutter->even ? part : batches ? (cutter->left + batches - 1) / batches : 1;
}

static size_t round_cost(const struct bake_round *round) {
  struct bake_batch all = {.count = round->unit_count};
  for (size_t unit = 0; unit < round->unit_count; ++unit)
    all.rays += (size_t)bake_box_rays(&round->boxes[round->units[unit].box]);
  return batch_cost(&all);
}

/* Whether a unit may join the batch. Frames of an animation are all of one shape. */
static bool fits(const struct bake_round *round, const struct bake_batch *batch, size_t unit,
                 enum bake_form form, size_t full) {
  const struct bake_box *box = &round->boxes[round->units[unit].box];
  const struct bake_box *first = &round->boxes[round->units[batch->first].box];
  bool second_of_pair =
      round->units[unit].pass % 2 == 1 && round->units[unit - 1].box == round->units[unit].box;
  if (second_of_pair) return true;
  bool same_shape = !memcmp(box->size, first->size, sizeof box->size);
  if (box->page / round->apertures != first->page / round->apertures) return false;
  if (form != BAKE_MESH && (batch->count >= BATCH_FRAMES || !same_shape)) return false;
  return batch_cost(batch) < full;
}

enum result bake_plan_cut(const struct bake_tiles *tiles, struct bake_round *round,
                          enum bake_form form, struct error *error) {
  size_t cost = round_cost(round);
  struct cutter cutter = {
      .left = cost, .least = least_cost(cost, tiles->dear), .dear = tiles->dear};
  round->batches = malloc((round->unit_count + 1) * sizeof *round->batches); /* at most */
  if (!round->batches) return result_no_memory(error);
  struct bake_batch *last = round->batches;
  for (size_t unit = 0; unit < round->unit_count; ++unit) {
    if (unit == 0 || !fits(round, last, unit, form, cutter.full)) {
      if (unit > 0) cutter.left -= batch_cost(last);
      next_cut(&cutter);
      last = &round->batches[round->batch_count++];
      *last = (struct bake_batch){.first = unit};
    }
    ++last->count;
    last->rays += (size_t)bake_box_rays(&round->boxes[round->units[unit].box]);
  }
  return RESULT_OK;
}

static double parts(int samples) {
  return ceil((double)samples / BAKE_MESH_SIDE);
}

/* The batches of a round of so much. */
static double count_batches(size_t left, bool dear) {
  size_t count = 0, most = part_cost(SIZE_MAX, dear), least = least_cost(left, dear);
  if (left / BATCH_PART > most) { /* the largest at once */
    count = (left - BATCH_PART * most + most - 1) / most;
    left -= count * most;
  }
  for (size_t part; (part = part_cost(left, dear)) > least; left -= part) ++count;
  return (double)(count + cut(left, least, dear));
}

void bake_plan_count(const struct slab *slabs, int pages, int passes, enum bake_form form,
                     bool dear, struct bake_plan_size *size) {
  double cameras = 0, rays = 0;
  for (int page = 0; page < pages; ++page) {
    const int *n = slabs[page].samples;
    double positions = (double)n[SLAB_U] * n[SLAB_V], directions = (double)n[SLAB_S] * n[SLAB_T];
    rays += passes * positions * directions;
    cameras += passes * (form == BAKE_TRANSPOSED ? directions : positions) *
               (form == BAKE_MESH ? parts(n[SLAB_S]) * parts(n[SLAB_T]) : 1);
  }
  size_t cost = (size_t)(rays + CAMERA_COST * cameras);
  size->frames = form == BAKE_MESH ? 0 : cameras;
  size->batches = fmax(count_batches(cost, dear), ceil(size->frames / BATCH_FRAMES));
  size_t part = part_cost(cost, dear);
  bool alike = part <= least_cost(cost, dear);
  size->largest = rays / size->batches;
  if (!alike) size->largest = fmax(size->largest, (double)part * rays / (double)cost);
  if (form != BAKE_MESH) size->largest = fmin(size->largest, BATCH_FRAMES * rays / cameras);
}
