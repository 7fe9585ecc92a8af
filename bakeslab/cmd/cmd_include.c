/* cmd_include.c - bakeslab include: a slab as an include that lights any
 * POV-Ray scene. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "base/sdl.h"
#include "cmd/slab_options.h"
#include "file/slab_exr.h"
#include "file/slab_json.h"
#include "file/slab_source.h"
#include "include/include_choose.h"
#include "include/include_source.h"
#include "include/text/include_own_error.h"
#include "lamp/housing.h"

static const char doc[] =
    "Writes LAMP.inc, an include file for stock POV-Ray 3.7, and beside it the image LAMP.exr "
    "that it reads, which light any scene with the slab. A cluster needs no image. In place of a "
    "slab it takes what `bakeslab import' reads: a photometric file (IES, EULUMDAT), say."
    "\v"
    "In a scene:\n"
    "\n"
    "  #include \"desk_lamp.inc\"\n"
    "  object { Desk_Lamp_Canned(1, 1) rotate x*30 translate <0, 2, 0> }\n"
    "\n"
    "The macro is called after the slab; Scale and Gain are its arguments. "
    "Desk_Lamp_Canned_Lumens(Scale, Lumens) is the lamp by its lumens, "
    "Desk_Lamp_Canned_Face(Scale, Gain, Eye), of a sheet, what a camera sees of it, lit. The "
    "header of the include tells what else may be set, and the error of each number of lights.\n"
    "\n"
    "Modes:\n"
    "  sheet    a point light on each uv sample, filtered by an image: exact\n"
    "  cluster  a few area lights fitted to the slab: faster, no image\n"
    "  point    the far field: one light, and an image; of a photometric file its own table\n"
    "  auto     the one that is cheapest for POV-Ray within the tolerance\n"
    "Errors are relative RMS differences of the irradiance on planes at the distance, and "
    "distances in widths of the aperture (its longer edge). With auto the tolerance holds also in "
    "the shadow of an edge half way between aperture and plane; the choice takes about as long as "
    "the bake took or less, or some seconds.\n"
    "\n"
    "Examples:\n"
    "  bakeslab include desk_lamp.tif -o desk_lamp.inc\n"
    "  bakeslab include desk_lamp.tif -o small.inc --lights 4\n"
    "  bakeslab include desk_lamp.tif -o fast.inc --mode cluster --lights 16\n"
    "  bakeslab include desk_lamp.tif -o fast.inc --mode cluster --tolerance 0.05 \\\n"
    "    --distance 4\n"
    "  bakeslab include street_lamp.tif -o far.inc --mode auto --tolerance 0.02 \\\n"
    "    --distance 40\n"
    "  bakeslab include IMG_2001.tif -o porch.inc --name porch_light\n"
    "  bakeslab include downlight.ies -o downlight.inc --mode point";

enum { DEFAULT_CLUSTER = 16, DEFAULT_CLUSTER_TABLE = 24 }; /* of a table: photometric files */
static const double default_distance = 4;

struct arguments {
  const char *slab;
  const char *output;
  const char *name;
  int modes;                  /* that may be made */
  int lights;                 /* 0: not given */
  double tolerance, distance; /* 0: no tolerance given */
};

#define ARGUMENT(member) offsetof(struct arguments, member)
#define KEY(member) VALUE_KEY(struct arguments, member)

static const struct argp_option options[] = {
    {"output", 'o', "LAMP.inc", 0, "the include to write; its image gets the ending .exr", 0},
    {"mode", 'm', "sheet|cluster|point|auto", 0, "kind of light; sheet, the default, is exact", 0},
    {"lights", 'l', "N", 0,
     "sheet: at most N lights an axis (default: one on each uv sample); cluster: at most N lights "
     "in all, up to 64 a page (default 16, of photometric files 24)",
     0},
    {"tolerance", KEY(tolerance), "T", 0, "as few lights as are at most T off (0.05 is 5 %)", 0},
    {"distance", KEY(distance), "D", 0, "where T holds, in aperture widths (default 4)", 0},
    {"name", 'n', "NAME", 0, "call the lamp NAME rather than what the slab says", 0},
    {0}};

static const struct value values[] = {{'o', VALUE_TEXT, ARGUMENT(output), 0, 0},
                                      {'l', VALUE_WHOLE, ARGUMENT(lights), 1, 65536},
                                      {KEY(tolerance), VALUE_POSITIVE, ARGUMENT(tolerance), 0, 0},
                                      {KEY(distance), VALUE_REAL, ARGUMENT(distance), 0.01, 1e6},
                                      {'n', VALUE_TEXT, ARGUMENT(name), 0, 0},
                                      {0}};

static int parse_mode(const char *value, struct argp_state *state) {
  if (!strcmp(value, "sheet")) return INCLUDE_SHEET;
  if (!strcmp(value, "cluster")) return INCLUDE_CLUSTER;
  if (!strcmp(value, "point")) return INCLUDE_POINT;
  if (!strcmp(value, "auto")) return INCLUDE_ANY;
  argp_error(state, "--mode %s: must be sheet, cluster, point or auto", value);
  return 0;
}

/* Options that contradict each other. */
static void check_arguments(const struct arguments *arguments, struct argp_state *state) {
  const char *output = arguments->output ? arguments->output : "";
  if (!*output) argp_error(state, "no output given; add -o LAMP.inc");
  for (const char *c = output; *c; ++c)
    if (iscntrl((unsigned char)*c))
      argp_error(state, "%s: the output's name must not have control characters", output);
  if (strlen(output) < 5 || strcmp(output + strlen(output) - 4, ".inc"))
    argp_error(state, "%s: the output must end in .inc; its image gets .exr", output);
  if (arguments->lights > 0 && arguments->tolerance > 0)
    argp_error(state, "--lights and --tolerance: give one of them");
  if (arguments->modes == INCLUDE_ANY && !(arguments->tolerance > 0))
    argp_error(state, "--mode auto: needs --tolerance T, and --distance D if not 4");
  if (arguments->lights > 0 && arguments->modes & INCLUDE_POINT)
    argp_error(state, "--lights: the far field is one light; leave it out");
}

static error_t parse_option(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  switch (key) {
  case 'm':
    arguments->modes = parse_mode(value, state);
    return 0;
  case ARGP_KEY_SUCCESS:
    check_arguments(arguments, state);
    return 0;
  default:
    if (values_take(values, options, key, value, arguments, state) == 0) return 0;
    return cli_parse_file(key, value, state, "slab", &arguments->slab);
  }
}

/* The image of the include; NULL where it has none. */
static const struct picture *picture_of(const struct include_choice *choice) {
  if (choice->mode == INCLUDE_CLUSTER) return NULL;
  return choice->mode == INCLUDE_POINT ? &choice->point.picture : &choice->sheet.picture;
}

static enum result compose(const struct include_choice *choice, const struct include_text *text,
                           struct output *output, struct error *error) {
  char *content = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&content, &size);
  if (!stream) return result_no_memory(error);
  if (choice->mode == INCLUDE_CLUSTER)
    cluster_print(&choice->cluster, text, stream);
  else if (choice->mode == INCLUDE_POINT)
    point_print(&choice->point, text, stream);
  else
    sheet_print(&choice->sheet, text, stream);
  enum result result = RESULT_OK;
  if (fclose(stream) != 0 || !content) /* glibc's fclose may lose the text without a word */
    result = result_no_memory(error);
  else if (output_write(output, content, size, 0) != 0)
    result = result_fail(error, RESULT_IO, "%s: cannot be written: %m", output->target);
  free(content);
  return result;
}

/* Both are on the disk before either gets its name: they belong together. */
static enum result write_files(const struct include_choice *choice, const struct include_text *text,
                               const char *include, const char *image, struct error *error) {
  struct output outputs[2] = {{0}, {0}};
  const struct picture *picture = picture_of(choice);
  enum result result = output_begin(&outputs[0], include, error);
  if (result == RESULT_OK) result = compose(choice, text, &outputs[0], error);
  if (result == RESULT_OK) result = output_flush(&outputs[0], error);
  if (result == RESULT_OK && picture) {
    result = output_begin(&outputs[1], image, error);
    if (result == RESULT_OK) result = slab_exr_put(&outputs[1], picture, 1, text->command, error);
    if (result == RESULT_OK) result = output_commit(&outputs[1], error);
  }
  if (result == RESULT_OK) result = output_commit(&outputs[0], error);
  for (int k = 0; k < 2; ++k) output_abandon(&outputs[k]);
  return result;
}

static enum result choose(const struct include_source *source, const struct include_wish *asked,
                          struct include_choice *choice, struct error *error) {
  struct progress progress;
  struct include_wish wish = *asked;
  wish.progress = &progress;
  progress_start(&progress, cli_quiet(), 0);
  enum result result =
      include_choose(source->light.slabs, source->light.count, &wish, choice, error);
  progress_end(&progress);
  return result;
}

/* The lamp's name in POV-Ray, the slab's unless --name gives another, and its lights. */
static enum result make_lights(const struct arguments *arguments,
                               const struct include_source *source, char name[SDL_IDENTIFIER_SIZE],
                               struct include_choice *choice, struct error *error) {
  const struct slab *slabs = source->light.slabs;
  const char *given = arguments->name ? arguments->name : slabs[0].name, *advice = "";
  int lights = arguments->lights;
  struct include_wish wish = {.modes = arguments->modes,
                              .tolerance = arguments->tolerance,
                              .distance = arguments->distance,
                              .table = source->has_table ? &source->table : NULL};
  if (wish.modes == INCLUDE_CLUSTER && !lights)
    lights = source->has_table ? DEFAULT_CLUSTER_TABLE : DEFAULT_CLUSTER;
  enum result result = sdl_capitalise(given, name, error);
  if (result != RESULT_OK)
    advice = "; give one with --name";
  else if (arguments->tolerance > 0)
    result = choose(source, &wish, choice, error);
  else
    result = include_make(slabs, source->light.count, &wish, lights, choice, error);
  if (result == RESULT_OK) return result;
  struct error reason = *error;
  return result_fail(error, result, "%s: %s%s", arguments->slab, reason.text, advice);
}

/* Says what was chosen and what is left out, and writes. */
static enum result write_include(const struct arguments *arguments, const struct slab *slabs,
                                 int count, const char *name, const struct include_choice *choice,
                                 const char *image, struct error *error) {
  json_t *root = NULL;
  char *own_error = NULL, *source = NULL;
  enum result result =
      include_own_error(slabs, count, include_choice_error, choice, &own_error, error);
  if (result == RESULT_OK) result = slab_json_root(&slabs[0], &root, error);
  if (result == RESULT_OK) result = slab_source_line(&slabs[0], &source, error);
  if (result != RESULT_OK) goto out;
  const char *housing =
      json_string_value(json_object_get(json_object_get(root, "provenance"), "housing"));
  int harmless = housing && housing_is_harmless(housing);
  if (*choice->why) cli_note("%s: note: %s", arguments->slab, choice->why);
  if (housing && !harmless)
    cli_note("%s: note: its housing is left out: it is more than an object (directives, or "
             "braces that do not match)",
             arguments->slab);
  struct include_text text = {.name = name,
                              .file = basename(arguments->output),
                              .image = picture_of(choice) ? basename(image) : NULL,
                              .image_path = strchr(image, '/') ? image : NULL,
                              .command = cli_command_line(),
                              .own_error = own_error,
                              .housing = harmless ? housing : NULL,
                              .housing_left_out = housing && !harmless,
                              .source = source,
                              .chosen = *choice->why ? choice->why : NULL};
  result = write_files(choice, &text, arguments->output, image, error);
out:
  json_decref(root);
  free(own_error);
  free(source);
  return result;
}

static enum result run(void *input, struct error *error) {
  const struct arguments *arguments = input;
  struct include_source source = {0};
  struct warnings notes = {0};
  struct include_choice choice = {0};
  char name[SDL_IDENTIFIER_SIZE], *image = strdup(arguments->output);
  enum result result = RESULT_OK;
  if (image)
    memcpy(image + strlen(image) - 4, ".exr", 4);
  else
    result = result_no_memory(error);
  if (result == RESULT_OK) {
    const char *outputs[2] = {arguments->output, image};
    result = output_check(outputs, 2, &arguments->slab, 1, error);
  }
  if (result == RESULT_OK)
    result = include_source_load(arguments->slab, cli_command_line(), &notes, &source, error);
  for (int k = 0; result == RESULT_OK && k < warnings_kept(&notes); ++k)
    cli_note("%s: note: %s", arguments->slab, notes.lines[k]);
  if (result == RESULT_OK) result = make_lights(arguments, &source, name, &choice, error);
  if (result == RESULT_OK)
    result = write_include(arguments, source.light.slabs, source.light.count, name, &choice, image,
                           error);
  free(image);
  include_choice_free(&choice);
  include_source_free(&source);
  return result;
}

static const struct argp argp = {options, parse_option, "SLAB|FILE -o LAMP.inc", doc, cli_options,
                                 NULL,    NULL};

int cmd_include(int argc, char **argv) {
  struct arguments arguments = {.modes = INCLUDE_SHEET, .distance = default_distance};
  return cli_run(&argp, argc, argv, run, &arguments);
}
