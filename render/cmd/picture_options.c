#include "cmd/picture_options.h"

#include <string.h>

#include "base/numbers.h"
#include "cli/cli.h"
#include "cli/values.h"
#include "cmd/options.h"

enum { OPTION_CAMERA = 2000, OPTION_SIZE, OPTION_BACKGROUND };

static const struct argp_option options_list[] = {
    {"camera", OPTION_CAMERA, "CAMERA", 0,
     "'from=X,Y,Z at=X,Y,Z [up=X,Y,Z] [fov=DEG]'; fov is the horizontal angle (default 60). Or the "
     "name of a glTF file's camera",
     0},
    {"size", OPTION_SIZE, "WxH", 0,
     "Of the picture, in pixels (default 640x480; 160x120 of tradeoff)", 0},
    {"background", OPTION_BACKGROUND, "R,G,B", 0, "Radiance where nothing is (default 0,0,0)", 0},
    {0}};

static const struct value values[] = {
    {OPTION_SIZE, VALUE_SIZE, offsetof(struct picture_options, size), 0, 0}, {0}};

static error_t parse(int key, char *value, struct argp_state *state) {
  struct picture_options *options = state->input;
  struct error error;
  switch (key) {
  case ARGP_KEY_INIT:
    if (options->size[0] > 0) return 0;
    options->size[0] = 640;
    options->size[1] = 480;
    return 0;
  case OPTION_CAMERA:
    options->camera_name = *value && !strchr(value, '=') ? value : NULL;
    if (!options->camera_name && camera_parse(value, &options->camera, &error) != RESULT_OK)
      argp_error(state, "%s", error.text);
    options->camera_given = true;
    return 0;
  case OPTION_BACKGROUND:
    if (!numbers_real(value, 3, options->background))
      argp_error(state, "--background %s: must be three numbers R,G,B", value);
    return 0;
  case ARGP_KEY_ARG:
    if (options->mesh) argp_error(state, "%s: one mesh at a time", value);
    options->mesh = value;
    return 0;
  case ARGP_KEY_SUCCESS:
    if (!options->mesh) argp_error(state, "no mesh given");
    if (!options->camera_given && !options->camera_optional)
      argp_error(state, "no camera given; add --camera 'from=X,Y,Z at=X,Y,Z'");
    return 0;
  default:
    return values_take(values, options_list, key, value, options, state);
  }
}

const struct argp picture_options_argp = {.options = options_list, .parser = parse};
const struct argp_child picture_options_children[] = {{&options_lights_argp, 0, NULL, 0},
                                                      {&picture_options_argp, 0, NULL, 0},
                                                      {&cli_argp, 0, NULL, 0},
                                                      {0}};
