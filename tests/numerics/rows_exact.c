/* rows_exact.c - cases with exact answers: Lambert's formula, tables by mpmath, exact rationals;
 * and the rules' own definitions. */
#include <math.h>
#include <string.h>

#include "microlight/levels.h"
#include "microlight/rule.h"
#include "microlight/strips.h"
#include "numerics.h"

static const int grid[SLAB_AXES] = {4, 3, 6, 5};
static const double ordinary[4] = {-0.7, 1.1, -0.9, 0.6};

/* ---- Radiance 1: Lambert's polygon formula, which has few digits left for little light. */

void row_constant(struct trial *trial) {
  enum frame frame = (enum frame)random_choose(&trial->seed, 3);
  struct slab slab =
      rough_slab(grid, trial_distance(trial), ordinary, frame, FILL_CONSTANT, trial->seed);
  struct lamp lamp = lamp_open(&slab);
  for (int k = 0; k < 8; ++k) {
    double z = random_log(&trial->seed, 1e-3, 1e3);
    struct surfel receiver = aimed_receiver(
        &slab, z, (enum receiver_kind)random_choose(&trial->seed, RECEIVER_KINDS), &trial->seed);
    long double exact = oracle_lambert(&slab, receiver.p, receiver.n);
    if (exact > 0 && exact < 1e-9L) continue;
    struct oracle_value value = {{exact, exact, exact}, {exact, exact, exact}, 0};
    trial_hold_value(trial, &lamp, &receiver, &value);
  }
  lamp_close(&lamp);
}

/* ---- mpmath. */

static const struct entry {
  double length[2];
  int samples[SLAB_AXES];
  double window[4], distance; /* 0: infinity */
  double p[3], n[3];
  uint32_t seed;
  long double rgb[3];
} table[] = {
#include "table.inc"
};

/* As table.py has it. */
static float table_sample(uint32_t seed, uint32_t number) {
  uint32_t word = number * 2654435761u + seed * 40503u + 12345u;
  word ^= word >> 15;
  return (float)(word * 2246822519u >> 8) / 16777216;
}

void row_mpmath(struct trial *trial) {
  const struct entry *entry = &table[trial->start % (sizeof table / sizeof table[0])];
  struct slab slab = rough_slab(entry->samples, entry->distance > 0 ? entry->distance : INFINITY,
                                entry->window, FRAME_PLAIN, FILL_CONSTANT, 0);
  struct surfel receiver;
  struct oracle_value exact = {{0}, {0}, 0};
  slab.u[0] = entry->length[0];
  slab.v[1] = entry->length[1];
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k)
    slab.rgb[k] = table_sample(entry->seed, (uint32_t)k);
  memcpy(receiver.p, entry->p, sizeof receiver.p);
  memcpy(receiver.n, entry->n, sizeof receiver.n);
  struct lamp lamp = lamp_open(&slab);
  const struct oracle_value value = oracle_irradiance(&slab, receiver.p, receiver.n);
  for (int c = 0; c < 3; ++c) {
    exact.e[c] = exact.magnitude[c] = entry->rgb[c];
    if (!(fabsl(value.e[c] - exact.e[c]) <= 1e-15L * exact.e[c]))
      fail_msg("the oracle has %.18Lg for %.18Lg of table.inc, seed %u", value.e[c], exact.e[c],
               entry->seed);
  }
  trial_hold_value(trial, &lamp, &receiver, &exact);
  lamp_close(&lamp);
}

/* ---- Strips and hat functions along one axis, against exact rationals. */

/* Integrals of the products of hat functions: [near][far]. */
struct products {
  double of[8][8], all;
};

static void add_products(struct products *products, const int near[2], const int far[2],
                         const double weight[4]) {
  for (int k = 0; k < 4; ++k) {
    products->of[near[k >> 1]][far[k & 1]] += weight[k];
    products->all += weight[k];
  }
}

static struct products exact_products(const struct slab *slab, const double p[3], int which) {
  static struct oracle_axis axis;
  struct products products = {{{0}}, 0};
  oracle_axis_find(slab, p, which, &axis);
  for (int k = 0; k < axis.count; ++k) {
    const struct oracle_piece *piece = &axis.piece[k];
    const long double *f = piece->uv_at, *g = piece->st_at, w = piece->width;
    long double a = (f[0] + f[1]) / 2, b = (g[0] + g[1]) / 2;
    long double more = (f[1] - f[0]) * (g[1] - g[0]) / 12;
    const double weight[4] = {(double)(w * ((1 - a) * (1 - b) + more)),
                              (double)(w * ((1 - a) * b - more)),
                              (double)(w * (a * (1 - b) - more)), (double)(w * (a * b + more))};
    add_products(&products, piece->uv, piece->st, weight);
  }
  return products;
}

static struct products found_products(const struct light_axis *axis, double q, double z,
                                      enum rule rule) {
  const struct rule_orders orders = rule_orders(1e-9);
  struct error error;
  struct strips strips = {0};
  struct rule_nodes nodes = {0};
  struct products products = {{{0}}, 0};
  if (strips_find(axis, q, z, &strips, &error) != RESULT_OK ||
      rule_place(&strips, rule, &orders, 1, &nodes, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  for (int k = 0; k < nodes.strips.count; ++k) {
    const struct strip_taps *taps = &nodes.strips.strip[k].taps;
    for (int node = nodes.first[k]; node < nodes.first[k + 1]; ++node)
      add_products(&products, (const int[]){taps->near, taps->near + taps->near_up},
                   (const int[]){taps->far, taps->far + taps->far_up}, nodes.weight[node]);
  }
  strips_free(&strips);
  rule_nodes_free(&nodes);
  return products;
}

static double off(const struct products *a, const struct products *b) {
  double worst = fabs(a->all - b->all);
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 8; ++k) worst = larger(worst, fabs(a->of[i][k] - b->of[i][k]));
  return worst;
}

/* Lines of uv and st, merged; each hat function's part in it. All rules but the midpoint integrate
 * products of hats exactly. What rounding the receiver could do is taken off. */
void row_strips(struct trial *trial) {
  const double distance =
      random_choose(&trial->seed, 2) ? INFINITY : random_log(&trial->seed, 1e-3, 1e3);
  struct slab slab = rough_slab(grid, distance, ordinary, FRAME_PLAIN, FILL_CONSTANT, 0);
  struct lamp lamp = lamp_open(&slab);
  for (int k = 0; k < 40; ++k) {
    const double z = random_log(&trial->seed, 1e-12, 1e12);
    const struct surfel at = aimed_receiver(&slab, z, RECEIVER_FACING, &trial->seed);
    const int which = k % 2;
    const struct products exact = exact_products(&slab, at.p, which);
    for (int rule = RULE_PI; rule <= RULE_GAUSS; ++rule) {
      const struct products found =
          found_products(&lamp.light.pages[0].axes[which], at.p[which], at.p[2], (enum rule)rule);
      double error = off(&found, &exact);
      for (int side = 0; side < 4 && error > 1e-14 * exact.all; ++side) {
        double p[3] = {at.p[0], at.p[1], at.p[2]};
        p[side & 1 ? 2 : which] *= side & 2 ? 1 + 1e-15 : 1 - 1e-15;
        const struct products moved = exact_products(&slab, p, which);
        error = larger(0, error - off(&moved, &exact));
      }
      if (error > 0) error /= exact.all;
      trial_note(trial, rule == RULE_PI ? GATHER_PI : GATHER_REFERENCE, error, 1e-13);
    }
  }
  lamp_close(&lamp);
}

/* ---- One node a micro light: the rules' definitions, in long double. */

static long double radiance(const struct slab *slab, const struct oracle_piece *u,
                            const struct oracle_piece *v, bool means, int channel) {
  long double sum = 0, weight[2][4];
  for (int axis = 0; axis < 2; ++axis) {
    const struct oracle_piece *piece = axis ? v : u;
    const long double *f = piece->uv_at, *g = piece->st_at;
    long double a = (f[0] + f[1]) / 2, b = (g[0] + g[1]) / 2;
    long double more = means ? (f[1] - f[0]) * (g[1] - g[0]) / 12 : 0;
    weight[axis][0] = (1 - a) * (1 - b) + more, weight[axis][1] = (1 - a) * b - more;
    weight[axis][2] = a * (1 - b) - more, weight[axis][3] = a * b + more;
  }
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      sum += weight[0][x] * weight[1][y] *
             (long double)slab_at(slab, u->uv[x >> 1], v->uv[y >> 1], u->st[x & 1],
                                  v->st[y & 1])[channel];
  return sum;
}

/* False where the tangent plane is near: there other rules take part. */
static bool single(const struct slab *slab, const struct surfel *at, bool means,
                   long double rgb[3]) {
  static struct oracle_axis axes[2];
  for (int axis = 0; axis < 2; ++axis) oracle_axis_find(slab, at->p, axis, &axes[axis]);
  for (int c = 0; c < 3; ++c) rgb[c] = 0;
  for (int i = 0; i < axes[0].count; ++i)
    for (int j = 0; j < axes[1].count; ++j) {
      const struct oracle_piece *u = &axes[0].piece[i], *v = &axes[1].piece[j];
      const double *n = at->n;
      long double x = u->x + u->width / 2, y = v->x + v->width / 2, square = 1 + x * x + y * y;
      long double g = x * n[0] + y * n[1] - n[2];
      if (g - fabsl(u->width * n[0]) - fabsl(v->width * n[1]) < 1e-3L) return false;
      for (int c = 0; c < 3; ++c)
        rgb[c] += g / (square * square) * u->width * v->width * radiance(slab, u, v, means, c);
    }
  return true;
}

void row_single(struct trial *trial) {
  struct slab slab =
      rough_slab(grid, trial_distance(trial), ordinary, FRAME_PLAIN, FILL_UNIFORM, trial->seed);
  struct lamp lamp = lamp_open(&slab);
  for (int k = 0; k < 20; ++k) {
    const double z = random_log(&trial->seed, 1e-6, 1e6);
    const struct surfel at = aimed_receiver(&slab, z, RECEIVER_GENERAL, &trial->seed);
    for (int means = 0; means < 2; ++means) {
      const enum gather_method method = means ? GATHER_PI : GATHER_MIDPOINT;
      struct gathered got;
      long double rgb[3];
      if (!single(&slab, &at, means, rgb) || rgb[0] <= 0) continue;
      lamp_sum(&lamp, method, 1e-3, &at, &got, NULL);
      double worst = 0;
      for (int c = 0; c < 3; ++c)
        worst = larger(worst, (double)fabsl(((long double)got.irradiance[c] - rgb[c]) / rgb[c]));
      trial_note(trial, method, worst, method_rounding(method));
    }
  }
  lamp_close(&lamp);
}

/* ---- Levels: the same energy on each, exactly. */

void row_levels(struct trial *trial) {
  int samples[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis) samples[axis] = 1 + random_choose(&trial->seed, 12);
  struct slab slab =
      rough_slab(samples, trial_distance(trial), ordinary, FRAME_PLAIN, FILL_UNIFORM, trial->seed);
  struct lamp lamp = lamp_open(&slab);
  const struct levels *levels = &lamp.levels.levels[0];
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < levels->count; ++k) /* samples of a level have the same area */
      trial_note(trial, GATHER_LEVELS, fabs(oracle_mean_change(&slab, &levels->page[k].slab, c)),
                 3e-7);
  lamp_close(&lamp);
}
