#include "include/include_source.h"

#include "file/slab_file.h"

/* The intensities themselves, beside the slabs that are made of them. */
static enum result load_table(const char *path, struct include_source *source,
                              struct error *error) {
  struct photometry lamp = {0};
  struct warnings told = {0};
  enum result result = photometry_read(path, &lamp, &told, error);
  if (result == RESULT_OK)
    result = result_at(point_table_make(&lamp, &source->table, error), error, "%s", path);
  source->has_table = result == RESULT_OK;
  photometry_free(&lamp);
  return result;
}

enum result include_source_load(const char *path, const char *command, struct warnings *notes,
                                struct include_source *source, struct error *error) {
  *source = (struct include_source){0};
  const struct import_kind *kind = import_kind_of(path);
  if (!kind) return slab_file_load_all(path, &source->light.slabs, &source->light.count, error);
  const struct import_wish wish = {.files = &path, .file_count = 1, .narrow = true, .notes = notes};
  enum result result = import_files(&wish, command, &source->light, error);
  if (result == RESULT_OK && kind->family == IMPORT_PHOTOMETRIC)
    result = load_table(path, source, error);
  return result;
}

void include_source_free(struct include_source *source) {
  import_free(&source->light);
  point_table_free(&source->table);
  *source = (struct include_source){0};
}
