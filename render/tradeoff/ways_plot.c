/* ways_plot.c - error against seconds to the first picture, a line a kind of way: what no other
 * way of its kind beats in both. Advised ways are circled, and an arrow leads from each in
 * POV-Ray to the whole lamp at the same error: the break-even. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tradeoff/plot.h"
#include "tradeoff/ways.h"

/* The lines: which rows of ways_pictures each has. */
static const struct {
  const char *title, *colour;
  enum ways_kind kind;
  int lights; /* 0: any */
} lines[] = {
    {"POV-Ray, sheet of 16 x 16 lights", "#08306b", WAYS_SHEET, 16},
    {"POV-Ray, 8 x 8 lights", "#2171b5", WAYS_SHEET, 8},
    {"POV-Ray, 4 x 4 lights", "#6baed6", WAYS_SHEET, 4},
    {"POV-Ray, cluster", "#2ca02c", WAYS_CLUSTER, 0},
    {"POV-Ray, far field", "#bcbd22", WAYS_POINT, 0},
    {"renderslab", "#d62728", WAYS_METHOD, 0},
};
enum { LINES = sizeof lines / sizeof *lines, MOST = WAYS_MOST_BAKES * WAYS_PICTURES };

struct point {
  double cpu, error;
};

static int by_cpu(const void *left, const void *right) {
  const struct point *a = left, *b = right;
  if (a->cpu != b->cpu) return a->cpu < b->cpu ? -1 : 1;
  return (a->error > b->error) - (a->error < b->error);
}

/* Those that no cheaper one beats; returns how many. */
static int keep_best(struct point *points, int count) {
  double least = INFINITY;
  int kept = 0;
  qsort(points, (size_t)count, sizeof *points, by_cpu);
  for (int k = 0; k < count; ++k)
    if (points[k].error < least) {
      least = points[k].error;
      points[kept++] = points[k];
    }
  return kept;
}

static int collect(const struct ways *ways, int line, struct point points[MOST]) {
  int count = 0;
  for (int b = 0; b < ways->bake_count; ++b)
    for (int p = 0; p < WAYS_PICTURES; ++p) {
      const struct ways_made *made = &ways->made[b][p];
      if (made->refused || ways_pictures[p].kind != lines[line].kind ||
          (lines[line].lights > 0 && ways_pictures[p].lights != lines[line].lights))
        continue;
      points[count++] =
          (struct point){ways_first(ways, b, p), made->tried ? made->measured : made->predicted};
    }
  return keep_best(points, count);
}

static void print_points(FILE *file, const char *name, int number, const struct point *points,
                         int count) {
  fprintf(file, "$%s%d << END\n", name, number);
  for (int k = 0; k < count; ++k)
    fprintf(file, "%.6g %.6g\n", points[k].cpu, 100 * points[k].error);
  fputs("END\n", file);
}

/* A circle for each way that is advised, and its bake. */
static int print_advice(FILE *file, const struct ways_settings *settings, const struct ways *ways) {
  int count = 0;
  fputs("$advised << END\n", file);
  for (int rung = 0; rung < settings->error_count; ++rung)
    for (int renderer = 0; renderer < 2; ++renderer) {
      const struct ways_advice *advice = &ways->advice[rung][renderer];
      if (!advice->found) continue;
      const struct ways_bake *bake = &ways->bakes[advice->bake];
      ++count;
      fprintf(file, "%.6g %.6g \"", ways_first(ways, advice->bake, advice->picture),
              100 * ways->made[advice->bake][advice->picture].measured);
      if (renderer == 0 && bake->rays > 0)
        fprintf(file, "uv %d, st %d, %d rays", bake->uv, bake->st, bake->rays);
      fputs("\"\n", file);
    }
  fputs("END\n", file);
  return count;
}

static void print_break_even(FILE *file, const struct ways_settings *settings,
                             const struct ways *ways) {
  for (int rung = 0; rung < settings->error_count; ++rung) {
    const struct ways_advice *advice = &ways->advice[rung][0];
    if (!advice->found || advice->whole <= 0) continue;
    double first = ways_first(ways, advice->bake, advice->picture);
    double error = 100 * settings->errors[rung];
    fprintf(file,
            "set arrow from %.6g,%.6g to %.6g,%.6g dt 2 lw 1.5 lc rgb 'black' filled size "
            "screen 0.012,20 front\n",
            first, error, advice->whole, error);
    if (advice->pays_from > 0)
      fprintf(
          file,
          "set label 'break-even: picture %d' at %.6g,%.6g center offset 0,0.6 font ',11' front\n",
          advice->pays_from, sqrt(first * advice->whole), error);
  }
}

/* The axes' ranges hold all points. */
struct range {
  double low, high;
};

static void widen(struct range *range, double value) {
  range->low = fmin(range->low, value);
  range->high = fmax(range->high, value);
}

static void print_axes(FILE *file, const struct ways_settings *settings, struct range cpu,
                       struct range error) {
  fprintf(
      file,
      "set logscale xy\nset format x '%%g'\nset format y '%%g'\n"
      "set xrange [%.4g:%.4g]\nset yrange [%.4g:%.4g]\n"
      "set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200)\nset grid\n"
      "set bmargin 9\nset key at screen 0.5,0.01 center bottom horizontal Left reverse maxrows 4\n"
      "set xlabel 'CPU seconds from the lamp script to the first picture'\n"
      "set ylabel 'error of the picture, %%'\n",
      cpu.low / 1.5, cpu.high * 1.5, 100 * error.low / 1.5, 100 * error.high * 1.3);
  for (int rung = 0; rung < settings->error_count; ++rung)
    fprintf(file,
            "set arrow from graph 0, first %.6g to graph 1, first %.6g nohead lw 1 lc rgb "
            "'#999999' back\n",
            100 * settings->errors[rung], 100 * settings->errors[rung]);
}

/* The whole lamp's line, and on to where it would reach the rungs. */
static void print_whole(FILE *file, const struct ways_settings *settings, const struct ways *ways,
                        struct range *cpu, struct range *error) {
  struct point points[WAYS_WHOLE], reckoned[WAYS_MOST_RUNGS + 1];
  int count = ways->lamp_count, more = 0;
  for (int k = 0; k < count; ++k) {
    points[k] = (struct point){ways->lamp[k].cpu, ways->lamp[k].error};
    widen(cpu, points[k].cpu);
    widen(error, points[k].error);
  }
  if (count) print_points(file, "whole", 0, points, count);
  if (count) reckoned[more++] = points[count - 1];
  for (int rung = 0; rung < settings->error_count; ++rung) {
    const struct ways_advice *advice = &ways->advice[rung][0];
    if (!advice->found || !advice->reckoned) continue;
    reckoned[more++] = (struct point){advice->whole, settings->errors[rung]};
    widen(cpu, advice->whole);
  }
  if (count) print_points(file, "reckoned", 0, reckoned, more);
}

static const char *base(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

static void print_title(const struct ways_settings *settings, char title[512]) {
  snprintf(title, 512, "%s in %s: from the lamp to the picture", base(settings->lamp),
           base(settings->mesh));
}

void ways_plot(FILE *file, const struct ways_settings *settings, const struct ways *ways) {
  struct point points[MOST] = {{0}};
  struct range cpu = {INFINITY, 0}, error = {INFINITY, 0};
  bool drawn[LINES];
  for (int k = 0; k < LINES; ++k) {
    int count = collect(ways, k, points);
    drawn[k] = count > 0;
    if (drawn[k]) print_points(file, "line", k, points, count);
    for (int p = 0; p < count; ++p) {
      widen(&cpu, points[p].cpu);
      widen(&error, points[p].error);
    }
  }
  print_whole(file, settings, ways, &cpu, &error);
  int advised = print_advice(file, settings, ways);
  print_axes(file, settings, cpu, error);
  print_break_even(file, settings, ways);
  fputs("set title ", file);
  char title[512];
  print_title(settings, title);
  plot_quote(file, title);
  fputs(" noenhanced\nplot ", file);
  const char *between = "";
  for (int k = 0; k < LINES; ++k) {
    if (!drawn[k]) continue;
    fprintf(file, "%s$line%d with linespoints lw 2 pt %d ps 1.1 lc rgb '%s' title '%s'", between, k,
            k + 4, lines[k].colour, lines[k].title);
    between = ", ";
  }
  if (ways->lamp_count)
    fprintf(file,
            "%s$whole0 with linespoints lw 2.5 pt 2 ps 1.4 lc rgb 'black' title 'POV-Ray, the "
            "whole lamp', $reckoned0 with lines dt 3 lw 2.5 lc rgb 'black' title 'the same, "
            "reckoned'",
            between);
  if (advised)
    fputs(", $advised with points pt 6 ps 2.6 lw 2 lc rgb '#ff7f0e' title 'advised', "
          "$advised using 1:2:3 with labels noenhanced left offset 0.6,-0.9 font ',9' notitle",
          file);
  fputc('\n', file);
}
