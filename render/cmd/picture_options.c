/* picture_options.c - see picture_options.h. */
#include "cmd/picture_options.h"

#include "cli/cli.h"
#include "cmd/options.h"
#include "picture/image.h"

enum { OPTION_CAMERA = 2000, OPTION_SIZE, OPTION_BACKGROUND };

static void parse_camera(const char *text, struct picture_options *options,
                         struct argp_state *state) {
  struct error error;
  if (camera_parse(text, &options->camera, &error) != RESULT_OK)
    argp_error(state, "%s", error.text);
  options->camera_given = true;
}

static error_t parse(int key, char *value, struct argp_state *state) {
  struct picture_options *options = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    options->size[0] = 640;
    options->size[1] = 480;
    return 0;
  case OPTION_CAMERA:
    parse_camera(value, options, state);
    return 0;
  case OPTION_SIZE:
    if (!cli_parse_size(value, options->size))
      argp_error(state, "--size %s: must be WxH, each from 1 to %d", value, IMAGE_MOST_SIZE);
    options->size_given = true;
    return 0;
  case OPTION_BACKGROUND:
    if (!options_numbers(value, 3, options->background))
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
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options_list[] = {
    {"camera", OPTION_CAMERA, "CAMERA", 0,
     "'from=X,Y,Z at=X,Y,Z [up=X,Y,Z] [fov=DEG]'; fov is the horizontal angle (default 60)", 0},
    {"size", OPTION_SIZE, "WxH", 0, "Of the picture, in pixels (default 640x480)", 0},
    {"background", OPTION_BACKGROUND, "R,G,B", 0, "Radiance where nothing is (default 0,0,0)", 0},
    {0}};

const struct argp picture_options_argp = {.options = options_list, .parser = parse};
