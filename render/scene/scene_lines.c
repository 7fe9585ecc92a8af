#include "scene/scene_lines.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/array.h"

enum { LONGEST = 1 << 26, BUFFER = 1 << 16 };

const char scene_blanks[] = " \t\v\f";

struct text {
  FILE *file;
  const char *path;
  char *line;
  int length, room;
  size_t lines; /* that were read */
};

/* Appends a line to what there is; *ended where there is none. */
static enum result append(struct text *text, bool *ended, struct error *error) {
  int c = getc_unlocked(text->file);
  *ended = c == EOF;
  for (; c != EOF && c != '\n' && c != '\r'; c = getc_unlocked(text->file)) {
    if (c == 0) return result_fail(error, RESULT_BAD, "%s: is no text", text->path);
    if (text->length >= LONGEST)
      return result_fail(error, RESULT_BAD, "%s:%zu: is longer than %d bytes", text->path,
                         text->lines + 1, LONGEST);
    if (!array_reserve(&text->line, &text->room, text->length + 2, 1))
      return result_at(result_no_memory(error), error, "%s", text->path);
    text->line[text->length++] = (char)c;
  }
  if (c == '\r' && (c = getc_unlocked(text->file)) != '\n' && c != EOF) ungetc(c, text->file);
  if (ferror(text->file))
    return result_fail(error, RESULT_IO, "%s: %s", text->path, strerror(errno));
  text->lines += !*ended;
  return RESULT_OK;
}

static enum result read_line(struct text *text, bool *ended, struct error *error) {
  bool more, none;
  text->length = 0;
  enum result result = append(text, ended, error);
  do {
    more = result == RESULT_OK && text->length > 0 && text->line[text->length - 1] == '\\';
    if (more) {
      text->line[text->length - 1] = ' ';
      result = append(text, &none, error);
      more = !none;
    }
  } while (more);
  if (!array_reserve(&text->line, &text->room, text->length + 1, 1)) /* an empty one */
    return result_at(result_no_memory(error), error, "%s", text->path);
  text->line[text->length] = 0;
  return result;
}

static void split(struct text *text, struct scene_line *line) {
  static const char mark[] = "\xef\xbb\xbf";
  char *start = text->line, *last = text->line + text->length;
  if (line->number == 1 && strncmp(start, mark, 3) == 0) start += 3;
  start += strspn(start, scene_blanks);
  line->keyword = start;
  char *end = start + strcspn(start, scene_blanks);
  line->rest = end + strspn(end, scene_blanks);
  while (last > line->rest && strchr(scene_blanks, last[-1])) *--last = 0;
  *end = 0;
}

enum result scene_lines_read(const char *path, scene_line_reader *reader, void *context,
                             struct error *error) {
  struct text text = {.path = path};
  struct scene_line line = {.path = path};
  struct stat status;
  enum result result = RESULT_OK;
  bool ended = false;
  if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
    return result_fail(error, RESULT_IO, "%s: is not a file", path);
  text.file = fopen(path, "re");
  if (!text.file) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  setvbuf(text.file, NULL, _IOFBF, BUFFER);
  while (result == RESULT_OK && !ended) {
    line.number = text.lines + 1;
    result = read_line(&text, &ended, error);
    if (result != RESULT_OK || ended) break;
    split(&text, &line);
    result = reader(context, &line, error);
  }
  free(text.line);
  fclose(text.file);
  return result;
}

/* A product or quotient of two numbers that doubles hold exactly is rounded once, as strtod's
 * (W. D. Clinger: How to read floating point numbers accurately, 1990). */
double scene_number(const char *text, char **end) {
  static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                  1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const char *at = text + (*text == '-' || *text == '+');
  uint64_t mantissa = 0;
  int digits = 0, after = 0;
  for (bool point = false; (*at >= '0' && *at <= '9') || (*at == '.' && !point); ++at) {
    if (*at == '.') {
      point = true;
      continue;
    }
    mantissa = 10 * mantissa + (uint64_t)(*at - '0');
    after += point;
    if (++digits > 18) return strtod(text, end);
  }
  bool simple = digits > 0 && (*at == 0 || strchr(" \t/#", *at)) && mantissa <= 1ULL << 53;
  if (!simple) return strtod(text, end);
  *end = (char *)at;
  double number = (double)mantissa / powers[after];
  return *text == '-' ? -number : number;
}

int scene_numbers(const char *text, int most, double *numbers) {
  for (int k = 0; k < most; ++k) {
    char *end;
    text += strspn(text, scene_blanks);
    if (!*text || *text == '#') return k;
    double number = scene_number(text, &end);
    if (end == text || !isfinite((float)number) || !strchr(scene_blanks, *end)) return -1;
    numbers[k] = number;
    text = end;
  }
  return most;
}
