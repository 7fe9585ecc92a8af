/* cmd_projector.c - bakeslab projector: an image becomes the slab of a slide projector. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bake/projector.h"
#include "base/numbers.h"
#include "base/output.h"
#include "base/sdl.h"
#include "base/version.h"
#include "cmd/slab_options.h"
#include "file/slab_file.h"
#include "file/slab_image.h"
#include "file/slab_json.h"

struct arguments {
  const char *image, *output;
  enum slab_precision precision;
  struct projector projector;
};

#define PROJECTOR(member) offsetof(struct arguments, projector.member)
#define KEY(member) VALUE_KEY(struct arguments, projector.member)

static const struct argp_option options[] = {
    {"output", 'o', "SLAB", 0,
     "The slab to write: .tif (LogLuv unless --precision is given) or .exr", 1},
    {"aperture", KEY(aperture), "W[xH]", 0, "Size of the opening that the light comes from", 1},
    {"focus", KEY(focus), "D", 0, "Distance at which the picture is sharp", 1},
    {"width", KEY(width), "W", 0, "Width of the picture there; its pixels are square", 1},
    {"uv", KEY(uv), "NxM", 0,
     "Positions on the aperture (default 8x8), all with the same samples: methods that sum over "
     "positions need some, for those that integrate 1x1 is as exact",
     2},
    {"st", KEY(st), "NxM", 0,
     "Samples of the picture (default: the image's pixels, at most 256 along the longer side). "
     "Fewer than pixels are means over their cells, more are interpolated",
     2},
    {"white", KEY(white), "L", 0, "Radiance where the image is 1 (default 1)", 3},
    {"flux", KEY(flux), "F", 0,
     "Flux of an all-white picture instead, as on a data sheet: lumens for --unit cd/m2, watts "
     "for W/(sr m2)",
     3},
    {"unit", KEY(unit), "UNIT", 0, "Unit of radiance: cd/m2, W/(sr m2) or relative (the default)",
     3},
    {"metres-per-unit", KEY(metres_per_unit), "M", 0, "Length of a lamp unit in metres (default 1)",
     3},
    {"precision", VALUE_KEY(struct arguments, precision), CLI_PRECISIONS, 0,
     "Number format of the samples", 1},
    {0}};

static const char doc[] =
    "Makes the light slab of a slide projector from an image. Each ray from the aperture has the "
    "colour of the picture where it passes the focus plane. A screen there shows the picture "
    "sharp. At the distance d each point of it is blurred over a rectangle, the aperture times "
    "|d - D|/D. Towards the corners it gets darker, by the cosines."
    "\v"
    "The projector is at the origin and shines along +z. The picture is upright (+y) and not "
    "mirrored, as seen from the projector.\n"
    "\n"
    "IMAGE is PNG, JPEG, TIFF, EXR, Radiance's HDR, GIF, BMP, WebP, PNM, PFM or TGA. Its colours "
    "become linear Rec. 709 as it says itself, by a colour profile, say; where it says nothing, "
    "floating-point files are linear, others sRGB. It is turned as EXIF says, and EXR is shown "
    "within its display window. Of several pictures in a file the first is read. What cannot be "
    "right (CMYK, profiles made of tables, transparent "
    "pixels, pixels that are not square) is refused. The lamp's name in POV-Ray is that of the "
    "output, if it is an identifier.\n"
    "\n"
    "Examples:\n"
    "  bakeslab projector slide.png -o slide.tif --aperture 5 --focus 300 \\\n"
    "    --width 200 --metres-per-unit 0.01\n"
    "  bakeslab projector film.jpg -o film.tif --aperture 5x3 --focus 400 \\\n"
    "    --width 300 --flux 2000 --unit cd/m2 --metres-per-unit 0.01\n"
    "  renderslab image room.obj --light 'slide.tif at=0,120,-140 toward=0,99,0' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o shown.png";

static void parse_aperture(struct argp_state *state, const char *text, double aperture[2]) {
  char width[64];
  int length = (int)strcspn(text, "x"); /* "0x2" is no hexadecimal number here */
  snprintf(width, sizeof width, "%.*s", length, text);
  if (!numbers_real(width, 1, &aperture[0]) ||
      !numbers_real(text[length] ? text + length + 1 : width, 1, &aperture[1]) ||
      !(aperture[0] > 0 && aperture[1] > 0))
    argp_error(state, "--aperture %s: must be a positive number, or two as in 5x3", text);
}

static void check_arguments(struct argp_state *state, struct arguments *arguments) {
  struct projector *projector = &arguments->projector;
  struct error error = {{0}};
  if (!arguments->output) argp_error(state, "no output given: -o SLAB");
  if (!(projector->aperture[0] > 0)) argp_error(state, "no opening given: --aperture W[xH]");
  if (!(projector->focus > 0)) argp_error(state, "no focus given: --focus D");
  if (!(projector->width > 0)) argp_error(state, "no size of the picture given: --width W");
  if (projector->white > 0 && projector->flux > 0)
    argp_error(state, "--white and --flux: give one of them");
  if (!(projector->flux > 0) && !(projector->white > 0)) projector->white = 1;
  if (projector_check(projector, &error) != RESULT_OK) argp_error(state, "%s", error.text);
}

static const struct value values[] = {
    {'o', VALUE_TEXT, offsetof(struct arguments, output), 0, 0},
    {KEY(focus), VALUE_POSITIVE, PROJECTOR(focus), 0, 0},
    {KEY(width), VALUE_POSITIVE, PROJECTOR(width), 0, 0},
    {KEY(uv), VALUE_SIZE, PROJECTOR(uv), 0, 0},
    {KEY(st), VALUE_SIZE, PROJECTOR(st), 0, 0},
    {KEY(white), VALUE_POSITIVE, PROJECTOR(white), 0, 0},
    {KEY(flux), VALUE_POSITIVE, PROJECTOR(flux), 0, 0},
    {KEY(unit), VALUE_TEXT, PROJECTOR(unit), 0, 0},
    {KEY(metres_per_unit), VALUE_POSITIVE, PROJECTOR(metres_per_unit), 0, 0},
    {VALUE_KEY(struct arguments, precision), VALUE_WORD, offsetof(struct arguments, precision),
     SLAB_PRECISION_LOGLUV, 0},
    {0}};

static error_t parse(int key, char *text, struct argp_state *state) {
  struct arguments *arguments = state->input;
  switch (key) {
  case KEY(aperture):
    parse_aperture(state, text, arguments->projector.aperture);
    return 0;
  case ARGP_KEY_SUCCESS:
    check_arguments(state, arguments);
    return 0;
  default:
    if (values_take(values, options, key, text, arguments, state) == 0) return 0;
    return cli_parse_file(key, text, state, "image", &arguments->image);
  }
}

static enum result read_image(const char *path, struct picture *image, struct error *error) {
  struct slab_image_says says;
  enum result result = slab_image_read(path, NULL, 0, NULL, SLAB_IMAGE_OWN, image, &says, error);
  if (result != RESULT_OK) return result;
  if (says.transparent)
    result = result_fail(
        error, RESULT_BAD,
        "%s: has transparent pixels; put it on black first, and save it without alpha", path);
  else if (!(fabs(says.pixel_aspect - 1) <= 0.01))
    result = result_fail(error, RESULT_BAD,
                         "%s: says that its pixels are %.4g times as wide as high; resize it so "
                         "that they are square",
                         path, says.pixel_aspect);
  else if (says.several)
    cli_note("%s: note: only the first picture of the file is read", path);
  if (result != RESULT_OK) picture_free(image);
  return result;
}

/* The output's name without folder and suffix. */
static void set_name(struct slab *slab, const char *output) {
  const char *slash = strrchr(output, '/'), *base = slash ? slash + 1 : output;
  char capitalised[SDL_IDENTIFIER_SIZE];
  snprintf(slab->name, sizeof slab->name, "%.*s", (int)strcspn(base, "."), base);
  if (sdl_capitalise(slab->name, capitalised, NULL) != RESULT_OK)
    snprintf(slab->name, sizeof slab->name, "projector");
}

static enum result run(void *input, struct error *error) {
  const struct arguments *arguments = input;
  struct picture image = {0};
  struct slab slab = {0};
  struct error why = {{0}};
  enum result result = output_check(&arguments->output, 1, &arguments->image, 1, error);
  if (result == RESULT_OK)
    result = slab_file_check_target(arguments->output, arguments->precision, error);
  if (result == RESULT_OK) result = read_image(arguments->image, &image, error);
  if (result != RESULT_OK) return result;
  result = projector_slab(&arguments->projector, &image, &slab, &why);
  picture_free(&image);
  if (result == RESULT_OK)
    result = slab_json_record(&slab, cli_command_line(), "bakeslab " CANNED_VERSION, false, &why);
  if (result == RESULT_OK) {
    set_name(&slab, arguments->output);
    result = slab_file_write(arguments->output, &slab, 1, arguments->precision, error);
  } else {
    result_fail(error, result, "%s: %s", arguments->image, why.text);
  }
  slab_free(&slab);
  return result;
}

int cmd_projector(int argc, char **argv) {
  static const struct argp argp = {
      options, parse, "IMAGE -o SLAB --aperture W --focus D --width W", doc, cli_options,
      NULL,    NULL};
  struct arguments arguments = {
      .projector = {.uv = {8, 8}, .metres_per_unit = 1, .unit = "relative"}};
  return cli_run(&argp, argc, argv, run, &arguments);
}
