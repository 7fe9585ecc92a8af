/* test_face.c - what a camera sees of the lit lamp, by @_Canned_Face: pictures of POV-Ray against
 * the radiance of each pixel's ray, by the look-up of oracle/. Near and far, grazing, turned,
 * mirrored and scaled; both kinds of st plane; several openings, and pages that share one; in
 * colour, before a background. That it changes no light, and what the macro refuses. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "chain.h"

enum { PAGES = 2 };

/* Where the camera is, what it sees, and how the lamp is placed. */
struct sight {
  const char *name;
  double eye[3]; /* from the first page's centre along u, v and the normal, in its |u| */
  double wide;   /* of the picture, on the plane of the first page, in its edges */
  double scale;  /* of the lamp */
  double matrix[12];
};

static const struct sight sights[] = {
    {"before it", {0.3, -0.2, 1.4}, 1.2, 1, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}},
    {"near", {0.21, 0.13, 0.09}, 1.2, 1, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}},
    {"far", {31, 12, 80}, 1.5, 2.5, {0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1, 3, -20, 7}},
    {"grazing", {1.6, 0.5, 0.3}, 2.8, 1, {0, 0.6, 0.8, 1, 0, 0, 0, 0.8, -0.6, 0.2, 0.3, -5}},
    {"mirrored", {0.7, 0.4, 2}, 1.5, 0.3, {-0.6, 0.8, 0, 0.8, 0.6, 0, 0, 0, 1, -1, 2, 0.5}}};

enum { SIGHTS = sizeof sights / sizeof *sights };

static const double background[3] = {2, 0.5, 7};
static const double edges[2] = {1.3, 0.9}, window[4] = {-1.2, 1.7, -2, 1.4};

/* Two openings at right angles, or two pages of one, of which the second is a row of views. */
static void make_pages(struct slab pages[PAGES], double distance, int mirrored, bool shared) {
  static const double narrow[4] = {-0.4, 0.9, -1, 0.7};
  pages[0] = chain_slab((const int[4]){4, 5, 6, 9}, edges, window, distance, mirrored, 3);
  pages[1] = chain_slab((const int[4]){3, 1, 7, 5}, edges, shared ? narrow : window,
                        shared ? INFINITY : distance, mirrored, 3);
  if (shared) return;
  for (int c = 0; c < 3; ++c) {
    double u = pages[0].u[c], along = edges[0] * pages[0].normal[c];
    pages[1].center[c] += (u - along) / 2;
    pages[1].u[c] = along;
    pages[1].normal[c] = u / edges[0];
  }
}

/* What comes through a page to the eye, against `direction`, all in lamp space. */
static void add_ray(const struct slab *page, const double eye[3], const double direction[3],
                    double rgb[3]) {
  double abst[4], seen[3], off[3], along = chain_dot(direction, page->normal);
  for (int c = 0; c < 3; ++c) off[c] = eye[c] - page->center[c];
  double away = -chain_dot(off, page->normal) / along;
  if (!(along < 0 && away > 0)) return;
  for (int axis = 0; axis < 2; ++axis) {
    const double *edge = axis ? page->v : page->u;
    double length = chain_length(edge), slope = chain_dot(direction, edge) / length / along;
    abst[axis] = (chain_dot(off, edge) + away * chain_dot(direction, edge)) / length;
    abst[2 + axis] = slope + abst[axis] / page->st_distance;
  }
  oracle_lookup(page, abst, seen);
  for (int c = 0; c < 3; ++c) rgb[c] += seen[c];
}

static void find_eye(const struct slab *page, const double along[3], double eye[3]) {
  for (int c = 0; c < 3; ++c)
    eye[c] = page->center[c] + along[0] * page->u[c] + along[1] * edges[0] / edges[1] * page->v[c] +
             along[2] * edges[0] * page->normal[c];
}

/* The picture is a window on the first page's plane, so its pixels' rays are known at once. */
static double picture_error(const struct slab pages[PAGES], const struct sight *sight) {
  static double expected[3 * CHAIN_PIXELS];
  const double *m = sight->matrix, gain[3] = {2, 0.5, 1};
  double eye[3], toward[3], vectors[4][3];
  struct picture picture;
  find_eye(&pages[0], sight->eye, eye);
  for (int c = 0; c < 3; ++c) toward[c] = pages[0].center[c] - eye[c];
  chain_move(m, sight->scale, eye, 1, vectors[0]);
  chain_move(m, 1, toward, 0, vectors[1]);
  chain_move(m, sight->wide, pages[0].u, 0, vectors[2]);
  chain_move(m, sight->wide, pages[0].v, 0, vectors[3]);
  chain_text("scene.pov", "w",
             "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#include \"lamp.inc\"\n"
             "background { rgb <%g, %g, %g> }\n",
             background[0], background[1], background[2]);
  static const char *const names[4] = {"camera { location", "direction", "right", "up"};
  for (int k = 0; k < 4; ++k)
    chain_text("scene.pov", "a", "%s <%.17g, %.17g, %.17g>%s\n", names[k], vectors[k][0],
               vectors[k][1], vectors[k][2], k == 3 ? " }" : "");
  chain_text("scene.pov", "a",
             "object { Test_Lamp_Canned_Face(%.17g, rgb <%g, %g, %g>, %.17g*<%.17g, %.17g, %.17g>)"
             "\n  matrix <%.17g, %.17g, %.17g, %.17g, %.17g, %.17g, %.17g, %.17g, %.17g, %.17g, "
             "%.17g, %.17g> }\n",
             sight->scale, gain[0], gain[1], gain[2], sight->scale, eye[0], eye[1], eye[2], m[0],
             m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]);
  for (int pixel = 0; pixel < CHAIN_PIXELS; ++pixel) {
    double x = (pixel % CHAIN_SIZE + 0.5) / CHAIN_SIZE - 0.5, rgb[3] = {0}, direction[3];
    double y = 0.5 - (pixel / CHAIN_SIZE + 0.5) / CHAIN_SIZE;
    for (int c = 0; c < 3; ++c)
      direction[c] = toward[c] + sight->wide * (x * pages[0].u[c] + y * pages[0].v[c]);
    for (int p = 0; p < PAGES; ++p) add_ray(&pages[p], eye, direction, rgb);
    for (int c = 0; c < 3; ++c) expected[3 * pixel + c] = gain[c] * rgb[c] + background[c];
  }
  chain_render(&picture);
  double error = chain_rmse(&picture, expected);
  picture_free(&picture);
  return error;
}

static void look(double distance, int mirrored, bool shared) {
  struct slab pages[PAGES];
  make_pages(pages, distance, mirrored, shared);
  chain_include(pages, PAGES, "lamp", "");
  for (int k = 0; k < SIGHTS; ++k) {
    double error = picture_error(pages, &sights[k]);
    print_message("# %s, st plane at %g: %.2g\n", sights[k].name, distance, error);
    if (!(error < 5e-4)) fail_msg("%s: %g", sights[k].name, error);
  }
  for (int p = 0; p < PAGES; ++p) slab_free(&pages[p]);
}

TEST(test_openings_at_right_angles) {
  look(INFINITY, 0, false);
}

TEST(test_pages_of_one_opening) {
  look(0.8, 1, true);
}

/* An eye on the st plane sees each view at one slope. */
TEST(test_eye_on_the_st_plane) {
  static const struct sight sight = {"", {0.2, 0.1, 0.5}, 1.2, 1, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  struct slab pages[PAGES];
  make_pages(pages, 0.5 * edges[0], 0, true);
  chain_include(pages, PAGES, "lamp", "");
  double error = picture_error(pages, &sight);
  if (!(error < 5e-4)) fail_msg("%g", error);
  for (int p = 0; p < PAGES; ++p) slab_free(&pages[p]);
}

/* The camera looks at the plane through the lamp, whose face is not seen from behind. */
TEST(test_light_stays) {
  struct slab slab = chain_slab((const int[4]){4, 4, 8, 8}, edges, window, INFINITY, 0, 5);
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 2);
  double eye[3];
  char sdl[512];
  find_eye(&slab, (const double[3]){0.2, 0.3, 1.5}, eye);
  snprintf(sdl, sizeof sdl,
           CHAIN_LIT("1, 1") "\nobject { Test_Lamp_Canned_Face(1, 1, <%.17g, %.17g, %.17g>) }",
           eye[0], eye[1], eye[2]);
  chain_include(&slab, 1, "lamp", "");
  assert_true(chain_error(&lamp, 1, &plane, 1, sdl) < 5e-4);
  slab_free(&slab);
}

TEST(test_refusals) {
  struct slab slab = chain_slab((const int[4]){2, 2, 4, 4}, edges, window, INFINITY, 0, 5);
  static const struct {
    double along[3];
    const char *arguments, *says;
  } bad[] = {{{0.1, 0.1, -1}, "1, 1", "Test_Lamp_Canned_Face: the eye is behind the lamp"},
             {{3, 0.1, 0}, "1, 1", "Test_Lamp_Canned_Face: the eye is behind the lamp"},
             {{0.1, 0.1, 0}, "1, 1", "Test_Lamp_Canned_Face: the eye is in the lamp's opening"},
             {{0, 0, 1}, "0, 1", "Test_Lamp_Canned_Face: Scale is 0.0000, must be positive"},
             {{0, 0, 1}, "<1, 2, 1>, 1", "Test_Lamp_Canned_Face: Scale must be one number"},
             {{0, 0, 1}, "1, 1e34", "Test_Lamp_Canned_Face: too bright for POV-Ray's colours"}};
  chain_include(&slab, 1, "lamp", "");
  for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
    double eye[3];
    char sdl[512];
    find_eye(&slab, bad[k].along, eye);
    snprintf(sdl, sizeof sdl,
             "#include \"lamp.inc\"\nobject { Test_Lamp_Canned_Face(%s, <%.17g, %.17g, %.17g>) }",
             bad[k].arguments, eye[0], eye[1], eye[2]);
    chain_says(&slab, sdl, 1, bad[k].says);
  }
  /* A number is an eye, too: here one before the lamp. */
  chain_says(&slab, "#include \"lamp.inc\"\nobject { Test_Lamp_Canned_Face(1, 1, 0) }", 0, "");
  slab_free(&slab);
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
