/* cmd_irradiance.c - renderslab irradiance: the light that receivers read from stdin get. */
#include <stdio.h>
#include <stdlib.h>

#include "base/tiles.h"
#include "cli/cli.h"
#include "cmd/commands.h"
#include "cmd/options.h"
#include "cmd/outputs.h"
#include "cmd/receiver_text.h"
#include "cmd/stats.h"
#include "gl/gl_gather.h"
#include "scene/scene.h"
#include "shadow/occlusion.h"

enum { OPTION_MESH = 256 };

/* Receivers that are read, and answered, at a time; and a thread's share of them. */
enum { BLOCK = 16384, TILE = 64 };

struct arguments {
  struct options options;
  const char *mesh;
};

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &arguments->options;
    return 0;
  case OPTION_MESH:
    arguments->mesh = value;
    return 0;
  case ARGP_KEY_ARG:
    argp_error(state, "%s: receivers come from stdin, lights by --light", value);
    return 0;
  case ARGP_KEY_SUCCESS:
    if (arguments->options.method == GATHER_CLOSED && arguments->mesh)
      argp_error(state, "--method closed: cannot be used with --mesh; use reference");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

/* What the threads share. */
struct work {
  struct gather_settings settings;
  struct gather_prepared aids;
  struct gather **gather; /* [threads] */
  struct gl_gather *gl;   /* method gl, in place of `gather` */
  int threads;
  struct receivers receivers;
  struct gathered *gathered; /* [BLOCK] */
};

static enum result work_tile(void *context, int tile, int worker, struct error *error) {
  struct work *work = context;
  struct receiver receivers[TILE] = {0};
  struct gathered gathered[TILE];
  int first = tile * TILE, count = work->receivers.count - first;
  if (count > TILE) count = TILE;
  const int *order = work->receivers.order + first;
  for (int k = 0; k < count; ++k) receivers[k] = work->receivers.receiver[order[k]];
  enum result result = gather_light(work->gather[worker], receivers, count, gathered, error);
  for (int k = 0; k < count && result == RESULT_OK; ++k) work->gathered[order[k]] = gathered[k];
  return result;
}

/* Once there have been so many receivers that it pays to prepare for more. */
static enum result prepare_for_many(struct work *work, struct error *error) {
  const struct gather_settings *settings = &work->settings;
  uint64_t many = work->receivers.index;
  if (settings->method != GATHER_AUTO || work->aids.trees || many < GATHER_MANY) return RESULT_OK;
  return gather_prepare(settings->lights, settings->light_count, settings->method, many,
                        work->threads, &work->aids, error);
}

static enum result answer(struct work *work, struct error *error) {
  enum result result;
  do {
    result = prepare_for_many(work, error);
    if (result == RESULT_OK) result = receiver_text_read(stdin, BLOCK, &work->receivers, error);
    int count = work->receivers.count, tiles = (count + TILE - 1) / TILE;
    if (result == RESULT_OK && work->gl)
      result = gl_gather_light(work->gl, work->receivers.receiver, count, work->gathered, error);
    else if (result == RESULT_OK)
      result = tiles_run(work->threads, tiles, work_tile, NULL, work, error);
    for (int k = 0; k < count && result == RESULT_OK; ++k) {
      const double *rgb = work->gathered[k].irradiance;
      printf("%.9g %.9g %.9g\n", rgb[0], rgb[1], rgb[2]);
    }
  } while (result == RESULT_OK && work->receivers.count == BLOCK && !ferror(stdout));
  return result;
}

/* `gl`: settings of the method gl, NULL for others. */
static enum result prepare(struct work *work, const struct gl_sum_settings *gl,
                           struct error *error) {
  work->gather = calloc((size_t)work->threads, sizeof *work->gather);
  work->gathered = calloc(BLOCK, sizeof *work->gathered);
  if (!work->gather || !work->gathered) return result_fail(error, RESULT_MEMORY, "out of memory");
  enum result result = RESULT_OK;
  if (gl) return gl_gather_create(gl, &work->gl, error);
  for (int k = 0; k < work->threads && result == RESULT_OK; ++k)
    result = gather_create(&work->settings, &work->gather[k], error);
  return result;
}

static void finish(struct work *work, struct stats *stats) {
  for (int k = 0; work->gather && k < work->threads; ++k) {
    if (work->gather[k]) gather_counts_add(&stats->counts, gather_counts(work->gather[k]));
    gather_free(work->gather[k]);
  }
  if (work->gl) gather_counts_add(&stats->counts, gl_gather_counts(work->gl));
  gl_gather_free(work->gl);
  free(work->gather);
  free(work->gathered);
  receiver_text_free(&work->receivers);
}

static enum result run(const struct arguments *arguments, struct stats *stats,
                       struct error *error) {
  const struct options *options = &arguments->options;
  struct light *lights = NULL;
  struct scene scene = {0};
  struct occlusion *occlusion = NULL;
  struct work work = {.threads = options->threads};
  char note[256] = "";
  stats_phase(stats, "load");
  enum result result = outputs_check(&options->stats, 1, &arguments->mesh, 1, error);
  if (result == RESULT_OK) result = options_load_lights(options, &lights, error);
  if (result == RESULT_OK && arguments->mesh) {
    result = scene_load(arguments->mesh, SCENE_SHAPE, options->repair, &scene, note, error);
    if (result == RESULT_OK) result = occlusion_create(&scene, &occlusion, error);
  }
  if (result == RESULT_OK) {
    if (*note) cli_note("note: %s", note);
    stats_effect(stats, "shadows", occlusion != NULL, occlusion ? "%zu triangles" : "no --mesh",
                 scene.triangles);
    work.settings = options_settings(options, lights, &work.aids, occlusion);
    stats_phase(stats, "prepare");
    result = gather_prepare(lights, options->light_count, options->method, 0, options->threads,
                            &work.aids, error);
    struct gl_sum_settings gl =
        options_gl_settings(options, lights, &work.aids, arguments->mesh ? &scene : NULL);
    if (result == RESULT_OK)
      result = prepare(&work, options->method == GATHER_GL ? &gl : NULL, error);
    stats_phase(stats, "gather");
  }
  if (result == RESULT_OK) result = answer(&work, error);
  finish(&work, stats);
  if (result == RESULT_OK && options->stats)
    result = stats_write(stats, lights, options->light_count, options->stats, error);
  gather_prepared_free(&work.aids);
  occlusion_free(occlusion);
  scene_free(&scene);
  options_free_lights(lights, options->light_count);
  return result;
}

int cmd_irradiance(int argc, char **argv) {
  static const struct argp_option option[] = {
      {"mesh", OPTION_MESH, "FILE", 0, "A mesh (OBJ, glTF, PLY) that casts shadows", 0}, {0}};
  const struct argp_child children[] = {{&options_argp, 0, NULL, 0}, cli_options[0], {0}};
  const struct argp argp = {
      .options = option,
      .parser = parse,
      .children = children,
      .doc = "Reads receivers `px py pz nx ny nz` (position and normal, scene space) from standard "
             "input, one a line, and prints the irradiance `er eg eb` of each from all lights. "
             "Empty lines and lines that start with # are skipped. A receiver in the uv plane has "
             "the limit of those in front of it; one behind it gets no light."
             "\vExamples:\n"
             "  echo 0 0 0  0 1 0 | renderslab irradiance --light 'lamp.tif at=0,2,0'\n"
             "  renderslab irradiance --light lamp.tif --method reference < receivers.txt"};
  struct arguments arguments = {0};
  struct stats stats = {0};
  struct error error = {{0}};
  cli_parse(&argp, argc, argv, &arguments);
  const struct options *options = &arguments.options;
  stats.command = cli_command_line();
  stats.method = gather_method_name(options->method);
  stats.tolerance = options->tolerance;
  stats.threads = options->threads;
  enum result result = run(&arguments, &stats, &error);
  options_free(&arguments.options);
  int status = result == RESULT_OK ? CLI_OK : cli_fail(&error);
  return cli_close_stdout() == CLI_OK ? status : CLI_FAILED;
}
