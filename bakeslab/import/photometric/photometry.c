#include "import/photometric/photometry.h"

#include <math.h>
#include <stdlib.h>

#include "base/interval.h"

static const double degrees = 180 / M_PI;

void photometry_free(struct photometry *lamp) {
  free(lamp->plane);
  free(lamp->row);
  free(lamp->candela);
  *lamp = (struct photometry){0};
}

enum result photometry_alloc(struct photometry *lamp, struct error *error) {
  lamp->plane = calloc((size_t)lamp->planes, sizeof *lamp->plane);
  lamp->row = calloc((size_t)lamp->rows, sizeof *lamp->row);
  lamp->candela = calloc((size_t)lamp->planes * (size_t)lamp->rows, sizeof *lamp->candela);
  return lamp->plane && lamp->row && lamp->candela ? RESULT_OK : result_no_memory(error);
}

/* Of the turn by quarters. */
static const int cosines[4] = {1, 0, -1, 0}, sines[4] = {0, 1, 0, -1};

/* The angles of a direction: the plane's, and that within it; degrees. */
static void angles(const struct photometry *lamp, const double d[3], double *plane, double *row) {
  int c = cosines[lamp->turn & 3], s = sines[lamp->turn & 3];
  double x = c * d[0] + s * d[2], y = d[1], z = c * d[2] - s * d[0];
  switch (lamp->type) {
  case PHOTOMETRY_C:
    *plane = atan2(z, x) * degrees;
    if (*plane < 0) *plane += 360;
    *row = atan2(hypot(x, z), -y) * degrees;
    return;
  case PHOTOMETRY_B:
    *plane = atan2(-z, hypot(x, y)) * degrees;
    *row = x == 0 && y == 0 ? 0 : atan2(x, -y) * degrees; /* at the pole all are one */
    return;
  case PHOTOMETRY_A:
    *plane = atan2(-z, x) * degrees;
    *row = atan2(y, hypot(x, z)) * degrees;
    return;
  }
}

void photometry_table_direction(const struct photometry *lamp, size_t entry, double direction[3]) {
  double plane = lamp->plane[entry / (size_t)lamp->rows] / degrees;
  double row = lamp->row[entry % (size_t)lamp->rows] / degrees, x = 0, y = 0, z = 0;
  int c = cosines[lamp->turn & 3], s = sines[lamp->turn & 3];
  switch (lamp->type) {
  case PHOTOMETRY_C:
    x = sin(row) * cos(plane), y = -cos(row), z = sin(row) * sin(plane);
    break;
  case PHOTOMETRY_B:
    x = cos(plane) * sin(row), y = -cos(plane) * cos(row), z = -sin(plane);
    break;
  case PHOTOMETRY_A:
    x = cos(row) * cos(plane), y = sin(row), z = -cos(row) * sin(plane);
    break;
  }
  direction[0] = c * x - s * z;
  direction[1] = y;
  direction[2] = c * z + s * x;
}

/* The cell of ascending values around x, and where in it, 0 to 1. False outside. */
static bool find(const double *values, int count, double x, int *cell, double *part) {
  *cell = 0;
  *part = 0;
  if (!(x >= values[0] && x <= values[count - 1])) return false;
  *cell = interval_find(values, count, x);
  if (count > 1) *part = (x - values[*cell]) / (values[*cell + 1] - values[*cell]);
  return true;
}

double photometry_candela(const struct photometry *lamp, const double direction[3]) {
  double plane = 0, row = 0, across = 0, along;
  int i = 0, j;
  angles(lamp, direction, &plane, &row);
  if (!find(lamp->row, lamp->rows, row, &j, &along)) return 0;

  if (lamp->planes > 1 && !find(lamp->plane, lamp->planes, plane, &i, &across)) return 0;
  const double *at = lamp->candela + (size_t)i * (size_t)lamp->rows + j;
  int right = across > 0 ? lamp->rows : 0, up = along > 0 ? 1 : 0;
  return (1 - across) * ((1 - along) * at[0] + along * at[up]) +
         across * ((1 - along) * at[right] + along * at[right + up]);
}

/* Adds to each value's weight the integral, over the angles, of density times the hat function
 * that is 1 there and 0 at its neighbours. The density is 1 or, with `how` 's' or 'c', the sine
 * or the cosine of the angle. */
static void hat_weights(const double *values, int count, char how, double *weights) {
  for (int k = 0; k < count; ++k) weights[k] = 0;
  for (int k = 0; k + 1 < count; ++k) {
    double a = values[k] / degrees, b = values[k + 1] / degrees, whole, first;
    if (how == 's') { /* the integrals of sin, and of (x - a) sin */
      whole = cos(a) - cos(b);
      first = sin(b) - sin(a) - (b - a) * cos(b);
    } else if (how == 'c') {
      whole = sin(b) - sin(a);
      first = (b - a) * sin(b) + cos(b) - cos(a);
    } else {
      whole = b - a;
      first = (b - a) * (b - a) / 2;
    }
    weights[k] += whole - first / (b - a);
    weights[k + 1] += first / (b - a);
  }
}

double photometry_flux(const struct photometry *lamp) {
  double sum = 0, *across = malloc((size_t)(lamp->planes + lamp->rows) * sizeof *across);
  if (!across) return NAN;
  double *along = across + lamp->planes;
  hat_weights(lamp->plane, lamp->planes, lamp->type == PHOTOMETRY_B ? 'c' : '1', across);
  hat_weights(lamp->row, lamp->rows,
              lamp->type == PHOTOMETRY_C   ? 's'
              : lamp->type == PHOTOMETRY_A ? 'c'
                                           : '1',
              along);
  if (lamp->planes == 1) across[0] = 2 * M_PI;
  for (int i = 0; i < lamp->planes; ++i)
    for (int j = 0; j < lamp->rows; ++j)
      sum += across[i] * along[j] * lamp->candela[(size_t)i * (size_t)lamp->rows + (size_t)j];
  free(across);
  return sum;
}

double photometry_peak(const struct photometry *lamp) {
  double peak = 0;
  size_t count = (size_t)lamp->planes * (size_t)lamp->rows;
  for (size_t n = 0; n < count; ++n) peak = fmax(peak, lamp->candela[n]);
  return peak;
}

enum result photometry_scale(struct photometry *lamp, double factor, struct error *error) {
  size_t count = (size_t)lamp->planes * (size_t)lamp->rows;
  double most = 0;
  for (size_t n = 0; n < count; ++n) {
    lamp->candela[n] *= factor;
    most = fmax(most, fabs(lamp->candela[n]));
  }
  if (most <= PHOTOMETRY_MOST) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "intensities of %g cd are no lamp's", most);
}
