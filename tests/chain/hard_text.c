/* hard_text.c - see hard.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

/* All of a file of the folder; "" without it. */
static const char *content(const char *name) {
  static char text[1 << 20];
  FILE *file = fopen(chain_path(name), "r");
  size_t length = file ? fread(text, 1, sizeof text - 1, file) : 0;
  if (file) fclose(file);
  text[length] = 0;
  return text;
}

/* Numbers between whatever else stands there. */
static bool scan(const char *text, double *numbers, int count) {
  for (int k = 0; k < count; ++text) {
    if (!*text) return false;
    char *end;
    double number = strtod(text, &end);
    if (end == text) continue;
    numbers[k++] = number;
    text = end - 1;
  }
  return true;
}

bool hard_numbers(const char *after, double *numbers, int count) {
  const char *text = strstr(content("lamp.inc"), after);
  return text && scan(text + strlen(after), numbers, count);
}

double hard_stated(const struct hard_case *lit) {
  static const double of_sheets[] = {0.5, 1, 2, 4, 8};
  const char *text = content("lamp.inc");
  double numbers[6], stated = -1;
  if (lit->kind == HARD_SHEET) {
    char line[64];
    int lights[2];
    hard_lights(lit, &lit->pages[0], lights);
    snprintf(line, sizeof line, "\n//   %dx%d ", lights[0], lights[1]);
    text = strstr(text, line);
    char cells[5][16];
    if (!text || sscanf(text + strlen(line), "%*d of %*d %15s %15s %15s %15s %15s", cells[0],
                        cells[1], cells[2], cells[3], cells[4]) != 5)
      return -1;
    for (int k = 0; k < 5; ++k)
      if (of_sheets[k] == lit->away)
        stated = strcmp(cells[k], "-") ? strtod(cells[k], NULL) : INFINITY;
  } else {
    text = strstr(text, "away:");
    if (!text || !scan(text, numbers, 6)) return -1;
    for (int k = 0; k < 3; ++k)
      if (numbers[2 * k + 1] == lit->away) stated = numbers[2 * k];
  }
  return stated / 100;
}
