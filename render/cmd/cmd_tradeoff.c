/* cmd_tradeoff.c - renderslab tradeoff: what accuracy costs in time, for the user's own scene. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "base/progress.h"
#include "cli/cli.h"
#include "cmd/commands.h"
#include "cmd/options.h"
#include "cmd/outputs.h"
#include "cmd/picture_options.h"
#include "picture/image.h"
#include "scene/scene.h"
#include "shadow/occlusion.h"
#include "tradeoff/plot.h"
#include "tradeoff/tradeoff.h"

struct arguments {
  struct options options; /* its lights */
  struct picture_options view;
  const char *output, *plot;
  bool methods[GATHER_METHODS];
  double finest;
  int levels; /* -1: all */
  int repeats, threads;
  bool no_shadows;
};

/* What is loaded. */
struct world {
  struct light *lights;
  struct scene scene;
  struct occlusion *occlusion;
};

enum {
  OPTION_PLOT = 256,
  OPTION_METHODS,
  OPTION_FINEST,
  OPTION_LEVELS,
  OPTION_REPEATS,
  OPTION_THREADS,
  OPTION_NO_SHADOWS
};

enum { MOST_THREADS = 1024, MOST_LEVEL = 30 }; /* as options.c has them */
/* Unless --size says otherwise the picture is no wider and no higher. */
enum { WIDTH = 160, HEIGHT = 120 };

static void parse_methods(const char *text, struct arguments *arguments, struct argp_state *state) {
  char *names = strdup(text), *rest = names, *name;
  if (!names) cli_out_of_memory();
  memset(arguments->methods, 0, sizeof arguments->methods);
  while ((name = strsep(&rest, ","))) {
    enum gather_method method = GATHER_AUTO;
    if (!gather_method_parse(name, &method))
      argp_error(state, "--methods %s: there is no method '%s'", text, name);
    arguments->methods[method] = true;
  }
  free(names);
}

static int parse_count(const char *option, const char *text, int high, struct argp_state *state) {
  uint64_t count = 1;
  if (!options_count(text, 1, (uint64_t)high, &count))
    argp_error(state, "%s %s: must be a whole number from 1 to %d", option, text, high);
  return (int)count;
}

static void init(struct arguments *arguments, struct argp_state *state) {
  state->child_inputs[0] = &arguments->options;
  state->child_inputs[1] = &arguments->view;
  for (int k = 0; k < GATHER_METHODS; ++k) arguments->methods[k] = true;
  arguments->finest = 1e-4;
  arguments->levels = -1;
  arguments->repeats = 3;
  arguments->threads = tiles_processors();
}

static void finish(struct arguments *arguments, struct argp_state *state) {
  if (!arguments->output) argp_error(state, "no output given; add -o OUT.tsv");
  if (arguments->view.size_given) return;
  arguments->view.size[0] = WIDTH;
  arguments->view.size[1] = HEIGHT;
}

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  uint64_t count = 0;
  switch (key) {
  case ARGP_KEY_INIT:
    init(arguments, state);
    return 0;
  case 'o':
    arguments->output = value;
    return 0;
  case OPTION_PLOT:
    arguments->plot = value;
    return 0;
  case OPTION_METHODS:
    parse_methods(value, arguments, state);
    return 0;
  case OPTION_FINEST:
    if (!options_number(value, &arguments->finest) || !(arguments->finest >= 1e-12) ||
        !(arguments->finest <= 0.1))
      argp_error(state, "--finest %s: must be a number from 1e-12 to 0.1", value);
    return 0;
  case OPTION_LEVELS:
    if (!options_count(value, 0, MOST_LEVEL, &count))
      argp_error(state, "--levels %s: must be a whole number from 0 to %d", value, MOST_LEVEL);
    arguments->levels = (int)count;
    return 0;
  case OPTION_REPEATS:
    arguments->repeats = parse_count("--repeats", value, TRADEOFF_MOST_REPEATS, state);
    return 0;
  case OPTION_THREADS:
    arguments->threads = parse_count("--threads", value, MOST_THREADS, state);
    return 0;
  case OPTION_NO_SHADOWS:
    arguments->no_shadows = true;
    return 0;
  case ARGP_KEY_SUCCESS:
    finish(arguments, state);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

/* Before the work: the outputs, and gnuplot. */
static enum result check_outputs(const struct arguments *arguments, const struct light *lights,
                                 struct error *error) {
  int count = arguments->options.light_count;
  const char *outputs[] = {arguments->output, arguments->plot};
  const char **inputs = calloc((size_t)count + 1, sizeof *inputs);
  if (!inputs) return result_fail(error, RESULT_MEMORY, "out of memory");
  for (int k = 0; k < count; ++k) inputs[k] = lights[k].path;
  inputs[count] = arguments->view.mesh;
  enum result result = outputs_check(outputs, 2, inputs, count + 1, error);
  free(inputs);
  if (result == RESULT_OK && arguments->plot) result = plot_check(arguments->plot, error);
  return result;
}

static enum result load(const struct arguments *arguments, struct world *world,
                        struct error *error) {
  const struct options *options = &arguments->options;
  char note[256] = "";
  enum result result = options_load_lights(options, &world->lights, error);
  if (result == RESULT_OK) result = check_outputs(arguments, world->lights, error);
  if (result == RESULT_OK)
    result = scene_load(arguments->view.mesh, SCENE_SURFACES, options->repair, &world->scene, note,
                        error);
  if (result == RESULT_OK && *note) cli_note("%s: note: %s", arguments->view.mesh, note);
  if (result == RESULT_OK) result = occlusion_create(&world->scene, &world->occlusion, error);
  return result;
}

static bool any_gloss(const struct scene *scene) {
  for (int k = 0; k < scene->material_count; ++k)
    if (scene_glossy(&scene->materials[k])) return true;
  return false;
}

static void show_progress(void *context, double done) {
  progress_show(context, done, "tradeoff");
}

static struct tradeoff_settings settings_of(const struct arguments *arguments,
                                            const struct world *world, struct progress *progress) {
  const struct picture_options *view = &arguments->view;
  struct tradeoff_settings settings = {
      .shade = {.scene = &world->scene,
                .occlusion = world->occlusion,
                .lights = world->lights,
                .light_count = arguments->options.light_count},
      .camera = view->camera,
      .width = view->size[0],
      .height = view->size[1],
      .gather = {.lights = world->lights,
                 .light_count = arguments->options.light_count,
                 .occlusion = arguments->no_shadows ? NULL : world->occlusion,
                 .shadow_grid = OPTIONS_SHADOW_GRID,
                 .shadow_edge = OPTIONS_SHADOW_EDGE},
      .closed = arguments->no_shadows && !any_gloss(&world->scene),
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

static enum result write_text(const char *path, const char *text, size_t length,
                              struct error *error) {
  struct output output = {0};
  enum result result = output_begin(&output, path, error);
  if (result != RESULT_OK) return result;
  if (output_write(&output, text, length, 0) != 0)
    result = result_fail(error, RESULT_IO, "%s: cannot be written: %s", path, strerror(errno));
  if (result == RESULT_OK) result = output_commit(&output, error);
  output_abandon(&output);
  return result;
}

/* The plot first: a table without it would look like success. */
static enum result write_files(const struct arguments *arguments, const struct world *world,
                               const struct tradeoff_settings *settings,
                               const struct tradeoff *tradeoff, struct error *error) {
  const struct tradeoff_about about = {cli_command_line(), arguments->view.mesh,
                                       slab_bytes(world->lights, arguments->options.light_count)};
  char *texts[2] = {NULL, NULL};
  size_t lengths[2] = {0, 0};
  enum result result = RESULT_OK;
  for (int k = 0; k < 2 && result == RESULT_OK; ++k) {
    FILE *file = open_memstream(&texts[k], &lengths[k]);
    if (file && k == 0) tradeoff_print(file, settings, tradeoff, &about);
    if (file && k == 1) tradeoff_plot(file, tradeoff, &about);
    if (!file || fclose(file) != 0 || !texts[k])
      result = result_fail(error, RESULT_MEMORY, "out of memory");
  }
  if (result == RESULT_OK && arguments->plot) result = plot_write(arguments->plot, texts[1], error);
  if (result == RESULT_OK) result = write_text(arguments->output, texts[0], lengths[0], error);
  free(texts[0]);
  free(texts[1]);
  return result;
}

static enum result run(const struct arguments *arguments, struct error *error) {
  struct world world = {0};
  struct tradeoff tradeoff = {0};
  struct progress progress;
  enum result result = load(arguments, &world, error);
  if (result == RESULT_OK) {
    struct tradeoff_settings settings = settings_of(arguments, &world, &progress);
    progress_start(&progress, cli_quiet(), 0);
    result = tradeoff_measure(&settings, &tradeoff, error);
    progress_end(&progress);
    if (result == RESULT_OK) result = write_files(arguments, &world, &settings, &tradeoff, error);
    for (int k = 0; k < GATHER_METHODS && result == RESULT_OK; ++k)
      if (tradeoff.refusal[k][0])
        cli_note("%s: note: without method %s: %s", arguments->output,
                 gather_method_name((enum gather_method)k), tradeoff.refusal[k]);
  }
  tradeoff_free(&tradeoff);
  occlusion_free(world.occlusion);
  scene_free(&world.scene);
  options_free_lights(world.lights, arguments->options.light_count);
  return result;
}

static const struct argp_option options_list[] = {
    {"output", 'o', "OUT.tsv", 0, "The table to write; - is standard output", 0},
    {"plot", OPTION_PLOT, "OUT.svg", 0,
     "Plot error against time, a line for each method, by gnuplot; .svg or .png", 0},
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

static const char help_text[] =
    "Shows what accuracy costs in time: gathers the light of a picture by every method at a "
    "ladder of settings, each several times, and writes a table of time, error against the "
    "reference, micro lights, nodes, shadow rays and memory. Unless --size is given the picture "
    "is 160x120: times are proportional to its pixels, errors stay."
    "\vExamples:\n"
    "  renderslab tradeoff room.obj --light 'lamp.tif at=0,2,0' --camera 'from=0,1,-3 at=0,1,0' "
    "-o room.tsv --plot room.svg\n"
    "  renderslab tradeoff room.obj --light 'lamp.tif at=0,2,0' --camera 'from=0,1,-3 at=0,1,0' "
    "-o - --methods auto,reference --finest 1e-3";

int cmd_tradeoff(int argc, char **argv) {
  const struct argp_child children[] = {
      {&options_lights_argp, 0, NULL, 0}, {&picture_options_argp, 0, NULL, 0}, cli_options[0], {0}};
  const struct argp argp = {.options = options_list,
                            .parser = parse,
                            .children = children,
                            .args_doc = "MESH",
                            .doc = help_text};
  struct arguments arguments = {0};
  struct error error = {{0}};
  cli_parse(&argp, argc, argv, &arguments);
  int status = run(&arguments, &error) == RESULT_OK ? CLI_OK : cli_fail(&error);
  options_free(&arguments.options);
  return cli_close_stdout() == CLI_OK ? status : CLI_FAILED;
}
