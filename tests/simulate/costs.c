#include "simulate/costs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct line {
  char bake[COSTS_NAME];
  bool last;
  double cost, seconds;
};

struct table {
  struct line *lines; /* owned */
  size_t count;
};

static double cost_of(double rays, double cameras) {
  return rays + 256 * cameras;
}

static bool add_line(struct table *table, const struct line *line) {
  struct line *grown = realloc(table->lines, (table->count + 1) * sizeof *grown);
  if (!grown) return false;
  table->lines = grown;
  table->lines[table->count++] = *line;
  return true;
}

/* One line of the file; false: it is of no known form. */
static bool take_line(const char *text, struct costs *costs, struct table *table) {
  char lamp[COSTS_NAME], kind[COSTS_NAME], round[COSTS_NAME];
  struct line line = {.last = false};
  double rays, cameras, seconds;
  if (text[strspn(text, " \t\r\n")] == 0 || *text == '#') return true;
  int got = sscanf(text, "%31s %31s %31s %31s %lf %lf %lf", lamp, kind, line.bake, round, &rays,
                   &cameras, &line.seconds);
  if (got != 7 && got != 4) return false;
  if (strcmp(lamp, costs->lamp) != 0) return true;
  strcpy(costs->kind, kind);
  if (got == 7) {
    line.last = !strcmp(round, "last");
    line.cost = cost_of(rays, cameras);
    return line.seconds > 0 && line.cost > 0 && add_line(table, &line);
  }
  const struct {
    const char *name;
    double *value;
  } values[] = {{"start", &costs->start},
                {"join", &costs->join},
                {"read", &costs->read},
                {"plan", &costs->plan},
                {"finish", &costs->finish}};
  for (size_t n = 0; n < sizeof values / sizeof *values; ++n)
    if (!strcmp(line.bake, values[n].name) && sscanf(round, "%lf", &seconds) == 1)
      return (*values[n].value = seconds) >= 0;
  return false;
}

/* Relative least squares over the first rounds of the bake with most sizes: that called "sizes". */
static bool fit_line(const struct table *table, struct costs *costs) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const struct line *line = table->lines; line < table->lines + table->count; ++line) {
    if (strcmp(line->bake, "sizes") != 0) continue;
    double weight = 1 / (line->seconds * line->seconds);
    n += weight;
    x += weight * line->cost;
    y += weight * line->seconds;
    xx += weight * line->cost * line->cost;
    xy += weight * line->cost * line->seconds;
  }
  double determinant = n * xx - x * x;
  if (!(determinant > 0)) return false;
  costs->ray = (n * xy - x * y) / determinant;
  costs->process = (y - costs->ray * x) / n;
  return costs->ray > 0;
}

/* Of the bake called "rounds": its last round over its first, by the cost; and the spread of both.
 */
static bool compare_rounds(const struct table *table, struct costs *costs) {
  double seconds[2] = {0}, fitted[2] = {0};
  costs->spread = malloc((table->count + 1) * sizeof *costs->spread);
  if (!costs->spread) return false;
  for (const struct line *line = table->lines; line < table->lines + table->count; ++line) {
    if (strcmp(line->bake, "rounds") != 0) continue;
    seconds[line->last] += line->seconds;
    fitted[line->last] += costs->process + costs->ray * line->cost;
  }
  if (!(fitted[0] > 0 && fitted[1] > 0)) return false;
  double mean[2] = {seconds[0] / fitted[0], seconds[1] / fitted[1]};
  costs->last = mean[1] / mean[0];
  for (const struct line *line = table->lines; line < table->lines + table->count; ++line)
    if (!strcmp(line->bake, "rounds"))
      costs->spread[costs->spread_count++] =
          line->seconds / (costs->process + costs->ray * line->cost) / mean[line->last];
  return true;
}

bool costs_read(const char *path, const char *lamp, struct costs *costs) {
  struct table table = {0};
  char text[512];
  int number = 0;
  *costs = (struct costs){0};
  snprintf(costs->lamp, sizeof costs->lamp, "%s", lamp);
  FILE *file = fopen(path, "re");
  bool good = file != NULL;
  while (good && fgets(text, sizeof text, file)) {
    ++number;
    good = take_line(text, costs, &table);
  }
  if (file) fclose(file);
  if (!good) fprintf(stderr, "%s: line %d: not a measured batch or cost\n", path, number);
  if (good && !(fit_line(&table, costs) && compare_rounds(&table, costs))) {
    fprintf(stderr, "%s: not enough batches of %s\n", path, lamp);
    good = false;
  }
  free(table.lines);
  return good;
}

void costs_free(struct costs *costs) {
  free(costs->spread);
}

double costs_batch(const struct costs *costs, bool last, double rays, double cameras, size_t n) {
  double seconds = costs->process + costs->ray * cost_of(rays, cameras);
  return costs->start +
         seconds * (last ? costs->last : 1) * costs->spread[n * 7 % costs->spread_count];
}
