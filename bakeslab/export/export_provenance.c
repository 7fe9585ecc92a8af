#include "export/export_provenance.h"

#include <stdlib.h>

#include "base/files.h"
#include "base/version.h"
#include "export/export_folder.h"
#include "file/json_text.h"
#include "file/slab_json.h"

/* What the slab is by itself: its geometry and its own provenance, as its file has them. */
static enum result page(const struct slab *slab, json_t *pages, struct error *error) {
  json_t *root = NULL;
  enum result result = slab_json_root(slab, &root, error);
  if (result == RESULT_OK) json_array_append_new(pages, root);
  return result;
}

enum result export_provenance(const struct slab *slabs, int count, const struct export_wish *wish,
                              const char *kind, json_t *errors, unsigned long mark,
                              const char *folder, struct error *error) {
  json_t *root = json_object(), *pages = json_array();
  char *text = NULL;
  enum result result = RESULT_OK;
  json_object_set_new(root, "tool", json_string("bakeslab " CANNED_VERSION));
  json_object_set_new(root, "command", json_any_string(wish->command));
  json_object_set_new(root, "export", json_string(kind));
  json_object_set_new(root, "name", json_string(wish->name));
  json_object_set_new(root, "slab", json_any_string(wish->slab));
  json_object_set_new(root, "error", errors);
  for (int k = 0; k < count && result == RESULT_OK; ++k) result = page(&slabs[k], pages, error);
  json_object_set_new(root, "pages", pages);
  if (result == RESULT_OK) result = json_text(root, mark, JSON_INDENT(1), &text, error);
  if (result == RESULT_OK) result = files_write(folder, export_folder_mark, text, error);
  json_decref(root);
  free(text);
  return result;
}
