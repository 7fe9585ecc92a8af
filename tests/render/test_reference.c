/* test_reference.c - `renderslab irradiance --method reference` against an
 * oracle that shares no code with it (oracle.h), and first the oracle against
 * simpler answers. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "helpers.h"
#include "oracle/oracle.h"

static const int grids[][SLAB_AXES] = {{4, 4, 6, 6}, {5, 3, 7, 4}, {1, 1, 8, 8}, {6, 5, 1, 1},
                                       {1, 3, 4, 1}, {2, 1, 1, 5}, {6, 6, 8, 8}, {1, 1, 1, 1}};
enum { GRIDS = sizeof grids / sizeof grids[0] };

static const double ordinary[4] = {-0.7, 1.1, -0.9, 0.6}, wide[4] = {-5, 5, -5, 5};
static const double narrow[4] = {-0.02, 0.03, -0.05, 0.01}, aside[4] = {0.2, 1.5, -1.4, -0.3};

/* Rough slabs and receivers at heights z[0]..z[1] (in the slab's units, the
 * aperture being about 1), evenly in the logarithm. */
struct family {
  const char *name;
  const double *window;
  double distance, z[2];
  enum frame frame;
  enum fill fill;
  enum receiver_kind kind; /* RECEIVER_KINDS: each in turn */
};

static const struct family families[] = {
    {"st at infinity", ordinary, INFINITY, {0.02, 1000}, FRAME_PLAIN, FILL_UNIFORM, RECEIVER_KINDS},
    {"facing", aside, INFINITY, {0.02, 1000}, FRAME_TURNED, FILL_EXTREME, RECEIVER_FACING},
    {"tangent plane cuts", ordinary, INFINITY, {0.02, 9}, FRAME_TURNED, FILL_EXTREME, RECEIVER_CUT},
    {"the same far away", narrow, INFINITY, {9, 1000}, FRAME_MIRRORED, FILL_UNIFORM, RECEIVER_CUT},
    {"wide window", wide, INFINITY, {0.02, 10}, FRAME_TURNED, FILL_UNIFORM, RECEIVER_KINDS},
    {"mirrored", ordinary, INFINITY, {0.02, 1000}, FRAME_MIRRORED, FILL_EXTREME, RECEIVER_KINDS},
    {"before the st plane", ordinary, 2, {0.02, 1.99}, FRAME_TURNED, FILL_UNIFORM, RECEIVER_KINDS},
    {"on it", ordinary, 0.5, {0.5, 0.5}, FRAME_PLAIN, FILL_EXTREME, RECEIVER_KINDS},
    {"nearly on it", ordinary, 3, {3 - 1e-9, 3 + 1e-9}, FRAME_TURNED, FILL_UNIFORM, RECEIVER_KINDS},
    {"beyond it", aside, 0.7, {0.71, 1000}, FRAME_MIRRORED, FILL_EXTREME, RECEIVER_KINDS},
    {"cut beyond it", ordinary, 1.5, {1.6, 20}, FRAME_MIRRORED, FILL_UNIFORM, RECEIVER_CUT},
};
enum { FAMILIES = sizeof families / sizeof families[0], EACH = 16 };

static struct slab family_slab(const struct family *family, int grid, int seed,
                               struct surfel receivers[], int count) {
  uint64_t state = (uint64_t)seed;
  struct slab slab = rough_slab(grids[grid], family->distance, family->window, family->frame,
                                family->fill, state + 1);
  aim(&slab, family->z, family->kind, &state, receivers, count);
  return slab;
}

/* Relative to the second; 0 must be met exactly. */
static double off(double a, long double b) {
  if (b == 0) return a == 0 ? 0 : INFINITY;
  return (double)fabsl(((long double)a - b) / b);
}

/* The same for a number printed with nine digits: beyond half of the last. */
static double printed_off(double a, long double b) {
  double half = a == 0 ? 0 : 0.5 * pow(10, floor(log10(fabs(a))) - 8);
  return larger(0, off(a, b) - (b == 0 ? 0 : (double)(half / fabsl(b))));
}

/* ---- The oracle itself. */

/* Lambert's sum cancels far away: it rounds at about 1e-21. */
TEST(test_oracle_lambert) {
  double worst = 0, error = 0;
  int dark = 0;
  for (int f = 0; f < FAMILIES; ++f) {
    struct family family = families[f];
    struct surfel receivers[EACH];
    family.fill = FILL_CONSTANT;
    struct slab slab = family_slab(&family, f % GRIDS, f, receivers, EACH);
    for (int k = 0; k < EACH; ++k) {
      struct oracle_value value = oracle_irradiance(&slab, receivers[k].p, receivers[k].n);
      long double exact = oracle_lambert(&slab, receivers[k].p, receivers[k].n);
      if (exact == 0) assert_true(value.e[1] == 0);
      assert_true(fabsl(value.e[1] - exact) <= 1e-13L * exact + 1e-20L);
      if (exact > 1e-6L) worst = larger(worst, (double)fabsl(value.e[1] / exact - 1));
      error = larger(error, (double)value.error);
      dark += exact == 0;
    }
    slab_free(&slab);
  }
  print_message("oracle - Lambert: %.1e relative, own estimate %.1e, %d of %d dark\n", worst, error,
                dark, FAMILIES * EACH);
  assert_true(error < 1e-13);
  assert_true(dark < FAMILIES * EACH / 3);
}

/* Whether all of the aperture lies within the window and above the receiver's tangent plane. */
static bool sees_all(const struct slab *slab, const struct surfel *at) {
  struct oracle_place place;
  oracle_place(slab, at->p, at->n, &place);
  for (int corner = 0; corner < 4; ++corner) {
    long double above = -place.n[2];
    for (int axis = 0; axis < 2; ++axis) {
      long double a = corner >> axis & 1 ? place.half[axis] : -place.half[axis];
      long double x = (a - place.p[axis]) / place.p[2], s = place.kappa * a - x;
      if (s < slab->st_window[2 * axis] || s > slab->st_window[2 * axis + 1]) return false;
      above += place.n[axis] * x;
    }
    if (above < 0) return false;
  }
  return true;
}

/* Rough samples. The sum errs by 1/n^2 where all of the aperture is seen; elsewhere by the part
 * that a cell is of what is seen, and that may be little: 1/n on the average. */
TEST(test_oracle_brute) {
  double worst = 0, sum_off = 0;
  int whole = 0, cut = 0;
  for (int f = 0; f < 2 * FAMILIES; ++f) {
    struct surfel receivers[3];
    struct slab slab = family_slab(&families[f % FAMILIES], (f + 1) % GRIDS, f + 100, receivers, 3);
    for (int k = 0; k < 3; ++k) {
      struct oracle_value value = oracle_irradiance(&slab, receivers[k].p, receivers[k].n);
      double sum[3], most = 0;
      oracle_brute(&slab, receivers[k].p, receivers[k].n, NULL, 0, 700, sum);
      for (int c = 0; c < 3; ++c) most = larger(most, off(sum[c], value.e[c]));
      if (sees_all(&slab, &receivers[k])) {
        worst = larger(worst, most);
        ++whole;
      } else {
        sum_off += most;
        ++cut;
      }
    }
    slab_free(&slab);
  }
  print_message(
      "oracle - midpoint sum: %.1e relative where %d see all, %.1e for the others' mean\n", worst,
      whole, sum_off / cut);
  assert_true(whole > FAMILIES / 2);
  assert_true(worst < 1e-5);
  assert_true(sum_off / cut < 1e-2);
}

/* ---- The program. */

struct worst {
  double off;
  int dark, count;
};

static void hold(const struct slab *slab, const struct surfel *receiver, const double rgb[3],
                 struct worst *worst) {
  struct oracle_value value = oracle_irradiance(slab, receiver->p, receiver->n);
  assert_true(value.error < 1e-12L);
  for (int c = 0; c < 3; ++c) worst->off = larger(worst->off, printed_off(rgb[c], value.e[c]));
  worst->dark += value.e[0] + value.e[1] + value.e[2] == 0;
  ++worst->count;
}

static struct worst family_worst(int f, int salt, const char *options) {
  struct worst worst = {0};
  for (int g = 0; g < GRIDS; ++g) {
    struct surfel receivers[EACH];
    double rgb[EACH][3];
    struct slab slab = family_slab(&families[f], g, salt + f * GRIDS + g, receivers, EACH);
    const char *light = write_light(g % 2 ? "rough.tif" : "rough.exr", &slab, 1);
    irradiance(receivers, EACH, rgb, "--light '%s' --method reference %s", light, options);
    for (int k = 0; k < EACH; ++k) hold(&slab, &receivers[k], rgb[k], &worst);
    slab_free(&slab);
  }
  return worst;
}

static void hold_families(int salt, const char *options, double tolerance) {
  int failed = 0;
  for (int f = 0; f < FAMILIES; ++f) {
    struct worst worst = family_worst(f, salt, options);
    print_message("%-20s worst %.1e beyond the digits printed, %d receivers, %d dark\n",
                  families[f].name, worst.off, worst.count, worst.dark);
    failed += !(worst.off <= tolerance);
  }
  assert_int_equal(failed, 0);
}

TEST(test_rough) {
  hold_families(1000, "", 1e-6);
}

TEST(test_tolerance) {
  hold_families(2000, "--tolerance 1e-10", 1e-9);
}

/* Lambert's sum has few digits left below 1e-10. */
TEST(test_constant) {
  double worst = 0;
  for (int f = 0; f < FAMILIES; ++f) {
    struct family family = families[f];
    struct surfel receivers[10 * EACH];
    double rgb[10 * EACH][3];
    family.fill = FILL_CONSTANT;
    struct slab slab = family_slab(&family, f % GRIDS, 3000 + f, receivers, 10 * EACH);
    const char *light = write_light("constant.exr", &slab, 1);
    irradiance(receivers, 10 * EACH, rgb, "--light '%s' --method reference --tolerance 1e-10",
               light);
    for (int k = 0; k < 10 * EACH; ++k) {
      long double exact = oracle_lambert(&slab, receivers[k].p, receivers[k].n);
      if (exact < 1e-10L) exact = oracle_irradiance(&slab, receivers[k].p, receivers[k].n).e[1];
      for (int c = 0; c < 3; ++c) worst = larger(worst, printed_off(rgb[k][c], exact));
    }
    slab_free(&slab);
  }
  print_message("constant radiance - Lambert: worst %.1e\n", worst);
  assert_true(worst <= 1e-9);
}

int main(void) {
  return testing_run(NULL, NULL);
}
