/* test_bits.c - the samples are the same, bit for bit, for any camera, number of jobs
 * and shards; where the lamp calls for radiosity, for any number of jobs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bakes.h"

/* POV-Ray's own light, shadows, a mirror and a filter: all that rounding may change. */
static void busy_lamp(const char *name, const char *slab) {
  bakes_lamp(name);
  bakes_lamp_add(name, "%s\n", slab);
  bakes_lamp_add(name, "Canned_Bulb(<0, 7, 1>, 0.5, rgb <90, 50, 20>)\n"
                       "plane { y, 9 pigment { rgb <0.8, 0.6, 0.5> } finish { diffuse 1 } }\n"
                       "sphere { <2, 4, -1>, 1.5 pigment { rgb 0.1 } finish { reflection 0.7 } }\n"
                       "cylinder { <-4, 3, 0>, <4, 3, 1>, 0.3 pigment { checker rgb 1 rgb 0.2 } "
                       "finish { diffuse 1 } }\n"
                       "box { <-3, 2, 1>, <-1, 2.2, 4> pigment { rgbf <0.9, 0.5, 0.7, 0.8> } }\n");
}

static const char infinite_slab[] =
    "Canned_Slab(<0, 0, 0>, <6, 0, 0>, <0, 0, 4>, <0, -1, 0>, <-1.1, 0.9, -0.7, 0.8>, 0)";
/* A finite st plane, and u x v = -n. */
static const char finite_slab[] =
    "Canned_Slab(<0, 0, 0>, <6, 0, 0>, <0, 0, -4>, <0, -1, 0>, <-5, 4, -6, 3>, 8)";

static int bake_all(void **state) {
  if (bakes_setup(state)) return -1;
  busy_lamp("open", infinite_slab);
  busy_lamp("near", finite_slab);
  bakes_lamp_add("near", "%s\n", infinite_slab);
  /* Few rays: an animation takes 0.25 s a frame. */
  bakes_start("open", "mesh.exr", "--uv 4x3 --st 3x4 --uniform --rays 2 --camera mesh");
  bakes_start("open", "perspective.exr",
              "--uv 4x3 --st 3x4 --uniform --rays 2 --camera perspective");
  bakes_start("open", "transposed.exr", "--uv 4x3 --st 3x4 --uniform --rays 2 --camera transposed");
  bakes_start("open", "centre-mesh.exr", "--uv 2x3 --st 40x9 --centre --camera mesh");
  bakes_start("open", "centre-perspective.exr", "--uv 2x3 --st 40x9 --centre --camera perspective");
  bakes_start("near", "near-mesh.exr", "--uv 3x2 --st 9x7 --uniform --rays 2 --camera mesh");
  bakes_start("near", "near-perspective.exr",
              "--uv 3x2 --st 9x7 --uniform --rays 2 --camera perspective");
  /* Tiles of 16 x 16 directions, and edges of them. */
  bakes_start("open", "adaptive-mesh.exr", "--uv 2x1 --st 36x34 --rays 6 --rays-max 8");
  bakes_start("open", "adaptive-perspective.exr",
              "--uv 2x1 --st 36x34 --rays 6 --rays-max 8 --camera perspective");
  /* Several batches a round. */
  static const char many[] = "--uv 16x16 --st 3x3 --rays 36 --rays-max 40";
  char options[256];
  for (int jobs = 1; jobs <= 3; jobs += 2) {
    char name[64];
    snprintf(options, sizeof options, "%s --jobs %d", many, jobs);
    snprintf(name, sizeof name, "jobs%d.exr", jobs);
    bakes_start("open", name, options);
  }
  snprintf(options, sizeof options, "%s --shard 2/3", many);
  bakes_start("open", "shards.exr", options);
  /* Both at once. */
  assert_int_equal(bakes_run("exec \"$BAKESLAB\" bake open.pov -o shards.exr -L \"$FIXTURES\" "
                             "-j 1 %s --shard 1/3 >shard1.log 2>&1",
                             many),
                   0);
  bakes_wait();
  assert_int_equal(bakes_run("! test -e shards.exr"), 0);
  bakes_start("open", "shards.exr", many);
  /* The passes of a radiosity bake depend on the order of rays. */
  bakes_lamp("gather");
  bakes_lamp_add("gather", "%s\n", infinite_slab);
  bakes_lamp_add("gather", "Canned_Bulb(<0, 7, 1>, 0.5, 90)\n"
                           "box { <-5, 0, -4>, <5, 9, 4> hollow pigment { rgb 0.6 } "
                           "finish { diffuse 1 } clipped_by { plane { -y, -0.01 } } }\n");
  for (int jobs = 1; jobs <= 2; ++jobs) {
    char name[64];
    snprintf(options, sizeof options,
             "--uv 16x16 --st 1x1 --rays 32 --uniform --effects interreflection --jobs %d", jobs);
    snprintf(name, sizeof name, "gather%d.exr", jobs);
    bakes_start("gather", name, options);
  }
  bakes_start("gather", "bare.exr", "--uv 16x16 --st 1x1 --rays 32 --uniform --effects none");
  bakes_wait();
  return 0;
}

static void assert_same(const char *one, const char *other, int pages) {
  for (int page = 0; page < pages; ++page) {
    struct slab a = bakes_load(one, page), b = bakes_load(other, page);
    size_t count = slab_sample_count(&a), different = 0, black = 0;
    assert_int_equal(count, slab_sample_count(&b));
    for (size_t n = 0; n < 3 * count; ++n) {
      different += a.rgb[n] != b.rgb[n];
      black += a.rgb[n] == 0;
    }
    if (different) fail_msg("%s, %s: %zu of %zu numbers differ", one, other, different, 3 * count);
    assert_true(black < 2 * count); /* enough is lit */
    slab_free(&a);
    slab_free(&b);
  }
}

TEST(test_cameras) {
  assert_same("mesh.exr", "perspective.exr", 1);
  assert_same("mesh.exr", "transposed.exr", 1);
  assert_same("centre-mesh.exr", "centre-perspective.exr", 1);
  assert_same("near-mesh.exr", "near-perspective.exr", 2);
}

TEST(test_adaptive_cameras) {
  struct slab slab = bakes_load("adaptive-mesh.exr", 0);
  double rays = bakes_provenance(&slab, "rays", NULL);
  assert_true(rays > 4 && rays <= 6); /* some tiles got more, not all */
  slab_free(&slab);
  assert_same("adaptive-mesh.exr", "adaptive-perspective.exr", 1);
}

TEST(test_jobs) {
  assert_same("jobs1.exr", "jobs3.exr", 1);
}

TEST(test_shards) {
  assert_same("jobs1.exr", "shards.exr", 1);
  /* The run without --shard had the third part left, not more. */
  assert_int_equal(
      bakes_run("cat shards.exr.log; grep -q ' [1-9][0-9]* of them found' shards.exr.log"), 0);
  assert_int_equal(bakes_run("! test -e shards.exr.partial"), 0);
}

TEST(test_radiosity) {
  assert_same("gather1.exr", "gather2.exr", 1);
  struct slab with = bakes_load("gather1.exr", 0), without = bakes_load("bare.exr", 0);
  double more[3], less[3];
  slab_flux(&with, more, NULL);
  slab_flux(&without, less, NULL);
  print_message("# interreflection multiplies the flux by %.3f\n", more[1] / less[1]);
  assert_true(more[1] > 1.1 * less[1]);
  slab_free(&with);
  slab_free(&without);
}

int main(void) {
  return testing_run(bake_all, bakes_teardown);
}
