/* gather_prepare.c - what methods make of the slabs before the first receiver. */
#include <stdlib.h>

#include "cut/cut.h"
#include "gather/gather.h"
#include "microlight/levels.h"

static enum result prepare_page(const struct light_page *page, int number, int threads,
                                struct gather_prepared *made, struct error *error) {
  if (made->levels) return levels_build(page, &made->levels[number], error);
  return cut_build(page, threads, &made->trees[number], error);
}

enum result gather_prepare(const struct light *lights, int count, enum gather_method method,
                           uint64_t receivers, int threads, struct gather_prepared *prepared,
                           struct error *error) {
  enum method_makes makes = gather_methods[method].makes;
  struct gather_prepared made = {.pages = light_pages(lights, count)};
  enum result result = RESULT_OK;
  gather_prepared_free(prepared);
  if (makes == METHOD_TREES_FOR_MANY && receivers < GATHER_MANY) makes = METHOD_NOTHING;
  if (makes == METHOD_LEVELS)
    made.levels = calloc((size_t)made.pages, sizeof *made.levels);
  else if (makes != METHOD_NOTHING)
    made.trees = calloc((size_t)made.pages, sizeof *made.trees);
  if (makes != METHOD_NOTHING && !made.levels && !made.trees) result = result_no_memory(error);
  for (int l = 0, number = 0; makes != METHOD_NOTHING && l < count; ++l)
    for (int page = 0; page < lights[l].count && result == RESULT_OK; ++page, ++number)
      result = prepare_page(&lights[l].pages[page], number, threads, &made, error);
  if (result != RESULT_OK) gather_prepared_free(&made);
  *prepared = made;
  return result;
}

void gather_prepared_free(struct gather_prepared *prepared) {
  for (int page = 0; page < prepared->pages; ++page) {
    if (prepared->levels) levels_free(&prepared->levels[page]);
    if (prepared->trees) cut_free(prepared->trees[page]);
  }
  free(prepared->levels);
  free(prepared->trees);
  *prepared = (struct gather_prepared){0};
}
