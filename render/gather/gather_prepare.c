/* gather_prepare.c - what methods make of the slabs before the first receiver. */
#include <stdlib.h>

#include "cut/cut.h"
#include "gather/gather.h"
#include "microlight/levels.h"

enum result gather_prepare(const struct light *lights, int count, enum gather_method method,
                           uint64_t receivers, int threads, struct gather_prepared *aids,
                           struct error *error) {
  enum result result = RESULT_OK;
  gather_prepared_free(aids);
  for (int l = 0; l < count; ++l) aids->pages += lights[l].count;
  bool levels = method == GATHER_LEVELS || method == GATHER_PAPER_LEVELS || method == GATHER_GL;
  bool trees = method == GATHER_CUT || (method == GATHER_AUTO && receivers >= GATHER_MANY);
  if (!levels && !trees) return RESULT_OK;
  if (levels)
    aids->levels = calloc((size_t)aids->pages, sizeof *aids->levels);
  else
    aids->trees = calloc((size_t)aids->pages, sizeof *aids->trees);
  if (!aids->levels && !aids->trees) return result_fail(error, RESULT_MEMORY, "out of memory");
  for (int l = 0, number = 0; l < count; ++l)
    for (int page = 0; page < lights[l].count && result == RESULT_OK; ++page, ++number)
      result = levels ? levels_build(&lights[l].pages[page], &aids->levels[number], error)
                      : cut_build(&lights[l].pages[page], threads, &aids->trees[number], error);
  if (result != RESULT_OK) gather_prepared_free(aids);
  return result;
}

void gather_prepared_free(struct gather_prepared *aids) {
  for (int page = 0; aids->levels && page < aids->pages; ++page) levels_free(&aids->levels[page]);
  for (int page = 0; aids->trees && page < aids->pages; ++page) cut_free(aids->trees[page]);
  free(aids->levels);
  free(aids->trees);
  *aids = (struct gather_prepared){0};
}
