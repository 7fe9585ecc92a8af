#include "cmd/options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "base/numbers.h"
#include "base/tiles.h"
#include "cli/cli.h"
#include "cli/values.h"
#include "shadow/visible.h"

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

/* ---- The lights ---- */

static void add_light(const char *text, struct options *options) {
  int room = options->light_count;
  if (!array_reserve(&options->lights, &room, room + 1, sizeof text)) cli_out_of_memory();
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

static const struct argp_option light_options[] = {
    {"light", OPTION_LIGHT, "LIGHT", 0,
     "'FILE [at=X,Y,Z] [toward=X,Y,Z] [up=X,Y,Z] [matrix=12 numbers] [scale=S] "
     "[gain=G|R,G,B|lumens=L] [kelvin=K] [metres=M] [gain.CHANNEL=G]': a slab, where it is, and "
     "how "
     "bright: gain multiplies its radiance, that of a channel the light of a group of bulbs that "
     "it "
     "has apart (`bakeslab info' names them), lumens make its flux (and its radiance cd/m2), "
     "kelvin, 1000 to 40000, is its colour; where scale converts units, metres is the scene's "
     "unit; "
     "may be "
     "repeated",
     0},
    {"repair", OPTION_REPAIR, NULL, 0,
     "Mend the mesh: drop repeated triangles, those without area and faces that cross themselves, "
     "make up normals and materials, do without textures that cannot be read",
     0},
    {0}};

const struct argp options_lights_argp = {.options = light_options, .parser = parse_lights};

/* ---- How their light is summed ---- */

static const struct argp_option sum_options[] = {
    {"method", OPTION_METHOD, "METHOD", 0, "How light is summed:", 0}, /* help() adds the methods */
    {"tolerance", OPTION_TOLERANCE, "T", 0,
     "Relative error that is allowed (default 0.01; 1e-6 for reference)", 0},
    {"level", OPTION_LEVEL, "K", 0,
     "Level of the hierarchy, for the methods levels and paper-levels (default: by solid angle) "
     "and gl (default: 0)",
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
     "At edges of shadows, shadow rays look at parts of 1/N of an aperture's sides (default 256; "
     "64 where blocks are 8)",
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

#define OPTION(member) offsetof(struct options, member)
static const struct value values[] = {
    /* Double precision gives no less. */
    {OPTION_TOLERANCE, VALUE_REAL, OPTION(tolerance), 1e-12, INFINITY},
    {OPTION_LEVEL, VALUE_WHOLE, OPTION(level), 0, OPTIONS_MOST_LEVEL},
    {OPTION_EFFECTS, VALUE_EITHER, OPTION(all_effects), 0, 0},
    {OPTION_SHADOW_GRID, VALUE_WHOLE, OPTION(shadow_grid), 1, 256},
    {OPTION_SHADOW_EDGE, VALUE_WHOLE, OPTION(shadow_edge), 1, VISIBLE_MOST_EDGE},
    {OPTION_SHADOW_MAP, VALUE_WHOLE, OPTION(shadow_map), 1, 16384},
    {OPTION_SHADOW_GROUPS, VALUE_WHOLE, OPTION(shadow_groups), 1, 1024},
    {OPTION_GL_PASSES, VALUE_EITHER, OPTION(gl_separate), 0, 0},
    {OPTION_THREADS, VALUE_WHOLE, OPTION(threads), 1, OPTIONS_MOST_THREADS},
    {OPTION_STATS, VALUE_TEXT, OPTION(stats), 0, 0},
    {0}};

/* Options that not all methods take: asking others for them is a mistake. */
static const struct {
  int key;
  unsigned takes;
  const char *name;
} bound[] = {
    {OPTION_LEVEL, METHOD_TAKES_LEVEL, "level"},
    {OPTION_SEED, METHOD_TAKES_SEED, "seed"},
    {OPTION_SHADOW_GRID, METHOD_TAKES_SHADOW_RAYS, "shadow-grid"},
    {OPTION_SHADOW_EDGE, METHOD_TAKES_SHADOW_RAYS, "shadow-edge"},
    {OPTION_SHADOW_MAP, METHOD_TAKES_SHADOW_MAPS, "shadow-map"},
    {OPTION_SHADOW_GROUPS, METHOD_TAKES_SHADOW_MAPS, "shadow-groups"},
    {OPTION_GL_PASSES, METHOD_TAKES_SHADOW_MAPS, "gl-passes"},
};

/* The names of the methods that take all of these, with commas between. */
static const char *list_methods(unsigned takes, char list[256]) {
  size_t used = 0;
  for (int k = 0; k < GATHER_METHODS; ++k)
    if ((gather_methods[k].takes & takes) == takes)
      used += (size_t)snprintf(list + used, 256 - used, "%s%s", used ? ", " : "",
                               gather_methods[k].name);
  return list;
}

static void check_bound(const struct options *options, struct argp_state *state) {
  char list[256];
  for (size_t k = 0; k < sizeof bound / sizeof *bound; ++k)
    if (options->given >> (bound[k].key - OPTION_LIGHT) & 1 &&
        !(gather_methods[options->method].takes & bound[k].takes))
      argp_error(state, "--%s: not with --method %s; it is for %s", bound[k].name,
                 gather_methods[options->method].name, list_methods(bound[k].takes, list));
}

/* Shadows as fine as the tolerance calls for, where that decides what is summed. */
static void set_shadows(struct options *options) {
  const struct method *method = &gather_methods[options->method];
  bool coarse = method->sum == METHOD_CHEAPEST && method->dial == METHOD_BY_TOLERANCE &&
                options->tolerance >= 0.003;
  if (options->shadow_grid < 1) options->shadow_grid = coarse ? 8 : OPTIONS_SHADOW_GRID;
  if (options->shadow_edge < 1) options->shadow_edge = coarse ? 64 : OPTIONS_SHADOW_EDGE;
  if (options->shadow_edge < options->shadow_grid) options->shadow_edge = options->shadow_grid;
}

static void finish(struct options *options, struct argp_state *state) {
  if (!(options->tolerance > 0)) options->tolerance = gather_methods[options->method].tolerance;
  if (options->threads < 1) options->threads = tiles_processors();
  if (options->shadow_edge > 0 && options->shadow_edge < options->shadow_grid)
    argp_error(state, "--shadow-edge %d: must not be less than --shadow-grid %d",
               options->shadow_edge, options->shadow_grid);
  check_bound(options, state);
  set_shadows(options);
}

static error_t parse_sum(int key, char *value, struct argp_state *state) {
  struct options *options = state->input;
  char list[256];
  if (key >= OPTION_LIGHT && key <= OPTION_GL_PASSES) options->given |= 1u << (key - OPTION_LIGHT);
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = options;
    options->method = GATHER_AUTO;
    options->level = -1;
    options->shadow_map = 2048;
    return 0;
  case OPTION_METHOD:
    if (!method_parse(value, &options->method))
      argp_error(state, "--method %s: there are %s", value, list_methods(0, list));
    return 0;
  case OPTION_SEED:
    if (!numbers_whole(value, 0, UINT64_MAX, &options->seed))
      argp_error(state, "--seed %s: must be a whole number from 0 to 2^64-1", value);
    return 0;
  case ARGP_KEY_SUCCESS:
    finish(options, state);
    return 0;
  default:
    return values_take(values, sum_options, key, value, options, state);
  }
}

/* argp's text for an option, allocated where it is not ours. */
static char *help(int key, const char *text, void *input) {
  (void)input;
  char *made = NULL;
  size_t size = 0;
  FILE *out = key == OPTION_METHOD ? open_memstream(&made, &size) : NULL;
  if (!out) return (char *)text;
  fputs(text, out);
  for (int k = 0; k < GATHER_METHODS; ++k)
    fprintf(out, "%s %s (%s%s)", k ? "," : "", gather_methods[k].name,
            k == GATHER_AUTO ? "the default: " : "", gather_methods[k].help);
  return fclose(out) == 0 && made ? made : (char *)text;
}

static const struct argp_child sum_children[] = {{&options_lights_argp, 0, NULL, 0}, {0}};
const struct argp options_argp = {
    .options = sum_options, .parser = parse_sum, .children = sum_children, .help_filter = help};

void options_free(struct options *options) {
  free(options->lights);
  memset(options, 0, sizeof *options);
}
