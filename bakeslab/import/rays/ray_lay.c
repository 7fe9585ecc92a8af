#include "import/rays/ray_lay.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/rays/ray_range.h"

/* Parts of the light that are left out at each end of a window or rectangle, and with a face. */
static const double negligible_window = 1.0 / 800, negligible_rectangle = 1.0 / 400,
                    negligible_face = 1e-4;
/* Cells of a window whose ranges are both this much longer are twice as large, which is dearer than
 * the little light beyond; a rectangle is to fit. */
static const double much_longer_window = 1.4, much_longer_rectangle = 1.1;
/* Boxes are flat where they are this much thinner than long; a line or a point gets a thickness. */
static const double flat = 1e-6, thickness = 1e-3;
static const double point_size = 1e-3; /* metres */
static const double reach = 15; /* of windows: rays at less than 4 degrees to a page are left out */
static const double square_to_axis = 0.94; /* cosine of 20 degrees */

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static double length(const double x[3]) {
  return hypot(hypot(x[0], x[1]), x[2]);
}

/* ---- The faces of a box ---- */

/* Gives lines and points a thickness; which axis the box is flat along, or -1. */
static int thicken(const double low[3], const double high[3], double box_low[3],
                   double box_high[3]) {
  double longest = 0;
  int flat_axes = 0, axis = -1;
  for (int c = 0; c < 3; ++c) longest = fmax(longest, high[c] - low[c]);
  for (int c = 0; c < 3; ++c)
    if (high[c] - low[c] <= flat * longest) ++flat_axes, axis = c;
  for (int c = 0; c < 3; ++c) {
    double half = (high[c] - low[c]) / 2, middle = low[c] + half;
    bool thin = high[c] - low[c] <= flat * longest;
    if (thin && flat_axes == 1) half = 0;
    if (thin && flat_axes > 1) half = longest > 0 ? thickness * longest / 2 : point_size / 2;
    box_low[c] = middle - half;
    box_high[c] = middle + half;
  }
  return flat_axes == 1 ? axis : -1;
}

static enum result add_face(struct ray_pages *pages, const double low[3], const double high[3],
                            int axis, int end, struct error *error) {
  double center[3], u[3] = {0}, v[3] = {0}, normal[3] = {0};
  int first = (axis + 1) % 3, second = (axis + 2) % 3;
  for (int c = 0; c < 3; ++c) center[c] = (low[c] + high[c]) / 2;
  center[axis] = end ? high[axis] : low[axis];
  u[first] = high[first] - low[first];
  v[second] = high[second] - low[second];
  normal[axis] = end ? 1 : -1;
  return ray_pages_add(pages, center, u, v, normal, error);
}

/* Takes away the pages that next to no light reaches. */
static void leave_out_dark(const struct ray_look *look, struct ray_pages *pages) {
  double flux[RAY_PAGES_MOST] = {0}, all = 0, abst[SLAB_AXES];
  int kept = 0;
  for (size_t n = 0; n < look->kept_count; ++n) {
    int found = ray_pages_find(pages, &look->kept[n], abst);
    double luminance = ray_luminance(look->kept[n].flux);
    all += luminance;
    if (found >= 0) flux[found] += luminance;
  }
  for (int n = 0; n < pages->count; ++n)
    if (flux[n] > negligible_face * all) pages->page[kept++] = pages->page[n];
  pages->count = kept;
}

enum result ray_lay_box(const struct ray_look *look, struct ray_pages *pages, struct error *error) {
  double low[3], high[3];
  int flat_axis = thicken(look->low, look->high, low, high);
  enum result result = RESULT_OK;
  *pages = (struct ray_pages){0};
  for (int k = 0; k < 6 && result == RESULT_OK; ++k)
    if (flat_axis < 0 || flat_axis == k / 2)
      result = add_face(pages, low, high, k / 2, k % 2, error);
  if (result == RESULT_OK) leave_out_dark(look, pages);
  return result;
}

/* ---- The best rectangle ---- */

/* Where most light goes, or the axis that is close to it. */
static void find_normal(const struct ray_look *look, double normal[3]) {
  double whole = length(look->direction);
  int axis = 2;
  memset(normal, 0, 3 * sizeof *normal);
  for (int c = 0; c < 3; ++c)
    if (fabs(look->direction[c]) > fabs(look->direction[axis])) axis = c;
  if (fabs(look->direction[axis]) >= square_to_axis * whole)
    normal[axis] = look->direction[axis] < 0 ? -1 : 1;
  else
    for (int c = 0; c < 3; ++c) normal[c] = look->direction[c] / whole;
}

/* Two unit vectors across it: axes, where it is one. */
static void find_across(const double normal[3], double across[2][3]) {
  int axis = 0;
  for (int c = 0; c < 3; ++c)
    if (fabs(normal[c]) > fabs(normal[axis])) axis = c;
  double *u = across[0], *v = across[1], along;
  memset(u, 0, 3 * sizeof *u);
  u[(axis + 1) % 3] = 1;
  along = dot(u, normal);
  for (int c = 0; c < 3; ++c) u[c] -= along * normal[c];
  double size = length(u);
  for (int c = 0; c < 3; ++c) u[c] /= size;
  for (int c = 0; c < 3; ++c)
    v[c] = normal[(c + 1) % 3] * u[(c + 2) % 3] - normal[(c + 2) % 3] * u[(c + 1) % 3];
}

/* Along the normal: the virtual focus, but within the box or close to it. */
static double find_height(const struct ray_look *look, const double normal[3]) {
  double focus[3], lowest = 0, highest = 0;
  for (int c = 0; c < 3; ++c) {
    double at_low = normal[c] * look->low[c], at_high = normal[c] * look->high[c];
    lowest += fmin(at_low, at_high);
    highest += fmax(at_low, at_high);
  }
  double near = 0.1 * (highest - lowest);
  double height = ray_look_focus(look, focus) ? dot(focus, normal) : (lowest + highest) / 2;
  return fmax(lowest - near, fmin(highest + near, height));
}

/* The rectangle on a plane at `height`, square to a normal, that holds the kept rays. */
static enum result fit_rectangle(const struct ray_look *look, const double normal[3], double height,
                                 struct ray_pages *pages, struct error *error) {
  double across[2][3], center[3], edge[2][3], range[2][2];
  struct ray_weighed *values = malloc((look->kept_count + 1) * sizeof *values);
  if (!values) return result_no_memory(error);
  find_across(normal, across);
  for (int axis = 0; axis < 2; ++axis) {
    size_t count = 0;
    for (size_t n = 0; n < look->kept_count; ++n) {
      const struct ray *ray = &look->kept[n];
      double forward = dot(ray->direction, normal);
      if (!(forward > 0)) continue;
      double steps = (height - dot(ray->origin, normal)) / forward;
      double at = dot(ray->origin, across[axis]) + steps * dot(ray->direction, across[axis]);
      if (isfinite(at)) values[count++] = (struct ray_weighed){at, ray_luminance(ray->flux)};
    }
    range[axis][0] = range[axis][1] = 0;
    if (count > 0)
      ray_range(values, count, negligible_rectangle, much_longer_rectangle, range[axis]);
  }
  free(values);
  double sizes[2] = {range[0][1] - range[0][0], range[1][1] - range[1][0]};
  double least = fmax(thickness * fmax(sizes[0], sizes[1]), 0);
  if (!(least > 0)) least = point_size;
  for (int c = 0; c < 3; ++c) {
    center[c] = height * normal[c];
    for (int axis = 0; axis < 2; ++axis) {
      center[c] += (range[axis][0] + range[axis][1]) / 2 * across[axis][c];
      edge[axis][c] = fmax(sizes[axis], least) * across[axis][c];
    }
  }
  return ray_pages_add(pages, center, edge[0], edge[1], normal, error);
}

enum result ray_lay_best(const struct ray_look *look, struct ray_pages *pages,
                         struct error *error) {
  double low[3], high[3], normal[3];
  int flat_axis = thicken(look->low, look->high, low, high);
  *pages = (struct ray_pages){0};
  if (flat_axis >= 0)
    return add_face(pages, low, high, flat_axis, look->direction[flat_axis] > 0, error);
  find_normal(look, normal);
  return fit_rectangle(look, normal, find_height(look, normal), pages, error);
}

/* ---- Windows ---- */

/* Fills the slopes along s or t of the kept rays that leave through a page. */
static size_t find_slopes(const struct ray_look *look, const struct ray_pages *pages, int page,
                          int axis, struct ray_weighed *values) {
  size_t count = 0;
  double abst[SLAB_AXES];
  for (size_t n = 0; n < look->kept_count; ++n)
    if (ray_pages_find(pages, &look->kept[n], abst) == page)
      values[count++] = (struct ray_weighed){abst[axis], ray_luminance(look->kept[n].flux)};
  return count;
}

enum result ray_lay_windows(const struct ray_look *look, struct ray_pages *pages,
                            struct error *error) {
  struct ray_weighed *values = malloc((look->kept_count + 1) * sizeof *values);
  enum result result = values ? RESULT_OK : result_no_memory(error);
  for (int n = 0; n < pages->count && result == RESULT_OK; ++n)
    for (int axis = 0; axis < 2 && result == RESULT_OK; ++axis) {
      size_t count = find_slopes(look, pages, n, SLAB_S + axis, values);
      double *window = pages->page[n].geometry.st_window + 2 * axis;
      if (count == 0) {
        result = result_fail(
            error, RESULT_BAD,
            "page %d: no ray reaches it: check its --center, --u, --v and --normal", n + 1);
        break;
      }
      ray_range(values, count, negligible_window, much_longer_window, window);
      window[0] = fmin(fmax(window[0], -reach), reach);
      window[1] = fmin(fmax(window[1], -reach), reach);
      double lacks = RAY_LAY_LEAST_WINDOW - (window[1] - window[0]);
      if (lacks > 0) { /* parallel rays */
        window[0] -= lacks / 2;
        window[1] += lacks / 2;
      }
    }
  free(values);
  return result;
}
