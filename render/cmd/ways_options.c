#include "cmd/ways_options.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/numbers.h"
#include "base/output.h"
#include "base/progress.h"
#include "cli/cli.h"
#include "light/light_text.h"
#include "shadow/occlusion.h"
#include "tradeoff/plot.h"

static volatile sig_atomic_t stop;

static void on_signal(int number) {
  (void)number;
  stop = 1;
}

/* ---- Options ---- */

static bool is_script(const char *text) {
  struct light_text light;
  struct error error;
  if (light_text_parse(text, &light, &error) != RESULT_OK) return false;
  const char *dot = strrchr(light.path, '.');
  bool script = dot && !strcasecmp(dot, ".pov");
  light_text_free(&light);
  return script;
}

bool ways_options_ask(const struct ways_options *ways, const struct options *lights) {
  bool ask = ways->errors != NULL;
  for (int k = 0; k < lights->light_count; ++k) ask |= is_script(lights->lights[k]);
  return ask;
}

static int falling(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return (a < b) - (a > b);
}

static void parse_ladder(struct ways_options *ways, struct argp_state *state) {
  const char *text = ways->errors ? ways->errors : "0.1,0.05,0.02,0.01";
  char *numbers = strdup(text), *rest = numbers, *number;
  if (!numbers) cli_out_of_memory();
  ways->rungs = 0;
  while ((number = strsep(&rest, ","))) {
    double error;
    if (ways->rungs == WAYS_MOST_RUNGS)
      argp_error(state, "--errors %s: more than %d", text, WAYS_MOST_RUNGS);
    if (!numbers_real(number, 1, &error) || !(error >= 1e-6 && error <= 1))
      argp_error(state, "--errors %s: must be numbers from 1e-6 to 1 with commas between", text);
    ways->ladder[ways->rungs++] = error;
  }
  free(numbers);
  qsort(ways->ladder, (size_t)ways->rungs, sizeof *ways->ladder, falling);
}

void ways_options_check(struct ways_options *ways, const struct options *lights,
                        struct argp_state *state) {
  if (!ways_options_ask(ways, lights)) {
    if (ways->bakes || ways->pictures || ways->time_limit > 0 || ways->all)
      argp_error(state,
                 "--bakes, --pictures, --time-limit and --all: for a lamp script or --errors only");
    return;
  }
  if (lights->light_count > 1)
    argp_error(state, "from a lamp script, or with --errors: one light at a time");
  if (ways->bakes && lights->light_count == 1 && !is_script(lights->lights[0]))
    argp_error(state, "--bakes: a slab needs no bake; leave it out, or give a lamp script");
  if (!ways->pictures) ways->pictures = 1;
  parse_ladder(ways, state);
}

/* ---- The work ---- */

static void show(void *context, double done, const char *label) {
  progress_show(context, done, label);
}

static void catch_signals(void) {
  const struct sigaction action = {.sa_handler = on_signal};
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
}

/* Outputs, and what they must not take the place of. */
static enum result load(struct world *world, const char *lamp, const char *output, const char *plot,
                        struct error *error) {
  const char *outputs[] = {output, plot}, *inputs[] = {lamp, world->view.mesh};
  enum result result = output_check(outputs, 2, inputs, 2, error);
  if (result == RESULT_OK && plot) result = plot_check(plot, error);
  FILE *there = result == RESULT_OK ? fopen(lamp, "re") : NULL;
  if (result == RESULT_OK && !there) result = result_fail(error, RESULT_IO, "%s: %m", lamp);
  if (there) fclose(there);
  if (result == RESULT_OK) result = world_load_scene(world, SCENE_SURFACES, error);
  if (result == RESULT_OK) result = occlusion_create(&world->scene, &world->occlusion, error);
  return result;
}

typedef void writer(FILE *file, const struct ways_settings *settings, const struct ways *ways);

static void words(FILE *file, const struct ways_settings *settings, const struct ways *ways) {
  ways_say(file, "", settings, ways);
}

static enum result compose(writer *write, const struct ways_settings *settings,
                           const struct ways *ways, char **text, size_t *length,
                           struct error *error) {
  FILE *file = open_memstream(text, length);
  if (file) write(file, settings, ways);
  return !file || fclose(file) != 0 || !*text ? result_no_memory(error) : RESULT_OK;
}

/* The plot first: a table without it would look like success. */
static enum result write_all(const struct ways_settings *settings, const struct ways *ways,
                             const char *output, const char *plot, struct error *error) {
  writer *const writers[] = {ways_plot, ways_print, words};
  char *texts[3] = {NULL, NULL, NULL};
  size_t lengths[3] = {0, 0, 0};
  enum result result = RESULT_OK;
  for (int k = 0; k < 3 && result == RESULT_OK; ++k)
    result = compose(writers[k], settings, ways, &texts[k], &lengths[k], error);
  if (result == RESULT_OK && plot) result = plot_write(plot, texts[0], error);
  if (result == RESULT_OK && output) result = output_text(output, texts[1], lengths[1], error);
  if (result == RESULT_OK && (!output || strcmp(output, "-")))
    result = output_text("-", texts[2], lengths[2], error);
  for (int k = 0; k < 3; ++k) free(texts[k]);
  return result;
}

static enum result measure(const struct ways_settings *settings, const char *output,
                           const char *plot, struct progress *progress, struct error *error) {
  struct ways *ways = calloc(1, sizeof *ways);
  if (!ways) return result_no_memory(error);
  enum result result = ways_measure(settings, ways, error);
  progress_end(progress);
  if (result == RESULT_OK) result = write_all(settings, ways, output, plot, error);
  if (result == RESULT_OK && *ways->lamp_refusal)
    cli_note("%s: note: without the whole lamp in POV-Ray: %s", settings->lamp, ways->lamp_refusal);
  ways_free(ways);
  free(ways);
  return result;
}

enum result ways_options_run(struct world *world, const struct ways_options *ways,
                             const char *output, const char *plot, struct error *error) {
  const char *text = world->options.lights[0];
  struct light_text light;
  struct progress progress;
  enum result result = light_text_parse(text, &light, error);
  if (result != RESULT_OK) return result;
  if (light.channel_count)
    result = result_fail(error, RESULT_BAD,
                         "--light %s: gain.%s=: the whole lamp is compared with, all channels at "
                         "their full light; leave it out",
                         text, light.channels[0].name);
  if (result == RESULT_OK) result = load(world, light.path, output, plot, error);
  if (result == RESULT_OK) {
    struct ways_settings settings = {
        .lamp = light.path,
        .script = is_script(text),
        .placement = strstr(text, light.path) + strlen(light.path),
        .mesh = world->view.mesh,
        .repair = world->options.repair,
        .view = world_shade(world),
        .bakes = ways->bakes,
        .command = cli_command_line(),
        .error_count = ways->rungs,
        .pictures = ways->pictures,
        .time_limit = ways->time_limit,
        .all = ways->all,
        .progress = show,
        .progress_context = &progress,
        .stop = &stop,
    };
    memcpy(settings.errors, ways->ladder, sizeof settings.errors);
    catch_signals();
    progress_start(&progress, cli_quiet(), 0);
    result = measure(&settings, output, plot, &progress, error);
  }
  light_text_free(&light);
  return result;
}
