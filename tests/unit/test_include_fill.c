/* test_include_fill.c - templates of includes: what stands for what, and which lines are left
 * out. */
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "include/text/include_fill.h"

static void quote(const char *text, FILE *out) {
  fprintf(out, "<%s>", text);
}

static void rows(const void *of, FILE *out) {
  fprintf(out, "%d,\n%d", *(const int *)of, *(const int *)of + 1);
}

/* `template`, filled with one of each kind of value, is `wanted`. */
static void assert_fills(const char *template, const char *wanted) {
  static const double numbers[3] = {0.25, 1.0 / 3, 1e9};
  static const int first = 4;
  const struct include_value more[] = {{"far", .number = 2}, {"none", .text = ""}, {0}};
  const struct include_value values[] = {{"part", .part = "a @{count}\nb\n"},
                                         {"text", .text = "@{count}"},
                                         {"quoted", .text = "q", .write = quote},
                                         {"rows", .print = rows, .of = &first},
                                         {"numbers", .numbers = numbers},
                                         {"count", .number = 65536},
                                         {"zero", .number = 0},
                                         {.more = more}};
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  include_fill(template, "Lamp", values, out);
  fclose(out);
  assert_string_equal(text, wanted);
  free(text);
}

static void test_values(void **state) {
  (void)state;
  assert_fills("@_A @{count} @{count:g} @{far}\n", "Lamp_A 65536 65536 2");
  assert_fills("@{numbers[0]} @{numbers[1]:.3g} @{numbers[2]:g}\n", "0.25 0.333 1e+09");
  assert_fills("@{text} @{quoted}@{none}.\n", "@{count} <q>.");
  assert_fills("x\n@{rows}\n@{part} c\n", "x\n4,\n5\na 65536\nb c");
  assert_fills("@{nothing}, @{coun} @{counts}\n", "@{nothing}, @{coun} @{counts}");
}

/* A line that is left out takes its end with it, a rest of a line does not. */
static void test_conditions(void **state) {
  (void)state;
  assert_fills("@{if zero}a\nb\n@{if none}c\n", "b");
  assert_fills("a\n\n@{if zero}b\n\nc@{if zero}, d\ne\n", "a\n\n\nc\ne");
  assert_fills("@{if count}a@{if text}, b\n@{if rows}@{rows}\n@{if part}\nc\n", "a, b\n4,\n5\n\nc");
  assert_fills("@{if nothing}a\nb\n", "b");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_values),
                                     cmocka_unit_test(test_conditions)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
