#include "base/sdl.h"

#include <ctype.h>
#include <string.h>

void sdl_string(const char *text, FILE *out) {
  putc('"', out);
  for (; *text; ++text) {
    if (*text == '"' || *text == '\\') putc('\\', out);
    putc(*text, out);
  }
  putc('"', out);
}

void sdl_comment(const char *text, FILE *out) {
  for (; *text; ++text) putc((unsigned char)*text < ' ' || *text == 0x7f ? '?' : *text, out);
}

enum result sdl_check_identifier(const char *name, size_t longest, struct error *error) {
  size_t length = strlen(name);
  int good = length > 0 && isalpha((unsigned char)name[0]);
  for (size_t k = 0; k < length; ++k)
    good = good && (isalnum((unsigned char)name[k]) || name[k] == '_');
  if (!good)
    return result_fail(error, RESULT_BAD, "the name \"%s\" is no identifier (letters, digits, _)",
                       name);
  if (length > longest)
    return result_fail(error, RESULT_BAD, "the name \"%s\" is longer than %zu characters", name,
                       longest);
  return RESULT_OK;
}

enum result sdl_capitalise(const char *name, char capitalised[SDL_IDENTIFIER_SIZE],
                           struct error *error) {
  enum result result = sdl_check_identifier(name, SDL_IDENTIFIER_SIZE - 1, error);
  for (size_t k = 0; result == RESULT_OK && (k == 0 || name[k - 1]); ++k) {
    int first = k == 0 || name[k - 1] == '_';
    capitalised[k] = first ? (char)toupper((unsigned char)name[k]) : name[k];
  }
  return result;
}
