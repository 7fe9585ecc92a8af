/* cmd_irradiance.c - renderslab irradiance: the light that receivers read from stdin get. */
#include <stdio.h>
#include <stdlib.h>

#include "base/tiles.h"
#include "cli/cli.h"
#include "cmd/commands.h"
#include "cmd/receiver_text.h"
#include "cmd/stats.h"
#include "cmd/world.h"
#include "gl/gl_gather.h"
#include "shadow/occlusion.h"

enum { OPTION_MESH = 256 };

/* Receivers that are read, and answered, at a time; and a thread's share of them. */
enum { BLOCK = 16384, TILE = 64 };

static error_t parse(int key, char *value, struct argp_state *state) {
  struct world *world = state->input;
  const struct method *method = &gather_methods[world->options.method];
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &world->options;
    return 0;
  case OPTION_MESH:
    world->view.mesh = value;
    return 0;
  case ARGP_KEY_ARG:
    argp_error(state, "%s: receivers come from stdin, lights by --light", value);
    return 0;
  case ARGP_KEY_SUCCESS:
    if (method->matte_only && world->view.mesh)
      argp_error(state, "--method %s: cannot be used with --mesh; use reference", method->name);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

/* What the threads share. */
struct work {
  struct world *world;
  struct gather_settings settings;
  struct gather **gather; /* [threads] */
  struct gl_gather *gl;   /* method gl, in place of `gather` */
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
  if (gather_methods[settings->method].makes != METHOD_TREES_FOR_MANY ||
      settings->prepared->trees || many < GATHER_MANY)
    return RESULT_OK;
  return world_prepare(work->world, many, error);
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
      result = tiles_run(work->world->options.threads, tiles, work_tile, NULL, work, error);
    for (int k = 0; k < count && result == RESULT_OK; ++k) {
      const double *rgb = work->gathered[k].irradiance;
      printf("%.9g %.9g %.9g\n", rgb[0], rgb[1], rgb[2]);
    }
  } while (result == RESULT_OK && work->receivers.count == BLOCK && !ferror(stdout));
  return result;
}

static enum result prepare(struct work *work, struct error *error) {
  struct world *world = work->world;
  enum result result = world_prepare(world, 0, error);
  if (result != RESULT_OK) return result;
  work->settings = world_gather(world, true);
  work->gather = calloc((size_t)work->world->options.threads, sizeof *work->gather);
  work->gathered = calloc(BLOCK, sizeof *work->gathered);
  if (!work->gather || !work->gathered) return result_no_memory(error);
  const struct gl_sum_settings gl = world_gl(world, world->occlusion != NULL);
  if (gather_methods[world->options.method].sum == METHOD_OPENGL)
    return gl_gather_create(&gl, &work->gl, error);
  return gather_create_all(&work->settings, work->world->options.threads, work->gather, error);
}

static void finish(struct work *work, struct stats *stats) {
  if (work->gather) gather_free_all(work->gather, work->world->options.threads, &stats->counts);
  if (work->gl) gather_counts_add(&stats->counts, gl_gather_counts(work->gl));
  gl_gather_free(work->gl);
  free(work->gather);
  free(work->gathered);
  receiver_text_free(&work->receivers);
}

static enum result run(void *input, struct error *error) {
  struct world *world = input;
  const char *mesh = world->view.mesh;
  struct work work = {.world = world};
  struct stats stats = stats_start();
  enum result result = world_load_lights(world, &world->options.stats, 1, error);
  if (result == RESULT_OK && mesh) result = world_load_scene(world, SCENE_SHAPE, error);
  if (result == RESULT_OK && mesh)
    result = occlusion_create(&world->scene, &world->occlusion, error);
  if (result == RESULT_OK) {
    stats_effect(&stats, "shadows", mesh != NULL, mesh ? "%zu triangles" : "no --mesh",
                 world->scene.triangles);
    stats_phase(&stats, "prepare");
    result = prepare(&work, error);
    stats_phase(&stats, "gather");
  }
  if (result == RESULT_OK) result = answer(&work, error);
  finish(&work, &stats);
  result = stats_end(&stats, world, result, error);
  world_free(world);
  return result;
}

static const struct argp_option options_list[] = {
    {"mesh", OPTION_MESH, "MESH", 0,
     "A mesh (OBJ, glTF, PLY) that casts shadows, as opaque surfaces", 0},
    {0}};

static const char help_text[] =
    "Reads receivers `px py pz nx ny nz` (position and normal, scene space) from standard input, "
    "one a line, and prints the irradiance `er eg eb` of each from all lights. Empty lines and "
    "lines that start with # are skipped. A receiver in the uv plane has the limit of those in "
    "front of it; one behind it gets no light."
    "\vExamples:\n"
    "  echo 0 0 0  0 1 0 | renderslab irradiance --light 'lamp.tif at=0,190,20'\n"
    "  renderslab irradiance --light lamp.tif --method reference < receivers.txt";

int cmd_irradiance(int argc, char **argv) {
  static const struct argp_child children[] = {
      {&options_argp, 0, NULL, 0}, {&cli_argp, 0, NULL, 0}, {0}};
  static const struct argp argp = {options_list, parse, NULL, help_text, children, NULL, NULL};
  struct world world = {0};
  return cli_run(&argp, argc, argv, run, &world);
}
