/* test_cut.c - the method cut against the reference: errors within the tolerance for lamps that
 * are smooth, have thin peaks or sharp edges, wherever the receivers are; what it costs;
 * where it gives way to micro lights. */
#include <string.h>

#include "base/vector.h"
#include "cut/cut.h"
#include "cut/cut_views.h"
#include "helpers.h"

enum { COUNT = 1000 };
static const double slope = 1.5; /* of the window's edges */

enum lamp { SMOOTH, PEAKS, EDGES, CONSTANT, LAMPS };

static double radiance(enum lamp lamp, const double at[4]) {
  double s = at[2] - at[0], t = at[3] - at[1] - 0.3;
  switch (lamp) {
  case SMOOTH:
    return exp(-2 * (at[2] * at[2] + at[3] * at[3]));
  case PEAKS:
    return exp(-200 * (s * s + t * t));
  case EDGES:
    return at[0] > 0.1 && at[2] < 0.2;
  default:
    return 1;
  }
}

/* One page along z at the origin, with an aperture of 1 x 1. */
struct lit {
  struct light light;
  struct gather_prepared prepared;
};

static void prepare(struct lit *lit, int threads) {
  struct error error;
  assert_int_equal(gather_prepare(&lit->light, 1, GATHER_CUT, 0, threads, &lit->prepared, &error),
                   RESULT_OK);
}

static void make(struct lit *lit, enum lamp lamp, const int samples[SLAB_AXES], double distance,
                 int threads) {
  static const double tint[3] = {1, 0.8, 0.3}, window[4] = {-slope, slope, -slope, slope};
  struct slab slab = rough_slab(samples, distance, window, FRAME_PLAIN, FILL_CONSTANT, 0);
  for (size_t p = 0; p < slab_sample_count(&slab); ++p) {
    int index[SLAB_AXES];
    double at[SLAB_AXES];
    slab_locate(&slab, p, index);
    for (int axis = 0; axis < SLAB_AXES; ++axis) at[axis] = slab_position(&slab, axis, index[axis]);
    double value = radiance(lamp, at);
    for (size_t c = 0; c < 3; ++c)
      slab.rgb[3 * p + c] = value > 1e-9 ? (float)(tint[c] * value) : 0;
  }
  memset(lit, 0, sizeof *lit);
  lit->light = load_light(&slab, 1);
  slab_free(&slab);
  prepare(lit, threads);
}

static void release(struct lit *lit) {
  gather_prepared_free(&lit->prepared);
  light_free(&lit->light);
}

/* Through a point of the aperture and one of the window or a little beside it, turned towards
 * the lamp more or less. */
static void make_receivers(struct receiver *receivers, int count, double nearest, double farthest,
                           double distance) {
  uint64_t seed = 7;
  for (int k = 0; k < count; ++k) {
    double z = random_log(&seed, nearest, farthest);
    struct surfel at = {{0, 0, z}, {0}};
    for (int c = 0; c < 2; ++c) {
      double a = random_between(&seed, -0.5, 0.5), s = 1.1 * slope * random_between(&seed, -1, 1);
      at.p[c] = s * z - (z / distance - 1) * a;
    }
    for (int c = 0; c < 3; ++c)
      at.n[c] = random_between(&seed, -0.5, 0.5) - at.p[c] / vector_length(at.p);
    vector_normalise(at.n);
    receivers[k] = receiver_at(&at);
    receivers[k].index = (uint64_t)k;
  }
}

static void sum(const struct lit *lit, enum gather_method method, double tolerance,
                const struct receiver *receivers, int count, struct gathered *gathered) {
  const struct gather_settings settings = {.lights = &lit->light,
                                           .light_count = 1,
                                           .prepared = method == GATHER_CUT ? &lit->prepared : NULL,
                                           .method = method,
                                           .tolerance = tolerance,
                                           .level = -1};
  struct gather_counts counts = sum_light(&settings, receivers, count, gathered);
  assert_true(counts.error <= tolerance || method != GATHER_CUT);
}

static double largest(const double rgb[3]) {
  return fmax(fmax(rgb[0], rgb[1]), rgb[2]);
}

/* The largest error, relative as cut.h says, with a floor of 1e-4 of the largest receiver's. */
static double worst_error(const struct gathered *got, const struct gathered *exact, int count) {
  double most = 0, worst = 0;
  for (int k = 0; k < count; ++k) most = fmax(most, largest(exact[k].irradiance));
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < 3; ++c) {
      double off = fabs(got[k].irradiance[c] - exact[k].irradiance[c]);
      if (off != 0) worst = larger(worst, off / fmax(largest(exact[k].irradiance), 1e-4 * most));
    }
  return worst;
}

static const struct scene {
  const char *name;
  double nearest, farthest;
} scenes[] = {{"near", 0.3, 2}, {"office", 4, 30}, {"far", 50, 300}};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

static const int ordinary[SLAB_AXES] = {16, 16, 64, 64}, small[SLAB_AXES] = {8, 8, 32, 32};

/* Nodes a receiver, of those that the cut takes. */
static double nodes(const struct lit *lit, double tolerance, const struct receiver *receivers,
                    int count, int *taken) {
  struct cut_counts counts = {0};
  struct cut_work *work = cut_work_make();
  *taken = 0;
  for (int k = 0; k < count; ++k) {
    struct seen_page seen;
    double irradiance[3];
    assert_true(seen_page_find(&lit->light.pages[0], &receivers[k], &seen));
    if (!cut_sum(lit->prepared.trees[0], &seen, tolerance, work, irradiance, &counts)) continue;
    assert_true(counts.error <= tolerance);
    ++*taken;
  }
  cut_work_free(work);
  return *taken ? (double)counts.nodes / *taken : 0;
}

static void hold_lamps(double distance) {
  struct receiver receivers[COUNT];
  struct gathered exact[COUNT], got[COUNT];
  for (int lamp = SMOOTH; lamp <= EDGES; ++lamp) {
    struct lit lit;
    make(&lit, (enum lamp)lamp, ordinary, distance, 2);
    for (int s = 0; s < SCENES; ++s) {
      make_receivers(receivers, COUNT, scenes[s].nearest, scenes[s].farthest, distance);
      sum(&lit, GATHER_REFERENCE, 1e-7, receivers, COUNT, exact);
      for (int digit = 2; digit <= 3; ++digit) {
        const double tolerance = digit == 2 ? 1e-2 : 1e-3;
        int taken;
        sum(&lit, GATHER_CUT, tolerance, receivers, COUNT, got);
        double worst = worst_error(got, exact, COUNT);
        double each = nodes(&lit, tolerance, receivers, COUNT, &taken);
        print_message("lamp %d %-6s %.0e: %.1e, %.1f nodes for %d of %d\n", lamp, scenes[s].name,
                      tolerance, worst, each, taken, COUNT);
        assert_true(worst <= tolerance);
      }
    }
    release(&lit);
  }
}

TEST(test_tolerance) {
  hold_lamps(INFINITY);
}

TEST(test_tolerance_st_plane) {
  hold_lamps(3);
}

/* Few nodes, and fewer the farther away. (Near the lamp the cut may need many: micro lights
 * would need Gauss rules for this tolerance.) */
TEST(test_work) {
  static const double most[][SCENES] = {{40, 1.1, 1.01}, {40, 6, 3}};
  struct receiver receivers[COUNT];
  for (int lamp = SMOOTH; lamp <= PEAKS; ++lamp) {
    struct lit lit;
    double before = INFINITY;
    make(&lit, (enum lamp)lamp, ordinary, INFINITY, 2);
    for (int s = 0; s < SCENES; ++s) {
      int taken;
      make_receivers(receivers, COUNT, scenes[s].nearest, scenes[s].farthest, INFINITY);
      double each = nodes(&lit, 1e-2, receivers, COUNT, &taken);
      assert_true(each <= most[lamp][s] && each <= 1.2 * before);
      assert_true(s == 0 || taken > COUNT / 2);
      before = each;
    }
    release(&lit);
  }
}

/* Four receivers at once, by the root: the bits of one by one, whoever the others are. */
static int hold_roots(const struct lit *lit, const struct receiver receivers[CUT_ROOTS],
                      struct cut_work *work) {
  struct seen_page seen[CUT_ROOTS];
  struct cut_root roots[CUT_ROOTS];
  int done = 0;
  for (int k = 0; k < CUT_ROOTS; ++k)
    assert_true(seen_page_find(&lit->light.pages[0], &receivers[k], &seen[k]));
  cut_roots(lit->prepared.trees[0], seen, CUT_ROOTS, 1e-2, roots);
  for (int k = 0; k < CUT_ROOTS; ++k) {
    struct cut_counts counts = {0};
    double irradiance[3];
    if (!roots[k].done) continue;
    assert_true(cut_sum(lit->prepared.trees[0], &seen[k], 1e-2, work, irradiance, &counts));
    assert_int_equal(counts.nodes, 1);
    assert_memory_equal(roots[k].irradiance, irradiance, sizeof irradiance);
    assert_true(roots[k].error == counts.error);
    ++done;
  }
  return done;
}

TEST(test_roots) {
  struct receiver receivers[COUNT];
  struct cut_work *work = cut_work_make();
  for (int lamp = SMOOTH; lamp < LAMPS; ++lamp) {
    struct lit lit;
    const double distance = lamp % 2 ? 3 : INFINITY;
    int done = 0;
    make(&lit, (enum lamp)lamp, small, distance, 2);
    make_receivers(receivers, COUNT, 2, 300, distance);
    for (int k = 0; k < COUNT; k += 7) receivers[k].normal[2] *= -1;
    for (int k = 0; k + CUT_ROOTS <= COUNT; k += CUT_ROOTS)
      done += hold_roots(&lit, receivers + k, work);
    assert_true(done > COUNT / 4 && done < COUNT);
    release(&lit);
  }
  cut_work_free(work);
}

/* On the way from the lamp: first micro lights, then all views at once, then few nodes, and no step
 * in the irradiance where one gives way to the next. */
TEST(test_way_from_the_lamp) {
  const double tolerance = 1e-2;
  struct receiver receivers[COUNT];
  struct gathered exact[COUNT], got[COUNT];
  struct lit lit;
  make(&lit, SMOOTH, ordinary, INFINITY, 2);
  for (int k = 0; k < COUNT; ++k) {
    double z = 0.2 * pow(100, (double)k / COUNT);
    receivers[k] = (struct receiver){.position = {0.1 * z, -0.3 * z, z},
                                     .normal = {0, 0, -1},
                                     .lift = {0, 0, -1},
                                     .index = (uint64_t)k};
  }
  sum(&lit, GATHER_REFERENCE, 1e-7, receivers, COUNT, exact);
  sum(&lit, GATHER_CUT, tolerance, receivers, COUNT, got);
  int taken;
  nodes(&lit, tolerance, receivers, COUNT, &taken);
  assert_true(taken > COUNT / 4);
  assert_true(worst_error(got, exact, COUNT) <= tolerance);
  receivers[0].position[2] = 0.01;
  nodes(&lit, tolerance, receivers, 1, &taken);
  assert_int_equal(taken, 0);
  release(&lit);
}

/* Sizes that do not halve, axes of one sample, any normal. */
TEST(test_sizes) {
  static const int sizes[][SLAB_AXES] = {{5, 3, 7, 4}, {1, 1, 8, 8},   {6, 5, 1, 1},
                                         {1, 3, 4, 1}, {2, 9, 33, 17}, {1, 1, 1, 1}};
  struct receiver receivers[COUNT];
  struct gathered exact[COUNT], got[COUNT];
  for (int k = 0; k < 2 * (int)(sizeof sizes / sizeof sizes[0]); ++k) {
    struct lit lit;
    double distance = k % 2 ? 2 : INFINITY;
    make(&lit, EDGES, sizes[k / 2], distance, 2);
    make_receivers(receivers, COUNT, 0.3, 100, distance);
    for (int r = 0; r < COUNT; r += 3) receivers[r].normal[2] *= -1;
    sum(&lit, GATHER_REFERENCE, 1e-7, receivers, COUNT, exact);
    sum(&lit, GATHER_CUT, 1e-3, receivers, COUNT, got);
    assert_true(worst_error(got, exact, COUNT) <= 1e-3);
    release(&lit);
  }
}

/* Powers of two in the samples change nothing but the sum's exponent. */
TEST(test_linear) {
  struct receiver receivers[COUNT];
  struct gathered once[COUNT], more[COUNT];
  struct lit lit;
  make(&lit, PEAKS, small, INFINITY, 2);
  make_receivers(receivers, COUNT, 2, 100, INFINITY);
  sum(&lit, GATHER_CUT, 1e-2, receivers, COUNT, once);
  struct slab *slab = &lit.light.pages[0].slab;
  for (size_t k = 0; k < 3 * slab_sample_count(slab); ++k) slab->rgb[k] *= 1024;
  gather_prepared_free(&lit.prepared);
  prepare(&lit, 2);
  sum(&lit, GATHER_CUT, 1e-2, receivers, COUNT, more);
  for (int k = 0; k < COUNT; ++k)
    for (int c = 0; c < 3; ++c) assert_true(more[k].irradiance[c] == 1024 * once[k].irradiance[c]);
  release(&lit);
}

TEST(test_threads) {
  struct receiver receivers[COUNT];
  struct gathered all[2][COUNT];
  struct lit lit;
  make_receivers(receivers, COUNT, 2, 100, 3);
  for (int threads = 1; threads <= 5; threads += 4) {
    make(&lit, PEAKS, small, 3, threads);
    sum(&lit, GATHER_CUT, 1e-2, receivers, COUNT, all[threads > 1]);
    release(&lit);
  }
  assert_memory_equal(all[0], all[1], sizeof all[0]);
}

static bool is_above(const struct seen_page *seen) {
  double low[2], high[2], range[2];
  for (int axis = 0; axis < 2; ++axis) {
    low[axis] = (-seen->page->axes[axis].half - seen->foot[axis]) / seen->height;
    high[axis] = (seen->page->axes[axis].half - seen->foot[axis]) / seen->height;
  }
  kernel_heights(&seen->kernel, low, high, range);
  return range[0] > 0;
}

/* Wherever they are done, and with as many nodes as that takes: as exact as is predicted, relative
 * as cut.h says. */
static void hold_views(enum lamp lamp, double distance, int done[CUT_VIEWS_NODES + 1]) {
  struct receiver receivers[COUNT];
  struct gathered exact[COUNT];
  struct cut_views *views = cut_views_make();
  struct lit lit;
  double most = 0;
  make(&lit, lamp, ordinary, distance, 2);
  make_receivers(receivers, COUNT, 0.3, 100, distance);
  sum(&lit, GATHER_REFERENCE, 1e-7, receivers, COUNT, exact);
  for (int r = 0; r < COUNT; ++r)
    most = fmax(most, largest(exact[r].irradiance) * pow(receivers[r].position[2], 2));
  for (int r = 0; r < COUNT; ++r)
    for (int digit = 2; digit <= 4; ++digit) {
      struct seen_page seen;
      double rgb[3], error;
      assert_true(seen_page_find(&lit.light.pages[0], &receivers[r], &seen));
      const int nodes = is_above(&seen) ? cut_views_nodes(&seen, pow(10, -digit), &error) : 0;
      if (nodes == 0) continue;
      assert_true(error <= pow(10, -digit));
      assert_true(cut_views_light(lit.prepared.trees[0], &seen, nodes, views, rgb));
      double light = fmax(largest(exact[r].irradiance), 1e-4 * most / pow(seen.height, 2));
      for (int c = 0; c < 3; ++c) {
        double off = fabs(rgb[c] - exact[r].irradiance[c]);
        assert_true(off <= error * light);
      }
      ++done[nodes];
    }
  cut_views_free(views);
  release(&lit);
}

TEST(test_views) {
  int done[CUT_VIEWS_NODES + 1] = {0};
  for (int lamp = PEAKS; lamp <= EDGES; ++lamp)
    for (int k = 0; k < 2; ++k) hold_views((enum lamp)lamp, k ? 3 : INFINITY, done);
  for (int nodes = 1; nodes <= CUT_VIEWS_NODES; ++nodes) assert_true(done[nodes] > COUNT / 10);
}

/* As cut.h states. */
TEST(test_memory) {
  struct lit lit;
  make(&lit, CONSTANT, small, INFINITY, 2);
  const struct cut_tree *tree = lit.prepared.trees[0];
  size_t nodes = 0;
  for (int level = 0; tree->level[level].images; ++level)
    nodes += (size_t)(tree->axes[0].count[level] * tree->axes[1].count[level]);
  assert_int_equal(nodes, 1 + 4 + 16);
  assert_int_equal(CUT_FLOATS * sizeof(float) + sizeof(struct cut_estimate), 64);
  release(&lit);
}

/* Highlights, and aperture that the tangent plane cuts, are left to the micro lights. */
TEST(test_refuses) {
  struct lit lit;
  struct cut_counts counts = {0};
  struct cut_work *work = cut_work_make();
  make(&lit, CONSTANT, small, INFINITY, 2);
  struct receiver receiver = {.position = {0, 0, 20}, .normal = {0, 0, -1}, .eye = {0, 0, -1}};
  static const double along[3] = {1, 0, 0};
  for (int kind = 0; kind < 3; ++kind) {
    struct seen_page seen;
    double irradiance[3];
    receiver.shininess = kind == 1 ? 10 : 0;
    if (kind == 2) memcpy(receiver.normal, along, sizeof along);
    assert_true(seen_page_find(&lit.light.pages[0], &receiver, &seen));
    assert_int_equal(cut_sum(lit.prepared.trees[0], &seen, 1e-2, work, irradiance, &counts),
                     kind == 0);
    if (kind == 0) assert_true(fabs(irradiance[0] * 20 * 20 - 1) < 0.01);
  }
  assert_int_equal(counts.nodes, 1);
  cut_work_free(work);
  release(&lit);
}

int main(void) {
  return testing_run(NULL, NULL);
}
