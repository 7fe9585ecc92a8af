/* test_energy.c - the light of a lamp whose flux is known, wherever the project takes it:
 * baked, converted, summed by each method of renderslab, and in POV-Ray's pictures. Those
 * sum the irradiance on a closed box that stands on the aperture. Prints the table of
 * RESULTS.md. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"
#include "oracle/lambert.h"

/* A glowing rectangle deep in a black box, seen through its opening; its light fades out
 * within the window. */
static const double opening[2] = {10, 8}, glow[2] = {8, 6}, depth = 10, window = 1;
static const double radiance[3] = {50, 35, 20};

static const char lamp[] =
    "#version 3.7;\n#include \"canned.inc\"\n"
    "Canned_Lamp(\"test_lamp\")\nCanned_Needs(\"\")\nCanned_Metres_Per_Unit(0.01)\n"
    "Canned_Slab(<3, 20, -5>, 10*x, 8*z, -y, <-1, 1, -1, 1>, 0)\n"
    "box { <-4, 10, -3>, <4, 11, 3> translate <3, 20, -5>\n"
    "  pigment { rgb 1 } finish { emission rgb <50, 35, 20> diffuse 0 } }\n";

/* What the opening gets from the glow: the exchange of two parallel rectangles. */
static double known_flux(void) {
  double to[4], from[4];
  assert_true((opening[0] + glow[0]) / 2 / depth <= window);
  for (int k = 0; k < 4; ++k) {
    to[k] = opening[k / 2] * (k % 2 - 0.5);
    from[k] = glow[k / 2] * (k % 2 - 0.5);
  }
  return lambert_exchange(to, from, depth);
}

/* The lid and the walls of the box, seen from inside; 12 below the opening, 16 wide. */
enum { FACES = 5 };
static const double low[3] = {-5, 8, -13}, high[3] = {11, 20, 3};

static struct chain_plane face_of(int number) {
  static const int axes[FACES] = {1, 0, 0, 2, 2}, ends[FACES] = {0, 0, 1, 0, 1};
  int axis = axes[number], across = (axis + 1) % 3, down = (axis + 2) % 3;
  struct chain_plane face = {{0}, {0}, {0}, {0}};
  for (int c = 0; c < 3; ++c) face.center[c] = (low[c] + high[c]) / 2;
  face.center[axis] = ends[number] ? high[axis] : low[axis];
  face.normal[axis] = ends[number] ? -1 : 1;
  face.across[across] = high[across] - low[across];
  face.down[down] = high[down] - low[down];
  return face;
}

/* ---- Fluxes: red, green, blue ---- */

static void flux_of_slab(const char *name, double flux[3]) {
  struct error error;
  struct slab *slabs;
  int count;
  if (slab_file_load_all(chain_path(name), &slabs, &count, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  assert_int_equal(count, 1);
  slab_flux(slabs, flux, NULL);
  slab_file_free_all(slabs, count);
}

static void write_receivers(void) {
  FILE *file = fopen(chain_path("receivers"), "w");
  assert_non_null(file);
  for (int number = 0; number < FACES; ++number) {
    struct chain_plane face = face_of(number);
    for (int k = 0; k < CHAIN_PIXELS; ++k) {
      double at[3];
      chain_pixel(&face, CHAIN_SIZE, k, at);
      fprintf(file, "%.17g %.17g %.17g %g %g %g\n", at[0], at[1], at[2], face.normal[0],
              face.normal[1], face.normal[2]);
    }
  }
  assert_int_equal(fclose(file), 0);
}

static void flux_by_method(const char *method, double flux[3]) {
  chain_must(
      "\"$RENDERSLAB\" irradiance -q --light \"lamp.exr $BRIGHT\" --method %s <receivers >sums",
      method);
  FILE *file = fopen(chain_path("sums"), "r");
  assert_non_null(file);
  flux[0] = flux[1] = flux[2] = 0;
  for (int number = 0; number < FACES; ++number) {
    struct chain_plane face = face_of(number);
    double area = chain_length(face.across) * chain_length(face.down) / CHAIN_PIXELS, rgb[3];
    for (int k = 0; k < CHAIN_PIXELS; ++k) {
      assert_int_equal(fscanf(file, "%lf %lf %lf", &rgb[0], &rgb[1], &rgb[2]), 3);
      for (int c = 0; c < 3; ++c) flux[c] += area * rgb[c];
    }
  }
  fclose(file);
}

/* A white wall shows E/pi. */
static void flux_by_povray(const char *sdl, double flux[3]) {
  flux[0] = flux[1] = flux[2] = 0;
  for (int number = 0; number < FACES; ++number) {
    struct chain_plane face = face_of(number);
    double area = chain_length(face.across) * chain_length(face.down) / CHAIN_PIXELS;
    struct picture picture;
    chain_scene(&face, 1, sdl);
    chain_render(&picture);
    for (int k = 0; k < 3 * CHAIN_PIXELS; ++k) flux[k % 3] += M_PI * area * (double)picture.rgb[k];
    picture_free(&picture);
  }
}

/* ---- The table ---- */

/* One line: the worst of the channels, in %, and what is allowed. */
static void expect(const char *what, const double flux[3], const double right[3], double most) {
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    double off = flux[c] / right[c] - 1;
    if (isnan(off) || fabs(off) > fabs(worst)) worst = off; /* NaN stays */
  }
  print_message("# | %-44s | %+8.3f | %5g |\n", what, 100 * worst, most);
  if (!(fabs(100 * worst) <= most)) fail_msg("%s: %g %% off", what, 100 * worst);
}

TEST(test_bake) {
  double right[3], flux[3], known = known_flux();
  chain_text("lamp.pov", "w", "%s", lamp);
  chain_must("\"$BAKESLAB\" bake lamp.pov -o lamp.exr -q --uv 8x8 --st 24x24 --jobs 1");
  for (int c = 0; c < 3; ++c) right[c] = radiance[c] * known;
  flux_of_slab("lamp.exr", flux);
  expect("bake, against the closed form", flux, right, 0.4);
}

TEST(test_convert) {
  static const struct {
    const char *what, *file, *options;
    double most;
  } rows[] = {
      {"convert to float", "c.exr", "", 0},
      {"convert to half", "c.exr", "--precision half", 0.01},
      {"convert to LogLuv", "c.tif", "", 0.1},
      {"convert to 4x4 positions", "c.exr", "--uv 4x4", 0.001},
      {"convert to 16x16 positions", "c.exr", "--uv 16x16", 0.001},
      {"convert to 12x12 directions", "c.exr", "--st 12x12", 1.5},
      {"convert to 48x48 directions", "c.exr", "--st 48x48", 0.2},
  };
  double right[3], flux[3];
  flux_of_slab("lamp.exr", right);
  for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
    chain_must("\"$BAKESLAB\" convert lamp.exr -o %s %s", rows[k].file, rows[k].options);
    flux_of_slab(rows[k].file, flux);
    expect(rows[k].what, flux, right, rows[k].most);
  }
}

TEST(test_methods) {
  static const struct {
    const char *method;
    double most;
  } rows[] = {
      {"reference", 0.05},   {"closed", 0.05}, {"midpoint", 0.15}, {"pi", 0.15},
      {"paper", 0.1},        {"views", 0.05},  {"levels", 0.1},    {"levels --level 2", 0.1},
      {"paper-levels", 0.1}, {"cut", 0.1},     {"auto", 0.1},      {"gl", 0.05},
      {"gl --level 1", 0.1}};
  double right[3], flux[3];
  flux_of_slab("lamp.exr", right);
  write_receivers();
  for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
    char what[64];
    snprintf(what, sizeof what, "on the box, --method %s", rows[k].method);
    flux_by_method(rows[k].method, flux);
    expect(what, flux, right, rows[k].most);
  }
}

static double luminance(const double rgb[3]) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/* What 800 lumens make of the flux of a lamp in centimetres. */
static double by_lumens(const double flux[3]) {
  return 800 / (1e-4 * luminance(flux));
}

TEST(test_lumens) {
  double right[3], flux[3];
  flux_of_slab("lamp.exr", right);
  assert_int_equal(setenv("BRIGHT", "lumens=800", 1), 0);
  flux_by_method("cut", flux);
  unsetenv("BRIGHT");
  double factor = by_lumens(right);
  for (int c = 0; c < 3; ++c) right[c] *= factor;
  expect("on the box, lumens=800", flux, right, 0.1);
}

TEST(test_povray) {
  static const struct {
    const char *what, *options, *declare, *macro;
    double most;
  } rows[] = {
      {"in POV-Ray, sheet of 8x8 lights", "", "", "Canned(1, 1)", 0.05},
      {"in POV-Ray, sheet of 2x2 lights, 800 lumens", "", "#declare Test_Lamp_Lights = 2;\n",
       "Canned_Lumens(1, 800)", 0.1},
      {"in POV-Ray, cluster of 8 lights, 800 lumens", "--mode cluster --lights 8", "",
       "Canned_Lumens(1, 800)", 0.5},
      {"in POV-Ray, far field, 800 lumens", "--mode point", "", "Canned_Lumens(1, 800)", 0.1},
  };
  double plain[3], flux[3];
  flux_of_slab("lamp.exr", plain);
  for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
    double factor = strstr(rows[k].macro, "Lumens") ? by_lumens(plain) : 1;
    const double right[3] = {plain[0] * factor, plain[1] * factor, plain[2] * factor};
    char sdl[256];
    chain_must("cp lamp.exr slab.exr && \"$BAKESLAB\" include slab.exr -o light.inc %s",
               rows[k].options);
    snprintf(sdl, sizeof sdl, "%s#include \"light.inc\"\nobject { Test_Lamp_%s }\n",
             rows[k].declare, rows[k].macro);
    flux_by_povray(sdl, flux);
    expect(rows[k].what, flux, right, rows[k].most);
  }
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
