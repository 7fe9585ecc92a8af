/* lamp.c - see lamp.h. A ray is followed upwards from (a, 0, b): at height y it is at
 * (a - s y, b - t y). Numbers are those of the script; surfaces are lit by the bulb's
 * centre, once. */
#include "lamp.h"

#include <math.h>
#include <stdbool.h>

const double lamp_aperture = 20, lamp_slope = 1.5;

static const double collar = 10, focus = 2.5, apex = 14, bulb = 11.5; /* radius, heights */
static const double bars_low = 0.1, bars_high = 4, pitch = 5, half_bar = 0.1;
static const double intensity = 500 * 1.5 * 1.5; /* pi times less than the bulb's, of albedo 1 */

/* Height at which x - slope y enters one of the bars, from bars_low on; -1: it starts
 * inside, INFINITY: never. *side is where it enters. */
static double bar_height(double x, double slope, double *side) {
  double first = INFINITY;
  for (int n = -1; n <= 1; ++n) {
    double from_middle = x - slope * bars_low - n * pitch;
    if (fabs(from_middle) <= half_bar) return -1;
    if (from_middle * slope <= 0) continue; /* moves away from it */
    double edge = n * pitch + copysign(half_bar, from_middle);
    double y = (x - edge) / slope;
    if (y < first) {
      first = y;
      *side = edge;
    }
  }
  return first;
}

/* Whether a bar is between x at height y and the bulb's centre, at x = 0. */
static bool bar_shades(double x, double y) {
  double from = fabs(x), to = from * (bulb - bars_high) / (bulb - y);
  for (int n = 0; n <= 1; ++n)
    if (from > n * pitch + half_bar && to < n * pitch + half_bar) return true;
  return false;
}

/* A bar's side at x = side, or (swapped) at z = side, which faces the ray. */
static double bar_radiance(double side, double other, double y, double slope) {
  /* The ray comes from larger x where slope > 0; the bulb must be there as well. */
  if (side * slope >= 0 || bar_shades(other, y)) return 0;
  double up = bulb - y, square = side * side + other * other + up * up;
  return 0.02 * intensity * fabs(side) / (square * sqrt(square));
}

static double collar_radiance(double x, double z, double y) {
  if (bar_shades(x, y) || bar_shades(z, y)) return 0;
  double square = collar * collar + (bulb - y) * (bulb - y);
  return 0.02 * intensity * collar / (square * sqrt(square));
}

static bool hits_bulb(double a, double b, double s, double t) {
  double up = a * s + b * t + bulb, d2 = s * s + t * t + 1;
  return a * a + b * b + bulb * bulb - up * up / d2 <= 1.5 * 1.5;
}

double lamp_radiance(double a, double b, double s, double t) {
  double x = a - s * bars_low, z = b - t * bars_low;
  if (x * x + z * z >= collar * collar) return 0; /* outside, where nothing is lit */
  double slope2 = s * s + t * t, half = a * s + b * t;
  double leave = INFINITY; /* height at which it meets the collar */
  if (slope2 > 0)
    leave = (half + sqrt(half * half - slope2 * (a * a + b * b - collar * collar))) / slope2;
  double end = fmin(leave, bars_high), side_x = 0, side_z = 0;
  double bar_x = bar_height(a, s, &side_x), bar_z = bar_height(b, t, &side_z);
  if (fmin(bar_x, bar_z) < 0) return 0; /* from below: in their own shade */
  if (fmin(bar_x, bar_z) < end)
    return bar_x < bar_z ? bar_radiance(side_x, b - t * bar_x, bar_x, s)
                         : bar_radiance(side_z, a - s * bar_z, bar_z, t);
  if (leave < bars_high) return collar_radiance(a - s * leave, b - t * leave, leave);
  if (hits_bulb(a, b, s, t)) return 500;
  /* The reflector, x^2 + z^2 = 4 focus (apex - y): a point of it is as far from the focus
   * as from a plane one focal length above the apex, and its normal halves the angle. */
  double p = 2 * focus - half, c = a * a + b * b - 4 * focus * apex;
  double root = sqrt(p * p - slope2 * c);
  double y = p >= 0 ? -c / (p + root) : (root - p) / slope2;
  double distance = focus + apex - y;
  return 0.8 * intensity / (distance * distance) * sqrt(focus / distance);
}

void lamp_point(int n, const double shift[4], double point[4]) {
  static const double step[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378086,
                                 0.5385972572236100};
  for (int c = 0; c < 4; ++c) {
    double x = shift[c] + (n + 1) * step[c];
    point[c] = x - floor(x);
  }
}

double lamp_flux(int rays) {
  static const double shift[4] = {0.5, 0.5, 0.5, 0.5};
  double sum = 0;
  for (int n = 0; n < rays; ++n) {
    double x[4];
    lamp_point(n, shift, x);
    for (int c = 0; c < 4; ++c) x[c] = (x[c] - 0.5) * (c < 2 ? lamp_aperture : 2 * lamp_slope);
    double r = 1 + x[2] * x[2] + x[3] * x[3]; /* cos(theta) d(omega) = ds dt / r^2 */
    sum += lamp_radiance(x[0], x[1], x[2], x[3]) / (r * r);
  }
  double area = lamp_aperture * lamp_aperture * 4 * lamp_slope * lamp_slope;
  return sum / rays * area;
}
