/* test_bake_search.c - what the search of an adaptive bake finds: every beam that is a sample wide
 * along all axes, wherever it lies; of thinner ones the part that they fill; and that the bake then
 * looks at all of what surrounds them. The rays' places are the test's own: those that bake_rays.h
 * promises, without POV-Ray. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_grow.h"
#include "helpers.h"
#include "oracle/random.h"

enum { PLACES = 200 };
static const int samples[SLAB_AXES] = {6, 5, 24, 16};

/* A box of light, in samples from the slab's lower ends. */
struct beam {
  double low[SLAB_AXES], high[SLAB_AXES];
};

static bool holds(const struct beam *beam, const double at[SLAB_AXES]) {
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    if (!(at[axis] >= beam->low[axis] && at[axis] < beam->high[axis])) return false;
  return true;
}

/* Adds a round to the sum, of a lamp that consists of beams. Returns how many rays met light. */
static int shoot(const struct bake_round *round, const struct beam *beams, int count,
                 struct bake_sum *sum) {
  int met = 0;
  for (size_t n = 0; n < round->batch_count; ++n) {
    const struct bake_batch *batch = &round->batches[n];
    float *rgb = calloc(3 * batch->rays, sizeof *rgb), *to = rgb;
    for (size_t unit = batch->first; unit < batch->first + batch->count; ++unit) {
      const struct bake_box *box = &round->boxes[round->units[unit].box];
      double offset[SLAB_AXES];
      bake_offset(BAKE_OWN, box, round->units[unit].pass, offset);
      for (int ray = 0; ray < bake_box_rays(box); ++ray, to += 3) {
        /* A camera covers s and t here. */
        int s = ray % box->size[SLAB_S], t = ray / box->size[SLAB_S];
        const int index[SLAB_AXES] = {box->first[SLAB_U], box->first[SLAB_V],
                                      box->first[SLAB_S] + s, box->first[SLAB_T] + t};
        double at[SLAB_AXES];
        bool lit = false;
        for (int axis = 0; axis < SLAB_AXES; ++axis) at[axis] = index[axis] + 0.5 + offset[axis];
        for (int k = 0; k < count; ++k) lit |= holds(&beams[k], at);
        for (int c = 0; c < 3; ++c) to[c] = lit;
        met += lit;
      }
    }
    bake_sum_add(sum, round, batch, rgb);
    free(rgb);
  }
  return met;
}

struct search {
  struct slab slab;
  struct bake_tiles tiles;
  struct bake_sum *sum;
  int *passes;
};

/* The first round of a bake. Returns how many of its rays met light. */
static int search_start(struct search *search, const struct beam *beams, int count) {
  struct bake_round round;
  memset(search, 0, sizeof *search);
  search->slab = (struct slab){.u = {1, 0, 0},
                               .v = {0, 1, 0},
                               .normal = {0, 0, 1},
                               .st_window = {-1, 1, -1, 1},
                               .st_distance = INFINITY};
  memcpy(search->slab.samples, samples, sizeof samples);
  assert_int_equal(bake_tiles_init(&search->tiles, &search->slab, 1, false, 8, NULL), RESULT_OK);
  assert_int_equal(bake_sum_new(&search->tiles, 16, &search->sum, NULL), RESULT_OK);
  search->passes = calloc((size_t)bake_tile_count(&search->tiles), sizeof *search->passes);
  assert_int_equal(
      bake_plan_whole(&search->tiles, BAKE_SEARCH, BAKE_SEARCH + 1, BAKE_MESH, &round, NULL),
      RESULT_OK);
  int met = shoot(&round, beams, count, search->sum);
  bake_round_free(&round);
  return met;
}

static void search_end(struct search *search) {
  bake_sum_free(search->sum);
  bake_tiles_free(&search->tiles);
  free(search->passes);
}

/* A beam of those widths somewhere inside the slab. */
static struct beam random_beam(const double width[SLAB_AXES], uint64_t *seed) {
  struct beam beam;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    beam.low[axis] = random_between(seed, 0, samples[axis] - width[axis]);
    beam.high[axis] = beam.low[axis] + width[axis];
  }
  return beam;
}

/* By one ray, no more and no less. */
TEST(test_a_sample_wide) {
  static const double width[SLAB_AXES] = {1, 1, 1, 1};
  uint64_t seed = 1;
  for (int n = 0; n < PLACES; ++n) {
    struct search search;
    struct beam beam = random_beam(width, &seed);
    assert_int_equal(search_start(&search, &beam, 1), 1);
    assert_true(bake_grow(&search.tiles, search.sum, 4, search.passes) > 0);
    search_end(&search);
  }
}

/* A quarter of a sample is found one time in four: what a search may miss. */
TEST(test_a_quarter_wide) {
  static const double width[SLAB_AXES] = {1, 1, 0.5, 0.5};
  uint64_t seed = 2;
  int found = 0;
  for (int n = 0; n < PLACES; ++n) {
    struct search search;
    struct beam beam = random_beam(width, &seed);
    found += search_start(&search, &beam, 1);
    search_end(&search);
  }
  print_message("# %d of %d\n", found, PLACES);
  assert_true(fabs(found - 0.25 * PLACES) < 4 * sqrt(PLACES * 0.25 * 0.75));
}

/* Of a long thin beam, a part of which was found, the rest is too: all that it lights gets rays. */
TEST(test_growth) {
  struct beam beam = {{0.3, 1.2, 1.2, 5.4}, {5.8, 1.9, 23.1, 5.7}}; /* thin along v and t */
  struct search search;
  struct bake_round round;
  int met = search_start(&search, &beam, 1), count = bake_tile_count(&search.tiles);
  int *done = calloc((size_t)count, sizeof *done);
  print_message("# %d rays of the search met it\n", met);
  while (bake_grow(&search.tiles, search.sum, 4, search.passes) > 0) {
    assert_int_equal(bake_plan_rest(&search.tiles, done, search.passes, BAKE_MESH, &round, NULL),
                     RESULT_OK);
    shoot(&round, &beam, 1, search.sum);
    bake_round_free(&round);
    memcpy(done, search.passes, (size_t)count * sizeof *done);
  }
  for (int u = 0; u < 6; ++u)
    for (int s = 1; s < 23; ++s)
      assert_int_equal(search.passes[bake_tile_at(&search.tiles, 0, (int[]){u, 1, s, 5})], 4);
  free(done);
  search_end(&search);
}

/* Light that lies together is a beam; what single rays meet far from one another may be chance. */
TEST(test_beams_or_chance) {
  struct search search;
  struct beam beams[40] = {{{0, 0, 2.1, 3.2}, {6, 5, 5.4, 7.9}}};
  uint64_t seed = 3;
  static const double width[SLAB_AXES] = {1, 1, 0.3, 0.3};
  search_start(&search, beams, 1);
  assert_true(bake_grow_has_beams(&search.tiles, search.sum));
  search_end(&search);
  for (int n = 0; n < 40; ++n) beams[n] = random_beam(width, &seed);
  assert_true(search_start(&search, beams, 40) > 0);
  assert_false(bake_grow_has_beams(&search.tiles, search.sum));
  search_end(&search);
}

int main(void) {
  return testing_run(NULL, NULL);
}
