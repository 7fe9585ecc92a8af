/* cut_axis.c - see cut_axis.h. */
#include "cut_axis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "simd.h"

int cut_axis_levels(int views) {
  int levels = 1;
  while (((long long)1 << (levels - 1)) < views) ++levels;
  return levels;
}

void cut_axis_free(struct cut_axis *axis) {
  for (int level = 0; level < CUT_LEVELS; ++level) free(axis->level[level]);
  *axis = (struct cut_axis){0};
}

static double view_at(const struct light_axis *axis, int view) {
  return (view + 0.5 - 0.5 * axis->near_count) * axis->near_step;
}

static void add_piece(struct cut_interval *interval, double low, double high, double from,
                      double to) {
  struct cut_piece *piece = &interval->piece[interval->pieces];
  if (!(high > low)) return;
  if (interval->pieces > 0 && from == to && piece[-1].from == from && piece[-1].to == to) {
    piece[-1].high = high;
    return;
  }
  *piece = (struct cut_piece){low, high, from, to};
  ++interval->pieces;
}

/* Gauss nodes and weights on [0, 1]: exact to the fifth power. */
static const double gauss_at[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
static const double gauss_weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

/* Integral of H d^power. */
static double moment(const struct cut_interval *interval, int power) {
  double sum = 0;
  for (int k = 0; k < interval->pieces; ++k) {
    const struct cut_piece *piece = &interval->piece[k];
    double width = piece->high - piece->low;
    for (int g = 0; g < 3; ++g)
      sum += gauss_weight[g] * width * (piece->from + gauss_at[g] * (piece->to - piece->from)) *
             pow(piece->low + gauss_at[g] * width, power);
  }
  return sum;
}

static void set_interval(const struct light_axis *axis, int first, int last,
                         struct cut_interval *interval) {
  bool begins = first == 0, ends = last == axis->near_count - 1;
  double low = begins ? -axis->half : view_at(axis, first - 1);
  double high = ends ? axis->half : view_at(axis, last + 1);
  double inner[2] = {view_at(axis, first), view_at(axis, last)};
  interval->first = first;
  interval->last = last;
  interval->pieces = 0;
  add_piece(interval, low, inner[0], begins, 1);
  add_piece(interval, inner[0], inner[1], 1, 1);
  add_piece(interval, inner[1], high, 1, ends);
  interval->center = moment(interval, 1) / moment(interval, 0);
  for (int k = 0; k < interval->pieces; ++k) {
    interval->piece[k].low -= interval->center;
    interval->piece[k].high -= interval->center;
  }
  for (int m = 0; m <= CUT_MOMENTS; ++m) interval->moment[m] = moment(interval, m);
  interval->half = fmax(high - interval->center, interval->center - low);
  interval->per_half = 1 / interval->half;
}

static void split(const struct cut_interval *from, int to, int cuts[3], int *children) {
  int count = from->last - from->first + 1;
  *children = count > 1 ? 2 : 1;
  cuts[0] = from->first;
  cuts[1] = count > 1 ? from->first + (count + 1) / 2 : to;
  cuts[2] = to;
}

enum slab_result cut_axis_make(const struct light_axis *axis, int levels, struct cut_axis *made,
                               struct slab_error *error) {
  *made = (struct cut_axis){0};
  for (int level = 0; level < levels; ++level) {
    int room = level == 0 ? 1 : 2 * made->count[level - 1];
    struct cut_interval *out = calloc((size_t)room, sizeof *out);
    if (!out) return slab_fail(error, SLAB_MEMORY, "out of memory");
    made->level[level] = out;
    if (level == 0) {
      set_interval(axis, 0, axis->near_count - 1, out);
      made->count[0] = 1;
    }
    for (int k = 0; level > 0 && k < made->count[level - 1]; ++k) {
      struct cut_interval *parent = &made->level[level - 1][k];
      int cuts[3];
      parent->child = made->count[level];
      split(parent, parent->last + 1, cuts, &parent->children);
      for (int c = 0; c < parent->children; ++c)
        set_interval(axis, cuts[c], cuts[c + 1] - 1, &out[made->count[level]++]);
    }
    for (int k = 0; k < made->count[level]; ++k)
      made->reach[level] = fmax(made->reach[level], out[k].half);
    made->widest[level] = 2 * made->reach[level] / axis->far_step;
  }
  return SLAB_OK;
}

SIMD_INLINE double least(double a, double b) {
  return a < b ? a : b;
}

SIMD_INLINE double most(double a, double b) {
  return a > b ? a : b;
}

SIMD_INLINE int clamp(int value, int high) {
  return value < 0 ? 0 : value > high ? high : value;
}

/* floor, without a call; for what lies in the window: at >= -1 */
SIMD_INLINE int whole(double at) {
  return (int)(at + 1) - 1;
}

/* Shortens a piece to what is seen of it: within the limits and the st window. */
static bool see(const struct cut_interval *interval, const struct cut_sight *sight, int far_count,
                struct cut_piece *range) {
  const struct cut_piece piece = *range;
  double rise = (piece.to - piece.from) / (piece.high - piece.low);
  double low = most(piece.low, sight->limits[0] - interval->center);
  double high = least(piece.high, sight->limits[1] - interval->center);
  double ends[2] = {sight->place + sight->rate * low, sight->place + sight->rate * high};
  for (int side = 0; side < 2; ++side) {
    double edge = side ? far_count - 0.5 : -0.5, sign = side ? 1 : -1;
    bool out[2] = {sign * (ends[0] - edge) > 0, sign * (ends[1] - edge) > 0};
    if (out[0] && out[1]) return false;
    if (out[0]) low = most(low, (edge - sight->place) / sight->rate);
    if (out[1]) high = least(high, (edge - sight->place) / sight->rate);
  }
  range->low = low;
  range->high = high;
  range->from = piece.from + rise * (low - piece.low);
  range->to = piece.from + rise * (high - piece.low);
  return high > low;
}

typedef double pair __attribute__((vector_size(16)));

/* Sums being made; a row for each st sample. */
struct sums {
  double moment[CUT_TAPS][CUT_MOMENTS];
};

/* Adds the part of a piece that lies in one cell, between samples `cell` and `cell` + 1. */
SIMD_INLINE void add_cell(const struct cut_sight *sight, int cell, const struct cut_piece *part,
                          double *lower_to, double *upper_to) {
  const double width = part->high - part->low, scale = sight->scale;
  pair all[2] = {{0}, {0}}, upper[2] = {{0}, {0}};
  for (int g = 0; g < 3; ++g) {
    double d = part->low + gauss_at[g] * width, x = d * scale;
    double up = sight->place + sight->rate * d - cell;
    double value = (part->from + gauss_at[g] * (part->to - part->from)) * gauss_weight[g];
    up = least(most(up, 0), 1);
    pair first = {value, value * x}, second = first * (x * x);
    all[0] += first;
    all[1] += second;
    upper[0] += first * up;
    upper[1] += second * up;
  }
  const double unit = width * scale;
  for (int half = 0; half < 2; ++half) {
    pair lower = (all[half] - upper[half]) * unit, higher = upper[half] * unit;
    lower_to[2 * half] += lower[0];
    lower_to[2 * half + 1] += lower[1];
    upper_to[2 * half] += higher[0];
    upper_to[2 * half + 1] += higher[1];
  }
}

/* Cuts a piece at the st samples. */
static void add_cells(const struct cut_sight *sight, int first, int far_count,
                      const struct cut_piece *piece, struct sums *sums) {
  const int step = sight->rate < 0 ? -1 : 1;
  int cell = whole(sight->place + sight->rate * piece->low);
  const int last = whole(sight->place + sight->rate * piece->high);
  const double rise = (piece->to - piece->from) / (piece->high - piece->low);
  struct cut_piece part = *piece;
  for (;; cell += step) {
    part.high = piece->high;
    part.to = piece->to;
    if (cell != last) {
      part.high = least((cell + (step > 0) - sight->place) / sight->rate, piece->high);
      part.to = piece->from + rise * (part.high - piece->low);
    }
    if (part.high > part.low) {
      add_cell(sight, cell, &part, sums->moment[clamp(cell, far_count - 1) - first],
               sums->moment[clamp(cell + 1, far_count - 1) - first]);
      part.low = part.high;
      part.from = part.to;
    }
    if (cell == last) break;
  }
}

/* Adds what lies beyond st sample `line`, on the side where (st sample - line) * side > 0: there
 * the radiance bends away from the line through the cell of the center, by its second difference
 * at `line`. */
static void add_bend(const struct cut_interval *interval, const struct cut_sight *sight, int line,
                     int side, double *before, double *at, double *after) {
  const double crossing = (line - sight->place) / sight->rate, speed = fabs(sight->rate);
  const bool above = (side > 0) == (sight->rate > 0);
  pair sum[2] = {{0}, {0}};
  for (int k = 0; k < interval->pieces; ++k) {
    const struct cut_piece *piece = &interval->piece[k];
    double low = above ? most(piece->low, crossing) : piece->low;
    double high = above ? piece->high : least(piece->high, crossing);
    if (!(high > low)) continue;
    double rise = (piece->to - piece->from) / (piece->high - piece->low);
    for (int g = 0; g < 3; ++g) {
      double d = low + gauss_at[g] * (high - low), x = d * sight->scale;
      double beyond = speed * (above ? d - crossing : crossing - d);
      double value =
          (piece->from + rise * (d - piece->low)) * gauss_weight[g] * (high - low) * beyond;
      pair first = {value, value * x};
      sum[0] += first;
      sum[1] += first * (x * x);
    }
  }
  for (int m = 0; m < CUT_MOMENTS; ++m) {
    double bend = sum[m / 2][m % 2] * sight->scale;
    before[m] += bend;
    at[m] -= 2 * bend;
    after[m] += bend;
  }
}

/* An interval that is seen whole and over few st samples: as if radiance were linear in all of
 * it, and bends at the samples. */
static void add_whole(const struct cut_interval *interval, const struct cut_sight *sight, int low,
                      int high, int first, int far_count, struct sums *sums) {
  const int center = whole(sight->place);
  double *lower = sums->moment[clamp(center, far_count - 1) - first];
  double *upper = sums->moment[clamp(center + 1, far_count - 1) - first];
  double up = sight->place - center, unit = sight->scale;
  for (int m = 0; m < CUT_MOMENTS; ++m, unit *= sight->scale) {
    double all = interval->moment[m] * unit;
    double more = (up * interval->moment[m] + sight->rate * interval->moment[m + 1]) * unit;
    lower[m] += all - more;
    upper[m] += more;
  }
  for (int line = low + 1; line <= high; ++line) {
    int side = line > center ? 1 : -1;
    add_bend(interval, sight, line, side, sums->moment[clamp(line - side, far_count - 1) - first],
             sums->moment[clamp(line, far_count - 1) - first],
             sums->moment[clamp(line + side, far_count - 1) - first]);
  }
}

static void store(const struct sums *sums, struct cut_taps *taps) {
  for (int m = 0; m < CUT_MOMENTS; ++m) {
    int k = 0;
    for (; k < taps->count; ++k) taps->moment[m][k] = (float)sums->moment[k][m];
    for (; k & 3; ++k) taps->moment[m][k] = 0;
  }
}

/* Where bends are cheaper than pieces: st samples inside the interval. */
enum { FEW = 2 };

bool cut_taps_find(const struct cut_interval *interval, const struct cut_sight *sight,
                   int far_count, struct cut_taps *taps) {
  struct cut_piece pieces[3];
  struct sums sums;
  int count = 0;
  double low = INFINITY, high = -INFINITY;
  for (int k = 0; k < interval->pieces; ++k) {
    struct cut_piece *piece = &pieces[count];
    *piece = interval->piece[k];
    if (sight->clipped && !see(interval, sight, far_count, piece)) continue;
    double first = sight->place + sight->rate * piece->low;
    double second = sight->place + sight->rate * piece->high;
    low = least(low, least(first, second));
    high = most(high, most(first, second));
    ++count;
  }
  taps->count = 0;
  if (count == 0) return true;
  if (!(high - low < CUT_TAPS - 2)) return false;
  taps->first = clamp(whole(low), far_count - 1);
  taps->count = clamp(whole(high) + 1, far_count - 1) - taps->first + 1;
  memset(sums.moment, 0, (size_t)taps->count * sizeof sums.moment[0]);
  if (!sight->clipped && whole(high) - whole(low) <= FEW)
    add_whole(interval, sight, whole(low), whole(high), taps->first, far_count, &sums);
  else
    for (int k = 0; k < count; ++k) add_cells(sight, taps->first, far_count, &pieces[k], &sums);
  store(&sums, taps);
  return true;
}
