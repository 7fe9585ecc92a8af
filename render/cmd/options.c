/* options.c - see options.h. */
#include "cmd/options.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/key_values.h"
#include "base/tiles.h"
#include "cli/cli.h"

enum {
  OPTION_LIGHT = 1000,
  OPTION_METHOD,
  OPTION_TOLERANCE,
  OPTION_LEVEL,
  OPTION_THREADS,
  OPTION_SEED,
  OPTION_STATS,
  OPTION_REPAIR,
  OPTION_EFFECTS,
  OPTION_SHADOW_GRID,
  OPTION_SHADOW_EDGE,
  OPTION_SHADOW_MAP,
  OPTION_SHADOW_GROUPS,
  OPTION_GL_PASSES
};

static const double least_tolerance = 1e-12;

enum {
  MOST_THREADS = 1024,
  MOST_LEVEL = 30,
  MOST_SHADOW_GRID = 256,
  MOST_SHADOW_EDGE = 65536,
  MOST_SHADOW_MAP = 16384,
  MOST_SHADOW_GROUPS = 1024
};

bool options_number(const char *text, double *number) {
  const char *end;
  return key_values_number_at(text, &end, number) && !*end;
}

bool options_numbers(const char *text, int count, double *numbers) {
  return !strpbrk(text, WORDS_BLANKS) && key_values_numbers(text, count, numbers);
}

bool options_count(const char *text, uint64_t low, uint64_t high, uint64_t *count) {
  if (!isdigit((unsigned char)*text)) return false;
  char *end;
  errno = 0;
  unsigned long long value = strtoull(text, &end, 10);
  if (errno || *end || value < low || value > high) return false;
  *count = value;
  return true;
}

static int parse_count(const char *option, const char *text, int high, struct argp_state *state) {
  uint64_t value = 1;
  if (!options_count(text, 1, (uint64_t)high, &value))
    argp_error(state, "%s %s: must be a whole number from 1 to %d", option, text, high);
  return (int)value;
}

static void parse_method(const char *name, struct options *options, struct argp_state *state) {
  if (gather_method_parse(name, &options->method)) return;
  if (!strcmp(name, gather_method_name(GATHER_GL))) {
    options->method = GATHER_GL;
    return;
  }
  char known[256] = "";
  size_t used = 0;
  for (int k = 0; k <= GATHER_GL && used < sizeof known; ++k)
    used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", k ? ", " : "",
                             gather_method_name((enum gather_method)k));
  argp_error(state, "--method %s: there are %s", name, known);
}

static void add_light(const char *text, struct options *options) {
  size_t room = sizeof *options->lights * ((size_t)options->light_count + 1);
  const char **lights = realloc(options->lights, room);
  if (!lights) cli_out_of_memory();
  options->lights = lights;
  options->lights[options->light_count++] = text;
}

static error_t parse_lights(int key, char *value, struct argp_state *state) {
  struct options *options = state->input;
  switch (key) {
  case OPTION_LIGHT:
    add_light(value, options);
    return 0;
  case OPTION_REPAIR:
    options->repair = true;
    return 0;
  case ARGP_KEY_SUCCESS:
    if (!options->light_count) argp_error(state, "no light given; add --light 'FILE [at=X,Y,Z]'");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static void set_defaults(struct options *options) {
  options->method = GATHER_AUTO;
  options->level = -1;
  options->shadow_map = 2048;
}

/* Options that some methods do not know: asking for them there is a mistake. */
#define OF(method) (1u << GATHER_##method)
static const struct {
  int key;
  unsigned methods; /* bits */
  const char *name, *of;
} bound[] = {
    {OPTION_LEVEL, OF(LEVELS) | OF(PAPER_LEVELS) | OF(GL), "level", "levels, paper-levels and gl"},
    {OPTION_SEED, OF(PAPER) | OF(PAPER_LEVELS), "seed", "paper and paper-levels"},
    {OPTION_SHADOW_GRID, ~OF(GL), "shadow-grid", "all methods but gl"},
    {OPTION_SHADOW_EDGE, ~OF(GL), "shadow-edge", "all methods but gl"},
    {OPTION_SHADOW_MAP, OF(GL), "shadow-map", "gl"},
    {OPTION_SHADOW_GROUPS, OF(GL), "shadow-groups", "gl"},
    {OPTION_GL_PASSES, OF(GL), "gl-passes", "gl"},
};

static void check_bound(const struct options *options, struct argp_state *state) {
  for (size_t k = 0; k < sizeof bound / sizeof *bound; ++k)
    if (options->given >> (bound[k].key - OPTION_LIGHT) & 1 &&
        !(bound[k].methods >> options->method & 1))
      argp_error(state, "--%s: not with --method %s; it is for %s", bound[k].name,
                 gather_method_name(options->method), bound[k].of);
}

/* Shadows as fine as the tolerance calls for, where that decides what is summed. */
static void set_shadows(struct options *options) {
  bool by_tolerance = options->method == GATHER_AUTO || options->method == GATHER_CUT;
  bool coarse = by_tolerance && options->tolerance >= 0.003;
  if (options->shadow_grid < 1) options->shadow_grid = coarse ? 8 : OPTIONS_SHADOW_GRID;
  if (options->shadow_edge < 1) options->shadow_edge = coarse ? 64 : OPTIONS_SHADOW_EDGE;
  if (options->shadow_edge < options->shadow_grid) options->shadow_edge = options->shadow_grid;
}

static void finish(struct options *options, struct argp_state *state) {
  if (!(options->tolerance > 0))
    options->tolerance = options->method == GATHER_REFERENCE ? 1e-6 : 0.01;
  if (options->threads < 1) options->threads = tiles_processors();
  if (options->shadow_edge > 0 && options->shadow_edge < options->shadow_grid)
    argp_error(state, "--shadow-edge %d: must not be less than --shadow-grid %d",
               options->shadow_edge, options->shadow_grid);
  check_bound(options, state);
  set_shadows(options);
}

static error_t parse_shadows(int key, const char *value, struct argp_state *state) {
  struct options *options = state->input;
  switch (key) {
  case OPTION_SHADOW_GRID:
    options->shadow_grid = parse_count("--shadow-grid", value, MOST_SHADOW_GRID, state);
    return 0;
  case OPTION_SHADOW_EDGE:
    options->shadow_edge = parse_count("--shadow-edge", value, MOST_SHADOW_EDGE, state);
    return 0;
  case OPTION_SHADOW_MAP:
    options->shadow_map = parse_count("--shadow-map", value, MOST_SHADOW_MAP, state);
    return 0;
  case OPTION_SHADOW_GROUPS:
    options->shadow_groups = parse_count("--shadow-groups", value, MOST_SHADOW_GROUPS, state);
    return 0;
  case OPTION_GL_PASSES:
    if (strcmp(value, "one") && strcmp(value, "views"))
      argp_error(state, "--gl-passes %s: there are one and views", value);
    options->gl_separate = !strcmp(value, "views");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static error_t parse_sum(int key, char *value, struct argp_state *state) {
  struct options *options = state->input;
  uint64_t level = 0;
  if (key >= OPTION_LIGHT && key <= OPTION_GL_PASSES) options->given |= 1u << (key - OPTION_LIGHT);
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = options;
    set_defaults(options);
    return 0;
  case OPTION_METHOD:
    parse_method(value, options, state);
    return 0;
  case OPTION_TOLERANCE:
    if (!options_number(value, &options->tolerance) || !(options->tolerance >= least_tolerance))
      argp_error(state,
                 "--tolerance %s: must be a number from %g on: double precision gives no less",
                 value, least_tolerance);
    return 0;
  case OPTION_LEVEL:
    if (!options_count(value, 0, MOST_LEVEL, &level))
      argp_error(state, "--level %s: must be a whole number from 0 to %d", value, MOST_LEVEL);
    options->level = (int)level;
    return 0;
  case OPTION_THREADS:
    options->threads = parse_count("--threads", value, MOST_THREADS, state);
    return 0;
  case OPTION_SEED:
    if (!options_count(value, 0, UINT64_MAX, &options->seed))
      argp_error(state, "--seed %s: must be a whole number from 0 to 2^64-1", value);
    return 0;
  case OPTION_STATS:
    options->stats = value;
    return 0;
  case OPTION_EFFECTS:
    if (strcmp(value, "auto") && strcmp(value, "all"))
      argp_error(state, "--effects %s: there are auto and all", value);
    options->all_effects = !strcmp(value, "all");
    return 0;
  case ARGP_KEY_SUCCESS:
    finish(options, state);
    return 0;
  default:
    return parse_shadows(key, value, state);
  }
}

static const struct argp_option light_options[] = {
    {"light", OPTION_LIGHT, "LIGHT", 0,
     "'FILE [at=X,Y,Z] [toward=X,Y,Z] [up=X,Y,Z] [matrix=12 numbers] [scale=S] [gain=G]': a slab "
     "and where it is; may be repeated",
     0},
    {"repair", OPTION_REPAIR, NULL, 0,
     "Mend the mesh: drop repeated triangles and those without area, make up normals and materials",
     0},
    {0}};

static const struct argp_option sum_options[] = {
    {"method", OPTION_METHOD, "METHOD", 0,
     "How light is summed: auto (the default), reference, paper, midpoint, pi, closed, views, "
     "levels, paper-levels, cut or gl",
     0},
    {"tolerance", OPTION_TOLERANCE, "T", 0,
     "Relative error that is allowed (default 0.01; 1e-6 for reference)", 0},
    {"level", OPTION_LEVEL, "K", 0,
     "Level of the hierarchy, for the methods levels and paper-levels (default: by solid angle) "
     "and "
     "gl (default: 0)",
     0},
    {"effects", OPTION_EFFECTS, "auto|all", 0,
     "auto (the default) traces no shadow rays where nothing stands between and sums nothing "
     "black; all skips nothing, to compare",
     0},
    {"shadow-grid", OPTION_SHADOW_GRID, "N", 0,
     "Shadow rays look at each aperture in N x N blocks (default 16; 8 for auto and cut with a "
     "tolerance of 0.003 or more)",
     0},
    {"shadow-edge", OPTION_SHADOW_EDGE, "N", 0,
     "and at edges of shadows in parts of 1/N of its sides (default 256; 64 where blocks are 8)",
     0},
    {"shadow-map", OPTION_SHADOW_MAP, "N", 0,
     "Method gl: shadow maps of N x N texels (default 2048)", 0},
    {"shadow-groups", OPTION_SHADOW_GROUPS, "G", 0,
     "Method gl: G x G shadow maps a page, each for a group of views, so that rims of shadows err "
     "by up to 1/(2G) of the light (default: one for each view)",
     0},
    {"gl-passes", OPTION_GL_PASSES, "one|views", 0,
     "Method gl: all views in one pass (the default), or one after the other, as published", 0},
    {"threads", OPTION_THREADS, "N", 0, "Threads (default: one a processor); same result", 0},
    {"seed", OPTION_SEED, "N", 0, "Of the methods paper and paper-levels (default 0)", 0},
    {"stats", OPTION_STATS, "FILE", 0, "Write what was done, and its time, as JSON", 0},
    {0}};

const struct argp options_lights_argp = {.options = light_options, .parser = parse_lights};

static const struct argp_child sum_children[] = {{&options_lights_argp, 0, NULL, 0}, {0}};
const struct argp options_argp = {
    .options = sum_options, .parser = parse_sum, .children = sum_children};

void options_free(struct options *options) {
  free(options->lights);
  memset(options, 0, sizeof *options);
}

enum result options_load_lights(const struct options *options, struct light **lights,
                                struct error *error) {
  int count = options->light_count;
  enum result result = RESULT_OK;
  *lights = calloc(count > 0 ? (size_t)count : 1, sizeof **lights);
  if (!*lights) return result_fail(error, RESULT_MEMORY, "out of memory for the lights");
  for (int k = 0; k < count && result == RESULT_OK; ++k)
    result = light_load(options->lights[k], &(*lights)[k], error);
  if (result != RESULT_OK) {
    options_free_lights(*lights, count);
    *lights = NULL;
  }
  return result;
}

void options_free_lights(struct light *lights, int count) {
  for (int k = 0; lights && k < count; ++k) light_free(&lights[k]);
  free(lights);
}

struct gather_settings options_settings(const struct options *options, const struct light *lights,
                                        const struct gather_prepared *aids,
                                        const struct occlusion *occlusion) {
  return (struct gather_settings){.lights = lights,
                                  .light_count = options->light_count,
                                  .aids = aids,
                                  .level = options->level,
                                  .all_effects = options->all_effects,
                                  .method = options->method,
                                  .tolerance = options->tolerance,
                                  .seed = options->seed,
                                  .occlusion = occlusion,
                                  .shadow_grid = options->shadow_grid,
                                  .shadow_edge = options->shadow_edge};
}

struct gl_sum_settings options_gl_settings(const struct options *options,
                                           const struct light *lights,
                                           const struct gather_prepared *aids,
                                           const struct scene *occluders) {
  return (struct gl_sum_settings){.lights = lights,
                                  .light_count = options->light_count,
                                  .levels = aids->levels,
                                  .level = options->level,
                                  .occluders = occluders,
                                  .map_size = options->shadow_map,
                                  .groups = options->shadow_groups,
                                  .separate = options->gl_separate};
}
