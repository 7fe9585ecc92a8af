#include "export/export_overlap.h"

#include <math.h>
#include <stdlib.h>

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Separating axes of two rectangles in one plane are along their edges. */
static bool overlap(const struct slab *a, const struct slab *b) {
  const double *edges[4] = {a->u, a->v, b->u, b->v};
  double apart[3];
  for (int c = 0; c < 3; ++c) apart[c] = b->center[c] - a->center[c];
  double size = sqrt(dot(a->u, a->u) + dot(a->v, a->v));
  if (dot(a->normal, b->normal) < 1 - 1e-6 || fabs(dot(apart, a->normal)) > 1e-6 * size)
    return false;
  for (int axis = 0; axis < 4; ++axis) {
    double reach = 0;
    for (int k = 0; k < 4; ++k) reach += fabs(dot(edges[k], edges[axis])) / 2;
    if (fabs(dot(apart, edges[axis])) >= (1 - 1e-6) * reach) return false;
  }
  return true;
}

/* The number, among the joined pages, of one that overlaps the slab; or their count. */
static int find(const struct export_joined *joined, const struct slab *slab) {
  int n = 0;
  while (n < joined->count && !(slab_is_lit(&joined->pages[n]) && overlap(&joined->pages[n], slab)))
    ++n;
  return n;
}

/* Adds the slab's samples to a page, which gets samples of its own. */
static enum result add(struct export_joined *joined, int n, const struct slab *slab,
                       struct error *error) {
  struct slab *page = &joined->pages[n], sum = *page;
  size_t count = 3 * slab_sample_count(slab);
  if (!joined->sums[n]) {
    sum.rgb = NULL;
    enum result result = slab_alloc(&sum, error);
    if (result != RESULT_OK) return result;
    joined->sums[n] = sum.rgb;
    for (size_t k = 0; k < count; ++k) sum.rgb[k] = page->rgb[k];
    page->rgb = sum.rgb;
    page->channel[0] = 0;
  }
  for (size_t k = 0; k < count; ++k) page->rgb[k] += slab->rgb[k];
  return RESULT_OK;
}

enum result export_join(const struct slab *slabs, int count, struct export_joined *joined,
                        struct error *error) {
  *joined = (struct export_joined){.pages = calloc((size_t)count, sizeof *joined->pages),
                                   .sums = calloc((size_t)count, sizeof *joined->sums),
                                   .numbers = calloc((size_t)count, sizeof *joined->numbers)};
  if (!joined->pages || !joined->sums || !joined->numbers) return result_no_memory(error);
  for (int k = 0; k < count; ++k) {
    int n = slab_is_lit(&slabs[k]) ? find(joined, &slabs[k]) : joined->count;
    enum result result = RESULT_OK;
    if (n == joined->count) {
      joined->numbers[n] = k + 1;
      joined->pages[joined->count++] = slabs[k];
    } else if (slab_alike(&joined->pages[n], &slabs[k])) {
      result = add(joined, n, &slabs[k], error);
    } else {
      result = result_fail(error, RESULT_BAD,
                           "pages %d and %d overlap, and other programs see one of two polygons in "
                           "a place; they are added up only where all but their samples is alike: "
                           "bake them with one --uv, --st and window",
                           joined->numbers[n], k + 1);
    }
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

void export_joined_free(struct export_joined *joined) {
  for (int n = 0; joined->sums && n < joined->count; ++n) free(joined->sums[n]);
  free(joined->pages);
  free(joined->sums);
  free(joined->numbers);
  *joined = (struct export_joined){0};
}
