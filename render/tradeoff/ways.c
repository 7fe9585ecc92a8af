#include "tradeoff/ways.h"

#include <stdlib.h>
#include <string.h>

#include "base/files.h"

/* What POV-Ray takes for a picture of one pixel of nothing. */
static enum result start_povray(const struct ways_settings *settings, struct ways *ways,
                                struct error *error) {
  enum result result =
      files_write(ways->programs.folder, "start.pov", "#version 3.7;\ncamera {}\n", error);
  if (result == RESULT_OK)
    result = ways_povray(settings, ways, "start.pov", 1, 1, NULL, &ways->start, error);
  if (result == RESULT_OK && settings->time_limit > 0 && settings->time_limit < ways->start)
    result =
        result_fail(error, RESULT_BAD,
                    "--time-limit %g: starting POV-Ray alone takes %.2g CPU seconds here; give "
                    "more",
                    settings->time_limit, ways->start);
  return result;
}

enum result ways_measure(const struct ways_settings *settings, struct ways *ways,
                         struct error *error) {
  *ways = (struct ways){0};
  enum result result = programs_begin(settings->stop, &ways->programs, error);
  if (result == RESULT_OK && settings->bakes) result = files_make_directory(settings->bakes, error);
  if (result == RESULT_OK) result = start_povray(settings, ways, error);
  if (result == RESULT_OK) result = ways_bake_all(settings, ways, error);
  if (result == RESULT_OK) result = ways_picture_all(settings, ways, error);
  if (result == RESULT_OK) result = ways_lamp_all(settings, ways, error);
  if (result == RESULT_OK) result = ways_choose(settings, ways, error);
  return result;
}

void ways_free(struct ways *ways) {
  for (int k = 0; k < ways->bake_count; ++k) {
    free(ways->bakes[k].slab);
    picture_free(&ways->bakes[k].picture);
  }
  programs_end(&ways->programs);
  pixels_free(&ways->pixels);
  light_free(&ways->light);
  *ways = (struct ways){0};
}
