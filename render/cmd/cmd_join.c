/* cmd_join.c - renderslab join: one picture of its tiles. --stats writes a JSON object: command,
 * tiles, seconds: {total}: of rendering all, and receivers, microlights, nodes, black_microlights,
 * shadow_rays, open_views, pages_behind, error_estimate as renderslab image (stats.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "cli/cli.h"
#include "cli/values.h"
#include "cmd/commands.h"
#include "cmd/picture_files.h"
#include "file/json_text.h"
#include "picture/picture_tile.h"

struct arguments {
  struct picture_files files;
  const char *stats;
  const char **tiles; /* into argv */
  int count;
};

enum { OPTION_PREVIEW = 256, OPTION_EXPOSURE, OPTION_STATS };

static const struct argp_option options_list[] = {
    {"output", 'o', "OUT.exr|png", 0,
     "The picture: radiance in float RGB, or 8-bit sRGB as a PNG; - is EXR on standard output", 0},
    {"preview", OPTION_PREVIEW, "FILE.png", 0, "Write an 8-bit sRGB picture too", 0},
    {"exposure", OPTION_EXPOSURE, "auto|EV", 0, "What is white in a PNG, as for renderslab image",
     0},
    {"stats", OPTION_STATS, "FILE", 0, "Write what all tiles took together, as JSON", 0},
    {0}};

#define ARGUMENT(member) offsetof(struct arguments, member)
static const struct value values[] = {{'o', VALUE_TEXT, ARGUMENT(files.output), 0, 0},
                                      {OPTION_PREVIEW, VALUE_TEXT, ARGUMENT(files.preview), 0, 0},
                                      {OPTION_STATS, VALUE_TEXT, ARGUMENT(stats), 0, 0},
                                      {0}};

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  switch (key) {
  case ARGP_KEY_ARGS: /* all that are left */
    arguments->tiles = (const char **)state->argv + state->next;
    arguments->count = state->argc - state->next;
    return 0;
  case OPTION_EXPOSURE:
    picture_files_expose(value, &arguments->files, state);
    return 0;
  case ARGP_KEY_END:
    if (arguments->count == 0) argp_error(state, "no tiles given");
    picture_files_check(arguments->files.output, state);
    return 0;
  default:
    return values_take(values, options_list, key, value, arguments, state);
  }
}

static enum result write_stats(const struct arguments *arguments, const struct picture_tile *sum,
                               struct error *error) {
  const struct gather_counts *counts = &sum->counts;
  char *text = NULL;
  unsigned long mark = json_mark();
  json_t *object = json_pack(
      "{s:o, s:i, s:{s:f}, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:o}", "command",
      json_any_string(cli_command_line()), "tiles", sum->count, "seconds", "total", sum->seconds,
      "receivers", (json_int_t)counts->receivers, "microlights", (json_int_t)counts->microlights,
      "nodes", (json_int_t)counts->nodes, "black_microlights", (json_int_t)counts->black,
      "shadow_rays", (json_int_t)counts->shadow_rays, "open_views", (json_int_t)counts->open_views,
      "pages_behind", (json_int_t)counts->pages_behind, "error_estimate",
      isfinite(counts->error) ? json_real(counts->error) : json_null());
  enum result result =
      json_text(object, mark, JSON_INDENT(2) | JSON_REAL_PRECISION(6), &text, error);
  if (result == RESULT_OK) {
    size_t length = strlen(text);
    text[length] = '\n'; /* in place of the final zero */
    result = output_text(arguments->stats, text, length + 1, error);
  }
  json_decref(object);
  free(text);
  return result;
}

static enum result run(void *input, struct error *error) {
  struct arguments *arguments = input;
  const char *outputs[] = {arguments->files.output, arguments->files.preview, arguments->stats};
  struct picture picture = {0};
  struct picture_tile sum;
  enum result result = output_check(outputs, 3, arguments->tiles, arguments->count, error);
  if (result == RESULT_OK)
    result = picture_tile_join(arguments->tiles, arguments->count, &picture, &sum, error);
  if (result == RESULT_OK) arguments->files.luminance = sum.luminance;
  if (result == RESULT_OK) result = picture_files_write(&arguments->files, &picture, error);
  if (result == RESULT_OK && arguments->stats) result = write_stats(arguments, &sum, error);
  picture_free(&picture);
  return result;
}

static const char help_text[] =
    "Puts tiles of a picture together, which renderslab image --tile K/N rendered in several "
    "processes or on several machines: the pixels and their errors are those of the whole picture, "
    "to the last bit. Tiles of other pictures, by other options, scenes, slabs or versions, are "
    "refused, and so is a picture that lacks one."
    "\vExamples, for room.obj of share/canned/include-pov:\n"
    "  for k in 1 2; do renderslab image room.obj --light 'lamp.tif at=0,190,20' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' --tile $k/2 \\\n"
    "    -o tile$k.exr; done\n"
    "  renderslab join tile1.exr tile2.exr -o whole.exr --preview whole.png\n";

int cmd_join(int argc, char **argv) {
  static const struct argp argp = {options_list, parse, "TILE...", help_text,
                                   cli_options,  NULL,  NULL};
  struct arguments arguments = {0};
  return cli_run(&argp, argc, argv, run, &arguments);
}
