/* test_viewer_state.c - what keys and mouse do to the viewer's state; the words on its picture. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "microlight/levels.h"
#include "testing.h"
#include "viewer/viewer_camera.h"
#include "viewer/viewer_command.h"
#include "viewer/viewer_state.h"
#include "viewer/viewer_text.h"

static const struct camera camera = {
    .from = {1, 3, -4}, .at = {0.5, 0.7, 1}, .up = {0.2, 2, 0.1}, .fov = 50};

/* Two lights of a page each, off the origin of their lamps; three levels. */
static struct light_page pages[2];
static struct light lights[2] = {
    {.path = "a lamp.tif", .count = 1, .pages = &pages[0], .gain = {2, 2, 2}, .scale = 1},
    {.path = "b.tif", .count = 1, .pages = &pages[1], .gain = {1, 0.5, 0.25}, .scale = 2}};
static struct levels levels[2] = {{.count = 3}, {.count = 1}};
static struct gather_prepared prepared = {.pages = 2, .levels = levels};
static struct viewer_world world = {
    .lights = lights, .light_count = 2, .prepared = &prepared, .map_size = 512};

static struct viewer_state start(void) {
  static const double first[4][3] = {{0, 2, 0}, {-2, 0, 0}, {0, 0, 2}, {1, 2, 3}};
  struct viewer_state state;
  struct error error;
  memcpy(lights[1].matrix, first, sizeof first);
  for (int c = 0; c < 3; ++c) lights[0].matrix[c][c] = 1;
  pages[0].slab.center[1] = 0.3;
  pages[1].slab.center[0] = -0.7;
  assert_int_equal(viewer_state_create(&world, &camera, &state, &error), RESULT_OK);
  return state;
}

/* Presses keys as --keys names them. */
static void press(struct viewer_state *state, const char *keys) {
  int key;
  bool shift;
  while (viewer_key_read(&keys, &key, &shift) && key) viewer_state_key(state, key, shift);
  assert_int_equal(*keys, 0);
}

/* Where a point is on the screen: to the right, upwards, and its depth. */
static void project(const struct camera *by, const double point[3], double on[3]) {
  double axes[3][3], offset[3];
  camera_axes(by, axes[2], axes[0], axes[1]);
  vector_subtract(point, by->from, offset);
  for (int k = 0; k < 3; ++k) on[k] = vector_dot(offset, axes[k]);
  for (int k = 0; k < 2; ++k) on[k] /= on[2];
}

static void assert_close(double a, double b) {
  if (!(fabs(a - b) <= 1e-12 * (1 + fabs(b)))) fail_msg("%.17g is not %.17g", a, b);
}

/* The scene turns and moves as the mouse does, the camera as the arrows say; what it looks at
 * stays in the middle, at its distance. */
TEST(the_camera_turns) {
  struct viewer_state state = start();
  double nearer[3], before[3], after[3];
  for (int c = 0; c < 3; ++c) nearer[c] = 0.8 * camera.at[c] + 0.2 * camera.from[c];
  project(&camera, nearer, before);
  assert_close(before[0], 0);
  viewer_state_drag(&state, 0.1, 0.05, false);
  project(&state.camera, nearer, after);
  assert_true(after[0] > 0 && after[1] < 0);
  assert_close(viewer_camera_distance(&state.camera), viewer_camera_distance(&camera));
  press(&state, "r right up");
  project(&camera, state.camera.from, after);
  assert_true(after[2] * after[0] > 0 && after[2] * after[1] > 0);
  for (int k = 0; k < 71; ++k) press(&state, "right");
  press(&state, "down");
  for (int c = 0; c < 3; ++c) assert_close(state.camera.from[c], camera.from[c]);
  for (int k = 0; k < 60; ++k) press(&state, "up");
  project(&state.camera, camera.at, after); /* steep, and still a camera */
  assert_true(fabs(after[0]) < 1e-9 && fabs(after[1]) < 1e-9 && after[2] > 4);
  viewer_state_free(&state);
}

TEST(the_camera_moves) {
  struct viewer_state state = start();
  double on[3], distance = viewer_camera_distance(&camera);
  viewer_state_drag(&state, 0.25, -0.1, true);
  project(&state.camera, camera.at, on); /* it has followed the mouse: tangents of the picture */
  assert_close(on[0], 0.25 * 2 * tan(camera.fov * M_PI / 360));
  assert_close(on[1], 0.1 * 2 * tan(camera.fov * M_PI / 360));
  press(&state, "r shift+right shift+up");
  project(&state.camera, camera.at, on);
  assert_close(on[0], -0.05);
  assert_close(on[1], -0.05);
  press(&state, "r pageup");
  assert_close(viewer_camera_distance(&state.camera), distance / 1.1);
  viewer_state_scroll(&state, -2);
  assert_close(viewer_camera_distance(&state.camera), distance * 1.1);
  viewer_state_free(&state);
}

static void find_pivot(const struct viewer_light *light, double point[3]) {
  for (int c = 0; c < 3; ++c) {
    point[c] = light->matrix[3][c];
    for (int row = 0; row < 3; ++row) point[c] += light->pivot[row] * light->matrix[row][c];
  }
}

/* The image of the lamp's axis number `row`. */
static void find_axis(const struct viewer_light *light, int row, double axis[3]) {
  memcpy(axis, light->matrix[row], 3 * sizeof *axis);
}

TEST(lights_move_and_turn) {
  struct viewer_state state = start();
  struct viewer_light *light = &state.lights[1];
  double before[3], after[3], axes[3][3], up[3], moved[3];
  double step = 0.05 * viewer_camera_distance(&camera);
  camera_axes(&camera, axes[2], axes[0], axes[1]);
  memcpy(up, camera.up, sizeof up);
  vector_normalise(up);
  find_pivot(light, before);
  press(&state, "2 right pageup pageup");
  find_pivot(light, after);
  for (int c = 0; c < 3; ++c) assert_close(after[c] - before[c], step * (axes[0][c] + 2 * up[c]));
  press(&state, "r up");
  find_pivot(light, after);
  vector_subtract(after, before, moved); /* away, and level */
  assert_close(vector_length(moved), step);
  assert_close(vector_dot(moved, up), 0);
  assert_true(vector_dot(moved, axes[2]) > 0);
  assert_memory_equal(&state.camera, &camera, sizeof camera);
  /* Turned to the right: what points away points more to the right. */
  static const char *const turns[] = {"r shift+right", "r shift+up", "r shift+pageup"};
  for (int k = 0; k < 3; ++k) {
    double level[3], first[3], turned[3], across[3];
    for (int c = 0; c < 3; ++c) level[c] = axes[2][c] - vector_dot(axes[2], up) * up[c];
    vector_normalise(level);
    const double *p = k < 2 ? level : axes[0], *q = k ? up : axes[0];
    press(&state, turns[k]);
    find_pivot(light, after);
    vector_cross(p, q, across);
    for (int c = 0; c < 3; ++c) assert_close(after[c], before[c]);
    for (int row = 0; row < 3; ++row) {
      memcpy(first, light->first[row], sizeof first);
      find_axis(light, row, turned);
      double angle = M_PI / 36, a = vector_dot(first, p), b = vector_dot(first, q);
      assert_close(vector_dot(turned, p), a * cos(angle) - b * sin(angle));
      assert_close(vector_dot(turned, q), a * sin(angle) + b * cos(angle));
      assert_close(vector_dot(turned, across), vector_dot(first, across));
    }
  }
  viewer_state_drag(&state, 0.1, 0, true);
  find_pivot(light, after);
  vector_subtract(after, before, moved);
  assert_close(vector_dot(moved, axes[0]),
               0.2 * tan(camera.fov * M_PI / 360) * viewer_camera_distance(&camera));
  press(&state, "r");
  assert_memory_equal(light->matrix, light->first, sizeof light->first);
  assert_memory_equal(state.lights[0].matrix, lights[0].matrix, sizeof lights[0].matrix);
  viewer_state_free(&state);
}

TEST(letters_choose) {
  struct viewer_state state = start();
  press(&state, "tab");
  assert_int_equal(state.selected, 1);
  press(&state, "tab tab shift+tab");
  assert_int_equal(state.selected, 2);
  press(&state, "3 9");
  assert_int_equal(state.selected, 2);
  press(&state, "0 v v v v v");
  assert_int_equal(state.selected, 0);
  assert_int_equal(state.sum.level, 3);
  press(&state, "V V V V V v d");
  assert_int_equal(state.sum.level, 1);
  assert_false(state.sum.shadows);
  for (int k = 0; k < 9; ++k) press(&state, "g");
  assert_int_equal(state.sum.groups, 1);
  press(&state, "G G G G d");
  assert_int_equal(state.sum.groups, 16);
  press(&state, "G G");
  assert_int_equal(state.sum.groups, 0);
  press(&state, "g");
  assert_int_equal(state.sum.groups, 16);
  state.exposure = 2;
  press(&state, "- - - - + h t x");
  assert_true(fabs(state.exposure - 2 * pow(2, 0.75)) < 1e-9);
  assert_true(state.help && !state.text && state.sum.shadows && !state.save && !state.quit);
  press(&state, "e s");
  assert_true(state.exposure == 0 && state.save && !state.quit);
  press(&state, "esc");
  assert_true(state.quit);
  viewer_state_free(&state);
}

TEST(what_is_no_key_is_told) {
  static const char *const wrong[] = {"lefft", "left shift+q", " shift+", "pageupp", "h leftright"};
  for (int k = 0; k < 5; ++k) {
    const char *at = wrong[k];
    int key = 1;
    bool shift, good = true;
    while (good && key) good = viewer_key_read(&at, &key, &shift);
    assert_false(good);
  }
}

/* In steps of a tenth, never below 0; those of the chosen light, or of the first. */
TEST(channels_are_dimmed) {
  static const char *texts[] = {"a.tif", "b.tif gain.warm=0.5"};
  static const struct light_channel channels[2] = {{"warm", 0.5}, {"cold", 1}};
  struct viewer_arguments arguments = {.mesh = "m.obj", .lights = texts, .world = &world};
  memcpy(lights[1].channels, channels, sizeof channels);
  lights[1].channel_count = 2;
  struct viewer_state state = start();
  press(&state, "c [ ]"); /* the first light has none */
  char *command = viewer_command(&arguments, &state, 30, 20, "out.exr");
  assert_non_null(strstr(command, "--light 'b.tif gain.warm=0.5' --camera"));
  free(command);
  press(&state, "2 ] ] ]");
  assert_close(state.lights[1].gains[0], 0.8);
  press(&state, "c ] c c [");
  assert_close(state.lights[1].gains[0], 0.8);
  assert_close(state.lights[1].gains[1], 1);
  for (int k = 0; k < 12; ++k) press(&state, "[");
  assert_true(state.lights[1].gains[1] == 0);
  for (int n = 0; n < 2; ++n) lights[1].channels[n].gain = state.lights[1].gains[n];
  command = viewer_command(&arguments, &state, 30, 20, "out.exr");
  assert_non_null(strstr(command, " gain=1,0.5,0.25 gain.warm=0.8 gain.cold=0' --camera"));
  free(command);
  press(&state, "r");
  assert_true(state.lights[1].gains[0] == 0.5 && state.lights[1].gains[1] == 1);
  viewer_state_free(&state);
  lights[1].channel_count = 0;
}

/* What has not moved is told as it was given; shells see one word a word. */
TEST(the_command_is_complete) {
  static const char *texts[] = {"a lamp.tif at=0,0,0 gain=2", "b.tif matrix=..."};
  struct viewer_state state = start();
  struct viewer_arguments arguments = {
      .mesh = "it's.obj", .repair = true, .lights = texts, .world = &world};
  press(&state, "2 pageup 0 v v d");
  world.background[1] = -0.5;
  char *command = viewer_command(&arguments, &state, 30, 20, "out.exr");
  assert_non_null(command);
  assert_non_null(strstr(command, "renderslab image 'it'\\''s.obj' "
                                  "--light 'a lamp.tif at=0,0,0 gain=2' "
                                  "--light 'b.tif matrix="));
  assert_non_null(strstr(command,
                         "gain=1,0.5,0.25' --camera 'from=1,3,-4 at=0.5,0.7,1 up=0.2,2,0.1 fov=50' "
                         "--method gl --level 2 --no-shadows --size 30x20 "
                         "--background=0,-0.5,0 --repair -o out.exr"));
  free(command);
  press(&state, "r V V d G");
  world.background[1] = 0;
  command = viewer_command(&arguments, &state, 30, 20, "out.exr");
  assert_non_null(command);
  assert_non_null(strstr(command, "--light 'b.tif matrix=...' --camera"));
  assert_non_null(strstr(command, " --method gl --shadow-map 512 --shadow-groups 8 --size"));
  free(command);
  viewer_state_free(&state);
}

/* An I is a column of 7 dots with 2 x 3 of serifs less one; what has no room is cut off. */
TEST(letters_have_their_dots) {
  struct viewer_text text;
  struct error error;
  assert_int_equal(viewer_text_create(640, 480, &text, &error), RESULT_OK);
  viewer_text_line(&text, 0, "I");
  int dots = 0, ground = 0, low = 640, high = 0;
  for (int k = 0; k < 640 * 480; ++k) {
    dots += text.pixels[k] == 255;
    ground += text.pixels[k] == 1;
    if (text.pixels[k] == 255 && k % 640 < low) low = k % 640;
    if (text.pixels[k] == 255 && k % 640 > high) high = k % 640;
  }
  assert_int_equal(dots, 4 * 11);
  assert_int_equal(high - low, 2 * 3 - 1);
  assert_int_equal(ground, 4 * (7 * 9 - 11));
  viewer_text_line(&text, 25,
                   "a line that is much longer than what the picture has room for, by far");
  viewer_text_line(&text, 26, "below");
  viewer_text_line(&text, 1000, "nowhere");
  viewer_text_clear(&text);
  viewer_text_line(&text, 2, "\x01\xff");
  for (int k = 0; k < 640 * 480; ++k) assert_int_not_equal(text.pixels[k], 255);
  viewer_text_free(&text);
}

int main(void) {
  return testing_run(NULL, NULL);
}
