/* point_table.c - a table of intensities on evenly spaced nodes.
 *
 * 1. The sphere's longitude and latitude are the two angles of the table, by its type.
 * 2. Nodes are as far apart as the greatest common divisor of the angles, so that all of these are
 *    nodes; closer where the table ends with light before the sphere does, so that its end is
 *    sharp; and no closer than MOST_STEPS allow.
 * 3. At each node the intensity is interpolated in the table. */
#include "include/point/point_table.h"

#include <math.h>
#include <stdlib.h>

/* Angles are multiples of it, in degrees, as files write them; ends with light are as sharp as
 * `sharp`. */
static const double grain = 1e-3, sharp = 0.25;
enum { MOST_STEPS = 2048 };

/* One of the table's two angles, and what it spans on the sphere, in degrees. */
struct angle {
  const double *at; /* ascending; not owned */
  int count;
  double low, span; /* longitudes from 0 on, negative ones being past 180 */
  bool lit_end;     /* the table ends with light, the sphere does not */
};

static int common_divisor(int a, int b) {
  while (b) {
    int rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

/* Steps to all of the span; whether all angles are nodes then. */
static int count_steps(const struct angle *angle, bool *exact) {
  int span = (int)lround(angle->span / grain), divisor = span;
  for (int k = 0; k < angle->count; ++k) {
    double from = (angle->at[k] - angle->low) / grain;
    if (fabs(from - round(from)) > 1e-3) *exact = false;
    divisor = common_divisor(divisor, abs((int)lround(from)));
  }
  int steps = span / divisor;
  int closer = angle->lit_end ? (int)ceil(angle->span / sharp / steps) : 1;
  if (steps > MOST_STEPS) {
    *exact = false;
    return MOST_STEPS;
  }
  return steps * (closer < MOST_STEPS / steps ? closer : MOST_STEPS / steps);
}

/* The neighbours of x, the first being k, and the weight of the second. False outside of the
 * table. */
static bool find(const struct angle *angle, double x, int *k, double *weight) {
  const double *at = angle->at;
  int last = angle->count - 1;
  *k = 0;
  *weight = 0;
  if (last == 0) return true; /* alike all around */
  if (x < at[0] - grain / 2 || x > at[last] + grain / 2) return false;
  while (*k < last - 1 && x >= at[*k + 1]) ++*k;
  *weight = fmin(fmax((x - at[*k]) / (at[*k + 1] - at[*k]), 0), 1);
  return true;
}

/* The table's intensity at its own two angles, planes first; 0 outside. */
static double interpolate(const struct photometry *lamp, const struct angle angles[2],
                          const double at[2]) {
  int first[2];
  double weight[2], sum = 0;
  for (int k = 0; k < 2; ++k)
    if (!find(&angles[k], at[k], &first[k], &weight[k])) return 0;
  for (int k = 0; k < 4; ++k) {
    double share = (k & 1 ? weight[0] : 1 - weight[0]) * (k & 2 ? weight[1] : 1 - weight[1]);
    size_t plane = (size_t)(first[0] + (k & 1)), row = (size_t)(first[1] + (k >> 1));
    if (share > 0) sum += share * lamp->candela[plane * (size_t)lamp->rows + row];
  }
  return sum;
}

static bool any_light(const struct photometry *lamp, int first, int count, int stride) {
  for (int k = 0; k < count; ++k)
    if (lamp->candela[first + k * stride] != 0) return true;
  return false;
}

/* The angles of planes and of rows on the sphere; returns which of them is the longitude. */
static int place_angles(const struct photometry *lamp, struct angle angles[2]) {
  int planes = lamp->planes, rows = lamp->rows;
  int longitude = lamp->type == PHOTOMETRY_B ? 1 : 0;
  bool ends[2][2] = {{any_light(lamp, 0, rows, 1), any_light(lamp, (planes - 1) * rows, rows, 1)},
                     {any_light(lamp, 0, planes, rows), any_light(lamp, rows - 1, planes, rows)}};
  angles[0] = (struct angle){.at = lamp->plane, .count = planes};
  angles[1] = (struct angle){.at = lamp->row, .count = rows};
  for (int k = 0; k < 2; ++k) {
    struct angle *angle = &angles[k];
    double low = lamp->type == PHOTOMETRY_C ? 0 : k == longitude ? -180 : -90;
    angle->span = k == longitude ? 360 : 180;
    angle->low = k == longitude ? 0 : low;
    if (angle->count == 1) continue;
    angle->lit_end = (ends[k][0] && angle->at[0] > low + grain) ||
                     (ends[k][1] && angle->at[angle->count - 1] < low + angle->span - grain);
  }
  return longitude;
}

/* The sphere's axes in lamp space: of longitude 0, the pole, of longitude 90; as photometry.h has
 * the angles. */
static void set_axes(const struct photometry *lamp, double axes[3][3]) {
  static const double of_a[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                      of_b[3][3] = {{0, -1, 0}, {0, 0, -1}, {1, 0, 0}},
                      of_c[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  static const double cosine[4] = {1, 0, -1, 0}, sine[4] = {0, 1, 0, -1};
  const double(*own)[3] = lamp->type == PHOTOMETRY_A   ? of_a
                          : lamp->type == PHOTOMETRY_B ? of_b
                                                       : of_c;
  double c = cosine[lamp->turn & 3], s = sine[lamp->turn & 3];
  for (int k = 0; k < 3; ++k) {
    axes[k][0] = c * own[k][0] - s * own[k][2];
    axes[k][1] = own[k][1];
    axes[k][2] = s * own[k][0] + c * own[k][2];
  }
}

enum result point_table_make(const struct photometry *lamp, struct point_table *table,
                             struct error *error) {
  struct angle angles[2];
  int longitude = place_angles(lamp, angles), latitude = 1 - longitude;
  *table = (struct point_table){.exact = true};
  set_axes(lamp, table->axes);
  table->columns = count_steps(&angles[longitude], &table->exact) + 1;
  table->rows = count_steps(&angles[latitude], &table->exact) + 1;
  table->intensity = malloc((size_t)table->columns * (size_t)table->rows * sizeof(double));
  if (!table->intensity) return result_no_memory(error);
  double *value = table->intensity, at[2];
  for (int j = 0; j < table->rows; ++j)
    for (int i = 0; i < table->columns; ++i, ++value) {
      at[longitude] = 360.0 * i / (table->columns - 1);
      if (lamp->type != PHOTOMETRY_C && at[longitude] > 180) at[longitude] -= 360;
      at[latitude] = angles[latitude].low + 180.0 * j / (table->rows - 1);
      *value = interpolate(lamp, angles, at);
      if (*value < 0)
        return result_fail(error, RESULT_BAD,
                           "its intensity of %g cd is negative, which no light of POV-Ray's can "
                           "give",
                           *value);
    }
  return RESULT_OK;
}

void point_table_free(struct point_table *table) {
  free(table->intensity);
  *table = (struct point_table){0};
}
