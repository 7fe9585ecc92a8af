#include "base/numbers.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *numbers_read(const char *text, char between, int count, double *numbers) {
  for (int k = 0; k < count; ++k) {
    char *end;
    if (k > 0 && between == ' ') text += strspn(text, NUMBERS_BLANKS);
    if (k > 0 && between != ' ' && *text++ != between) return NULL;
    if (strchr(NUMBERS_BLANKS, *text)) return NULL; /* strtod would skip it; \0 too */
    numbers[k] = strtod(text, &end);
    if (end == text || !isfinite(numbers[k])) return NULL;
    text = end;
  }
  return text;
}

bool numbers_real(const char *text, int count, double *numbers) {
  const char *end = numbers_read(text, ',', count, numbers);
  return end && !*end;
}

/* Returns where the number ends. */
static const char *read_whole(const char *text, uint64_t low, uint64_t high, uint64_t *number) {
  char *end;
  if (*text < '0' || *text > '9') return NULL; /* strtoull takes blanks and signs */
  errno = 0;
  unsigned long long value = strtoull(text, &end, 10);
  if (errno || value < low || value > high) return NULL;
  *number = value;
  return end;
}

bool numbers_whole(const char *text, uint64_t low, uint64_t high, uint64_t *number) {
  const char *end = read_whole(text, low, high, number);
  return end && !*end;
}

bool numbers_size(const char *text, int size[2]) {
  uint64_t n = 0, m = 0;
  const char *end = read_whole(text, 1, NUMBERS_MOST_SIZE, &n);
  m = n;
  if (end && *end == 'x') end = read_whole(end + 1, 1, NUMBERS_MOST_SIZE, &m);
  if (!end || *end) return false;
  size[0] = (int)n;
  size[1] = (int)m;
  return true;
}
