/* ray_text.c - rays as text: `x y z dx dy dz flux` a line, blank lines, and comments from # on. */
#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "import/rays/ray_records.h"

enum { LINE_MOST = 4096, NUMBERS = 7 };

/* What is not to be read of a line: nothing, or its comment. */
static const char *significant(const char *line) {
  line += strspn(line, NUMBERS_BLANKS);
  return *line == '#' ? "" : line;
}

/* The first line that says something begins with at least two numbers, or all are comments. */
static bool is_text(const char *head, size_t size) {
  char line[LINE_MOST];
  double numbers[2];
  bool comments = false;
  for (size_t at = 0; at < size;) {
    const char *end = memchr(head + at, '\n', size - at);
    size_t length = end ? (size_t)(end - head) - at : size - at;
    if (length >= LINE_MOST || memchr(head + at, 0, length)) return false;
    memcpy(line, head + at, length);
    line[length] = 0;
    const char *says = significant(line);
    if (*says) return numbers_read(says, ' ', 2, numbers);
    comments |= strchr(line, '#') != NULL;
    at += length + 1;
  }
  return comments;
}

static enum result open_text(struct ray_file *file, struct error *error) {
  (void)file, (void)error;
  return RESULT_OK;
}

/* A text source file of Zemax begins with the number of rays and their unit of length. */
static bool is_zemax_head(const struct ray_file *file, const double numbers[NUMBERS]) {
  return file->line == 1 && numbers[0] >= 1 && numbers[0] == floor(numbers[0]) && numbers[1] >= 0 &&
         numbers[1] <= 4 && numbers[1] == floor(numbers[1]) && numbers[3] == 0 && numbers[4] == 0 &&
         numbers[5] == 0;
}

static enum result parse(const struct ray_file *file, const char *line, struct ray *ray,
                         struct error *error) {
  double numbers[NUMBERS];
  const char *end = numbers_read(line, ' ', NUMBERS, numbers);
  if (!end || *significant(end))
    return result_fail(error, RESULT_BAD,
                       "is not a ray `x y z dx dy dz flux` of seven finite numbers");
  if (is_zemax_head(file, numbers))
    return result_fail(
        error, RESULT_BAD,
        "begins as a text source file of Zemax: take this line away, and say --unit");
  memcpy(ray->origin, numbers, sizeof ray->origin);
  memcpy(ray->direction, numbers + 3, sizeof ray->direction);
  for (int c = 0; c < 3; ++c) ray->flux[c] = numbers[6];
  if (numbers[6] < 0) return result_fail(error, RESULT_BAD, "a ray with a flux of %g", numbers[6]);
  return ray_check(ray, file->metres, error);
}

/* The next line, without its end; *more is false at the end of the file. */
static enum result read_line(struct ray_file *file, char line[LINE_MOST], bool *more,
                             struct error *error) {
  const unsigned char *data;
  size_t there = 0;
  enum result result = ray_bytes_peek(&file->bytes, LINE_MOST, &data, &there, error);
  *more = there > 0;
  if (result != RESULT_OK || !*more) return result;
  ++file->line;
  if (there > LINE_MOST) there = LINE_MOST;
  const unsigned char *end = memchr(data, '\n', there);
  size_t length = end ? (size_t)(end - data) : there;
  if (length >= LINE_MOST)
    return result_fail(error, RESULT_BAD, "has more than %d characters", LINE_MOST - 1);
  if (memchr(data, 0, length)) return result_fail(error, RESULT_BAD, "is not text");
  memcpy(line, data, length);
  line[length] = 0;
  ray_bytes_skip(&file->bytes, end ? length + 1 : length);
  return RESULT_OK;
}

static enum result read_text(struct ray_file *file, struct ray *rays, size_t most, size_t *count,
                             struct error *error) {
  char line[LINE_MOST];
  bool more = true;
  enum result result = RESULT_OK;
  while (*count < most && result == RESULT_OK) {
    result = read_line(file, line, &more, error);
    if (!more || result != RESULT_OK) break;
    const char *says = significant(line);
    if (*says) result = parse(file, says, &rays[(*count)++], error);
  }
  return result_at(result, error, "line %llu", file->line);
}

const struct ray_format ray_format_text = {"ray text", is_text, open_text, read_text};
