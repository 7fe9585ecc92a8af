#include "microlight/levels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/slab_resample.h"

static bool halved(const struct slab *slab, int axis) {
  return axis == SLAB_U || axis == SLAB_V || isfinite(slab->st_distance);
}

/* The level above `below`. */
static enum result halve(const struct light_page *below, struct light_page *page,
                         struct error *error) {
  int samples[SLAB_AXES];
  const struct slab *slab = &below->slab;
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    samples[axis] = halved(slab, axis) ? (slab->samples[axis] + 1) / 2 : slab->samples[axis];
  *page = *below;
  page->slab = (struct slab){0};
  page->lit = NULL;
  enum result result = slab_resample(slab, samples, &page->slab, error);
  if (result == RESULT_OK) result = light_page_set_samples(page, error);
  if (result != RESULT_OK) light_page_free(page);
  return result;
}

enum result levels_build(const struct light_page *page, struct levels *levels,
                         struct error *error) {
  enum { MOST = 32 }; /* an int has no more bits */
  enum result result = RESULT_OK;
  *levels = (struct levels){.page = calloc(MOST, sizeof *levels->page)};
  if (!levels->page) return result_no_memory(error);
  while (result == RESULT_OK &&
         (page->slab.samples[SLAB_U] > 1 || page->slab.samples[SLAB_V] > 1)) {
    result = halve(page, &levels->page[levels->count], error);
    if (result == RESULT_OK) page = &levels->page[levels->count++];
  }
  if (result != RESULT_OK) levels_free(levels);
  return result;
}

void levels_move(struct levels *levels, const struct light_page *page) {
  for (int k = 0; k < levels->count; ++k) {
    memcpy(levels->page[k].center, page->center, sizeof page->center);
    memcpy(levels->page[k].frame, page->frame, sizeof page->frame);
  }
}

void levels_free(struct levels *levels) {
  if (!levels) return;
  for (int k = 0; k < levels->count; ++k) light_page_free(&levels->page[k]);
  free(levels->page);
  *levels = (struct levels){0};
}

int levels_choose(const struct levels *levels, const struct seen_page *seen) {
  int level = levels->count;
  for (int axis = 0; axis < 2; ++axis) {
    const struct light_axis *along = &seen->page->axes[axis];
    double cells = along->far_step * seen->height / along->near_step;
    int most = cells >= 1 ? (int)fmin(log2(cells), 1e6) : 0;
    if (most < level) level = most;
  }
  return level;
}
