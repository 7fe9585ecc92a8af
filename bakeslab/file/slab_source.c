#include "file/slab_source.h"

#include <stdio.h>
#include <stdlib.h>

#include "file/slab_json.h"

enum result slab_source(const struct slab *slab, json_t **source, struct error *error) {
  json_t *root = NULL;
  *source = NULL;
  enum result result = slab_json_root(slab, &root, error);
  json_t *found = json_object_get(json_object_get(root, "provenance"), "import");
  if (json_is_object(found)) *source = json_incref(found);
  json_decref(root);
  return result;
}

/* Without an end of its own, since the line goes on. */
static void put_sentence(const char *before, const json_t *sentence, FILE *out) {
  const char *text = json_string_value(sentence);
  size_t length = json_string_length(sentence);
  if (length > 0 && text[length - 1] == '.') --length;
  if (length > 0) fprintf(out, "%s%.*s", before, (int)length, text);
}

static void put(const json_t *source, FILE *out) {
  const char *kind = json_string_value(json_object_get(source, "kind"));
  const json_t *error = json_object_get(source, "error");
  put_sentence("", json_object_get(source, "source"), out);
  if (kind) fprintf(out, " (%s)", kind);
  put_sentence(": ", json_object_get(source, "assumptions"), out);
  if (!json_is_number(error)) return;
  fprintf(out, "; error of its samples %.2g %%", 100 * json_number_value(error));
  put_sentence(": ", json_object_get(source, "error_is"), out);
}

enum result slab_source_line(const struct slab *slab, char **line, struct error *error) {
  json_t *source = NULL;
  size_t size = 0;
  *line = NULL;
  enum result result = slab_source(slab, &source, error);
  if (!source) return result;
  FILE *out = open_memstream(line, &size);
  if (out) put(source, out);
  if (!out || fclose(out) != 0 || !*line) /* glibc's fclose may lose the text without a word */
    result = result_no_memory(error);
  else
    result_one_line(*line);
  json_decref(source);
  return result;
}
