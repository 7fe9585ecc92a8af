/* test_counts.c - how much work a receiver is: the micro lights that are visited, against the
 * paper's bound (section 4.1) and a count by exact rationals. */
#include <math.h>

#include "helpers.h"
#include "oracle/exact.h"

static const double window[4] = {-0.7, 1.1, -0.9, 0.6};
static const int sizes[] = {4, 7, 8, 16, 31, 32, 64};
enum { SIZES = sizeof sizes / sizeof sizes[0], EACH = 12 };

static struct gather_counts count(const struct light *light, enum gather_method method,
                                  const struct receiver *receiver) {
  struct gathered gathered;
  const struct gather_settings settings = {
      .lights = light, .light_count = 1, .method = method, .tolerance = 1e-3, .level = -1};
  return sum_light(&settings, receiver, 1, &gathered);
}

/* Pieces of the aperture between the lines of its samples and those of the window, as seen from p:
 * the micro lights. */
static uint64_t visible(const struct slab *slab, const double p[3]) {
  static struct oracle_axis axes[2];
  for (int axis = 0; axis < 2; ++axis) oracle_axis_find(slab, p, axis, &axes[axis]);
  return (uint64_t)axes[0].count * (uint64_t)axes[1].count;
}

/* ---- Counts. */

struct tally {
  int seen, unseen;
  double worst; /* share of the bound */
};

static void hold(const struct slab *slab, uint64_t seed, struct tally *tally) {
  struct light light = load_light(slab, 1);
  const int *n = slab->samples;
  uint64_t bound = (uint64_t)(n[SLAB_U] + n[SLAB_S] + 1) * (uint64_t)(n[SLAB_V] + n[SLAB_T] + 1);
  for (int k = 0; k < EACH; ++k) {
    double z = random_log(&seed, 0.05, 50);
    struct surfel aimed = aimed_receiver(slab, z, RECEIVER_FACING, &seed);
    struct receiver receiver = receiver_at(&aimed);
    uint64_t expected = visible(slab, aimed.p);
    assert_true(expected <= bound);
    struct gather_counts pi = count(&light, GATHER_PI, &receiver);
    assert_int_equal(pi.microlights, expected);
    assert_int_equal(pi.nodes, expected);
    assert_int_equal(pi.pages_behind, expected == 0);
    /* At this tolerance no micro light is split. */
    assert_int_equal(count(&light, GATHER_REFERENCE, &receiver).microlights, expected);
    assert_int_equal(count(&light, GATHER_PAPER, &receiver).microlights, expected);
    ++*(expected > 0 ? &tally->seen : &tally->unseen);
    tally->worst = fmax(tally->worst, (double)expected / (double)bound);
  }
  light_free(&light);
}

/* Along u and s the sizes; along v and t few samples, so that the slab stays small; and the
 * other way round. */
TEST(test_axes) {
  struct tally tally = {0};
  for (int k = 0; k < 2 * SIZES * SIZES; ++k) {
    int uv = sizes[k / 2 % SIZES], st = sizes[k / 2 / SIZES];
    const int along_u[SLAB_AXES] = {uv, 3, st, 4}, along_v[SLAB_AXES] = {3, uv, 4, st};
    for (int far = 0; far < 2; ++far) {
      struct slab slab = rough_slab(k % 2 ? along_v : along_u, far ? INFINITY : 0.8, window,
                                    FRAME_TURNED, FILL_UNIFORM, (uint64_t)k);
      hold(&slab, (uint64_t)(2 * k + far), &tally);
      slab_free(&slab);
    }
  }
  print_message("%d receivers, %d see nothing; at most %.3f of the bound\n",
                tally.seen + tally.unseen, tally.unseen, tally.worst);
  assert_true(tally.seen > 9 * tally.unseen);
}

TEST(test_all_axes) {
  static const int grids[][SLAB_AXES] = {{4, 4, 4, 4}, {8, 8, 16, 16}, {16, 16, 32, 32}};
  struct tally tally = {0};
  for (int g = 0; g < 3; ++g)
    for (int far = 0; far < 2; ++far) {
      struct slab slab = rough_slab(grids[g], far ? INFINITY : 2, window, FRAME_MIRRORED,
                                    FILL_UNIFORM, (uint64_t)g);
      hold(&slab, (uint64_t)(500 + 2 * g + far), &tally);
      slab_free(&slab);
    }
  assert_true(tally.seen > 0);
}

/* ---- Pages that are skipped. */

TEST(test_skipped) {
  static const int samples[SLAB_AXES] = {6, 6, 8, 8};
  struct slab slab = rough_slab(samples, INFINITY, window, FRAME_PLAIN, FILL_UNIFORM, 1);
  struct light light = load_light(&slab, 1);
  static const struct receiver skipped[] = {
      {.position = {0.1, 0.1, -1}, .normal = {0, 0, 1}},     /* behind the aperture */
      {.position = {0.1, 0.1, 1}, .normal = {0, 0, 1}},      /* turned away from it */
      {.position = {4, 0.1, 1}, .normal = {0, 0, -1}},       /* beside the window */
      {.position = {0.1, 0.1, 1}, .normal = {0, 0.6, 0.8}}}; /* all below its tangent plane */
  for (int method = GATHER_AUTO; method < GATHER_METHODS; ++method) {
    if (gather_methods[method].makes == METHOD_LEVELS) continue;
    for (size_t k = 0; k < sizeof skipped / sizeof skipped[0]; ++k) {
      struct gather_counts counts = count(&light, (enum gather_method)method, &skipped[k]);
      assert_int_equal(counts.pages_behind, 1);
      assert_int_equal(counts.microlights, 0);
      assert_int_equal(counts.nodes, 0);
    }
  }
  light_free(&light);
  slab_free(&slab);
}

/* Two pages back to back: every receiver sees one. */
TEST(test_back_to_back) {
  static const int samples[SLAB_AXES] = {6, 6, 8, 8};
  struct slab slabs[2];
  for (int k = 0; k < 2; ++k)
    slabs[k] = rough_slab(samples, INFINITY, window, FRAME_PLAIN, FILL_UNIFORM, (uint64_t)k);
  for (int c = 0; c < 3; ++c) slabs[1].normal[c] = -slabs[0].normal[c];
  struct light light = load_light(slabs, 2);
  for (int side = 0; side < 2; ++side) {
    struct receiver receiver = {.position = {0.1, 0.1, side ? -1 : 1},
                                .normal = {0, 0, side ? 1 : -1}};
    struct gather_counts counts = count(&light, GATHER_PI, &receiver);
    assert_int_equal(counts.pages_behind, 1);
    assert_int_equal(counts.microlights, visible(&slabs[side], receiver.position));
    assert_true(counts.microlights > 0);
  }
  light_free(&light);
  for (int k = 0; k < 2; ++k) slab_free(&slabs[k]);
}

int main(void) {
  return testing_run(NULL, NULL);
}
