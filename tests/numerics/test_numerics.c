/* test_numerics.c - hard cases stay numerically stable (numerics.h). As a test: a few seeds of
 * each row. With arguments: a sweep.
 *
 *   test_numerics EFFORT JOBS TABLE.html GROWTH.txt   seeds in proportion, by so many processes
 *   test_numerics ROW SEED                            one case again, with all numbers */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "numerics.h"

typedef struct tally table[NUMERICS_ROWS_MAX][NUMERICS_METHODS];

struct part {
  table sums;
  struct growth growth;
};

/* A seed's random numbers are those of its row's, too. */
static void run(int row, uint32_t seed, struct tally *tally, struct growth *growth, bool verbose) {
  struct trial trial = {.start = seed, .tally = tally, .verbose = verbose, .growth = growth};
  trial.seed = seed * 2654435761u + (uint64_t)row * 40503u + 1;
  numerics_rows[row].run(&trial);
}

static void merge(const table from, table to) {
  for (int row = 0; row < numerics_row_count; ++row)
    for (int k = 0; k < NUMERICS_METHODS; ++k) {
      const struct tally *a = &from[row][k];
      struct tally *b = &to[row][k];
      if (a->share > b->share || (b->share == 0 && a->error > b->error)) b->seed = a->seed;
      b->share = fmax(a->share, b->share);
      b->error = fmax(a->error, b->error);
      b->values += a->values;
      b->stated += a->stated;
    }
}

/* ---- The test: a few seeds. */

static void test_row(void **state) {
  static table few;
  const int row = (int)((const struct numerics_row *)*state - numerics_rows);
  memset(few, 0, sizeof few);
  for (uint32_t seed = 0; seed < 3; ++seed) run(row, seed, few[row], NULL, false);
  for (int k = 0; k < NUMERICS_METHODS; ++k) {
    const struct tally *tally = &few[row][k];
    if (!(tally->share <= 1))
      fail_msg("%s by %s: error %.3g, %.3g of what is allowed, seed %u", numerics_rows[row].name,
               gather_methods[k].name, tally->error, tally->share, tally->seed);
  }
}

static int test(void) {
  const char *why;
  if (!gl_is_here(&why)) { /* set-up brings one that needs no GPU */
    print_error("%s\n", why);
    return 1;
  }
  for (int row = 0; row < numerics_row_count; ++row)
    testing_add(numerics_rows[row].name, test_row, &numerics_rows[row]);
  return testing_run(NULL, NULL);
}

/* ---- The sweep. */

/* Every jobs-th seed of each row. */
static void sweep_part(int part, int jobs, int effort, struct part *sums) {
  for (int row = 0; row < numerics_row_count; ++row)
    for (int seed = part; seed < effort * numerics_rows[row].seeds; seed += jobs)
      run(row, (uint32_t)seed, sums->sums[row], &sums->growth, false);
}

static int sweep(int effort, int jobs, const char *path, const char *growth) {
  struct part *parts = mmap(NULL, (size_t)jobs * sizeof *parts, PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  static struct part all;
  struct timespec start, end;
  clock_gettime(CLOCK_MONOTONIC, &start);
  if (parts == MAP_FAILED) return 1;
  for (int k = 0; k < jobs; ++k) {
    pid_t child = fork();
    if (child < 0) return 1;
    if (child == 0) {
      sweep_part(k, jobs, effort, &parts[k]);
      exit(0);
    }
  }
  int status, failed = 0;
  while (wait(&status) > 0) failed += status != 0;
  for (int k = 0; k < jobs; ++k) {
    merge((const struct tally(*)[NUMERICS_METHODS])parts[k].sums, all.sums);
    growth_merge(&parts[k].growth, &all.growth);
  }
  clock_gettime(CLOCK_MONOTONIC, &end);
  double seconds =
      (double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec);
  int missed = report_print((const struct tally(*)[NUMERICS_METHODS])all.sums, seconds);
  if (!report_write(path, (const struct tally(*)[NUMERICS_METHODS])all.sums, seconds,
                    &all.growth) ||
      !growth_write_table(growth, &all.growth))
    failed = 1;
  return missed > 0 || failed > 0;
}

/* ---- One case again. */

static int again(const char *name, const char *seed) {
  static struct tally tally[NUMERICS_METHODS];
  for (int row = 0; row < numerics_row_count; ++row) {
    if (strcmp(numerics_rows[row].name, name) != 0) continue;
    run(row, (uint32_t)strtoul(seed, NULL, 10), tally, NULL, true);
    for (int k = 0; k < NUMERICS_METHODS; ++k)
      if (tally[k].values > 0)
        printf("%-12s error %.3g, %.3g of what is allowed\n", gather_methods[k].name,
               tally[k].error, tally[k].share);
    return 0;
  }
  fprintf(stderr, "test_numerics: %s: no such row; there are:", name);
  for (int row = 0; row < numerics_row_count; ++row)
    fprintf(stderr, " %s", numerics_rows[row].name);
  fprintf(stderr, "\n");
  return 2;
}

int main(int argc, char **argv) {
  if (argc == 3) return again(argv[1], argv[2]);
  if (argc == 5) return sweep(atoi(argv[1]), atoi(argv[2]), argv[3], argv[4]);
  return test();
}
