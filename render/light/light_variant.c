#include "light/light_variant.h"

#include <stdlib.h>

#include "file/slab_json.h"
#include "slab/slab_resample.h"

static enum result vary_page(const struct light_page *page, enum slab_variant which,
                             struct light_page *copy, int *lack, struct error *error) {
  const struct slab *slab = &page->slab;
  struct slab_sampling sampling;
  enum result result = slab_json_sampling(slab, &sampling, error);
  *copy = *page;
  copy->slab = (struct slab){0};
  copy->lit = NULL;
  if (result == RESULT_OK) result = slab_variant_make(slab, &sampling, which, &copy->slab, error);
  if (result == RESULT_OK && !copy->slab.rgb) {
    *lack += slab_is_lit(slab);
    result = slab_resample(slab, slab->samples, &copy->slab, error);
  }
  return result == RESULT_OK ? light_page_set_samples(copy, error) : result;
}

enum result light_variant_make(const struct light *lights, int count, enum slab_variant which,
                               struct light **copies, int *lack, struct error *error) {
  struct light *made = calloc((size_t)count, sizeof *made);
  enum result result = made ? RESULT_OK : result_no_memory(error);
  *copies = made;
  *lack = 0;
  for (int l = 0; l < count && result == RESULT_OK; ++l) {
    struct light *copy = &made[l];
    *copy = lights[l];
    copy->path = NULL;
    copy->pages = calloc((size_t)copy->count, sizeof *copy->pages);
    if (!copy->pages) result = result_no_memory(error);
    for (int page = 0; page < copy->count && result == RESULT_OK; ++page)
      result = vary_page(&lights[l].pages[page], which, &copy->pages[page], lack, error);
  }
  if (result != RESULT_OK) {
    light_variant_free(made, count);
    *copies = NULL;
  }
  return result;
}

void light_variant_free(struct light *copies, int count) {
  for (int l = 0; copies && l < count; ++l) light_free(&copies[l]);
  free(copies);
}
