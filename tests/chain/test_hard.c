/* test_hard.c - hard cases of the includes in POV-Ray (hard.h). As a test: a seed of each
 * row and kind. With arguments: a sweep.
 *
 *   test_hard EFFORT JOBS TABLE.html   seeds in proportion, by so many processes
 *   test_hard ROW SEED                 one case again; its files stay in the folder it names */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hard.h"

enum { MOST_ROWS = 24, SEEDS = 6 };

/* What became of a row's cases of one kind. */
struct tally {
  int cases, refused, missed, dark;
  double error, share; /* the worst of those that are right */
};
typedef struct tally table[MOST_ROWS][HARD_KINDS];

static void run(int row, uint32_t seed, table sums) {
  static struct hard_case lit;
  struct hard_result result;
  hard_make(row, seed, &lit);
  hard_run(&lit, &result);
  struct tally *tally = &sums[row][lit.kind];
  ++tally->cases;
  tally->refused += result.verdict == HARD_REFUSED;
  tally->dark += result.dark;
  if (result.verdict == HARD_RIGHT) {
    tally->error = fmax(tally->error, result.error);
    tally->share = fmax(tally->share, result.error / result.allowed);
  }
  if (result.verdict == HARD_MISSED) {
    printf("missed: make stability CASE='%s %u': %s: %s\n", hard_rows[row].name, seed,
           hard_kind_names[lit.kind], result.why);
    fflush(stdout);
    ++tally->missed;
  }
  hard_free(&lit);
}

/* ---- The test: a seed of each. */

static void test_row(void **state) {
  static table sums;
  const int row = (int)((const struct hard_row *)*state - hard_rows);
  int missed = 0;
  for (uint32_t seed = 0; seed < HARD_KINDS; ++seed) run(row, seed, sums);
  for (int k = 0; k < HARD_KINDS; ++k) missed += sums[row][k].missed;
  assert_int_equal(missed, 0);
}

static int test(void) {
  for (int row = 0; row < hard_row_count; ++row)
    testing_add(hard_rows[row].name, test_row, &hard_rows[row]);
  return testing_run(chain_setup, chain_teardown);
}

/* ---- The sweep. */

static void sweep_part(int part, int jobs, int effort, table sums) {
  if (chain_setup(NULL) != 0) exit(1);
  for (int row = 0; row < hard_row_count; ++row)
    for (int seed = part; seed < effort * SEEDS; seed += jobs) run(row, (uint32_t)seed, sums);
  chain_teardown(NULL);
}

static void merge(table from, table to) {
  for (int row = 0; row < hard_row_count; ++row)
    for (int k = 0; k < HARD_KINDS; ++k) {
      to[row][k].cases += from[row][k].cases;
      to[row][k].refused += from[row][k].refused;
      to[row][k].missed += from[row][k].missed;
      to[row][k].dark += from[row][k].dark;
      to[row][k].error = fmax(to[row][k].error, from[row][k].error);
      to[row][k].share = fmax(to[row][k].share, from[row][k].share);
    }
}

static void print_text(table all) {
  printf("%-14s %-8s %6s %8s %7s %8s %8s\n", "", "", "cases", "refused", "missed", "error",
         "share");
  for (int row = 0; row < hard_row_count; ++row)
    for (int k = 0; k < HARD_KINDS; ++k) {
      const struct tally *tally = &all[row][k];
      if (tally->cases > 0)
        printf("%-14s %-8s %6d %8d %7d %8.1e %7.2gx\n", hard_rows[row].name, hard_kind_names[k],
               tally->cases, tally->refused, tally->missed, tally->error, tally->share);
    }
}

static const char head[] =
    "<!doctype html>\n<html lang=en><meta charset=utf-8><title>Hard cases in POV-Ray</title>\n"
    "<style>body{font:15px/1.4 sans-serif;margin:2em;max-width:60em}table{border-collapse:collapse}"
    "td,th{padding:.25em .6em;border-bottom:1px solid #ccc;text-align:right}"
    "td:first-child,th:first-child{text-align:left}td small{display:block;color:#555}"
    ".held{background:#dff2df}.missed{background:#f6c9c9}</style>\n<h1>Hard cases in POV-Ray</h1>\n"
    "<p>The largest error as a share of what is allowed: 5e-4, relative RMS, or what the include's "
    "header states. Below each: cases, and how many of them were refused.</p>\n<table>\n<tr><th>";

static bool write_page(const char *path, table all) {
  FILE *file = fopen(path, "w");
  if (!file) {
    perror(path);
    return false;
  }
  fputs(head, file);
  for (int k = 0; k < HARD_KINDS; ++k) fprintf(file, "<th>%s", hard_kind_names[k]);
  for (int row = 0; row < hard_row_count; ++row) {
    fprintf(file, "\n<tr><td>%s<small>%s</small>", hard_rows[row].name, hard_rows[row].text);
    for (int k = 0; k < HARD_KINDS; ++k) {
      const struct tally *tally = &all[row][k];
      fprintf(file, "<td class='%s'>%.2gx<small>%d, %d refused</small>",
              tally->missed ? "missed" : "held", tally->share, tally->cases, tally->refused);
    }
  }
  fputs("\n</table>\n<p>One case again: <code>make stability CASE='ROW SEED'</code></html>\n",
        file);
  return fclose(file) == 0;
}

static int sweep(int effort, int jobs, const char *path) {
  static table all;
  table *parts = mmap(NULL, (size_t)jobs * sizeof *parts, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (parts == MAP_FAILED) return 1;
  for (int k = 0; k < jobs; ++k) {
    pid_t child = fork();
    if (child < 0) return 1;
    if (child == 0) {
      sweep_part(k, jobs, effort, parts[k]);
      exit(0);
    }
  }
  int status, failed = 0, cases = 0, refused = 0, missed = 0, dark = 0;
  while (wait(&status) > 0) failed += status != 0;
  for (int k = 0; k < jobs; ++k) merge(parts[k], all);
  print_text(all);
  for (int row = 0; row < hard_row_count; ++row)
    for (int k = 0; k < HARD_KINDS; ++k) {
      cases += all[row][k].cases;
      refused += all[row][k].refused;
      missed += all[row][k].missed;
      dark += all[row][k].dark;
    }
  printf("%d cases by POV-Ray, %d refused, %d missed; %d without light\n", cases, refused, missed,
         dark);
  return !write_page(path, all) || missed > 0 || failed > 0;
}

/* ---- One case again. */

static int again(const char *name, const char *seed) {
  static struct hard_case lit;
  struct hard_result result;
  static const char *const verdicts[] = {"", "right", "refused", "missed"};
  for (int row = 0; row < hard_row_count; ++row) {
    if (strcmp(hard_rows[row].name, name) != 0) continue;
    if (chain_setup(NULL) != 0) return 1;
    hard_make(row, (uint32_t)strtoul(seed, NULL, 10), &lit);
    hard_run(&lit, &result);
    printf("%s, in %s: %s: %s\n", hard_kind_names[lit.kind], chain_path("scene.pov"),
           verdicts[result.verdict], result.why);
    hard_free(&lit);
    return result.verdict == HARD_MISSED;
  }
  fprintf(stderr, "test_hard: %s: no such row; there are:", name);
  for (int row = 0; row < hard_row_count; ++row) fprintf(stderr, " %s", hard_rows[row].name);
  fprintf(stderr, "\n");
  return 2;
}

int main(int argc, char **argv) {
  if (argc == 3) return again(argv[1], argv[2]);
  if (argc == 4) return sweep(atoi(argv[1]), atoi(argv[2]), argv[3]);
  return test();
}
