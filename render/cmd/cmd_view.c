/* cmd_view.c - renderslab view: a mesh scene that light slabs light, in a window. */
#include <string.h>

#include "base/tiles.h"
#include "cli/cli.h"
#include "cmd/commands.h"
#include "cmd/world.h"
#include "shadow/occlusion.h"
#include "viewer/viewer_camera.h"
#include "viewer/viewer_loop.h"

enum { MAP_SIZE = 1024 }; /* of shadow maps: 16 of 16 groups are drawn in a frame or two */

struct arguments {
  struct world world;
  const char *keys;
};

enum { OPTION_KEYS = 256 };

static void check_keys(const char *keys, struct argp_state *state) {
  const char *at = keys;
  int key;
  bool shift;
  do {
    if (!viewer_key_read(&at, &key, &shift))
      argp_error(state,
                 "--keys: %s: no such key; there are characters, left, right, up, down, "
                 "pageup, pagedown, tab and esc, and shift+ before these",
                 at);
  } while (key);
}

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &arguments->world.options;
    state->child_inputs[1] = &arguments->world.view;
    return 0;
  case OPTION_KEYS:
    check_keys(value, state);
    arguments->keys = value;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static enum result run(void *input, struct error *error) {
  struct arguments *arguments = input;
  struct world *world = &arguments->world;
  const struct picture_options *view = &world->view;
  enum result result = world_load_lights(world, NULL, 0, error);
  if (result == RESULT_OK) result = world_prepare(world, 0, error);
  if (result == RESULT_OK) result = world_load_scene(world, SCENE_SURFACES, error);
  if (result == RESULT_OK) result = occlusion_create(&world->scene, &world->occlusion, error);
  if (result == RESULT_OK) {
    struct viewer_world shown = {.scene = &world->scene,
                                 .occlusion = world->occlusion,
                                 .lights = world->lights,
                                 .light_count = world->light_count,
                                 .prepared = &world->prepared,
                                 .map_size = MAP_SIZE,
                                 .threads = world->options.threads};
    const struct viewer_arguments what = {.mesh = view->mesh,
                                          .repair = world->options.repair,
                                          .lights = world->options.lights,
                                          .world = &shown};
    struct camera camera = view->camera_given ? view->camera : viewer_camera_outside(&world->scene);
    memcpy(shown.background, view->background, sizeof shown.background);
    result = viewer_loop_run(&what, &camera, view->size[0], view->size[1], arguments->keys, error);
  }
  world_free(world);
  return result;
}

static const struct argp_option options_list[] = {
    {"keys", OPTION_KEYS, "KEYS", 0,
     "Press these keys first, each once the picture is complete: characters and left, right, up, "
     "down, pageup, pagedown, tab, esc, shift+left, ..., with blanks between",
     0},
    {0}};

static const char help_text[] =
    "Shows an OBJ, glTF or PLY scene lit by light slabs in a window, by OpenGL 4.3 (the sum of "
    "--method gl of `renderslab image'). While something moves, each frame sums as many of the "
    "lights' views as it has time for; once all is still they all come in. Without --camera one "
    "looks from outside."
    "\vArrows and mouse turn the camera, or the light that Tab has chosen; v and V choose fewer or "
    "more views, d shadows, - and + the exposure; h shows all keys. s saves view-1.exr, "
    "view-2.exr, "
    "... and prints the `renderslab image' command that makes the same picture; q quits.\n\n"
    "Examples, for room.obj of share/canned/include-pov:\n"
    "  renderslab view room.obj --light 'lamp.tif at=0,190,20 toward=0,80,0'\n"
    "  renderslab view room.obj --light 'lamp.tif at=0,190,20' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' --keys 's q'";

int cmd_view(int argc, char **argv) {
  static const struct argp argp = {options_list, parse, "MESH", help_text, picture_options_children,
                                   NULL,         NULL};
  struct arguments arguments = {
      .world = {.options = {.method = GATHER_GL, .threads = tiles_processors()},
                .view = {.camera_optional = true}}};
  return cli_run(&argp, argc, argv, run, &arguments);
}
