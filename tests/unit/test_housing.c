/* test_housing.c - lifting Canned_Housing out of a lamp script as text. */
#include <stdlib.h>

#include "helpers.h"
#include "housing.h"

static void expect(const char *script, const char *housing) {
  char *found = housing_find(script);
  if (housing)
    assert_string_equal(found, housing);
  else
    assert_null(found);
  free(found);
}

static void test_found(void **state) {
  (void)state;
  expect("#declare Canned_Housing = sphere { 0, 1 }\nlight_source { y }", "sphere { 0, 1 }");
  expect("#declare R = 2;\n#declare V=<1,2,3>*R ;#declare Canned_Housing=box{0,R}",
         "#local R = 2;\n#local V = <1,2,3>*R ;\nbox{0,R}");
  expect("#declare Canned_Housing = union { sphere { 0, 1 } box { 0, 1 } } sphere { y, 1 }",
         "union { sphere { 0, 1 } box { 0, 1 } }");
}

/* Braces and words in comments and strings are no code. */
static void test_quiet_text(void **state) {
  (void)state;
  expect("// #declare Canned_Housing = sphere { 0, 1 }\n", NULL);
  expect("/* #declare Canned_Housing = sphere { 0, 1 } */", NULL);
  expect("#debug \"#declare Canned_Housing = x { }\"", NULL);
  expect("#declare Canned_Housing = union { // }\n sphere { 0, 1 /* } */ } }\nbox { 0, 1 }",
         "union { // }\n sphere { 0, 1 /* } */ } }");
  expect("#declare Canned_Housing = text { ttf \"a}.ttf\" \"\\\"}\" 1, 0 } box { 0, 1 }",
         "text { ttf \"a}.ttf\" \"\\\"}\" 1, 0 }");
}

/* Objects and textures are not carried, nor names that only begin alike. */
static void test_left_alone(void **state) {
  (void)state;
  expect("#declare T = texture { pigment { rgb 1 } }\n#declare Canned_Housing = box { 0, 1 }",
         "box { 0, 1 }");
  expect("#declare Canned_Housing_2 = box { 0, 1 }", NULL);
  expect("", NULL);
  expect("#declare Canned_Housing", NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_found),
                                     cmocka_unit_test(test_quiet_text),
                                     cmocka_unit_test(test_left_alone)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
