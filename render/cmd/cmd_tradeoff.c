/* cmd_tradeoff.c - renderslab tradeoff: what accuracy costs in time, for the user's own scene. */
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "base/progress.h"
#include "cli/cli.h"
#include "cli/values.h"
#include "cmd/commands.h"
#include "cmd/ways_options.h"
#include "cmd/world.h"
#include "shadow/occlusion.h"
#include "tradeoff/plot.h"
#include "tradeoff/tradeoff.h"

struct arguments {
  struct world world;
  const char *output, *plot;
  bool methods[GATHER_METHODS];
  double finest;
  int levels; /* -1: all */
  int repeats, threads;
  bool no_shadows;
  bool table; /* an option of the table of methods was given */
  struct ways_options ways;
};

enum {
  OPTION_PLOT = 256,
  OPTION_METHODS,
  OPTION_FINEST,
  OPTION_LEVELS,
  OPTION_REPEATS,
  OPTION_THREADS,
  OPTION_NO_SHADOWS,
  OPTION_ERRORS,
  OPTION_PICTURES,
  OPTION_LIMIT,
  OPTION_BAKES,
  OPTION_ALL
};

static const struct argp_option options_list[] = {
    {"output", 'o', "OUT.tsv", 0, "The table to write; - is standard output", 0},
    {"plot", OPTION_PLOT, "OUT.svg", 0,
     "Plot error against time, a line for each way or method, by gnuplot; .svg or .png", 0},
    {0, 0, 0, 0, "From the lamp to the picture:", 1},
    {"errors", OPTION_ERRORS, "E,E,...", 0,
     "The errors to reach (default 0.1,0.05,0.02,0.01); with a slab, asks for ways rather than "
     "methods",
     1},
    {"pictures", OPTION_PICTURES, "N", 0,
     "How many pictures the bake is to pay for (default 1): the cheapest way is the one for so "
     "many",
     1},
    {"time-limit", OPTION_LIMIT, "S", 0,
     "Advise no way that takes more than S CPU seconds from the script to the first picture", 1},
    {"bakes", OPTION_BAKES, "FOLDER", 0,
     "Keep the slabs there, with their seconds, and bake only what is missing or older than the "
     "script; files that the script includes are not looked at",
     1},
    {"all", OPTION_ALL, NULL, 0,
     "Try every way that is cheaper than the one advised too, and tell whether any would do", 1},
    {0, 0, 0, 0, "Methods of the sum over a slab:", 2},
    {"methods", OPTION_METHODS, "M,M,...", 0,
     "Measure these only (default: all that can do the scene)", 0},
    {"finest", OPTION_FINEST, "T", 0, "The last of the tolerances 0.1, 0.03, ... (default 1e-4)",
     0},
    {"levels", OPTION_LEVELS, "K", 0,
     "The last level that is measured of methods that have levels (default: all)", 0},
    {"repeats", OPTION_REPEATS, "N", 0, "Measure N times what takes less than a second (default 3)",
     0},
    {"threads", OPTION_THREADS, "N", 0, "Threads (default: one a processor); same result", 0},
    {"no-shadows", OPTION_NO_SHADOWS, NULL, 0,
     "Light passes through the mesh; then the method closed is measured too", 0},
    {0}};

#define ARGUMENT(member) offsetof(struct arguments, member)
static const struct value values[] = {
    {'o', VALUE_TEXT, ARGUMENT(output), 0, 0},
    {OPTION_PLOT, VALUE_TEXT, ARGUMENT(plot), 0, 0},
    {OPTION_FINEST, VALUE_REAL, ARGUMENT(finest), 1e-12, 0.1},
    {OPTION_LEVELS, VALUE_WHOLE, ARGUMENT(levels), 0, OPTIONS_MOST_LEVEL},
    {OPTION_REPEATS, VALUE_WHOLE, ARGUMENT(repeats), 1, TRADEOFF_MOST_REPEATS},
    {OPTION_THREADS, VALUE_WHOLE, ARGUMENT(threads), 1, OPTIONS_MOST_THREADS},
    {OPTION_NO_SHADOWS, VALUE_FLAG, ARGUMENT(no_shadows), 0, 0},
    {OPTION_ERRORS, VALUE_TEXT, ARGUMENT(ways.errors), 0, 0},
    {OPTION_PICTURES, VALUE_WHOLE, ARGUMENT(ways.pictures), 1, 1000000},
    {OPTION_LIMIT, VALUE_POSITIVE, ARGUMENT(ways.time_limit), 0, 0},
    {OPTION_ALL, VALUE_FLAG, ARGUMENT(ways.all), 0, 0},
    {OPTION_BAKES, VALUE_TEXT, ARGUMENT(ways.bakes), 0, 0},
    {0}};

static void parse_methods(const char *text, struct arguments *arguments, struct argp_state *state) {
  char *names = strdup(text), *rest = names, *name;
  if (!names) cli_out_of_memory();
  memset(arguments->methods, 0, sizeof arguments->methods);
  while ((name = strsep(&rest, ","))) {
    enum gather_method method = GATHER_AUTO;
    if (!method_parse(name, &method) || gather_methods[method].sum == METHOD_OPENGL)
      argp_error(state, "--methods %s: there is no method '%s' to measure", text, name);
    arguments->methods[method] = true;
  }
  free(names);
}

/* The two tables take different options. */
static void check(struct arguments *arguments, struct argp_state *state) {
  const struct options *lights = &arguments->world.options;
  ways_options_check(&arguments->ways, lights, state);
  if (!ways_options_ask(&arguments->ways, lights)) {
    if (!arguments->output) argp_error(state, "no output given; add -o OUT.tsv");
  } else if (arguments->table) {
    argp_error(state, "--methods, --finest, --levels, --repeats, --threads and --no-shadows: for a "
                      "slab without --errors only");
  }
}

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  if (key >= OPTION_METHODS && key <= OPTION_NO_SHADOWS) arguments->table = true;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &arguments->world.options;
    state->child_inputs[1] = &arguments->world.view;
    for (int k = 0; k < GATHER_METHODS; ++k)
      arguments->methods[k] = gather_methods[k].sum != METHOD_OPENGL;
    return 0;
  case OPTION_METHODS:
    parse_methods(value, arguments, state);
    return 0;
  case ARGP_KEY_SUCCESS:
    check(arguments, state);
    return 0;
  default:
    return values_take(values, options_list, key, value, arguments, state);
  }
}

static enum result load(struct arguments *arguments, struct error *error) {
  struct world *world = &arguments->world;
  const char *outputs[] = {arguments->output, arguments->plot};
  enum result result = world_load_lights(world, outputs, 2, error);
  if (result == RESULT_OK && arguments->plot) result = plot_check(arguments->plot, error);
  if (result == RESULT_OK) result = world_load_scene(world, SCENE_SURFACES, error);
  if (result == RESULT_OK) result = occlusion_create(&world->scene, &world->occlusion, error);
  return result;
}

static void show_progress(void *context, double done) {
  progress_show(context, done, "tradeoff");
}

static struct tradeoff_settings settings_of(const struct arguments *arguments,
                                            struct progress *progress) {
  const struct world *world = &arguments->world;
  struct tradeoff_settings settings = {
      .shade = world_shade(world),
      .gather = {.lights = world->lights,
                 .light_count = world->light_count,
                 .occlusion = arguments->no_shadows ? NULL : world->occlusion,
                 .shadow_grid = OPTIONS_SHADOW_GRID,
                 .shadow_edge = OPTIONS_SHADOW_EDGE},
      .matte = arguments->no_shadows && !world_glossy(world),
      .finest = arguments->finest,
      .levels = arguments->levels,
      .threads = arguments->threads,
      .repeats = arguments->repeats,
      .progress = show_progress,
      .progress_context = progress};
  memcpy(settings.methods, arguments->methods, sizeof settings.methods);
  return settings;
}

static size_t slab_bytes(const struct light *lights, int count) {
  size_t bytes = 0;
  for (int l = 0; l < count; ++l)
    for (int page = 0; page < lights[l].count; ++page)
      bytes += 3 * sizeof(float) * slab_sample_count(&lights[l].pages[page].slab);
  return bytes;
}

/* The plot first: a table without it would look like success. */
static enum result write_files(const struct arguments *arguments,
                               const struct tradeoff_settings *settings,
                               const struct tradeoff *tradeoff, struct error *error) {
  const struct world *world = &arguments->world;
  const struct tradeoff_about about = {cli_command_line(), world->view.mesh,
                                       slab_bytes(world->lights, world->light_count)};
  char *texts[2] = {NULL, NULL};
  size_t lengths[2] = {0, 0};
  enum result result = RESULT_OK;
  for (int k = 0; k < 2 && result == RESULT_OK; ++k) {
    FILE *file = open_memstream(&texts[k], &lengths[k]);
    if (file && k == 0) tradeoff_print(file, settings, tradeoff, &about);
    if (file && k == 1) tradeoff_plot(file, tradeoff, &about);
    if (!file || fclose(file) != 0 || !texts[k]) result = result_no_memory(error);
  }
  if (result == RESULT_OK && arguments->plot) result = plot_write(arguments->plot, texts[1], error);
  if (result == RESULT_OK) result = output_text(arguments->output, texts[0], lengths[0], error);
  free(texts[0]);
  free(texts[1]);
  return result;
}

static enum result run_methods(struct arguments *arguments, struct error *error) {
  struct tradeoff tradeoff = {0};
  struct progress progress;
  enum result result = load(arguments, error);
  if (result == RESULT_OK) {
    struct tradeoff_settings settings = settings_of(arguments, &progress);
    progress_start(&progress, cli_quiet(), 0);
    result = tradeoff_measure(&settings, &tradeoff, error);
    progress_end(&progress);
    if (result == RESULT_OK) result = write_files(arguments, &settings, &tradeoff, error);
    for (int k = 0; k < GATHER_METHODS && result == RESULT_OK; ++k)
      if (tradeoff.refusal[k][0])
        cli_note("%s: note: without method %s: %s", arguments->output, gather_methods[k].name,
                 tradeoff.refusal[k]);
  }
  tradeoff_free(&tradeoff);
  return result;
}

static enum result run(void *input, struct error *error) {
  struct arguments *arguments = input;
  struct world *world = &arguments->world;
  enum result result =
      ways_options_ask(&arguments->ways, &world->options)
          ? ways_options_run(world, &arguments->ways, arguments->output, arguments->plot, error)
          : run_methods(arguments, error);
  world_free(world);
  return result;
}

static const char help_text[] =
    "Shows what accuracy costs. With a lamp script, `--light LAMP.pov ...': for a ladder of errors "
    "the cheapest way from the lamp to the picture of the scene: which bake, which include or "
    "tolerance of renderslab, and the CPU seconds of each step. It bakes the lamp up to ten times, "
    "from coarse to fine, which takes from a minute to an hour; what it advises it has tried. "
    "With a slab and --errors: the same from the slab on.\n"
    "With a slab alone it gathers the light of a picture by every method at a ladder of settings, "
    "each several times, and writes a table of time, error against the "
    "reference, micro lights, nodes, shadow rays and memory. Unless --size is given the picture "
    "is 160x120: times are proportional to its pixels, errors stay."
    "\vThe errors of ways are the RMS of the difference over the mean of the pixels that show a "
    "surface, against renderslab's reference from the finest slab, which tells its own error. "
    "Light that surfaces of the scene reflect onto each other is in none of the pictures.\n"
    "\n"
    "Examples, for room.obj of share/canned/include-pov:\n"
    "  renderslab tradeoff room.obj --light 'lamp.pov at=0,190,20' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' --plot room.svg\n"
    "  renderslab tradeoff room.obj --light 'lamp.tif at=0,190,20' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' --errors 0.2,0.1\n"
    "  renderslab tradeoff room.obj --light 'lamp.tif at=0,190,20' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o - \\\n"
    "    --methods auto,reference --finest 1e-3";

int cmd_tradeoff(int argc, char **argv) {
  static const struct argp argp = {options_list, parse, "MESH", help_text, picture_options_children,
                                   NULL,         NULL};
  /* Unless --size says otherwise the picture is no wider and no higher. */
  struct arguments arguments = {.world = {.view = {.size = {160, 120}}},
                                .finest = 1e-4,
                                .levels = -1,
                                .repeats = 3,
                                .threads = tiles_processors()};
  return cli_run(&argp, argc, argv, run, &arguments);
}
