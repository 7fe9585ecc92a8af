/* cmd_include.c - bakeslab include: a slab as an include that lights any
 * POV-Ray scene. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli.h"
#include "housing.h"
#include "sheet.h"
#include "slab_file.h"
#include "slab_json.h"
#include "slab_name.h"
#include "slab_output.h"

static const char help_text[] =
    "Writes LAMP.inc, an include file for stock POV-Ray 3.7, and beside it the image LAMP.exr "
    "that it reads, which light any scene with the slab."
    "\v"
    "In a scene:\n"
    "\n"
    "  #include \"desk_lamp.inc\"\n"
    "  object { Desk_Lamp_Canned(1, 1) rotate x*30 translate <0, 2, 0> }\n"
    "\n"
    "The macro is called after the slab; Scale and Gain are its arguments. The header of the "
    "include tells what else may be set, and the error of each number of lights.\n"
    "\n"
    "Examples:\n"
    "  bakeslab include desk_lamp.tif -o desk_lamp.inc\n"
    "  bakeslab include desk_lamp.tif -o small.inc --lights 4\n"
    "  bakeslab include IMG_2001.tif -o porch.inc --name porch_light";

struct arguments {
  const char *slab;
  const char *output;
  const char *name;
  int lights;
};

static const struct argp_option options[] = {
    {"output", 'o', "LAMP.inc", 0, "the include to write; its image gets the ending .exr", 0},
    {"mode", 'm', "MODE", 0, "kind of light: sheet (exact; the default)", 0},
    {"lights", 'l', "N", 0, "at most N lights an axis (default: one on each uv sample)", 0},
    {"name", 'n', "NAME", 0, "call the lamp NAME rather than what the slab says", 0},
    {0}};

static error_t parse_option(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  int size[2];
  switch (key) {
  case 'o':
    arguments->output = value;
    return 0;
  case 'm':
    if (strcmp(value, "sheet")) argp_error(state, "--mode %s: only sheet is there", value);
    return 0;
  case 'l':
    if (!cli_parse_size(value, size) || size[0] != size[1])
      argp_error(state, "--lights %s: must be a whole number from 1", value);
    arguments->lights = size[0];
    return 0;
  case 'n':
    arguments->name = value;
    return 0;
  case ARGP_KEY_SUCCESS:
    if (!arguments->output) argp_error(state, "no output given; add -o LAMP.inc");
    return 0;
  default:
    return cli_parse_slab(key, value, state, &arguments->slab);
  }
}

/* The lamp's name in POV-Ray: the slab's, unless --name gives another. */
static enum slab_result choose_name(const char *given, const struct slab *slab,
                                    char name[SLAB_IDENTIFIER_SIZE], struct slab_error *error) {
  enum slab_result result = slab_name_capitalise(given ? given : slab->name, name, error);
  if (result == SLAB_OK) return result;
  struct slab_error reason = *error;
  return slab_fail(error, result, "%s; give one with --name", reason.text);
}

static const char *base_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* "LAMP.exr" for "LAMP.inc", allocated; NULL without memory. */
static char *image_path(const char *include) {
  char *path = strdup(include);
  if (path) memcpy(path + strlen(path) - 4, ".exr", 4);
  return path;
}

/* Whether both paths lead, by whatever links, to one file that is there. */
static int same_file(const char *path, const char *other) {
  struct stat a, b;
  if ((strcmp(path, "-") ? stat(path, &a) : fstat(STDIN_FILENO, &a)) != 0) return 0;
  return stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/* The slab may be an EXR of the name that the image would get. */
static enum slab_result check_outputs(const char *slab, const char *include, const char *image,
                                      struct slab_error *error) {
  const char *outputs[2] = {include, image};
  for (int k = 0; k < 2; ++k)
    if (same_file(slab, outputs[k]))
      return slab_fail(error, SLAB_BAD,
                       "%s: is the slab itself and would be overwritten; choose another -o",
                       outputs[k]);
  if (same_file(include, image))
    return slab_fail(error, SLAB_BAD, "%s: is the same file as %s; choose another -o", image,
                     include);
  return SLAB_OK;
}

/* The include waits under its temporary name until the image is in place. */
static enum slab_result write_files(const struct sheet *sheet, const struct include_text *text,
                                    const char *include, const char *image,
                                    struct slab_error *error) {
  struct slab_output output = {0};
  char *content = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&content, &size);
  if (!stream) return slab_fail(error, SLAB_MEMORY, "out of memory");
  sheet_print(sheet, text, stream);
  enum slab_result result = SLAB_OK;
  if (fclose(stream) != 0) result = slab_fail(error, SLAB_MEMORY, "out of memory");
  if (result == SLAB_OK) result = slab_output_begin(&output, include, error);
  if (result == SLAB_OK && slab_output_write(&output, content, size, 0) != 0)
    result = slab_fail(error, SLAB_IO, "%s: %m", include);
  if (result == SLAB_OK) result = slab_exr_write(image, &sheet->picture, 1, text->command, error);
  if (result == SLAB_OK) {
    result = slab_output_commit(&output, error);
    if (result != SLAB_OK) unlink(image);
  }
  slab_output_abandon(&output);
  free(content);
  return result;
}

/* Prefixes the message with the slab's path. */
static enum slab_result blame(const char *path, enum slab_result result, struct slab_error *error) {
  if (result == SLAB_OK) return result;
  struct slab_error reason = *error;
  return slab_fail(error, result, "%s: %s", path, reason.text);
}

static enum slab_result include_slab(const struct arguments *arguments, struct slab_error *error) {
  struct slab *slabs = NULL;
  int count = 0;
  struct sheet sheet = {0};
  char name[SLAB_IDENTIFIER_SIZE];
  char *image = image_path(arguments->output), *housing = NULL;
  enum slab_result result = SLAB_OK;
  if (!image) result = slab_fail(error, SLAB_MEMORY, "out of memory");
  if (result == SLAB_OK) result = check_outputs(arguments->slab, arguments->output, image, error);
  if (result == SLAB_OK) result = slab_file_load_all(arguments->slab, &slabs, &count, error);
  if (result == SLAB_OK) {
    result = choose_name(arguments->name, &slabs[0], name, error);
    if (result == SLAB_OK) result = sheet_make(slabs, count, arguments->lights, &sheet, error);
    result = blame(arguments->slab, result, error);
  }
  if (result == SLAB_OK) {
    housing = slab_json_get_string(&slabs[0], "provenance", "housing");
    int harmless = housing && housing_is_harmless(housing);
    if (housing && !harmless)
      cli_note("%s: note: its housing is left out: it is more than an object (directives, or "
               "braces that do not match)",
               arguments->slab);
    struct include_text text = {.name = name,
                                .file = base_name(arguments->output),
                                .image = base_name(image),
                                .command = cli_command_line(),
                                .housing = harmless ? housing : NULL,
                                .housing_left_out = housing && !harmless};
    result = write_files(&sheet, &text, arguments->output, image, error);
  }
  free(housing);
  free(image);
  sheet_free(&sheet);
  slab_file_free_all(slabs, count);
  return result;
}

int cmd_include(int argc, char **argv) {
  struct arguments arguments = {0};
  static const struct argp argp = {.options = options,
                                   .parser = parse_option,
                                   .args_doc = "SLAB -o LAMP.inc",
                                   .doc = help_text,
                                   .children = cli_options};
  error_t status = argp_parse(&argp, argc, argv, 0, NULL, &arguments);
  if (status != 0) return CLI_USAGE;
  size_t length = strlen(arguments.output);
  for (const char *c = arguments.output; *c; ++c)
    if (iscntrl((unsigned char)*c)) {
      cli_complain("%s: the output's name must not have control characters", arguments.output);
      return CLI_USAGE;
    }
  if (length < 5 || strcmp(arguments.output + length - 4, ".inc")) {
    cli_complain("%s: the output must end in .inc; its image gets .exr", arguments.output);
    return CLI_USAGE;
  }
  struct slab_error error;
  if (include_slab(&arguments, &error) != SLAB_OK) return cli_fail(&error);
  return CLI_OK;
}
