/* cut_views_error.c - what the sum over all views errs by, and what it costs (cut_views.h). */
#include <math.h>

#include "cut/cut_views.h"

/* What the kernel's slope leaves out, in units of its change over a view and over the aperture. */
static const double view_order = 0.5, aperture_order = 0.15;
/* From this square of a view's size over its distance on, the slope in the middle of the aperture
 * says nothing of it. */
static const double steep = 0.25;
static const double rounding = 3e-6, nodes_rounding = 3e-5; /* of sums in single precision */

/* Slopes between which the aperture is, to the last bit those that the errors below were measured
 * with. Returns the square of the distance to its nearest point, in units of the height. */
static double find_ends(const struct seen_page *seen, double low[2], double high[2]) {
  double square = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double half = seen->page->axes[axis].half, foot = seen->foot[axis];
    low[axis] = (-half - foot) / seen->height;
    high[axis] = (half - foot) / seen->height;
    const double nearest = low[axis] > 0 ? low[axis] : high[axis] < 0 ? high[axis] : 0;
    square += nearest * nearest;
  }
  return square;
}

/* Slopes are in single precision: what that makes of the height over the tangent plane. */
static double slope_rounding(const struct seen_page *seen, const double low[2],
                             const double high[2]) {
  double range[2], far = 1;
  kernel_heights(&seen->kernel, low, high, range);
  for (int axis = 0; axis < 2; ++axis) far = hypot(far, fmax(fabs(low[axis]), fabs(high[axis])));
  return range[0] > 0 ? 2e-7 * far / range[0] : INFINITY;
}

/* With one node and the kernel's slope. */
static double slope_error(const struct seen_page *seen) {
  const struct light_axis *axes = seen->page->axes;
  const double *n = seen->kernel.normal;
  double middle[2], low[2], high[2], error = rounding;
  const double nearest = find_ends(seen, low, high);
  seen_page_middle(seen, middle);
  error += slope_rounding(seen, low, high);
  const double square = 1 + middle[0] * middle[0] + middle[1] * middle[1];
  const double tilt =
      sqrt(n[0] * n[0] + n[1] * n[1]) / kernel_height(&seen->kernel, middle[0], middle[1]);
  const double change = tilt + 2 / sqrt(square); /* of the kernel, relative */
  for (int axis = 0; axis < 2; ++axis) {
    const double step = axes[axis].near_step / seen->height, half = axes[axis].half / seen->height;
    const double wide = fabs(axes[axis].kappa * seen->height - 1) * step / axes[axis].far_step;
    error += change * change * step * (view_order * step + aperture_order * half * fmin(wide, 1));
    if (step * step > steep * nearest) error = INFINITY;
  }
  return error;
}

/* What polynomials through the nodes leave out: of the kernel's part 1/r^4, whose n-th derivative
 * is about (n + 1)!/r^n, and of that times its height over the tangent plane. */
static double nodes_error(const struct seen_page *seen, int nodes) {
  static const double order[CUT_VIEWS_NODES + 1] = {0, 0, 1, 0.8, 0.6};
  const struct light_axis *axes = seen->page->axes;
  double low[2], high[2], range[2], error = nodes_rounding;
  const double square = find_ends(seen, low, high);
  error += slope_rounding(seen, low, high);
  kernel_heights(&seen->kernel, low, high, range);
  if (!(range[0] > 0)) return INFINITY;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = axes[axis].near_step / seen->height, part = step / sqrt(square);
    const double tilt = fabs(seen->kernel.normal[axis]) * step / range[0];
    error += order[nodes] * pow(part, nodes - 1) * (part + tilt);
  }
  return error;
}

int cut_views_nodes(const struct seen_page *seen, double tolerance, double *error) {
  const struct light_axis *axes = seen->page->axes;
  if (axes[0].near_count > CUT_VIEWS_MOST || axes[1].near_count > CUT_VIEWS_MOST ||
      !(seen->height > 0))
    return 0;
  for (int nodes = 1; nodes <= CUT_VIEWS_NODES; ++nodes) {
    *error = nodes == 1 ? slope_error(seen) : nodes_error(seen, nodes);
    if (*error <= tolerance) return nodes;
  }
  return 0;
}

double cut_views_price(const struct seen_page *seen, int nodes) {
  static const double fixed = 200, view_price = 20, pair_price = 1.2;
  const struct light_axis *axes = seen->page->axes;
  double samples = 1, views = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const double wide = fabs(axes[axis].kappa * seen->height - 1) / seen->height *
                        axes[axis].near_step / axes[axis].far_step;
    samples *= (2 + 2 * wide) * axes[axis].near_count;
    views += axes[axis].near_count;
  }
  return fixed + view_price * views + nodes * pair_price * samples / 2;
}
