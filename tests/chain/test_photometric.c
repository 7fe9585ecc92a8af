/* test_photometric.c - POV-Ray lit by the includes of photometric files: intensities in 200
 * directions, seen from 100 openings away, against the file's own numbers.
 *
 * The table is a function of the test's, rounded as the file has it; what it means in between is
 * bilinear in the two angles of its type (LM-63-2002, section 3). Shares no code with the reader.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"

enum { DIRECTIONS = 200, MOST_ANGLES = 40 };

/* Of the lamp: in centimetres, since small sheets are refused. */
static const double scale = 100;

/* A lamp by type and angles; its sizes are as the file has them. */
struct lamp {
  const char *what;
  int type; /* 1: C, 2: B, 3: A */
  int planes, rows;
  double first[2], step[2]; /* of planes, of rows, degrees */
  const char *size;         /* width, length, height, m */
  double width;             /* of the opening: its longest edge, m */
  double sharpness;         /* of the lobe */
  double at_end;            /* cd, added: what the table ends with */
  double candela[MOST_ANGLES][MOST_ANGLES];
};

/* Unit vector of a plane's and a row's angle in lamp space. */
static void direction_of(int type, double plane, double row, double d[3]) {
  double p = plane * M_PI / 180, r = row * M_PI / 180;
  const double all[3][3] = {{sin(r) * cos(p), -cos(r), sin(r) * sin(p)},
                            {cos(p) * sin(r), -cos(p) * cos(r), -sin(p)},
                            {cos(r) * cos(p), sin(r), -cos(r) * sin(p)}};
  memcpy(d, all[type - 1], sizeof all[0]);
}

static void angles_of(int type, const double d[3], double *plane, double *row) {
  const double degrees = 180 / M_PI;
  if (type == 1) {
    *plane = fmod(atan2(d[2], d[0]) * degrees + 360, 360);
    *row = acos(-d[1]) * degrees;
  } else if (type == 2) {
    *plane = -asin(d[2]) * degrees;
    *row = atan2(d[0], -d[1]) * degrees;
  } else {
    *plane = atan2(-d[2], d[0]) * degrees;
    *row = asin(d[1]) * degrees;
  }
}

/* A lobe off the axis over a wide rest that fades towards the table's ends. */
static void fill(struct lamp *lamp) {
  static const double tops[3][3] = {{0.3, -0.9, 0.31}, {0.3, -0.9, 0.31}, {0.9, 0.3, -0.31}};
  const double *top = tops[lamp->type - 1];
  bool c = lamp->type == 1;
  for (int p = 0; p < lamp->planes; ++p)
    for (int r = 0; r < lamp->rows; ++r) {
      double plane = lamp->first[0] + p * lamp->step[0], row = lamp->first[1] + r * lamp->step[1];
      double fades = c ? 1 - (double)r / (lamp->rows - 1)
                       : cos(plane * M_PI / 180) * cos(row * M_PI / 180),
             d[3];
      direction_of(lamp->type, c && r == 0 ? 0 : p == lamp->planes - 1 && c ? 0 : plane, row, d);
      double lobe = pow((1 + chain_dot(d, top)) / 2, lamp->sharpness);
      lamp->candela[p][r] = round(fades * (1000 * lobe + 100 + 90 * d[2]) + lamp->at_end);
    }
}

/* The file, of which the numbers are half as large as its multiplier makes them. */
static void write_ies(const struct lamp *lamp) {
  chain_text("lamp.ies", "w",
             "IESNA:LM-63-2002\r\n[TEST] none\r\nTILT=NONE\r\n1 1000 2 %d %d %d 2 %s\r\n1 1 10\r\n",
             lamp->rows, lamp->planes, lamp->type, lamp->size);
  for (int r = 0; r < lamp->rows; ++r)
    chain_text("lamp.ies", "a", "%g\r\n", lamp->first[1] + r * lamp->step[1]);
  for (int p = 0; p < lamp->planes; ++p)
    chain_text("lamp.ies", "a", "%g ", lamp->first[0] + p * lamp->step[0]);
  for (int p = 0; p < lamp->planes; ++p)
    for (int r = 0; r < lamp->rows; ++r)
      chain_text("lamp.ies", "a", "%s%g", r % 10 ? " " : "\r\n", lamp->candela[p][r] / 2);
  chain_text("lamp.ies", "a", "\r\n");
}

/* What the table says of a direction. */
static double candela(const struct lamp *lamp, const double d[3]) {
  double at[2];
  int cell[2], counts[2] = {lamp->planes, lamp->rows};
  angles_of(lamp->type, d, &at[0], &at[1]);
  for (int k = 0; k < 2; ++k) {
    at[k] = (at[k] - lamp->first[k]) / lamp->step[k];
    if (!(at[k] >= 0 && at[k] <= counts[k] - 1)) return 0;
    cell[k] = (int)at[k] < counts[k] - 1 ? (int)at[k] : counts[k] - 2;
    at[k] -= cell[k];
  }
  const double *low = &lamp->candela[cell[0]][cell[1]],
               *high = &lamp->candela[cell[0] + 1][cell[1]];
  return (1 - at[0]) * ((1 - at[1]) * low[0] + at[1] * low[1]) +
         at[0] * ((1 - at[1]) * high[0] + at[1] * high[1]);
}

static void cross(const double a[3], const double b[3], double out[3]) {
  for (int c = 0; c < 3; ++c)
    out[c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
}

/* A triangle around `middle`, whose normal is that direction, by the left hand. */
static void put_triangle(FILE *out, const double middle[3], double size) {
  const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
  double a[3], b[3];
  cross(middle, fabs(middle[0]) < fabs(middle[1]) ? x : y, a);
  cross(a, middle, b);
  fputs("triangle {", out);
  for (int k = 0; k < 3; ++k) {
    double p = size * cos(2 * M_PI * k / 3) / chain_length(a);
    double q = size * sin(2 * M_PI * k / 3) / chain_length(b);
    fprintf(out, "%s <%.12g, %.12g, %.12g>", k ? "," : "", middle[0] + p * a[0] + q * b[0],
            middle[1] + p * a[1] + q * b[1], middle[2] + p * a[2] + q * b[2]);
  }
  fputs(" }\n", out);
}

/* The inside of a white sphere around the lamp, which one ray of a mesh_camera towards each
 * direction sees: from the middle of a triangle, along its normal. */
static void write_scene(double directions[DIRECTIONS][3], double radius) {
  FILE *out = fopen(chain_path("scene.pov"), "w");
  assert_non_null(out);
  fprintf(out,
          "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#include \"lamp.inc\"\n"
          "object { Lamp_Canned(%g, 1) }\n"
          "sphere { 0, %.9g pigment { rgb 1 } finish { diffuse 1 ambient 0 } }\n"
          "camera { mesh_camera { 1 0 mesh {\n",
          scale, radius);
  for (int n = 0; n < DIRECTIONS; ++n) {
    double middle[3];
    for (int c = 0; c < 3; ++c) middle[c] = 0.9 * radius * directions[n][c];
    put_triangle(out, middle, 0.001 * radius);
  }
  fputs("} } location 0 direction z }\n", out);
  assert_int_equal(fclose(out), 0);
}

struct errors {
  double most, of_95,
      rms; /* of the largest intensity of the directions: at most, of 95 % of them */
};

static int compare_numbers(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Makes lamp.inc from lamp.ies by these options, and compares. */
static struct errors compare(const struct lamp *lamp, const char *options) {
  static double directions[DIRECTIONS][3];
  double off[DIRECTIONS], largest = 0, radius = 100 * scale * lamp->width;
  struct errors errors = {0, 0, 0};
  struct picture picture;
  struct error error;
  uint64_t seed = 7;
  for (int n = 0; n < DIRECTIONS; ++n) random_direction(&seed, directions[n]);
  chain_must("\"$BAKESLAB\" include lamp.ies -o lamp.inc %s", options);
  write_scene(directions, radius);
  chain_must("povray +Iscene.pov +Oframe.exr +FE -A +WT1 -D +W%d +H1", DIRECTIONS);
  if (slab_exr_read(chain_path("frame.exr"), &picture, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  for (int n = 0; n < DIRECTIONS; ++n) {
    double is = candela(lamp, directions[n]);
    off[n] = fabs((double)picture.rgb[3 * n + 1] * M_PI * pow(radius / scale, 2) - is);
    largest = fmax(largest, is);
    errors.rms += off[n] * off[n] / DIRECTIONS;
  }
  picture_free(&picture);
  qsort(off, DIRECTIONS, sizeof *off, compare_numbers);
  errors = (struct errors){off[DIRECTIONS - 1] / largest, off[DIRECTIONS * 95 / 100] / largest,
                           sqrt(errors.rms) / largest};
  print_message("%-40s %-24s 95 %% within %.2g %%, all within %.2g %%, RMS %.2g %%\n", lamp->what,
                options, 100 * errors.of_95, 100 * errors.most, 100 * errors.rms);
  return errors;
}

/* A wide lobe and a narrow one; openings of each shape; tables that end with light. */
static struct lamp lamps[] = {
    {"rectangle", 1, 25, 19, {0, 0}, {15, 5}, ".3 .6 0", 0.6, 8, 0, {{0}}},
    {"disc", 1, 13, 10, {0, 0}, {30, 10}, "-.2 -.2 0", 0.2, 30, 0, {{0}}},
    {"box, to 180 degrees", 1, 19, 37, {0, 0}, {20, 5}, ".1 .2 .05", 0.2, 4, 0, {{0}}},
    {"point", 1, 25, 37, {0, 0}, {15, 5}, "0 0 0", 0.1, 8, 0, {{0}}},
    {"cylinder", 1, 19, 37, {0, 0}, {20, 5}, "-.1 -.1 .2", 0.2, 4, 0, {{0}}},
    {"type B, to its end", 2, 19, 19, {-90, -90}, {10, 10}, ".2 .3 0", 0.3, 12, 5, {{0}}},
    {"type A", 3, 19, 19, {-90, -90}, {10, 10}, ".1 .1 .1", 0.1, 12, 0, {{0}}},
};
enum { LAMPS = sizeof lamps / sizeof *lamps, SHEETS = 5 };

/* The image is the table, but for the rounding of half floats, 2^-12, there and in POV-Ray's
 * picture. */
TEST(test_point) {
  for (int n = 0; n < LAMPS; ++n) {
    fill(&lamps[n]);
    write_ies(&lamps[n]);
    struct errors errors = compare(&lamps[n], "--mode point");
    assert_true(errors.most < 1e-3);
  }
}

/* Of the slabs that the files become, whose directions have cells. */
TEST(test_sheet) {
  for (int n = 0; n < SHEETS; ++n) {
    fill(&lamps[n]);
    write_ies(&lamps[n]);
    struct errors errors = compare(&lamps[n], "");
    assert_true(errors.of_95 < 0.02 && errors.most < 0.05);
  }
}

/* Fitted by solid angle. */
TEST(test_cluster) {
  fill(&lamps[0]);
  write_ies(&lamps[0]);
  struct errors errors = compare(&lamps[0], "--mode cluster --distance 100");
  assert_true(errors.of_95 < 0.02 && errors.most < 0.05);
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
