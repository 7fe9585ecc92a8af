/* report.c - the table of numerics.h, as text and as HTML. */
#include <math.h>
#include <stdio.h>

#include "numerics.h"

/* As text: the largest error; in parentheses where nothing is claimed of it; for methods that
 * claim what they predict, or a tolerance, its largest share of that. */
static const char *cell(enum gather_method method, const struct tally *tally, char text[32]) {
  bool exact = method == GATHER_REFERENCE || method == GATHER_CLOSED || method == GATHER_GL;
  if (tally->values == 0)
    text[0] = 0;
  else if (tally->stated == 0)
    snprintf(text, 32, "(%.0e)", tally->error);
  else if (exact)
    snprintf(text, 32, "%.0e%s", tally->error, tally->share > 1 ? " !" : "");
  else
    snprintf(text, 32, "%.2gx%s", tally->share, tally->share > 1 ? " !" : "");
  return text;
}

/* gl is the last one, and left out where there is no OpenGL. */
static int count_methods(const struct tally table[][NUMERICS_METHODS]) {
  for (int row = 0; row < numerics_row_count; ++row)
    if (table[row][GATHER_GL].values > 0) return NUMERICS_METHODS;
  return GATHER_GL;
}

int report_print(const struct tally table[][NUMERICS_METHODS], double seconds) {
  const int methods = count_methods(table);
  const char *why;
  int missed = 0;
  uint64_t values = 0, stated = 0;
  printf("%-17s", "");
  for (int k = 0; k < methods; ++k) printf(" %10.10s", gather_methods[k].name);
  printf("\n");
  for (int row = 0; row < numerics_row_count; ++row) {
    printf("%-17s", numerics_rows[row].name);
    for (int k = 0; k < methods; ++k) {
      char text[32];
      printf(" %10s", cell((enum gather_method)k, &table[row][k], text));
      missed += !(table[row][k].share <= 1);
      values += table[row][k].values;
      stated += table[row][k].stated;
    }
    printf("\n");
  }
  for (int row = 0; row < numerics_row_count; ++row)
    for (int k = 0; k < methods; ++k) {
      const struct tally *tally = &table[row][k];
      if (!(tally->share <= 1))
        printf(
            "missed: %s by %s: error %.3g, %.3g of what is allowed: make stability CASE='%s %u'\n",
            numerics_rows[row].name, gather_methods[k].name, tally->error, tally->share,
            numerics_rows[row].name, tally->seed);
    }
  if (!gl_is_here(&why)) printf("no column gl: %s\n", why);
  printf("%llu values, %llu of them with an error stated; %d cells missed; %.0f s\n",
         (unsigned long long)values, (unsigned long long)stated, missed, seconds);
  return missed;
}

static const char head[] =
    "<!doctype html>\n<html lang=en><meta charset=utf-8><title>Hard cases</title>\n<style>"
    "body{font:15px/1.4 sans-serif;margin:2em;max-width:75em}table{border-collapse:collapse}"
    "td,th{padding:.25em .6em;border-bottom:1px solid #ccc;text-align:right;white-space:nowrap}"
    "td:first-child,th:first-child{text-align:left}td small{display:block;color:#555;"
    "white-space:normal;max-width:22em}.held{background:#dff2df}.missed{background:#f6c9c9}"
    "</style>\n<h1>Hard cases</h1>\n";

static const char legend[] =
    "<p><b>reference</b>, <b>closed</b>: the largest relative error; 1e-9 is allowed. <b>gl</b>: "
    "of "
    "the sum over views; 1e-5 and what rounding to floats does are. "
    "<b>0.2x</b>: the largest error as a share of what the method predicts, or of the tolerance. "
    "(In parentheses): the largest error of a method that claims none; it must be finite, and not "
    "negative. Below each: values compared.</p>\n";

bool report_write(const char *path, const struct tally table[][NUMERICS_METHODS], double seconds,
                  const struct growth *growth) {
  const int methods = count_methods(table);
  FILE *file = fopen(path, "w");
  if (!file) {
    perror(path);
    return false;
  }
  fprintf(file, "%s%s<table>\n<tr><th>", head, legend);
  for (int k = 0; k < methods; ++k) fprintf(file, "<th>%s", gather_methods[k].name);
  for (int row = 0; row < numerics_row_count; ++row) {
    const struct numerics_row *about = &numerics_rows[row];
    fprintf(file, "\n<tr><td>%s<small>%s; by %s</small>", about->name, about->text,
            about->oracle ? about->oracle : "exact rationals, long double quadrature");
    for (int k = 0; k < methods; ++k) {
      const struct tally *tally = &table[row][k];
      char text[32];
      const char *class = tally->share > 1 ? "missed" : tally->stated > 0 ? "held" : "";
      fprintf(file, "<td class='%s' title='seed %u'>%s<small>%llu</small>", class, tally->seed,
              cell((enum gather_method)k, tally, text), (unsigned long long)tally->values);
    }
  }
  fprintf(file, "\n</table>\n");
  growth_write_svg(file, growth);
  fprintf(file,
          "<p>%.0f s. One case again: <code>make stability CASE='ROW SEED'</code>"
          "</html>\n",
          seconds);
  return fclose(file) == 0;
}
