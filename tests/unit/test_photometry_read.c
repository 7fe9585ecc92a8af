/* Photometric files as they are read: IES LM-63 of each year and EULUMDAT, their symmetries, shapes
 * and factors, against what the text says; and what is refused. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "import/photometric/eulumdat.h"
#include "import/photometric/ies.h"
#include "testing.h"

static struct warnings notes;

static struct photometry read_ies(const char *text) {
  struct photometry lamp;
  struct error error = {{0}};
  notes = (struct warnings){0};
  if (ies_read(text, strlen(text), NULL, &lamp, &notes, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return lamp;
}

static struct photometry read_ldt(const char *text) {
  struct photometry lamp;
  struct error error = {{0}};
  notes = (struct warnings){0};
  assert_true(eulumdat_is(text, strlen(text)));
  if (eulumdat_read(text, strlen(text), &lamp, &notes, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return lamp;
}

/* Intensity of a lamp towards the angles of type C, by its frame: gamma 0 is -y, C0 +x, C90 +z. */
static double at(const struct photometry *lamp, double c, double gamma) {
  double g = gamma * M_PI / 180, a = c * M_PI / 180;
  return photometry_candela(lamp, (double[3]){sin(g) * cos(a), -cos(g), sin(g) * sin(a)});
}

TEST(numbers_wrapped_anyhow_with_factors) {
  struct photometry lamp = read_ies("IESNA91\r\n[LUMINAIRE] Leuchte \xfc\r\nTILT=NONE\r\n"
                                    "2,1500 0.5\r\n3\r\n1 1 1 -2 3 0.5 0.9\r\n1.1 60\r\n"
                                    "0 90\r\n\r\n180\r\n0\r\n100,50 1e1");
  double factor = 0.5 * 0.9 * 1.1, cone = 2 * M_PI * factor;
  assert_int_equal(lamp.planes, 1);
  assert_near(at(&lamp, 77, 0), 100 * factor, 1e-9);
  assert_near(at(&lamp, 77, 45), 75 * factor, 1e-9);
  assert_near(at(&lamp, 200, 135), 30 * factor, 1e-9);
  assert_near(lamp.lumens, 3000, 0);
  assert_string_equal(lamp.label, "Leuchte \xc3\xbc");
  assert_near(lamp.size[0], 3 * 0.3048, 1e-12);
  /* The integral of (a + b gamma) sin gamma over both halves. */
  double half = M_PI / 2;
  double flux = 100 - 50 / half * 1 + (50 + 40) * 1 - 40 / half * (M_PI - 1);
  assert_near(photometry_flux(&lamp), cone * flux, 1e-9);
  photometry_free(&lamp);
}

/* Since 1995 the number behind the ballast factor tells how the file was made. */
TEST(the_third_factor_by_year) {
  static const char *const first[] = {"IESNA:LM-63-1986", "IESNA91",        "IESNA:LM-63-1995",
                                      "IESNA:LM-63-2002", "IES:LM-63-2019", "some text"};
  static const double factor[] = {1.2, 1.2, 1, 1, 1, 1.2};
  for (int n = 0; n < 6; ++n) {
    char text[200];
    snprintf(text, sizeof text, "%s\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1.2 5\n0 90\n0\n10 10\n",
             first[n]);
    struct photometry lamp = read_ies(text);
    assert_near(at(&lamp, 0, 10), 10 * factor[n], 1e-9);
    assert_true(isnan(lamp.lumens));
    photometry_free(&lamp);
  }
}

#define HEAD(planes, type)                                                                         \
  "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 " planes " " type " 2 0 0 0 1 1 1\n"

TEST(symmetries_of_type_c) {
  struct photometry lamp = read_ies(HEAD("2", "1") "0 90 0 90 1 2 1 4"); /* both */
  assert_near(at(&lamp, 135, 90), 3, 1e-9);
  assert_near(at(&lamp, 225, 90), 3, 1e-9);
  assert_near(at(&lamp, 270, 90), 4, 1e-9);
  photometry_free(&lamp);
  lamp = read_ies(HEAD("3", "1") "0 90 0 90 180 1 2 1 4 1 6"); /* about C0-C180 */
  assert_near(at(&lamp, 270, 90), 4, 1e-9);
  assert_near(at(&lamp, 225, 90), 5, 1e-9);
  photometry_free(&lamp);
  lamp = read_ies(HEAD("3", "1") "0 90 90 180 270 1 2 1 4 1 6"); /* about C90-C270 */
  assert_near(at(&lamp, 0, 90), 4, 1e-9);
  assert_near(at(&lamp, 45, 90), 3, 1e-9);
  assert_near(at(&lamp, 315, 90), 5, 1e-9);
  photometry_free(&lamp);
  lamp = read_ies(HEAD("4", "1") "0 90 0 90 180 270 1 2 1 4 1 6 1 8"); /* 360 left out */
  assert_near(at(&lamp, 315, 90), 5, 1e-9);
  photometry_free(&lamp);
  lamp = read_ies(HEAD("4", "1") "0 90 0 90 180 180 1 2 1 4 1 6 9 9"); /* the last one twice */
  assert_near(at(&lamp, 180, 90), 6, 1e-9);
  assert_int_equal(notes.count, 1);
  photometry_free(&lamp);
}

/* Type B: V turns about a horizontal axis, so that all V are one at H = 90; type A: H turns about
 * the vertical. Both are mirrored where they begin at 0. */
TEST(types_b_and_a) {
  struct photometry lamp = read_ies(HEAD("2", "2") "0 90 0 90 8 2 1 1");
  assert_near(photometry_candela(&lamp, (double[3]){0, -1, 0}), 8, 1e-9);
  assert_near(photometry_candela(&lamp, (double[3]){1, 0, 0}), 2, 1e-9);
  assert_near(photometry_candela(&lamp, (double[3]){-1, 0, 0}), 2, 1e-9);
  assert_near(photometry_candela(&lamp, (double[3]){0, 0, 1}), 1, 1e-9);
  assert_near(photometry_candela(&lamp, (double[3]){0, 1, 0}), 0, 1e-9);
  photometry_free(&lamp);
  lamp = read_ies(HEAD("3", "2") "-90 90 -90 0 90 1 1 1 1 1 1"); /* 1 cd over a half sphere */
  assert_near(photometry_flux(&lamp), 2 * M_PI, 1e-9);
  photometry_free(&lamp);
  lamp = read_ies(HEAD("3", "3") "-90 90 -90 0 90 1 1 1 1 1 5");
  assert_near(photometry_candela(&lamp, (double[3]){1, 0, 0}), 1, 1e-9);
  assert_near(photometry_candela(&lamp, (double[3]){0, 0, -1}), 3, 1e-9); /* H = 90, clockwise */
  assert_near(photometry_candela(&lamp, (double[3]){0, 0, 1}), 1, 1e-9);
  photometry_free(&lamp);
}

TEST(shapes_of_openings) {
  static const struct {
    const char *year, *says; /* width, length, height */
    enum photometry_shape shape;
    int axis;
    double size[3];
  } rows[] = {{"1995", "0 0 0", PHOTOMETRY_POINT, 0, {0, 0, 0}},
              {"1995", "1 2 0", PHOTOMETRY_BOX, 0, {2, 0, 1}},
              {"2002", "1 2 3", PHOTOMETRY_BOX, 0, {2, 3, 1}},
              {"1995", "-1 0 0", PHOTOMETRY_CYLINDER, 1, {1, 0, 1}},
              {"2002", "-1 -1 0", PHOTOMETRY_CYLINDER, 1, {1, 0, 1}},
              {"2002", "-1 -2 3", PHOTOMETRY_CYLINDER, 1, {2, 3, 1}},
              {"1995", "-1 2 3", PHOTOMETRY_CYLINDER, 1, {2, 3, 1}},
              {"1995", "-1 0 -1", PHOTOMETRY_ELLIPSOID, 0, {1, 1, 1}},
              {"2002", "-1 0 -2", PHOTOMETRY_CYLINDER, 0, {0, 2, 1}},
              {"2002", "-1 -2 -3", PHOTOMETRY_ELLIPSOID, 0, {2, 3, 1}},
              {"1995", "-1 2 -3", PHOTOMETRY_ELLIPSOID, 0, {2, 3, 1}},
              {"2002", "-1 2 -3", PHOTOMETRY_CYLINDER, 0, {2, 3, 1}},
              {"1995", "0 2 -3", PHOTOMETRY_CYLINDER, 0, {2, 3, 3}},
              {"1995", "2 0 -3", PHOTOMETRY_CYLINDER, 2, {3, 3, 2}}};
  for (size_t n = 0; n < sizeof rows / sizeof *rows; ++n) {
    char text[200];
    snprintf(text, sizeof text,
             "IESNA:LM-63-%s\nTILT=NONE\n1 -1 1 2 1 1 2 %s 1 1 5\n0 90\n0\n1 1\n", rows[n].year,
             rows[n].says);
    struct photometry lamp = read_ies(text);
    assert_int_equal(lamp.shape, rows[n].shape);
    if (lamp.shape == PHOTOMETRY_CYLINDER) assert_int_equal(lamp.axis, rows[n].axis);
    for (int k = 0; k < 3; ++k) assert_near(lamp.size[k], rows[n].size[k], 1e-12);
    photometry_free(&lamp);
  }
}

TEST(tilt) {
  struct photometry lamp = read_ies("IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n0.9 0.8 0.7\n"
                                    "1 -1 1 2 1 1 2 0 0 0 1 1 5\n0 90\n0\n10 10\n");
  assert_near(at(&lamp, 0, 10), 9, 1e-9);
  assert_non_null(strstr(notes.lines[0], "tilted"));
  photometry_free(&lamp);
}

#define LDT(symmetry, planes, length, width, heights, lamps)                                       \
  "Maker\r\n1\r\n" symmetry "\r\n" planes "\r\n90\r\n2\r\n90\r\nreport\r\nName\r\n\r\n\r\n\r\n"    \
  "600\r\n600\r\n50\r\n" length "\r\n" width "\r\n" heights                                        \
  "\r\n100\r\n80,5\r\n2,0\r\n0\r\n" lamps
#define ONE_SET "1\r\n1\r\nLED\r\n500\r\n840\r\n80\r\n7\r\n"
#define RATIOS "0\r\n0\r\n0\r\n0\r\n0\r\n0\r\n0\r\n0\r\n0\r\n0\r\n"

TEST(eulumdat_and_its_symmetries) {
  struct photometry lamp =
      read_ldt(LDT("4", "4", "1200", "100", "0\r\n50\r\n0\r\n40", ONE_SET) RATIOS
               "0\r\n90\r\n180\r\n270\r\n0\r\n90\r\n100,5\r\n2\r\n100,5\r\n4\r\n\x1a");
  assert_near(at(&lamp, 0, 0), 100.5, 1e-9); /* 500 lm, factor 2 */
  assert_near(at(&lamp, 225, 90), 3, 1e-9);
  assert_int_equal(lamp.shape, PHOTOMETRY_BOX);
  assert_near(lamp.size[2], 1.2, 1e-12); /* length along C90 */
  assert_near(lamp.size[0], 0.1, 1e-12);
  assert_near(lamp.size[1], 0.05, 1e-12);
  assert_near(lamp.side[3], 0.04, 1e-12);
  assert_near(lamp.lumens, 500, 0);
  photometry_free(&lamp);
  lamp = read_ldt(LDT("3", "4", "200", "0", "0\r\n0\r\n0\r\n0", ONE_SET) RATIOS
                  "0\r\n90\r\n180\r\n270\r\n0\r\n90\r\n1\r\n8\r\n1\r\n6\r\n1\r\n2\r\n");
  assert_near(at(&lamp, 270, 90), 8, 1e-9); /* C270, C0, C90 */
  assert_near(at(&lamp, 0, 90), 6, 1e-9);
  assert_near(at(&lamp, 180, 90), 6, 1e-9);
  assert_near(at(&lamp, 135, 90), 4, 1e-9);
  assert_int_equal(lamp.shape, PHOTOMETRY_CYLINDER);
  photometry_free(&lamp);
  lamp = read_ldt(LDT("2", "4", "0", "0", "0\r\n0\r\n0\r\n0", ONE_SET) RATIOS
                  "0\r\n90\r\n180\r\n270\r\n0\r\n90\r\n1\r\n2\r\n1\r\n4\r\n1\r\n6\r\n");
  assert_near(at(&lamp, 270, 90), 4, 1e-9);
  assert_int_equal(lamp.shape, PHOTOMETRY_POINT);
  photometry_free(&lamp);
}

/* Sets of lamps are alternatives; a negative number of lamps says that all was measured at once. */
TEST(eulumdat_sets) {
  struct photometry lamp = read_ldt(
      LDT("1", "1", "0", "0", "0\r\n0\r\n0\r\n0",
          "2\r\n-1\r\nLED\r\n1000\r\n840\r\n80\r\n7\r\n1\r\nLED\r\n2000\r\n840\r\n80\r\n7\r\n")
          RATIOS "0\r\n0\r\n90\r\n10\r\n20\r\n");
  assert_near(at(&lamp, 0, 0), 20, 1e-9);
  assert_true(isnan(lamp.lumens));
  assert_non_null(strstr(notes.lines[0], "2 sets"));
  photometry_free(&lamp);
}

static void refuses(const char *text, const char *piece) {
  struct photometry lamp = {0};
  struct error error = {{0}};
  bool ies = ies_is(text, strlen(text));
  enum result result = ies ? ies_read(text, strlen(text), NULL, &lamp, &notes, &error)
                           : eulumdat_read(text, strlen(text), &lamp, &notes, &error);
  if (result != RESULT_BAD || !strstr(error.text, piece) || !strstr(error.text, "line "))
    fail_msg("\"%s\" does not say \"%s\"", error.text, piece);
  photometry_free(&lamp);
}

TEST(what_is_refused) {
  refuses("IESNA91\n[A] b\n", "TILT=");
  refuses("IESNA91\nTILT=NONE\n1 -1 1", "cut off");
  refuses("IESNA91\nTILT=lamp.tlt\n1 -1 1", "lamp.tlt cannot be read");
  refuses("IESNA91\nTILT=INCLUDE\n1 2 0 0 1 1\n", "ascend");
  refuses(HEAD("1", "4") "0 90 0 1 1", "from 1 to 3");
  refuses(HEAD("0", "1") "0 90 0 1 1", "horizontal angles is 0");
  refuses(HEAD("-1", "1") "0 90 0 1 1", "horizontal angles is -1");
  refuses(HEAD("1e9", "1") "0 90 0 1 1", "horizontal angles is 1e+09");
  refuses(HEAD("9999", "1") "0 90 0 1 1", "too short");
  refuses(HEAD("1", "1") "90 0 0 1 1", "ascend");
  refuses(HEAD("1", "1") "0 190 0 1 1", "190 degrees");
  refuses(HEAD("2", "1") "0 90 0 100 1 1 1 1", "fit no symmetry");
  refuses(HEAD("1", "1") "0 90 0 1 nan", "\"nan\" is no finite number");
  refuses(HEAD("1", "1") "0 90 0 1 1e999", "no finite number");
  refuses(HEAD("1", "1") "0 90 0 1", "cut off");
  refuses(HEAD("1", "1") "0 90 0 1 1 1", "1 numbers too many");
  refuses("IESNA91\nTILT=NONE\n1 -1 0 2 1 1 2 0 0 0 1 1 5\n0 90 0 1 1", "multiplier is 0");
  refuses(LDT("3", "6", "0", "0", "0\r\n0\r\n0\r\n0", ONE_SET) RATIOS, "multiple of 4");
  refuses(LDT("1", "1", "0", "0", "0\r\n0\r\n0\r\n0", "1\r\n1\r\nLED\r\n0\r\n\r\n\r\n\r\n") RATIOS,
          "no luminous flux");
  refuses(LDT("1", "1", "-5", "0", "0\r\n0\r\n0\r\n0", ONE_SET), "opening's length is -5");
  refuses(LDT("1", "1", "0", "0", "0\r\n0\r\n0\r\n0", ONE_SET) RATIOS "0\r\n0\r\n90\r\n1\r\n",
          "cut off");
  refuses("Maker\n1\n0\n", "cut off");
}

int main(void) {
  return testing_run(NULL, NULL);
}
