#include "import/photometric/photometry_text.h"

#include <stdio.h>
#include <string.h>

#include "base/numbers.h"

enum { WORD = 64 }; /* longer words are no numbers */

struct photometry_text photometry_text_of(const char *text, size_t size) {
  return (struct photometry_text){.at = text, .end = text + size, .line = 1};
}

/* Skips one character and counts lines. */
static void step(struct photometry_text *text) {
  char c = *text->at++;
  if (c == '\n' || (c == '\r' && !(text->at < text->end && *text->at == '\n'))) ++text->line;
}

bool photometry_text_line(struct photometry_text *text, const char **line, size_t *length) {
  if (text->at >= text->end) return false;
  *line = text->at;
  while (text->at < text->end && *text->at != '\n' && *text->at != '\r') ++text->at;
  *length = (size_t)(text->at - *line);
  if (text->at + 1 < text->end && text->at[0] == '\r' && text->at[1] == '\n') ++text->at;
  if (text->at < text->end) step(text);
  return true;
}

/* Some files end with the 26 (hexadecimal) of CP/M, or have zeros behind the last line. */
static bool is_blank(const struct photometry_text *text, char c) {
  return c == ' ' || (c >= '\t' && c <= '\r') || c == 0x1a || (c == 0 && text->end[-1] == 0) ||
         (c == ',' && !text->decimal_comma);
}

static void skip_blanks(struct photometry_text *text) {
  while (text->at < text->end && is_blank(text, *text->at)) step(text);
}

/* The next word, with a point for a decimal comma; its length, 0 at the end, WORD where it is too
 * long. */
static size_t next_word(struct photometry_text *text, char word[WORD]) {
  size_t length = 0;
  skip_blanks(text);
  while (text->at < text->end && !is_blank(text, *text->at)) {
    char c = *text->at;
    if (length < WORD - 1) word[length] = c == ',' ? '.' : c == 0 ? '?' : c;
    ++length;
    ++text->at;
  }
  word[length < WORD - 1 ? length : WORD - 1] = 0;
  return length < WORD - 1 ? length : WORD;
}

bool photometry_text_may_be_decimal(const struct photometry_text *text) {
  struct photometry_text rest = *text;
  char word[WORD];
  bool found = false;
  rest.decimal_comma = true;
  for (;;) {
    skip_blanks(&rest);
    const char *start = rest.at, *comma = NULL;
    if (next_word(&rest, word) == 0) return found;
    for (const char *c = start; c < rest.at; ++c) {
      if (*c == '.' || (*c == ',' && comma)) return false;
      if (*c == ',') comma = c;
    }
    found = found || (comma && comma + 1 < rest.at && comma[1] >= '0' && comma[1] <= '9');
  }
}

enum result photometry_text_number(struct photometry_text *text, const char *what, double *number,
                                   struct error *error) {
  char word[WORD];
  size_t length = next_word(text, word);
  if (length == 0)
    return result_fail(error, RESULT_BAD,
                       "line %d: the file ends where %s should be: it is cut "
                       "off",
                       text->line, what);
  if (numbers_real(word, 1, number)) {
    if (*number >= -PHOTOMETRY_MOST && *number <= PHOTOMETRY_MOST) return RESULT_OK;
    return result_fail(error, RESULT_BAD, "line %d: %s: %g is no lamp's", text->line, what,
                       *number);
  }
  for (char *c = word; *c; ++c)
    if (*c < ' ' || *c > '~') *c = '?';
  return result_fail(error, RESULT_BAD,
                     "line %d: %s should be here, but \"%.20s%s\" is no finite "
                     "number",
                     text->line, what, word, length > 20 ? "..." : "");
}

enum result photometry_text_whole(struct photometry_text *text, const char *what, int low, int high,
                                  int *number, struct error *error) {
  double value;
  enum result result = photometry_text_number(text, what, &value, error);
  if (result != RESULT_OK) return result;
  if (!(value >= low && value <= high) || value != (int)value)
    return result_fail(error, RESULT_BAD,
                       "line %d: %s is %g, but must be a whole number from %d "
                       "to %d",
                       text->line, what, value, low, high);
  *number = (int)value;
  return RESULT_OK;
}

enum result photometry_text_numbers(struct photometry_text *text, const char *what, size_t count,
                                    double *numbers, struct error *error) {
  /* Each takes a digit and what separates it. */
  if (count > ((size_t)(text->end - text->at) + 1) / 2)
    return result_fail(error, RESULT_BAD,
                       "line %d: %zu numbers should follow (%s), more than the "
                       "file holds: it is cut off",
                       text->line, count, what);
  for (size_t k = 0; k < count; ++k) {
    enum result result = photometry_text_number(text, what, &numbers[k], error);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

enum result photometry_text_ascending(const struct photometry_text *text, const char *what,
                                      const double *numbers, int count, double low, double high,
                                      struct error *error) {
  for (int k = 0; k < count; ++k) {
    if (!(numbers[k] >= low && numbers[k] <= high))
      return result_fail(error, RESULT_BAD, "line %d: %s: %g degrees is outside of %g to %g",
                         text->line, what, numbers[k], low, high);
    if (k > 0 && !(numbers[k] > numbers[k - 1]))
      return result_fail(error, RESULT_BAD, "line %d: %s must ascend, but %g follows %g",
                         text->line, what, numbers[k], numbers[k - 1]);
  }
  return RESULT_OK;
}

size_t photometry_text_left(const struct photometry_text *text, int *line) {
  struct photometry_text rest = *text;
  char word[WORD];
  size_t count = 0;
  skip_blanks(&rest);
  *line = rest.line;
  while (next_word(&rest, word) > 0) ++count;
  return count;
}

/* The length of the UTF-8 character at `at`, 0 where there is none. */
static size_t utf8(const unsigned char *at, size_t left) {
  size_t length = at[0] < 0x80   ? 1
                  : at[0] < 0xc2 ? 0
                  : at[0] < 0xe0 ? 2
                  : at[0] < 0xf0 ? 3
                  : at[0] < 0xf5 ? 4
                                 : 0;
  if (length > left) return 0;
  for (size_t k = 1; k < length; ++k)
    if ((at[k] & 0xc0) != 0x80) return 0;
  if ((at[0] == 0xe0 && at[1] < 0xa0) || (at[0] == 0xed && at[1] > 0x9f)) return 0;
  if ((at[0] == 0xf0 && at[1] < 0x90) || (at[0] == 0xf4 && at[1] > 0x8f)) return 0;
  return length;
}

void photometry_text_label(struct photometry *lamp, const char *bytes, size_t length) {
  const unsigned char *in = (const unsigned char *)bytes;
  char *label = lamp->label;
  size_t used = strlen(label);
  bool blank = true; /* before the next character: none at the start */
  bool is_utf8 = true;
  for (size_t k = 0; k < length && is_utf8; k += is_utf8 ? utf8(in + k, length - k) : 0)
    is_utf8 = utf8(in + k, length - k) > 0;
  for (size_t k = 0; k < length;) {
    size_t take = is_utf8 ? utf8(in + k, length - k) : 1;
    if (in[k] <= ' ' || in[k] == 0x7f) {
      blank = true;
    } else if (used + 6 < PHOTOMETRY_LABEL) {
      if (blank && used > 0) label[used++] = ' ';
      blank = false;
      if (is_utf8 || in[k] < 0x80) {
        memcpy(label + used, in + k, take);
        used += take;
      } else {
        label[used++] = (char)(0xc0 | in[k] >> 6);
        label[used++] = (char)(0x80 | (in[k] & 0x3f));
      }
    }
    k += take;
  }
  label[used] = 0;
}
