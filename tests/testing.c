/* testing.c - see testing.h. */
#include "testing.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { MOST_TESTS = 32 };

static struct CMUnitTest tests[MOST_TESTS];
static size_t test_count;

void testing_add(const char *name, CMUnitTestFunction test, const void *row) {
  if (test_count == MOST_TESTS) abort();
  tests[test_count++] =
      (struct CMUnitTest){.name = name, .test_func = test, .initial_state = (void *)(uintptr_t)row};
}

int testing_run(CMFixtureFunction setup, CMFixtureFunction teardown) {
  return _cmocka_run_group_tests("tests", tests, test_count, setup, teardown);
}

static char directory[256];

static void remove_scratch(void) {
  DIR *listing = opendir(directory);
  const struct dirent *entry;
  while (listing && (entry = readdir(listing)) != NULL) {
    char path[600];
    snprintf(path, sizeof path, "%s/%s", directory, entry->d_name);
    if (entry->d_name[0] != '.') unlink(path);
  }
  if (listing) closedir(listing);
  rmdir(directory);
}

const char *scratch(const char *name) {
  static char paths[8][600];
  static int next;
  if (!*directory) {
    const char *parent = getenv("TMPDIR");
    snprintf(directory, sizeof directory, "%s/canned-test-XXXXXX", parent ? parent : "/tmp");
    if (!mkdtemp(directory)) abort();
    atexit(remove_scratch);
  }
  char *path = paths[next++ % 8];
  snprintf(path, sizeof paths[0], "%s/%s", directory, name);
  return path;
}

int scratch_entries(void) {
  int count = 0;
  scratch("");
  DIR *listing = opendir(directory);
  const struct dirent *entry;
  while (listing && (entry = readdir(listing)) != NULL) count += entry->d_name[0] != '.';
  if (listing) closedir(listing);
  return count;
}

void assert_near_at(double a, double b, double tolerance, const char *file, int line) {
  if (fabs(a - b) <= tolerance) return;
  print_error("%.17g and %.17g differ by %g, more than %g\n", a, b, fabs(a - b), tolerance);
  _fail(file, line);
}
