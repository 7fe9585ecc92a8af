#include "import/rays/ray_pages.h"

#include <math.h>
#include <string.h>

/* Rays that are this little beside a rectangle are moved to this little within. */
static const double on_edge = 1 + 1e-6, within = 1 + 1e-9;

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static double length(const double x[3]) {
  return hypot(hypot(x[0], x[1]), x[2]);
}

static double clamp(double x, double most) {
  return x > most ? most : x < -most ? -most : x;
}

enum result ray_pages_add(struct ray_pages *pages, const double center[3], const double u[3],
                          const double v[3], const double normal[3], struct error *error) {
  if (pages->count == RAY_PAGES_MOST)
    return result_fail(error, RESULT_BAD, "more than %d pages", RAY_PAGES_MOST);
  struct ray_page *page = &pages->page[pages->count];
  *page = (struct ray_page){.geometry = slab_default()};
  struct slab *slab = &page->geometry;
  double n = length(normal);
  memcpy(slab->center, center, sizeof slab->center);
  memcpy(slab->u, u, sizeof slab->u);
  memcpy(slab->v, v, sizeof slab->v);
  for (int c = 0; c < 3; ++c) slab->normal[c] = normal[c] / n;
  enum result result = slab_check(slab, error);
  if (result != RESULT_OK) return result_at(result, error, "page %d", pages->count + 1);
  page->half[0] = length(u) / 2;
  page->half[1] = length(v) / 2;
  for (int k = 0; k < 2; ++k) {
    page->edge[k] = on_edge * page->half[k];
    page->inside[k] = page->half[k] / within;
  }
  for (int c = 0; c < 3; ++c) {
    page->u[c] = u[c] / length(u);
    page->v[c] = v[c] / length(v);
  }
  ++pages->count;
  return RESULT_OK;
}

int ray_pages_find(const struct ray_pages *pages, const struct ray *ray, double abst[SLAB_AXES]) {
  int found = -1;
  double closest = INFINITY;
  for (int n = 0; n < pages->count; ++n) {
    const struct ray_page *page = &pages->page[n];
    const struct slab *slab = &page->geometry;
    double forward = dot(ray->direction, slab->normal), point[3];
    if (!(forward > 0)) continue;
    for (int c = 0; c < 3; ++c) point[c] = ray->origin[c] - slab->center[c];
    double steps = -dot(point, slab->normal) / forward;
    if (!(fabs(steps) < closest)) continue;
    double slope_u = dot(ray->direction, page->u), slope_v = dot(ray->direction, page->v);
    double a = dot(point, page->u) + steps * slope_u, b = dot(point, page->v) + steps * slope_v;
    if (!(fabs(a) <= page->edge[0] && fabs(b) <= page->edge[1])) continue;
    abst[0] = clamp(a, page->inside[0]); /* onto the rectangle, where it was on its edge */
    abst[1] = clamp(b, page->inside[1]);
    abst[2] = slope_u / forward;
    abst[3] = slope_v / forward;
    closest = fabs(steps);
    found = n;
  }
  return found;
}
