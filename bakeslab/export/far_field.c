#include "export/far_field.h"

#include <math.h>
#include <stdlib.h>

#include "slab/plane.h"

static const double told_distance = 4;

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void as_point(const void *of, int unused, const double at[3], double rgb[3]) {
  const struct far_page *page = of;
  const struct slab *slab = page->slab;
  double direction[3], r2 = dot(at, at), r = sqrt(r2);
  (void)unused;
  for (int c = 0; c < 3; ++c)
    direction[c] = (at[0] * slab->u[c] / plane_edge(slab, SLAB_U) +
                    at[1] * slab->v[c] / plane_edge(slab, SLAB_V) + at[2] * slab->normal[c]) /
                   r;
  rgb[0] = rgb[1] = rgb[2] = far_page_candela(page, direction) / page->scale *
                             plane_edge(slab, SLAB_U) * plane_edge(slab, SLAB_V) * at[2] / r / r2;
}

/* The largest of the pages', of their luminance. */
static enum result find_loss(const struct far_page *pages, int count, struct far_field *field,
                             struct error *error) {
  for (int k = 0; k < count; ++k) {
    struct far_page page = pages[k];
    struct slab grey = {0};
    double loss;
    enum result result = slab_copy_geometry(page.slab, &grey, error);
    if (result == RESULT_OK) result = slab_alloc(&grey, error);
    for (size_t i = 0, end = result == RESULT_OK ? slab_sample_count(&grey) : 0; i < end; ++i)
      for (int c = 0; c < 3; ++c)
        grey.rgb[3 * i + (size_t)c] = (float)slab_luminance(page.slab->rgb + 3 * i);
    if (result == RESULT_OK) {
      plane_errors(&grey, told_distance * plane_width(&grey), 1, as_point, &page, 1, &loss);
      field->loss = fmax(field->loss, loss);
    }
    slab_free(&grey);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

static enum result measure(const struct far_page *pages, int count, struct far_field *field,
                           struct error *error) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (int k = 0; k < count; ++k) {
    const struct slab *slab = pages[k].slab;
    double flux[3], metres = slab->metres_per_unit;
    enum result result = slab_flux(slab, flux, error);
    if (result != RESULT_OK) return result;
    field->flux += pages[k].scale / (plane_edge(slab, SLAB_U) * plane_edge(slab, SLAB_V)) *
                   (0.2126 * flux[0] + 0.7152 * flux[1] + 0.0722 * flux[2]);
    for (int c = 0; c < 3; ++c) {
      double half = (fabs(slab->u[c]) + fabs(slab->v[c])) / 2;
      low[c] = fmin(low[c], metres * (slab->center[c] - half));
      high[c] = fmax(high[c], metres * (slab->center[c] + half));
    }
  }
  for (int c = 0; c < 3; ++c) field->size[c] = high[c] - low[c];
  return find_loss(pages, count, field, error);
}

/* What interpolation gains or loses is less than the tolerance; one factor on all intensities makes
 * up for it. Much more is lost where light is too narrow for the grid, and stays told. */
static void fit_flux(struct far_field *field, double tolerance) {
  struct far_grid *grid = &field->grid;
  field->lumens = far_grid_flux(grid);
  double factor = field->flux / field->lumens;
  if (!(fabs(factor - 1) <= tolerance)) return;
  for (int k = 0; k < grid->count[FAR_C] * grid->count[FAR_GAMMA]; ++k) grid->candela[k] *= factor;
  grid->most += fabs(factor - 1);
  field->lumens = field->flux;
}

enum result far_field_make(const struct slab *slabs, int count, double tolerance,
                           struct far_field *field, struct error *error) {
  struct far_page *pages = calloc((size_t)count, sizeof *pages);
  enum result result = pages ? RESULT_OK : result_no_memory(error);
  int lit = 0;
  *field = (struct far_field){0};
  for (int k = 0; k < count && result == RESULT_OK; ++k)
    if (slab_is_lit(&slabs[k])) result = far_page_make(&slabs[k], &pages[lit++], error);
  if (result == RESULT_OK && !lit)
    result = result_fail(error, RESULT_BAD, "all radiance is zero: the lamp gives no light");
  if (result == RESULT_OK) result = measure(pages, lit, field, error);
  if (result == RESULT_OK) result = far_grid_make(pages, lit, tolerance, &field->grid, error);
  if (result == RESULT_OK) fit_flux(field, tolerance);
  for (int k = 0; k < lit; ++k) far_page_free(&pages[k]);
  free(pages);
  return result;
}

void far_field_free(struct far_field *field) {
  far_grid_free(&field->grid);
  *field = (struct far_field){0};
}
