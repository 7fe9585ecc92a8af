/* cmd_view.c - renderslab view: a mesh scene that light slabs light, in a window. */
#include <math.h>
#include <string.h>

#include "base/tiles.h"
#include "cli/cli.h"
#include "cmd/commands.h"
#include "cmd/options.h"
#include "cmd/picture_options.h"
#include "viewer/viewer_camera.h"
#include "viewer/viewer_loop.h"

enum { MAP_SIZE = 1024 }; /* of shadow maps: 16 of 16 groups are drawn in a frame or two */

struct arguments {
  struct options options;
  struct picture_options view;
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
    state->child_inputs[0] = &arguments->options;
    state->child_inputs[1] = &arguments->view;
    return 0;
  case OPTION_KEYS:
    check_keys(value, state);
    arguments->keys = value;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static enum result load(const struct arguments *arguments, struct light **lights,
                        struct gather_prepared *aids, struct scene *scene, struct error *error) {
  const struct options *options = &arguments->options;
  char note[256] = "";
  enum result result = options_load_lights(options, lights, error);
  if (result == RESULT_OK)
    result = gather_prepare(*lights, options->light_count, GATHER_GL, 0, 1, aids, error);
  if (result == RESULT_OK)
    result = scene_load(arguments->view.mesh, SCENE_SURFACES, options->repair, scene, note, error);
  if (result == RESULT_OK && *note) cli_note("%s: note: %s", arguments->view.mesh, note);
  return result;
}

static enum result run(const struct arguments *arguments, struct error *error) {
  const struct options *options = &arguments->options;
  const struct picture_options *view = &arguments->view;
  struct light *lights = NULL;
  struct gather_prepared aids = {0};
  struct scene scene = {0};
  enum result result = load(arguments, &lights, &aids, &scene, error);
  if (result == RESULT_OK) {
    struct viewer_world world = {.scene = &scene,
                                 .lights = lights,
                                 .light_count = options->light_count,
                                 .aids = &aids,
                                 .map_size = MAP_SIZE,
                                 .threads = tiles_processors()};
    const struct viewer_arguments what = {
        .mesh = view->mesh, .repair = options->repair, .lights = options->lights, .world = &world};
    struct camera camera = view->camera_given ? view->camera : viewer_camera_outside(&scene);
    memcpy(world.background, view->background, sizeof world.background);
    result = viewer_loop_run(&what, &camera, view->size[0], view->size[1], arguments->keys, error);
  }
  scene_free(&scene);
  gather_prepared_free(&aids);
  options_free_lights(lights, options->light_count);
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
    "Examples:\n"
    "  renderslab view room.obj --light 'lamp.tif at=0,2,0 toward=0,0,0'\n"
    "  renderslab view room.obj --light lamp.tif --camera 'from=0,1,-3 at=0,1,0' --keys 's q'";

int cmd_view(int argc, char **argv) {
  const struct argp_child children[] = {
      {&options_lights_argp, 0, NULL, 0}, {&picture_options_argp, 0, NULL, 0}, cli_options[0], {0}};
  const struct argp argp = {.options = options_list,
                            .parser = parse,
                            .children = children,
                            .args_doc = "MESH",
                            .doc = help_text};
  struct arguments arguments = {.view = {.camera_optional = true}};
  struct error error = {{0}};
  cli_parse(&argp, argc, argv, &arguments);
  int status = run(&arguments, &error) == RESULT_OK ? CLI_OK : cli_fail(&error);
  options_free(&arguments.options);
  return cli_close_stdout() == CLI_OK ? status : CLI_FAILED;
}
