#include "cut/cut_axis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"

int cut_axis_levels(int views) {
  int levels = 1;
  while (((long long)1 << (levels - 1)) < views) ++levels;
  return levels;
}

void cut_axis_free(struct cut_axis *axis) {
  for (int level = 0; level < CUT_LEVELS; ++level) {
    free(axis->level[level]);
    free(axis->fours[level]);
  }
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

/* Integral of H d^power. */
static double moment(const struct cut_interval *interval, int power) {
  double sum = 0;
  for (int k = 0; k < interval->pieces; ++k) {
    const struct cut_piece *piece = &interval->piece[k];
    double width = piece->high - piece->low;
    for (int g = 0; g < 3; ++g)
      sum += cut_gauss_weight[g] * width *
             (piece->from + cut_gauss_at[g] * (piece->to - piece->from)) *
             pow(piece->low + cut_gauss_at[g] * width, power);
  }
  return sum;
}

/* The hinges of a piece (cut_axis.h) as polynomials: their second derivative is H y^m. */
static void set_hinge(struct cut_interval *interval, int number) {
  const struct cut_piece *piece = &interval->piece[number];
  const double per = interval->per_half, width = piece->high - piece->low;
  const double middle = (piece->low + piece->high) / 2, y = middle * per;
  const double value = (piece->from + piece->to) / 2, rise = (piece->to - piece->from) / width;
  float(*out)[CUT_MOMENTS] = interval->hinge[number];
  struct cut_interval beyond = *interval;
  beyond.piece[number].low = middle;
  beyond.piece[number].from = value;
  for (int k = 0; k < number; ++k) beyond.piece[k].high = beyond.piece[k].low;
  for (int m = 0; m < CUT_MOMENTS; ++m) {
    double power[CUT_MOMENTS + 1] = {0}, all = moment(&beyond, m) * pow(per, m);
    out[0][m] = (float)(moment(&beyond, m + 1) * pow(per, m + 1) - y * all);
    out[1][m] = (float)-all;
    power[0] = 1; /* (y + t)^m, ascending */
    for (int n = 0; n < m; ++n)
      for (int k = n + 1; k >= 0; --k) power[k] = y * power[k] + (k > 0 ? power[k - 1] : 0);
    for (int k = 0; k <= m + 1; ++k) {
      double curve = value * power[k] + (k > 0 ? rise * interval->half * power[k - 1] : 0);
      out[k + 2][m] = (float)(curve * interval->half / ((k + 1) * (k + 2)));
    }
  }
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
  for (int m = 0; m <= CUT_MOMENTS; ++m)
    interval->share[m] = (float)(interval->moment[m] * pow(interval->per_half, m));
  for (int k = 0; k < interval->pieces; ++k) set_hinge(interval, k);
}

static enum result set_fours(struct cut_axis *made, int level, struct error *error) {
  const int count = made->count[level];
  struct cut_four *fours = calloc((size_t)(count + 3) / 4, sizeof *fours);
  if (!fours) return result_no_memory(error);
  made->fours[level] = fours;
  for (int k = 0; k < count; ++k) {
    const struct cut_interval *from = &made->level[level][k];
    struct cut_four *four = &fours[k / 4];
    four->center[k % 4] = from->center;
    four->half[k % 4] = from->half;
    four->per_half[k % 4] = from->per_half;
    four->size[k % 4] = from->moment[0];
  }
  return RESULT_OK;
}

enum result cut_axis_make(const struct light_axis *axis, int levels, struct cut_axis *made,
                          struct error *error) {
  *made = (struct cut_axis){.per_step = 1 / axis->far_step};
  for (int level = 0; level < levels; ++level) {
    int room = level == 0 ? 1 : 2 * made->count[level - 1];
    struct cut_interval *out = calloc((size_t)room, sizeof *out);
    if (!out) return result_no_memory(error);
    made->level[level] = out;
    if (level == 0) {
      set_interval(axis, 0, axis->near_count - 1, out);
      made->count[0] = 1;
    }
    for (int k = 0; level > 0 && k < made->count[level - 1]; ++k) {
      struct cut_interval *parent = &made->level[level - 1][k];
      int views = parent->last - parent->first + 1, second = parent->first + (views + 1) / 2;
      parent->child = made->count[level];
      parent->children = views > 1 ? 2 : 1;
      set_interval(axis, parent->first, second - 1, &out[made->count[level]++]);
      if (views > 1) set_interval(axis, second, parent->last, &out[made->count[level]++]);
    }
    for (int k = 0; k < made->count[level]; ++k)
      made->reach[level] = fmax(made->reach[level], out[k].half);
    made->widest[level] = 2 * made->reach[level] / axis->far_step;
    if (set_fours(made, level, error) != RESULT_OK) return RESULT_MEMORY;
  }
  return RESULT_OK;
}

SIMD_INLINE int clamp(int value, int high) {
  return value < 0 ? 0 : value > high ? high : value;
}

/* floor without a call, for at >= -1: in the window. */
SIMD_INLINE int whole(double at) {
  return (int)(at + 1) - 1;
}

/* Shortens a piece to what is seen of it within the st window; false: nothing. */
static bool see(const struct cut_sight *sight, int far_count, struct cut_piece *range) {
  const struct cut_piece piece = *range;
  double rise = (piece.to - piece.from) / (piece.high - piece.low);
  double low = piece.low, high = piece.high;
  double ends[2] = {sight->place + sight->rate * low, sight->place + sight->rate * high};
  for (int side = 0; side < 2; ++side) {
    double edge = side ? far_count - 0.5 : -0.5, sign = side ? 1 : -1;
    bool out[2] = {sign * (ends[0] - edge) > 0, sign * (ends[1] - edge) > 0};
    if (out[0] && out[1]) return false;
    if (out[0]) low = simd_max(low, (edge - sight->place) / sight->rate);
    if (out[1]) high = simd_min(high, (edge - sight->place) / sight->rate);
  }
  range->low = low;
  range->high = high;
  range->from = piece.from + rise * (low - piece.low);
  range->to = piece.from + rise * (high - piece.low);
  return high > low;
}

/* taps->moment as it is summed, transposed. */
struct sums {
  simd_float4 moment[CUT_TAPS];
};

/* Adds the part of a piece that lies in one cell, between samples `cell` and `cell` + 1. */
SIMD_INLINE void add_cell(const struct cut_interval *interval, const struct cut_sight *sight,
                          int cell, const struct cut_piece *part, simd_float4 *lower,
                          simd_float4 *upper) {
  const double width = part->high - part->low, unit = width * sight->scale;
  for (int g = 0; g < 3; ++g) {
    double d = part->low + cut_gauss_at[g] * width;
    double up = sight->place + sight->rate * d - cell;
    double value =
        (part->from + cut_gauss_at[g] * (part->to - part->from)) * cut_gauss_weight[g] * unit;
    float y = (float)(d * interval->per_half), share = (float)simd_min(simd_max(up, 0), 1);
    simd_float4 all = (float)value * (simd_float4){1, y, y * y, y * y * y};
    *lower += all * (1 - share);
    *upper += all * share;
  }
}

/* Cuts a piece at the st samples. */
static void add_cells(const struct cut_interval *interval, const struct cut_sight *sight, int first,
                      int far_count, const struct cut_piece *piece, struct sums *sums) {
  const int step = sight->rate < 0 ? -1 : 1;
  int cell = whole(sight->place + sight->rate * piece->low);
  const int last = whole(sight->place + sight->rate * piece->high);
  const double rise = (piece->to - piece->from) / (piece->high - piece->low);
  struct cut_piece part = *piece;
  for (;; cell += step) {
    part.high = piece->high;
    part.to = piece->to;
    if (cell != last) {
      part.high = simd_min((cell + (step > 0) - sight->place) / sight->rate, piece->high);
      part.to = piece->from + rise * (part.high - piece->low);
    }
    if (part.high > part.low) {
      add_cell(interval, sight, cell, &part, &sums->moment[clamp(cell, far_count - 1) - first],
               &sums->moment[clamp(cell + 1, far_count - 1) - first]);
      part.low = part.high;
      part.from = part.to;
    }
    if (cell == last) break;
  }
}

/* Integrals of H y^m times the distance beyond `crossing`, above it or below. */
SIMD_INLINE simd_float4 find_hinge(const struct cut_interval *interval, double crossing,
                                   bool above) {
  int k = 0;
  while (k < interval->pieces - 1 && crossing > interval->piece[k].high) ++k;
  const struct cut_piece *piece = &interval->piece[k];
  const float y = (float)(crossing * interval->per_half);
  const float t = (float)((crossing - (piece->low + piece->high) / 2) * interval->per_half);
  simd_float4 sum = {0};
  for (int power = CUT_HINGE - 1; power >= 0; --power)
    sum = sum * t + SIMD_LOAD(simd_floats4, interval->hinge[k][power]);
  if (above) return sum;
  return sum - (SIMD_LOAD(simd_floats4, interval->share + 1) -
                y * SIMD_LOAD(simd_floats4, interval->share));
}

/* An interval that is seen whole and over few st samples: as if radiance were linear in all of
 * it, as in the cell of the center, with kinks at the samples: its second differences there. */
static void add_whole(const struct cut_interval *interval, const struct cut_sight *sight, int low,
                      int high, int first, int far_count, struct sums *sums) {
  const int center = whole(sight->place), last = far_count - 1;
  const float up = (float)(sight->place - center), unit = (float)sight->scale;
  const float slope = (float)(sight->rate * interval->half), speed = slope < 0 ? -slope : slope;
  const simd_float4 all = SIMD_LOAD(simd_floats4, interval->share) * unit;
  const simd_float4 next = SIMD_LOAD(simd_floats4, interval->share + 1) * unit;
  const simd_float4 more = all * up + next * slope;
  sums->moment[clamp(center, last) - first] += all - more;
  sums->moment[clamp(center + 1, last) - first] += more;
  for (int line = low + 1; line <= high; ++line) {
    const int side = line > center ? 1 : -1;
    const double crossing = (line - sight->place) / sight->rate;
    const bool above = (side > 0) == (slope > 0);
    const simd_float4 kink = find_hinge(interval, crossing, above) * (speed * unit);
    sums->moment[clamp(line - side, last) - first] += kink;
    sums->moment[clamp(line, last) - first] -= kink + kink;
    sums->moment[clamp(line + side, last) - first] += kink;
  }
}

static void store(const struct sums *sums, struct cut_taps *taps) {
  for (int k = 0; k < taps->count; k += 4) {
    const simd_float4 *row = sums->moment + k;
    const simd_float4 low[2] = {__builtin_shufflevector(row[0], row[1], 0, 4, 1, 5),
                                __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5)};
    const simd_float4 high[2] = {__builtin_shufflevector(row[0], row[1], 2, 6, 3, 7),
                                 __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7)};
    *(simd_floats4 *)(taps->moment[0] + k) = __builtin_shufflevector(low[0], low[1], 0, 1, 4, 5);
    *(simd_floats4 *)(taps->moment[1] + k) = __builtin_shufflevector(low[0], low[1], 2, 3, 6, 7);
    *(simd_floats4 *)(taps->moment[2] + k) = __builtin_shufflevector(high[0], high[1], 0, 1, 4, 5);
    *(simd_floats4 *)(taps->moment[3] + k) = __builtin_shufflevector(high[0], high[1], 2, 3, 6, 7);
  }
}

/* So many st samples inside an interval at most, and kinks are cheaper than pieces. */
enum { FEW = 4 };

bool cut_taps_find(const struct cut_interval *interval, const struct cut_sight *sight,
                   int far_count, struct cut_taps *taps) {
  const struct cut_piece *pieces = interval->piece;
  struct cut_piece seen[3];
  struct sums sums;
  int count = interval->pieces;
  if (sight->clipped) {
    count = 0;
    pieces = seen;
    for (int k = 0; k < interval->pieces; ++k) {
      seen[count] = interval->piece[k];
      count += see(sight, far_count, &seen[count]);
    }
  }
  taps->count = 0;
  if (count == 0) return true;
  const double first = sight->place + sight->rate * pieces[0].low;
  const double second = sight->place + sight->rate * pieces[count - 1].high;
  const double low = simd_min(first, second), high = simd_max(first, second);
  if (!(high - low < CUT_TAPS - 2)) return false;
  const int from = whole(low), to = whole(high);
  taps->first = clamp(from, far_count - 1);
  taps->count = clamp(to + 1, far_count - 1) - taps->first + 1;
  for (int k = 0; k < 4; ++k) sums.moment[k] = (simd_float4){0};
  for (int k = 4; k < taps->count; k += 4) memset(sums.moment + k, 0, 4 * sizeof sums.moment[0]);
  if (!sight->clipped && to - from <= FEW)
    add_whole(interval, sight, from, to, taps->first, far_count, &sums);
  else
    for (int k = 0; k < count; ++k)
      add_cells(interval, sight, taps->first, far_count, &pieces[k], &sums);
  store(&sums, taps);
  return true;
}
