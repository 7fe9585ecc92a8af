/* test_bake_cut.c - how rounds are cut into batches: each image once and in order, batches that
 * never grow, none that is more than its part of what is left, unless that is too little to be
 * worth a process; few of a small round. */
#include <math.h>

#include "batch/bake_plan.h"
#include "helpers.h"

/* Rays of the two images of a pair, by which a batch may be larger than was meant. */
enum { PAIR = 2 * 64 * 64 };

/* The least and most rays of batches in a large round, by lamps without and with interreflection.
 */
static const double least[2] = {0x1p19, 0x1p21}, most[2] = {0x1p21, 0x1p22};

static void cut(int positions, int passes, bool dear, struct bake_round *round) {
  const struct slab slab = {.st_distance = INFINITY, .samples = {positions, positions, 64, 64}};
  struct bake_tiles tiles;
  assert_int_equal(bake_tiles_init(&tiles, &slab, 1, false, 16, NULL), RESULT_OK);
  tiles.dear = dear;
  assert_int_equal(bake_plan_whole(&tiles, 0, passes, BAKE_MESH, round, NULL), RESULT_OK);
  bake_tiles_free(&tiles);
}

/* Batches that follow each other and hold all images: the rays of all. */
static double count_rays(const struct bake_round *round) {
  double rays = 0;
  size_t unit = 0;
  for (size_t n = 0; n < round->batch_count; unit += round->batches[n++].count) {
    assert_int_equal(round->batches[n].first, unit);
    rays += (double)round->batches[n].rays;
  }
  assert_int_equal(unit, round->unit_count);
  return rays;
}

TEST(test_smaller_towards_the_end) {
  for (int dear = 0; dear < 2; ++dear) {
    struct bake_round round;
    cut(48, 60, dear, &round);
    double left = count_rays(&round), last = (double)round.batches[0].rays;
    assert_true(left == 48.0 * 48 * 64 * 64 * 60);
    assert_true(last > 0.9 * most[dear] && last <= most[dear]);
    for (size_t n = 0; n < round.batch_count; ++n) {
      double rays = (double)round.batches[n].rays;
      assert_true(rays <= last + PAIR);
      assert_true(rays <= fmax(left / 64, least[dear]) + PAIR);
      assert_true(rays >= 0.8 * least[dear] || n + 1 == round.batch_count);
      left -= last = rays;
    }
    bake_round_free(&round);
  }
}

/* Of a small round all are alike, and their number is a multiple of four. */
TEST(test_small_rounds) {
  static const size_t counts[2] = {8, 4};
  for (int dear = 0; dear < 2; ++dear) {
    struct bake_round round;
    cut(16, 4, dear, &round);
    assert_true(count_rays(&round) == 16.0 * 16 * 64 * 64 * 4);
    assert_int_equal(round.batch_count, counts[dear]);
    for (size_t n = 0; n < round.batch_count; ++n)
      assert_int_equal(round.batches[n].rays, round.batches[0].rays);
    bake_round_free(&round);
    cut(4, 4, dear, &round); /* a quarter of a million rays */
    assert_int_equal(round.batch_count, dear ? 1 : 2);
    bake_round_free(&round);
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
