#include "export/export_text.h"

#include "export/export_folder.h"

enum result export_texts(const char *folder, const char *name, const struct export_text *texts,
                         const struct slab *slab, const struct export_scene *scene,
                         const struct include_value *values, struct error *error) {
  const struct include_value all[] = {{"floor", .numbers = scene->floor},
                                      {"eye", .numbers = scene->eye},
                                      {"target", .numbers = scene->target},
                                      {"up", .numbers = scene->up},
                                      {"metres", .number = slab->metres_per_unit},
                                      {"unit", .text = slab->radiance_unit},
                                      {.more = values}};
  enum result result = RESULT_OK;
  for (; texts->template && result == RESULT_OK; ++texts) {
    FILE *out = export_folder_open(folder, texts->stem, texts->ending, error);
    if (!out) return RESULT_IO;
    include_fill(texts->template, name, all, out);
    putc('\n', out);
    result = export_folder_close(out, texts->stem, texts->ending, result, error);
  }
  return result;
}
