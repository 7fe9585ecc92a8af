#include "base/sdl_scan.h"

#include <ctype.h>
#include <string.h>

const char *sdl_skip_comment(const char *at) {
  int depth = 0;
  do {
    if (at[0] == '/' && at[1] == '*')
      ++depth, at += 2;
    else if (at[0] == '*' && at[1] == '/')
      --depth, at += 2;
    else if (!*at++)
      return NULL;
  } while (depth > 0);
  return at;
}

const char *sdl_skip_string(const char *at) {
  for (++at; *at && *at != '"'; ++at)
    if (*at == '\\' && at[1]) ++at;
  return *at ? at + 1 : NULL;
}

const char *sdl_skip_quiet(const char *at) {
  const char *end = at;
  if (at[0] == '/' && at[1] == '/') return at + strcspn(at, "\n");
  if (at[0] == '/' && at[1] == '*') end = sdl_skip_comment(at);
  if (at[0] == '"') end = sdl_skip_string(at);
  return end ? end : at + strlen(at);
}

size_t sdl_word_length(const char *at) {
  size_t n = 0;
  while (isalnum((unsigned char)at[n]) || at[n] == '_') ++n;
  return n;
}

bool sdl_is_one_of(const char *word, size_t length, const char *const *words) {
  for (; *words; ++words)
    if (strlen(*words) == length && !memcmp(*words, word, length)) return true;
  return false;
}

int sdl_block(const char *word, size_t length) {
  static const char *const openers[] = {"if",    "ifdef", "ifndef", "for",
                                        "while", "macro", "switch", NULL};
  static const char *const closers[] = {"end", NULL};
  return sdl_is_one_of(word, length, openers) - sdl_is_one_of(word, length, closers);
}
