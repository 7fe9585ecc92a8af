#include "export/export_pages.h"

#include <stdlib.h>
#include <string.h>

#include "base/files.h"
#include "file/json_text.h"
#include "file/slab_exr.h"
#include "file/slab_json.h"

enum { FILE_NAME_SIZE = SLAB_NAME_SIZE + 32 };

const struct slab *export_pages_first(const struct slab *slabs, int count) {
  for (int k = 0; k < count; ++k)
    if (slab_is_lit(&slabs[k])) return &slabs[k];
  return NULL;
}

/* The page's JSON with the name of its picture, appended to `pages`. */
static enum result describe(const struct slab *slab, const char *image, json_t *pages,
                            struct error *error) {
  char *text = NULL;
  json_t *page = NULL;
  enum result result = slab_json_text(slab, NULL, &text, error);
  if (result == RESULT_OK) result = json_read(text, 0, &page, error);
  if (result == RESULT_OK) {
    json_object_del(page, "provenance");
    json_object_set_new(page, "image", json_string(image));
    json_array_append(pages, page);
  }
  json_decref(page);
  free(text);
  return result;
}

static enum result write_image(const struct slab *slab, const char *folder, const char *image,
                               struct error *error) {
  char *path = files_join(folder, image);
  if (!path) return result_no_memory(error);
  const struct picture picture = {
      .width = slab_width(slab), .height = slab_height(slab), .rgb = slab->rgb};
  enum result result = slab_exr_write(path, &picture, 0, NULL, error);
  free(path);
  return result;
}

static enum result write_pages(const struct slab *slabs, int count, const char *name,
                               const char *folder, json_t *pages, struct error *error) {
  for (int k = 0; k < count; ++k) {
    char image[FILE_NAME_SIZE];
    if (!slab_is_lit(&slabs[k])) continue;
    if (count > 1)
      snprintf(image, sizeof image, "%s_%d.exr", name, k + 1);
    else
      snprintf(image, sizeof image, "%s.exr", name);
    enum result result = describe(&slabs[k], image, pages, error);
    if (result == RESULT_OK) result = write_image(&slabs[k], folder, image, error);
    if (result != RESULT_OK) return result_at(result, error, "page %d", k + 1);
  }
  return RESULT_OK;
}

enum result export_pages_write(const struct slab *slabs, int count, const struct export_wish *wish,
                               const char *folder, struct error *error) {
  if (!export_pages_first(slabs, count))
    return result_fail(error, RESULT_BAD, "all radiance is zero: the lamp gives no light");
  unsigned long mark = json_mark();
  json_t *root = json_object(), *pages = json_array();
  char *text = NULL, file[FILE_NAME_SIZE];
  enum result result = write_pages(slabs, count, wish->name, folder, pages, error);
  json_object_set_new(root, "format", json_string("light-slab-pages"));
  json_object_set_new(root, "version", json_integer(1));
  json_object_set_new(root, "name", json_string(wish->name));
  json_object_set_new(root, "pages", pages);
  snprintf(file, sizeof file, "%s.json", wish->name);
  if (result == RESULT_OK) result = json_text(root, mark, JSON_INDENT(1), &text, error);
  if (result == RESULT_OK) result = files_write(folder, file, text, error);
  json_decref(root);
  free(text);
  return result;
}
