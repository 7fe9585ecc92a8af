/* matt.c - see matt.h. Lines stay as they are, for POV-Ray's messages. A finish or rainbow that
 * #macro, #if or their like cut in two is left alone. */
#include "preload/matt.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/sdl_scan.h"

enum { MOST_TEXT = 1 << 26 };

/* What is added at the end of which blocks. */
static const struct {
  const char *word, *addition;
} additions[] = {{"finish", " specular 0 phong 0 "},
                 {"rainbow", " color_map { [0 rgbt 1] [1 rgbt 1] } "}};
enum { ADDITIONS = sizeof additions / sizeof *additions };

/* A number that is zero, and no sum or product that begins with it. */
static int is_zero(const char *at) {
  char *end;
  if (strtod(at, &end) != 0 || end == at) return 0;
  end += strspn(end, " \t\r\n");
  return *end == 0 || !strchr("+-*/", *end) || sdl_skip_quiet(end) != end;
}

/* Behind the word `diffuse`: whether a second number follows, which is not zero. No other item of a
 * finish has a comma outside of brackets. */
static int is_translucent(const char *at) {
  for (int depth = 0; *at && depth >= 0;) {
    const char *rest = sdl_skip_quiet(at);
    if (rest == at && depth == 0 && *at == ',') return !is_zero(at + 1);
    if (rest == at) depth += (strchr("({[<", *at) != NULL) - (strchr(")}]>", *at) != NULL);
    at = rest != at ? rest : at + 1;
  }
  return 0;
}

/* The brace that closes the one at `open`, or NULL. */
static const char *closing_brace(const char *open, int *found) {
  static const char *const shiny[] = {"specular", "phong", 0}, *const diffuse[] = {"diffuse", 0};
  int depth = 0, blocks = 0, has = 0;
  for (const char *at = open; *at;) {
    const char *rest = sdl_skip_quiet(at);
    if (rest != at) {
      at = rest;
      continue;
    }
    depth += (*at == '{') - (*at == '}');
    if (depth == 0 && blocks == 0) *found |= has;
    if (depth == 0) return blocks == 0 ? at : NULL;
    int directive = *at == '#';
    if (directive) at += 1 + strspn(at + 1, " \t");
    size_t length = sdl_word_length(at);
    if (directive) blocks += sdl_block(at, length);
    if (!directive && sdl_is_one_of(at, length, shiny) && !is_zero(at + length))
      has |= MATT_HIGHLIGHTS;
    if (!directive && sdl_is_one_of(at, length, diffuse) && is_translucent(at + length))
      has |= MATT_TRANSLUCENT;
    at += length ? length : !directive;
  }
  return NULL;
}

/* The addition to blocks of this word, or NULL. */
static const char *addition_to(const char *word, size_t length) {
  for (int n = 0; n < ADDITIONS; ++n)
    if (strlen(additions[n].word) == length && !strncmp(word, additions[n].word, length))
      return additions[n].addition;
  return NULL;
}

static int has_any(const char *text) {
  for (int n = 0; n < ADDITIONS; ++n)
    if (strstr(text, additions[n].word)) return 1;
  return 0;
}

/* Writes the script to `out`. */
static void rewrite(const char *text, FILE *out, int *found) {
  const char *written = text, *at = text;
  while (*at) {
    const char *rest = sdl_skip_quiet(at);
    size_t length = sdl_word_length(at);
    if (rest != at || length == 0) {
      at = rest != at ? rest : at + 1;
      continue;
    }
    const char *addition = addition_to(at, length);
    at += length;
    if (!addition) continue;
    const char *open = at + strspn(at, " \t\r\n");
    const char *close = *open == '{' ? closing_brace(open, found) : NULL;
    if (!close) continue;
    fwrite(written, 1, (size_t)(close - written), out);
    fputs(addition, out);
    written = at = close;
  }
  fputs(written, out);
}

FILE *matt_script(FILE *file, int *found) {
  FILE *out = NULL;
  char *text = NULL;
  long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
  rewind(file);
  if (size <= 0 || size > MOST_TEXT || !(text = malloc((size_t)size + 1))) goto end;
  size_t length = fread(text, 1, (size_t)size, file);
  text[length] = 0;
  rewind(file);
  if (strlen(text) != length || !has_any(text)) goto end;
  int memory = memfd_create("script", MFD_CLOEXEC);
  out = memory >= 0 ? fdopen(memory, "w+") : NULL;
  if (!out) goto end;
  rewrite(text, out, found);
  if (fflush(out) == 0 && !ferror(out)) {
    rewind(out);
    fclose(file);
    file = out;
  } else {
    fclose(out);
  }
end:
  free(text);
  return file;
}
