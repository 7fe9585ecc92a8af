/* test_include.c - what `bakeslab include` and the macros it writes refuse, and
 * that the lamp is not seen. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"
#include "file/slab_json.h"

static const int samples[4] = {4, 4, 16, 16};
static const double square[2] = {1, 1}, window[4] = {-1.5, 1.5, -1.5, 1.5};

#define LIT CHAIN_LIT("1, 1")

/* The tests' slab, made anew by each, and its lamp.inc. */
static struct slab slab;

static void make_slab(void) {
  slab_free(&slab);
  slab = chain_slab(samples, square, window, INFINITY, 0, 11);
}

static void make_lamp(void) {
  make_slab();
  chain_include(&slab, 1, "lamp", "");
}

/* The error of the picture that the lamp, so large, makes of a plane one width away. */
static double picture_error(const struct slab *lit, double scale, const char *sdl) {
  struct chain_lamp lamp = chain_lamp_of(lit, 1, scale);
  struct chain_plane plane = chain_facing(&lamp, 0, 1);
  return chain_error(&lamp, 1, &plane, 1, sdl);
}

/* The program fails with one line that holds `text`, and leaves nothing. */
static void expect_refusal(const char *arguments, int status, const char *text) {
  assert_int_equal(chain_run("rm -f out.*; \"$BAKESLAB\" include %s", arguments), status);
  if (!strstr(chain_log(), text)) fail_msg("no \"%s\" in: %s", text, chain_log());
  assert_int_equal(chain_run("test $(ls -a | grep -c out) = 0 || { ls -a; exit 1; }"), 0);
}

/* Below the smallest Scale the lamp stops with it; there it is still right. */
TEST(test_tolerance) {
  make_lamp();
  chain_says(&slab, CHAIN_LIT("0.0148, 1"), 1,
             "Test_Lamp_Canned: too small for POV-Ray's shadow tolerance with 4x4 lights");
  assert_non_null(strstr(chain_log(), "its unit is 1 m: in a scene in centimetres Scale is 100"));
  const char *advice = strstr(chain_log(), "use Scale >= ");
  assert_non_null(advice);
  double scale = atof(advice + strlen("use Scale >= "));
  assert_true(scale > 0.0148 && scale < 0.0152);
  char sdl[256];
  snprintf(sdl, sizeof sdl, "#include \"lamp.inc\"\nobject { Test_Lamp_Canned(%.17g, 1) }", scale);
  assert_true(picture_error(&slab, scale, sdl) < 5e-4);
  struct slab means = chain_means(&slab, 2, 2);
  assert_true(picture_error(&means, 0.0076,
                            "#declare Test_Lamp_Lights = 2;\n" CHAIN_LIT("0.0076, 1")) < 5e-4);
  slab_free(&means);
}

TEST(test_macro_arguments) {
  make_lamp();
  chain_says(&slab, CHAIN_LIT("0, 1"), 1, "Test_Lamp_Canned: Scale is 0.0000, must be positive");
  chain_says(&slab, CHAIN_LIT("-1, 1"), 1, "Test_Lamp_Canned: Scale is -1.0000, must be positive");
  chain_says(&slab, "#include \"lamp.inc\"\nobject { Test_Lamp_Canned_Lumens(1, 0) }", 1,
             "Test_Lamp_Canned_Lumens: Lumens is 0.0000, must be positive");
  chain_says(&slab, "#declare Test_Lamp_Lights = 0;\n" CHAIN_LIT("1, 1"), 1,
             "Test_Lamp_Canned: Test_Lamp_Lights is 0.00, must be at least 1");
}

/* A twentieth of the lamp in units of 20 m is as large as the lamp itself; in its own units it is
 * a smaller one, which is told. */
TEST(test_lumens) {
  static const char sdl[] = "#declare Test_Lamp_Scene_Metres = 20;\n#include \"lamp.inc\"\n"
                            "object { Test_Lamp_Canned_Lumens(0.05, 300) }";
  double flux[3];
  make_lamp();
  slab_flux(&slab, flux, NULL);
  double gain = 1 / (0.2126 * flux[0] + 0.7152 * flux[1] + 0.0722 * flux[2]);
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 0.05);
  struct chain_plane plane = chain_facing(&lamp, 0, 1);
  lamp.gain = 300 * gain;
  assert_true(chain_error(&lamp, 1, &plane, 1, sdl) < 5e-4);
  assert_null(strstr(chain_log(), "is a smaller or larger lamp"));
  lamp.gain *= 400;
  assert_true(chain_error(&lamp, 1, &plane, 1, strchr(sdl, '\n')) < 5e-4);
  assert_non_null(strstr(chain_log(), "Scale 0.050000 is a smaller or larger lamp"));
}

/* An image that is missing, elsewhere, or another lamp's. */
TEST(test_image) {
  make_lamp();
  chain_must("mkdir other && mv lamp.exr other/");
  chain_says(&slab, LIT, 1, "Test_Lamp_Canned: no image lamp.exr");
  assert_true(picture_error(&slab, 1, "#declare Test_Lamp_Sheet_File = \"other/lamp.exr\";\n" LIT) <
              5e-4);
  /* Written into a folder, from where the scene is rendered too; then brought elsewhere. */
  chain_must("mkdir sub && \"$BAKESLAB\" include lamp-slab.exr -o sub/lamp.inc");
  assert_true(picture_error(&slab, 1,
                            "#include \"sub/lamp.inc\"\n"
                            "object { Test_Lamp_Canned(1, 1) }") < 5e-4);
  chain_must("mv sub elsewhere");
  chain_says(&slab, "#include \"elsewhere/lamp.inc\"", 1,
             "Test_Lamp_Canned: no image lamp.exr: put it into the working folder, or declare "
             "Test_Lamp_Sheet_File before the #include");
  slab.rgb[0] += 1;
  chain_include(&slab, 1, "lamp2", "");
  chain_must("mv lamp2.exr lamp.exr");
  chain_says(&slab, LIT, 1, "lamp.exr is not the image that was made with this include");
}

/* Including a lamp twice is fine; another one under its name is not. */
TEST(test_two_of_a_name) {
  make_lamp();
  assert_true(
      picture_error(
          &slab, 1,
          "#include \"lamp.inc\"\n#include \"lamp.inc\"\nobject { Test_Lamp_Canned(1, 1) }") <
      5e-4);
  slab.center[0] += 0.25; /* the image is the same */
  chain_include(&slab, 1, "moved", "");
  chain_says(&slab, "#include \"lamp.inc\"\n#include \"moved.inc\"", 1,
             "Test_Lamp_Canned: another lamp of this name is included already; make one anew "
             "with `bakeslab include --name'");
  chain_include(&slab, 1, "moved", "--name other");
  assert_true(picture_error(&slab, 1,
                            "#include \"lamp.inc\"\n#include \"moved.inc\"\n"
                            "object { Other_Canned(1, 1) }") < 5e-4);
}

TEST(test_command_line) {
  make_slab();
  chain_write("slab.exr", &slab, 1);
  expect_refusal("slab.exr -o out.inc --mode blob", 2, "--mode blob: must be sheet, cluster");
  expect_refusal("slab.exr -o out.inc --lights 0", 2, "--lights 0: must be a whole number from 1");
  expect_refusal("slab.exr", 2, "no output given");
  expect_refusal("-o out.inc", 2, "no slab given");
  expect_refusal("slab.exr -o out.pov", 2, "out.pov: the output must end in .inc");
  expect_refusal("missing.tif -o out.inc", 1, "missing.tif");
  expect_refusal("slab.exr -o nowhere/out.inc", 1, "nowhere/out.inc");
  expect_refusal(
      "slab.exr -o out.inc --name '2 lamps'", 1,
      "the name \"2 lamps\" is no identifier (letters, digits, _); give one with --name");
  expect_refusal("slab.exr -o out.inc --name a234567890123456789012345", 1,
                 "is longer than 24 characters");
  /* Where the image cannot be put in place there is no include either. */
  chain_must("mkdir other2 other2/lamp.exr && touch other2/lamp.exr/x");
  assert_int_equal(chain_run("\"$BAKESLAB\" include slab.exr -o other2/lamp.inc"), 1);
  chain_must("test \"$(ls -A other2)\" = lamp.exr");
}

/* The image beside the include would replace the slab, or a link would lead there. */
TEST(test_own_slab) {
  static const char *const commands[] = {
      "include own/lamp.exr -o own/lamp.inc",    "include own/../own/lamp.exr -o own/lamp.inc",
      "include own/linked.exr -o own/lamp.inc",  "include own/lamp.exr -o own/linked.inc",
      "include own/lamp.exr -o own/hard.inc",    "include own/lamp.exr -o own/script.inc",
      "include - -o own/lamp.inc <own/lamp.exr",
  };
  make_slab();
  chain_write("slab.exr", &slab, 1);
  chain_must("mkdir own && cp slab.exr own/lamp.exr && cd own && "
             "ln -s lamp.exr linked.exr && ln lamp.exr hard.exr && "
             "ln -s lamp.exr script.inc");
  for (size_t k = 0; k < sizeof commands / sizeof *commands; ++k) {
    if (chain_run("\"$BAKESLAB\" %s", commands[k]) != 1) fail_msg("not refused: %s", commands[k]);
    if (!strstr(chain_log(), "choose another name")) fail_msg("%s", chain_log());
    chain_must("cmp slab.exr own/lamp.exr && test ! -e own/lamp.inc");
  }
  chain_must("\"$BAKESLAB\" include own/lamp.exr -o own/other.inc");
}

TEST(test_radiance) {
  make_slab();
  oracle_sample(&slab, 0, 0, 3, 2)[1] = -0.5F;
  chain_write("slab.exr", &slab, 1);
  expect_refusal("slab.exr -o out.inc", 1,
                 "slab.exr: page 1: radiance -0.5 of sample (0, 0, 3, 2) is negative");
  assert_null(strstr(chain_log(), "clamp"));
  memset(slab.rgb, 0, sizeof(float) * 3 * 64 * 64);
  chain_write("slab.exr", &slab, 1);
  expect_refusal("slab.exr -o out.inc", 1, "slab.exr: all radiance is zero");
}

/* Text of a slab file stays text: it ends no macro and no comment. */
TEST(test_injection) {
  static const char *const housings[] = {
      "sphere { 0, 1 } #end #fopen F \\\"made\\\" write #macro X()", "#fopen F \\\"made\\\" write",
      "/* \\n #fopen F \\\"made\\\" write"};
  make_slab();
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 1);
  struct picture picture;
  char provenance[256];
  for (size_t k = 0; k < sizeof housings / sizeof *housings; ++k) {
    snprintf(provenance, sizeof provenance, "{\"housing\": \"%s\"}", housings[k]);
    assert_int_equal(slab_json_set(&slab, "provenance", provenance, NULL), RESULT_OK);
    chain_include(&slab, 1, "lamp", "");
    assert_non_null(strstr(chain_log(), "lamp-slab.exr: note: its housing is left out"));
    chain_must("grep -q 'without a housing that could be used' lamp.inc");
    chain_scene(&plane, 1, LIT);
    chain_render(&picture);
    picture_free(&picture);
    chain_must("test ! -e made");
  }
  /* The name must be an identifier; the command's line ends are not printed. */
  snprintf(slab.name, sizeof slab.name, "lamp\n#error \"x\"");
  chain_write("slab.exr", &slab, 1);
  expect_refusal("slab.exr -o out.inc", 1, "is no identifier");
  expect_refusal("slab.exr -o \"$(printf 'out\\n.inc')\"", 2, "control characters");
  chain_must("\"$BAKESLAB\" include slab.exr --name a --name b "
             "-o 'l\"#.inc' --lights \"$(printf '1')\"");
  chain_must("grep -v '^//' 'l\"#.inc' | grep -F 'l\\\"#.exr'");
}

/* A lamp of saturated colours comes through LogLuv, the default, into the picture. */
TEST(test_saturated) {
  static const float colours[3][3] = {{1, 0, 0}, {0, 0, 1}, {1, 0.3F, 0}};
  for (int n = 0; n < 3; ++n) {
    make_slab();
    struct error error;
    for (size_t k = 0; k < (size_t)3 * 64 * 64; ++k) slab.rgb[k] = slab.rgb[k / 3 * 3];
    for (size_t k = 0; k < (size_t)3 * 64 * 64; ++k) slab.rgb[k] *= colours[n][k % 3];
    if (slab_file_write(chain_path("lamp.tif"), &slab, 1, SLAB_PRECISION_LOGLUV, &error) !=
        RESULT_OK)
      fail_msg("%s", error.text);
    chain_must("\"$BAKESLAB\" include lamp.tif -o lamp.inc");
    assert_true(picture_error(&slab, 1, LIT) < 0.02);
  }
}

/* The longest name that is allowed, and its capitals. */
TEST(test_name) {
  make_slab();
  chain_include(&slab, 1, "lamp", "--name a_b2_cdefghijklmnopqrstu");
  assert_true(picture_error(&slab, 1,
                            "#include \"lamp.inc\"\n"
                            "object { A_B2_Cdefghijklmnopqrstu_Canned(1, 1) }") < 5e-4);
}

/* Pictures of the scene with the lamp, shining nothing, and without it. */
static void expect_unseen(const char *scene, const char *what) {
  struct picture pictures[2];
  for (int with = 0; with < 2; ++with) {
    chain_text("scene.pov", "w", "#version 3.7;\n#include \"lamp.inc\"\n%s\n%s\n", scene,
               with ? "object { Test_Lamp_Canned(1, 0) rotate 20*x }" : "");
    chain_render(&pictures[with]);
  }
  for (int k = 0; k < 3 * CHAIN_PIXELS; ++k)
    if (!(fabsf(pictures[0].rgb[k] - pictures[1].rgb[k]) <= 1e-3F))
      fail_msg("the lamp is seen %s, value %d: %g, not %g", what, k, (double)pictures[1].rgb[k],
               (double)pictures[0].rgb[k]);
  picture_free(&pictures[0]);
  picture_free(&pictures[1]);
}

TEST(test_unseen) {
  make_lamp();
  expect_unseen("global_settings { assumed_gamma 1 } background { rgb <1, 2, 3> }\n"
                "camera { location -3*z look_at 0 }",
                "itself");
  expect_unseen("global_settings { assumed_gamma 1 } background { rgb <1, 2, 3> }\n"
                "camera { location -3*z look_at 0 }\n"
                "sphere { 0.2*z, 4 inverse pigment { rgb <1, 2, 3> }\n"
                "  finish { reflection 0.7 diffuse 0 ambient 0.1 } }",
                "in a mirror");
  expect_unseen("global_settings { assumed_gamma 1 radiosity { count 100 recursion_limit 1 } }\n"
                "background { rgb 1 } camera { location <0, 3, -3> look_at 0 }\n"
                "plane { y, -0.7 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }",
                "by radiosity");
}

/* A housing in the slab's provenance is what _Housing() draws, and _Case(), its earlier name. */
TEST(test_housing) {
  make_slab();
  struct picture picture;
  chain_include(&slab, 1, "lamp", "");
  chain_says(&slab, "#include \"lamp.inc\"\nobject { Test_Lamp_Canned_Housing() }", 1,
             "Test_Lamp_Canned_Housing");
  assert_int_equal(slab_json_set(&slab, "provenance",
                                 "{\"housing\": \"sphere { 0, 1 pigment { rgb <0, 1, 0> } "
                                 "finish { ambient 0 emission 1 diffuse 0 } }\"}",
                                 NULL),
                   RESULT_OK);
  chain_include(&slab, 1, "lamp", "");
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 1);
  static const char *const scenes[] = {
      "#include \"lamp.inc\"\nobject { Test_Lamp_Canned_Housing() }",
      "#include \"lamp.inc\"\nobject { Test_Lamp_Canned_Case() }"};
  for (int k = 0; k < 2; ++k) {
    chain_scene(&plane, 1, scenes[k]);
    chain_render(&picture);
    const float *middle = picture.rgb + 3 * (CHAIN_SIZE / 2 * CHAIN_SIZE + CHAIN_SIZE / 2);
    assert_true(middle[0] < 0.01F && middle[1] > 0.99F && middle[2] < 0.01F);
    picture_free(&picture);
  }
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
