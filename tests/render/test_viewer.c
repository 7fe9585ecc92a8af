/* test_viewer.c - the viewer's picture, without a window: surfaces that are drawn against camera
 * rays, lamps that are seen, views that are added in shares, lights that move. */
#include <epoxy/gl.h>
#include <string.h>

#include "base/vector.h"
#include "helpers.h"
#include "picture/image.h"
#include "shadow/occlusion.h"
#include "viewer/viewer_picture.h"

enum { WIDTH = 90, HEIGHT = 70, QUADS = 6, LIGHTS = 3 };
enum { FLOOR, PAINTED, GLOSSY, GLOWING, BLACK, MATERIALS };

static struct {
  struct gl_context *context;
  struct scene scene;
  double position[4 * QUADS][3], normal[4 * QUADS][3], uv[4 * QUADS][2];
  int corners[2 * QUADS][3], material[2 * QUADS];
  struct scene_material materials[MATERIALS];
  struct scene_texture texture;
  float texels[12];
  struct light lights[LIGHTS];
  struct gather_prepared prepared;
  struct occlusion *occlusion;
  struct viewer_world world;
} all;

static const struct camera camera = {
    .from = {0.4, 1.7, -3.2}, .at = {0.1, 0.5, 0}, .up = {0.1, 1, 0}, .fov = 55};
static const struct viewer_sum whole = {.groups = 2};

/* x + a e0 + b e1 for a, b in 0..1, with normals that spread out from its middle by `bend`. */
static void add_quad(int material, const double x[3], const double edge[2][3], double bend) {
  struct scene *scene = &all.scene;
  double normal[3];
  vector_cross(edge[0], edge[1], normal);
  vector_normalise(normal);
  for (int k = 0; k < 4; ++k) {
    double side[2] = {k & 1, k >> 1}; /* NOLINT(bugprone-narrowing-conversions) */
    size_t v = scene->vertices + (size_t)k;
    for (int c = 0; c < 3; ++c) {
      all.position[v][c] = x[c] + side[0] * edge[0][c] + side[1] * edge[1][c];
      all.normal[v][c] =
          normal[c] + bend * ((side[0] - 0.5) * edge[0][c] + (side[1] - 0.5) * edge[1][c]);
    }
    vector_normalise(all.normal[v]);
    for (int c = 0; c < 2; ++c) all.uv[v][c] = 2.3 * side[c] - 0.4;
  }
  for (int t = 0; t < 2; ++t) {
    static const int corners[2][3] = {{0, 1, 3}, {0, 3, 2}};
    for (int k = 0; k < 3; ++k)
      all.corners[scene->triangles][k] = (int)scene->vertices + corners[t][k];
    all.material[scene->triangles++] = material;
  }
  scene->vertices += 4;
}

static void make_scene(void) {
  static const struct scene_material materials[MATERIALS] = {
      {"floor", {0.8, 0.7, 0.6}, {0}, 0, {0}, -1},
      {"painted", {0.9, 0.8, 0.7}, {0}, 0, {0}, 0},
      {"glossy", {0.2, 0.3, 0.1}, {0.5, 0.6, 0.7}, 30, {0}, -1},
      {"glowing", {0.1, 0.1, 0.1}, {0}, 0, {0.02, 0.03, 0.01}, -1},
      {"black", {0}, {0}, 0, {0}, -1}};
  static const double sides[][2][3] = {{{4, 0, 0}, {0, 0, 4}},
                                       {{1, 0, 0.4}, {0, 1, 0.3}},
                                       {{0.9, 0.1, -0.3}, {-0.1, 0.8, 0.5}},
                                       {{0.3, 0, 0}, {0, 0.2, 0.1}}};
  memcpy(all.materials, materials, sizeof materials);
  for (int k = 0; k < 12; ++k) all.texels[k] = (float)((k * 7) % 12) / 12;
  all.texture =
      (struct scene_texture){.path = "texture", .picture = {2, 2, all.texels, NULL, NULL}};
  all.scene = (struct scene){.position = all.position,
                             .normal = all.normal,
                             .uv = all.uv,
                             .corners = all.corners,
                             .material = all.material,
                             .material_count = MATERIALS,
                             .texture_count = 1,
                             .materials = all.materials,
                             .textures = &all.texture};
  add_quad(FLOOR, (const double[]){-2, 0, -2}, sides[0], 0);
  add_quad(PAINTED, (const double[]){-1.3, 0.1, 0.2}, sides[1], 0);
  add_quad(GLOSSY, (const double[]){0.3, 0.1, -0.2}, sides[2], 0.4);
  add_quad(GLOWING, (const double[]){-0.3, 0.2, -0.9}, sides[3], 0);
  add_quad(BLACK, (const double[]){0.2, 0.2, -0.9}, sides[3], 0);
  add_quad(FLOOR, (const double[]){-0.5, 1.1, 0.4}, sides[3], 0);
}

/* A lamp of one page of random samples that shines along `normal`; u is along x. */
static void make_light(int number, const int samples[SLAB_AXES], const double normal[3],
                       const double at[3]) {
  static const double window[4] = {-1.6, 1.5, -1.6, 1.5};
  struct slab slab = rough_slab(samples, number == 0 ? 2 : INFINITY, window, FRAME_PLAIN,
                                FILL_UNIFORM, (uint64_t)number + 5);
  slab.u[0] = 0.5;
  memcpy(slab.normal, normal, sizeof slab.normal);
  vector_cross(normal, slab.u, slab.v);
  /* One view is black. */
  for (int l = 0; number == 0 && l < samples[SLAB_T]; ++l)
    memset(slab_at(&slab, 1, 2, 0, l), 0, 3 * (size_t)samples[SLAB_S] * sizeof(float));
  struct light *light = &all.lights[number];
  *light = load_light(&slab, 1);
  slab_free(&slab);
  for (int c = 0; c < 3; ++c) light->gain[c] = number == 2 ? 0.1 : 8;
  double matrix[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {at[0], at[1], at[2]}};
  assert_true(light_move(light, matrix));
}

static int make_all(void **state) {
  (void)state;
  struct error error;
  static const int samples[LIGHTS][SLAB_AXES] = {{6, 5, 8, 7}, {1, 1, 5, 5}, {2, 3, 4, 4}};
  make_scene();
  make_light(0, samples[0], (const double[]){0, -1, 0}, (const double[]){0.1, 2, 0.3});
  make_light(1, samples[1], (const double[]){0, 0, 1}, (const double[]){-0.2, 0.8, -1.8});
  make_light(2, samples[2], (const double[]){0, 0, -1}, (const double[]){0.3, 0.7, 0.3});
  if (gather_prepare(all.lights, LIGHTS, GATHER_GL, 1, 1, &all.prepared, &error) != RESULT_OK)
    return 1;
  if (occlusion_create(&all.scene, &all.occlusion, &error) != RESULT_OK) return 1;
  all.world = (struct viewer_world){.scene = &all.scene,
                                    .occlusion = all.occlusion,
                                    .lights = all.lights,
                                    .light_count = LIGHTS,
                                    .prepared = &all.prepared,
                                    .background = {0.01, 0.02, 0.03},
                                    .map_size = 256,
                                    .threads = 2};
  if (gl_context_create(&all.context, &error) == RESULT_OK) return 0;
  print_error("%s\n", error.text); /* set-up brings an OpenGL that needs no GPU */
  return 1;
}

static int free_all(void **state) {
  (void)state;
  gl_context_free(all.context);
  occlusion_free(all.occlusion);
  gather_prepared_free(&all.prepared);
  for (int k = 0; k < LIGHTS; ++k) light_free(&all.lights[k]);
  return 0;
}

static void make_picture(const struct viewer_sum *how, struct viewer_picture *picture) {
  struct error error = {{0}};
  if (viewer_picture_create(&all.world, how, WIDTH, HEIGHT, picture, &error) != RESULT_OK)
    fail_msg("%s", error.text);
}

/* The picture, its views added in so many shares. */
static struct picture take(struct viewer_picture *picture, int shares) {
  struct error error;
  struct picture taken;
  viewer_picture_start(picture, &camera);
  for (int k = 0; k < shares; ++k)
    assert_int_equal(viewer_picture_add(picture, 1.0 / shares + 1e-9, &error), RESULT_OK);
  assert_true(picture->done == 1);
  assert_int_equal(gl_show_read(&picture->show, &taken, &error), RESULT_OK);
  return taken;
}

/* The same by a new picture and a new hierarchy, made for the lights where they now are. */
static struct picture take_anew(const struct viewer_sum *how) {
  struct error error;
  struct gather_prepared prepared = {0};
  struct viewer_world world = all.world;
  struct viewer_picture picture;
  world.prepared = &prepared;
  assert_int_equal(gather_prepare(all.lights, LIGHTS, GATHER_GL, 1, 1, &prepared, &error),
                   RESULT_OK);
  assert_int_equal(viewer_picture_create(&world, how, WIDTH, HEIGHT, &picture, &error), RESULT_OK);
  struct picture taken = take(&picture, 1);
  viewer_picture_free(&picture);
  gather_prepared_free(&prepared);
  return taken;
}

/* By camera rays and sums of the CPU. */
static struct picture trace(enum gather_method method, bool shadows) {
  struct error error = {{0}};
  struct picture picture;
  struct image_report report;
  struct image_settings settings = {.shade = {.scene = &all.scene,
                                              .occlusion = all.occlusion,
                                              .lights = all.lights,
                                              .light_count = LIGHTS,
                                              .camera = camera,
                                              .width = WIDTH,
                                              .height = HEIGHT},
                                    .gather = {.lights = all.lights,
                                               .light_count = LIGHTS,
                                               .method = method,
                                               .tolerance = 0.003,
                                               .occlusion = shadows ? all.occlusion : NULL,
                                               .shadow_grid = 16,
                                               .shadow_edge = 256},
                                    .samples = 1,
                                    .threads = 2};
  memcpy(settings.shade.background, all.world.background, sizeof all.world.background);
  assert_int_equal(image_render(&settings, &picture, &report, &error), RESULT_OK);
  return picture;
}

/* Relative RMS of a - b, but for pixels that differ by more than `limit` of b's largest value;
 * *off of these. */
static double differ(const struct picture *a, const struct picture *b, double limit, int *off) {
  double sum = 0, square = 0, most = 0;
  *off = 0;
  for (int k = 0; k < 3 * WIDTH * HEIGHT; ++k) most = fmax(most, (double)b->rgb[k]);
  for (int pixel = 0; pixel < WIDTH * HEIGHT; ++pixel) {
    double here = 0, worst = 0;
    for (int k = 3 * pixel; k < 3 * pixel + 3; ++k) {
      double x = (double)a->rgb[k] - (double)b->rgb[k];
      worst = fmax(worst, fabs(x));
      here += x * x;
      square += (double)b->rgb[k] * (double)b->rgb[k];
    }
    if (worst > limit * most)
      ++*off;
    else
      sum += here;
  }
  return sqrt(sum / square);
}

static void expect_same(struct picture a, struct picture b, double tolerance, int most) {
  int off;
  double error = differ(&a, &b, most > 0 ? 0.005 : INFINITY, &off);
  print_message("# relative RMS %.2g, %d pixels elsewhere\n", error, off);
  assert_true(error <= tolerance);
  assert_true(off <= most);
  picture_free(&a);
  picture_free(&b);
}

/* Right way round, highlights, textures, what glows, the background, the lamp that is seen and
 * the one that is hidden; edges are rounded to 1/256 pixel. */
TEST(shows_what_camera_rays_see) {
  struct viewer_picture picture;
  make_picture(&whole, &picture);
  expect_same(take(&picture, 1), trace(GATHER_VIEWS, false), 3e-4, 4);
  assert_true(picture.lamps.any);
  viewer_picture_free(&picture);
}

/* In 1, 7 and 100 shares, of pages with 29 views, 1 and 6; with and without shadows, with maps
 * that are kept and too many to be. */
TEST(all_shares_are_the_whole) {
  static const struct viewer_sum sums[] = {{0, false, 2}, {0, true, 2}, {0, true, 0}, {1, true, 2}};
  for (int k = 0; k < 5; ++k) {
    struct viewer_picture picture;
    all.world.map_size = k == 4 ? 8192 : 256;
    make_picture(&sums[k % 4], &picture);
    if (sums[k % 4].shadows) assert_true(picture.sum.kept == (k < 4));
    expect_same(take(&picture, 7), take(&picture, 1), 3e-6, 0);
    if (k < 4) expect_same(take(&picture, 100), take(&picture, 1), 3e-6, 0);
    viewer_picture_free(&picture);
  }
  all.world.map_size = 256;
}

/* The estimate from a part is unbiased for each page: after a third of the views, that of one
 * view is all there, and the error is about what the picture says. */
TEST(a_part_estimates_the_whole) {
  struct error error;
  struct picture part, full;
  struct viewer_picture picture;
  int off;
  make_picture(&whole, &picture);
  assert_int_equal(picture.views, 29 + 1 + 6);
  assert_int_equal(picture.black, 1);
  for (int share = 16; share >= 2; share /= 2) {
    viewer_picture_start(&picture, &camera);
    assert_int_equal(viewer_picture_add(&picture, 0.5 / share, &error), RESULT_OK);
    assert_int_equal(viewer_picture_add(&picture, 0.5 / share, &error), RESULT_OK);
    double change = picture.change, error_told = picture.error;
    assert_int_equal(gl_show_read(&picture.show, &part, &error), RESULT_OK);
    full = take(&picture, 1);
    double off_by = differ(&part, &full, INFINITY, &off);
    print_message("# 1/%d of the views: %.3f off, told %.3f and %.3f\n", share, off_by, change,
                  error_told);
    assert_true(off_by < 0.5 && change < 4 * off_by && change > off_by / 4);
    assert_true(share == 16 ? isinf(error_told) : fabs(error_told / off_by - 1) < 0.2);
    picture_free(&part);
    picture_free(&full);
  }
  viewer_picture_free(&picture);
}

/* Of views and of coarse shadow maps; against the reference, at all pixels. Pixels at edges of
 * surfaces, which differ from those of camera rays, are in both. */
TEST(the_error_counts_shadows) {
  static const struct viewer_sum sums[] = {{0, false, 1}, {0, true, 1}, {2, true, 1}};
  for (int k = 0; k < 3; ++k) {
    struct viewer_picture picture;
    struct error error;
    int off;
    make_picture(&sums[k], &picture);
    struct picture shown = take(&picture, 1);
    struct picture exact = trace(GATHER_REFERENCE, sums[k].shadows);
    assert_true(isinf(picture.exact));
    for (int row = 0; row < VIEWER_PICTURE_ROWS; ++row)
      assert_int_equal(viewer_picture_check(&picture, &error), RESULT_OK);
    double right = differ(&shown, &exact, INFINITY, &off);
    print_message("# %.4f off, told %.4f, against all views %.4f\n", right, picture.exact,
                  picture.error);
    assert_true(picture.exact > right / 2 && picture.exact < 2 * right);
    picture_free(&shown);
    picture_free(&exact);
    viewer_picture_free(&picture);
  }
}

/* Turned, moved and seen from elsewhere, then back; the shadow maps go along. */
TEST(lights_move) {
  static const struct viewer_sum sum = {.level = 1, .shadows = true, .groups = 2};
  static const double turned[4][3] = {{0.8, 0, 0.6}, {0, 1, 0}, {-0.6, 0, 0.8}, {0.4, 1.7, -0.3}};
  double before[4][3];
  struct viewer_picture picture;
  make_picture(&sum, &picture);
  memcpy(before, all.lights[0].matrix, sizeof before);
  struct picture still = take(&picture, 1);
  assert_true(viewer_picture_move(&picture, 0, turned));
  struct picture moved = take(&picture, 1);
  uint64_t drawn = picture.sum.maps.drawn;
  picture_free(&still);
  still = take(&picture, 3);
  assert_int_equal(picture.sum.maps.drawn, drawn);
  picture_free(&still);
  expect_same(moved, take_anew(&sum), 3e-6, 0);
  assert_true(viewer_picture_move(&picture, 0, before));
  assert_int_equal(picture.sum.maps.drawn, drawn);
  still = take(&picture, 1);
  assert_int_equal(picture.sum.maps.drawn, drawn + 4);
  expect_same(still, take_anew(&sum), 3e-6, 0);
  const double nowhere[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {INFINITY, 0, 0}};
  assert_false(viewer_picture_move(&picture, 0, nowhere));
  expect_same(take(&picture, 1), take(&picture, 2), 3e-6, 0);
  viewer_picture_free(&picture);
}

/* A page with the whole scene behind it is skipped. */
TEST(pages_behind_are_skipped) {
  static const double away[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -0.5, 0}};
  struct viewer_picture picture;
  double before[4][3];
  memcpy(before, all.lights[0].matrix, sizeof before);
  make_picture(&whole, &picture);
  assert_int_equal(picture.behind, 0);
  assert_true(viewer_picture_move(&picture, 0, away));
  assert_int_equal(picture.behind, 29);
  uint64_t views = picture.sum.views;
  expect_same(take(&picture, 1), trace(GATHER_VIEWS, false), 3e-4, 4);
  assert_int_equal(picture.sum.views - views, 7);
  assert_true(viewer_picture_move(&picture, 0, before));
  viewer_picture_free(&picture);
}

/* Upright, by the curve of sRGB, with words where they were written. */
TEST(is_put_on_the_screen) {
  static unsigned char words[WIDTH * HEIGHT];
  static float pixels[HEIGHT][WIDTH][4];
  const double white = 0.3;
  struct viewer_picture picture;
  unsigned target, texture;
  make_picture(&whole, &picture);
  struct picture linear = take(&picture, 1);
  texture = gl_receivers_texture(WIDTH, HEIGHT);
  glGenFramebuffers(1, &target);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0);
  words[3 * WIDTH + 5] = 255;
  words[4 * WIDTH + 5] = 1;
  gl_show_screen(&picture.show, white, words, target);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_FLOAT, pixels);
  for (int k = 0; k < WIDTH * HEIGHT; ++k)
    for (int c = 0; c < 3; ++c) {
      double x = fmin((double)linear.rgb[3 * k + c] / white, 1);
      double srgb = x > 0.0031308 ? 1.055 * pow(x, 1 / 2.4) - 0.055 : 12.92 * x;
      if (words[k]) srgb = words[k] == 255 ? 1 : 0.4 * srgb;
      assert_true(fabs((double)pixels[HEIGHT - 1 - k / WIDTH][k % WIDTH][c] - srgb) < 1e-3);
    }
  picture_free(&linear);
  glDeleteFramebuffers(1, &target);
  glDeleteTextures(1, &texture);
  viewer_picture_free(&picture);
}

int main(void) {
  return testing_run(make_all, free_all);
}
