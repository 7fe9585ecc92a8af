/* test_housing.c - lifting Canned_Housing out of a lamp script as text. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "lamp/housing.h"

static void expect(const char *script, const char *housing) {
  char *found = housing_find(script);
  if (housing)
    assert_string_equal(found, housing);
  else
    assert_null(found);
  free(found);
}

TEST(test_found) {
  expect("#declare Canned_Housing = sphere { 0, 1 }\nlight_source { y }", "sphere { 0, 1 }");
  expect("#declare R = 2;\n#declare V=<1,2,3>*R ;#declare Canned_Housing=box{0,R}",
         "#local R = 2;\nbox{0,R}");
  expect("#declare R = 2;\n#declare V=<1,2,3>*R ;#declare Canned_Housing=box{0,V}",
         "#local R = 2;\n#local V = <1,2,3>*R ;\nbox{0,V}");
  expect("#declare Canned_Housing = union { sphere { 0, 1 } box { 0, 1 } } sphere { y, 1 }",
         "union { sphere { 0, 1 } box { 0, 1 } }");
}

/* Braces and words in comments and strings are no code. */
TEST(test_quiet_text) {
  expect("// #declare Canned_Housing = sphere { 0, 1 }\n", NULL);
  expect("/* #declare Canned_Housing = sphere { 0, 1 } */", NULL);
  expect("#debug \"#declare Canned_Housing = x { }\"", NULL);
  expect("#declare Canned_Housing = union { // }\n sphere { 0, 1 /* } */ } }\nbox { 0, 1 }",
         "union { // }\n sphere { 0, 1 /* } */ } }");
  expect("#declare Canned_Housing = text { ttf \"a}.ttf\" \"\\\"}\" 1, 0 } box { 0, 1 }",
         "text { ttf \"a}.ttf\" \"\\\"}\" 1, 0 }");
}

/* Objects and textures are not carried, nor names that only begin alike. */
TEST(test_left_alone) {
  expect("#declare T = texture { pigment { rgb 1 } }\n#declare Canned_Housing = box { 0, 1 }",
         "box { 0, 1 }");
  expect("#declare Canned_Housing_2 = box { 0, 1 }", NULL);
  expect("", NULL);
  expect("#declare Canned_Housing", NULL);
}

/* Puts the part in place of %s. */
static void wrap(char script[256], const char *around, const char *part, const char *after) {
  const char *hole = strstr(around, "%s");
  snprintf(script, 256, "%.*s%s%s%s", (int)(hole - around), around, part, hole + 2, after);
}

/* What the script only declares at times, or twice, is not known without running it. */
TEST(test_conditional) {
  static const char *const wraps[] = {
      "#if (0)\n%s\n#end",
      "#ifdef (X) %s #else #end",
      "#ifndef(X) %s #end",
      "#for (I, 1, 2) %s #end",
      "#while (0)\n%s\n#end",
      "#macro M()\n%s\n#end",
      "#switch (1) #case (1) %s #break #end",
      "#if (1) #if (0) #end %s #end",
      "# if (1) %s #end",
  };
  static const char *const parts[] = {"#declare Canned_Housing = box { 0, 1 }", "#declare R = 1;"};
  for (size_t k = 0; k < sizeof wraps / sizeof *wraps; ++k) {
    char script[256];
    wrap(script, wraps[k], parts[0], "");
    expect(script, "");
    wrap(script, wraps[k], parts[1], "\n#declare Canned_Housing = box { 0, R }");
    expect(script, "");
    /* one that the housing does not need is of no interest, nor is a closed block */
    char *other = strrchr(script, 'R');
    *other = '2';
    expect(script, "box { 0, 2 }");
  }
  expect("#declare R = 1;\n#declare R = 2;\n#declare Canned_Housing = box { 0, R }", "");
  expect(
      "#declare R = 1;\n#declare S = R;\n#declare R = 2;\n#declare Canned_Housing = box { 0, S }",
      "");
  expect("#declare R = 1;\nunion { #local R = 2; }\n#declare Canned_Housing = box { 0, R }", "");
  expect("#declare Canned_Housing = box { 0, 1 }\n#declare Canned_Housing = box { 0, 2 }", "");
  expect("#declare R = 1;\n#declare Canned_Housing = box { 0, R }\n#declare R = 2;",
         "#local R = 1;\nbox { 0, R }");
  expect("// #if\n/* #if /* */ #if */ #debug \"#if\"\n#declare Canned_Housing = box { 0, 1 }",
         "box { 0, 1 }");
  expect("#declare Canned_Housing = union { #for (I, 1, 2) box { 0, I } #end }",
         "union { #for (I, 1, 2) box { 0, I } #end }");
}

/* A slab file may come from anyone. */
TEST(test_harmless) {
  static const char *const good[] = {
      "box { 0, 1 }",
      "#local R = 2;\n#local V = <1,2,3>*R ;\nbox{0,R}",
      "union { // }\n sphere { 0, 1 /* } */ } }",
      "union {\r\n #for (I, 1, 2) #if (I > 1) box { 0, I } #else box { 0, 2 } #end #end }",
      "text { ttf \"#end}.ttf\" \"}\" 1, 0 }",
      "/* /* nested */ #fopen */ box { 0, 1 }",
      "box { 0, 1 } // #end",
  };
  static const char *const bad[] = {
      "#end #fopen F \"x\" write #macro X()",
      "box { 0, 1 } #end #macro X()",
      "box { 0, 1 } # end\n# macro X()",
      "box { 0, 1 } #/**/end",
      "#if (1) box { 0, 1 }",
      "union { box { 0, 1 }",
      "box { 0, 1 } }",
      "} box { 0, 1 } {",
      "#declare Clock = 1; box { 0, 1 }",
      "#include \"x\" box { 0, 1 }",
      "#macro M() #end box { 0, 1 }",
      "#fclose F box { 0, 1 }",
      "box { 0, 1 } /*",
      "box { 0, 1 } \"",
      "box { 0, 1 } // \r #end",
      "text { ttf \"a\" \"\\\" #end \" 1, 0 }",
      "/* /* */ \" */ #fopen F \"x\" write /*\" */",
      "box { 0, 1 } \x1a",
  };
  for (size_t k = 0; k < sizeof good / sizeof *good; ++k)
    if (!housing_is_harmless(good[k])) fail_msg("refused: %s", good[k]);
  for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k)
    if (housing_is_harmless(bad[k])) fail_msg("let through: %s", bad[k]);
}

int main(void) {
  return testing_run(NULL, NULL);
}
