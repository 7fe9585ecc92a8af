/* json_text.c - an allocator that counts its failures. */
#include "file/json_text.h"

#include <stdlib.h>
#include <string.h>

static _Thread_local unsigned long lost;

static void *allocate(size_t size) {
  void *memory = malloc(size);
  if (!memory) ++lost;
  return memory;
}

__attribute__((constructor)) static void watch_allocations(void) {
  json_set_alloc_funcs(allocate, free);
}

unsigned long json_mark(void) {
  return lost;
}

enum result json_whole(unsigned long mark, struct error *error) {
  return lost == mark ? RESULT_OK : result_no_memory(error);
}

enum result json_text(const json_t *value, unsigned long mark, size_t flags, char **text,
                      struct error *error) {
  *text = json_dumps(value, JSON_ENCODE_ANY | flags);
  enum result result = json_whole(mark, error);
  if (result == RESULT_OK && *text) return RESULT_OK;
  free(*text);
  *text = NULL;
  return result_no_memory(error);
}

enum result json_read(const char *text, size_t flags, json_t **value, struct error *error) {
  json_error_t why;
  unsigned long mark = json_mark();
  *value = json_loads(text, flags, &why);
  enum result result = json_whole(mark, error);
  if (result == RESULT_OK && *value) return RESULT_OK;
  json_decref(*value);
  *value = NULL;
  if (result != RESULT_OK) return result;
  return result_fail(error, RESULT_BAD, "malformed JSON: line %d: %s", why.line, why.text);
}

json_t *json_any_string(const char *text) {
  json_t *value = json_string(text);
  char *plain = value ? NULL : strdup(text);
  for (char *c = plain; c && *c; ++c)
    if ((unsigned char)*c >= 0x80) *c = '?';
  if (plain) value = json_string(plain);
  free(plain);
  return value;
}
