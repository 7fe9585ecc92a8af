/* strips.c - line p of n samples is the p-th sample, line -1 and line n are the
 * ends of the axis; piece p lies between the lines p-1 and p. */
#include "microlight/strips.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/array.h"
#include "base/simd.h"

void strips_free(struct strips *strips) {
  free(strips->strip);
  *strips = (struct strips){0};
}

enum result strips_append(struct strips *strips, const struct strip *strip, struct error *error) {
  if (!array_reserve(&strips->strip, &strips->room, strips->count + 1, sizeof *strip))
    return result_no_memory(error);
  strips->strip[strips->count++] = *strip;
  return RESULT_OK;
}

/* An axis as one receiver sees it. Slopes x are relative to one ray, which has the slope `base` and
 * passes through a of the aperture and s of the st plane. */
struct sight {
  const struct light_axis *axis;
  double q, z, rate; /* s changes by `rate` x */
  double base, a, s;
};

static double near_line(const struct light_axis *axis, int line) {
  if (line < 0) return -axis->half;
  if (line >= axis->near_count) return axis->half;
  return (line + 0.5 - 0.5 * axis->near_count) * axis->near_step;
}

static double far_line(const struct light_axis *axis, int line) {
  if (line < 0) return axis->far_low;
  if (line >= axis->far_count) return axis->far_high;
  return axis->far_low + (line + 0.5) * axis->far_step;
}

static double near_slope(const struct sight *sight, int line) {
  return (near_line(sight->axis, line) - sight->a) / sight->z;
}

static double far_slope(const struct sight *sight, int line) {
  return (far_line(sight->axis, line) - sight->s) / sight->rate;
}

static double within(double weight) {
  return weight > 0 ? weight < 1 ? weight : 1 : 0;
}

/* Weights of the upper samples where a ray has the slope x. */
static double near_weight(const struct sight *sight, const struct strip_taps *taps, double x) {
  if (!taps->near_up) return 0;
  double from_line = sight->a - near_line(sight->axis, taps->near) + x * sight->z;
  return within(from_line / sight->axis->near_step);
}

static double far_weight(const struct sight *sight, const struct strip_taps *taps, double x) {
  if (!taps->far_up) return 0;
  double from_line = sight->s - far_line(sight->axis, taps->far) + x * sight->rate;
  return within(from_line / sight->axis->far_step);
}

/* The samples on both sides of a piece between the lines of `count` samples. */
static void set_taps(int piece, int count, int *lower, int *up) {
  *lower = piece > 0 ? piece - 1 : 0;
  *up = piece > 0 && piece < count;
}

static struct sight make_sight(const struct light_axis *axis, double q, double z) {
  double height = z > 0 ? z : DBL_MIN;
  return (struct sight){.axis = axis, .q = q, .z = height, .rate = axis->kappa * height - 1};
}

/* Choose the ray through a, or through s; the other of the two by the formula that cancels the
 * fewest digits. */
static void start_at_near(struct sight *sight, double a) {
  sight->base = (a - sight->q) / sight->z;
  sight->a = a;
  sight->s = sight->axis->kappa * a - sight->base;
}

static void start_at_far(struct sight *sight, double s) {
  const double kappa = sight->axis->kappa;
  sight->base = (s - kappa * sight->q) / sight->rate;
  sight->s = s;
  const bool near = kappa * fabs(sight->q) < fabs(s) + fabs(sight->base);
  sight->a = near ? sight->q + sight->z * sight->base : (s + sight->base) / kappa;
}

/* The piece that holds s, the only one that a receiver on the st plane sees; -1 outside. */
static int piece_at(const struct light_axis *axis, double s) {
  if (!(s >= axis->far_low && s <= axis->far_high)) return -1;
  int piece = 0;
  while (piece < axis->far_count && s >= far_line(axis, piece)) ++piece;
  return piece;
}

/* Starts from the lowest visible slope. Finds the piece of the far samples there, and the slope
 * at which they end: ascending slopes meet the pieces in ascending order beyond the st plane, else
 * in descending order. */
static bool start(struct sight *sight, int *piece, double *far_high) {
  const int count = sight->axis->far_count;
  const bool ascending = sight->rate > 0;
  start_at_near(sight, near_line(sight->axis, -1));
  if (sight->rate == 0) {
    *far_high = INFINITY;
    *piece = piece_at(sight->axis, sight->s);
    return *piece >= 0;
  }
  *piece = ascending ? 0 : count;
  if (far_slope(sight, ascending ? -1 : count) > 0)
    start_at_far(sight, far_line(sight->axis, ascending ? -1 : count));
  *far_high = far_slope(sight, ascending ? count : -1);
  return true;
}

static double near_slope_or_end(const struct sight *sight, int line) {
  return line < sight->axis->near_count ? near_slope(sight, line) : INFINITY;
}

enum result strips_find(const struct light_axis *axis, double q, double z, struct strips *strips,
                        struct error *error) {
  struct sight sight = make_sight(axis, q, z);
  double far_high;
  int far, near = 0;
  strips->count = 0;
  if (!start(&sight, &far, &far_high)) return RESULT_OK;
  double low = 0, high = simd_min(near_slope(&sight, axis->near_count), far_high);
  /* Ascending: the piece ends at line `far`; descending: at the line before. */
  int ascending = sight.rate > 0, step = ascending ? 1 : -1;
  int last = ascending ? axis->far_count : 0;
  double near_end = near_slope_or_end(&sight, near);
  double far_end = sight.rate != 0 && far != last ? far_slope(&sight, far - !ascending) : INFINITY;
  while (low < high) {
    double end = simd_min(simd_min(near_end, far_end), high);
    if (end > low) {
      struct strip strip = {.low = sight.base + low, .high = sight.base + end, .width = end - low};
      set_taps(near, axis->near_count, &strip.taps.near, &strip.taps.near_up);
      set_taps(far, axis->far_count, &strip.taps.far, &strip.taps.far_up);
      for (int side = 0; side < 2; ++side) {
        double x = side ? end : low;
        strip.near_weight[side] = near_weight(&sight, &strip.taps, x);
        strip.far_weight[side] = far_weight(&sight, &strip.taps, x);
      }
      enum result result = strips_append(strips, &strip, error);
      if (result != RESULT_OK) return result;
      low = end;
    }
    if (end >= high) break;
    if (near_end <= end) near_end = near_slope_or_end(&sight, ++near);
    if (far_end <= end) {
      far += step;
      far_end = far != last ? far_slope(&sight, far - !ascending) : INFINITY;
    }
  }
  return RESULT_OK;
}

/* The square of a larger width overflows. */
static const double widest_view = 1e150;

enum result strips_find_views(const struct light_axis *axis, double q, double z,
                              struct strips *strips, struct error *error) {
  struct sight sight = make_sight(axis, q, z);
  const double width = axis->near_step / sight.z;
  strips->count = 0;
  for (int i = 0; i < axis->near_count; ++i) {
    start_at_near(&sight, near_line(axis, i));
    int piece = isfinite(sight.base) ? piece_at(axis, sight.s) : -1;
    if (piece < 0 || !(width < widest_view)) continue;
    struct strip strip = {.low = sight.base - width / 2,
                          .high = sight.base + width / 2,
                          .width = width,
                          .taps = {.near = i}};
    set_taps(piece, axis->far_count, &strip.taps.far, &strip.taps.far_up);
    for (int side = 0; side < 2; ++side)
      strip.far_weight[side] = far_weight(&sight, &strip.taps, 0);
    enum result result = strips_append(strips, &strip, error);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

struct strip strip_part(const struct strip *strip, double low, double high) {
  if (low <= strip->low && high >= strip->high) return *strip;
  struct strip part = *strip;
  part.low = fmax(low, strip->low);
  part.high = fmin(high, strip->high);
  part.width = part.high - part.low;
  for (int side = 0; side < 2; ++side) {
    double share = ((side ? part.high : part.low) - strip->low) / strip->width;
    part.near_weight[side] =
        strip->near_weight[0] + share * (strip->near_weight[1] - strip->near_weight[0]);
    part.far_weight[side] =
        strip->far_weight[0] + share * (strip->far_weight[1] - strip->far_weight[0]);
  }
  return part;
}

enum result strips_clip(const struct strips *from, double low, double high, struct strips *strips,
                        struct error *error) {
  for (int k = 0; k < from->count; ++k) {
    const struct strip *strip = &from->strip[k];
    if (!(strip->high > low)) continue;
    if (!(strip->low < high)) break;
    struct strip part = strip_part(strip, low, high);
    enum result result = strips_append(strips, &part, error);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}
