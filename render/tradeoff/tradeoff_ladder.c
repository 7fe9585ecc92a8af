/* tradeoff_ladder.c - the settings at which methods are measured. */
#include "tradeoff/tradeoff.h"

/* The commands' default, of methods that have another dial. */
static const double usual_tolerance = 0.01;

/* Of shadows: blocks and edges in shares of an aperture. */
enum { COARSEST_GRID = 4, COARSEST_EDGE = 8 };

struct ladder {
  const struct gather_settings *usual;
  struct tradeoff_rung *rungs;
  int count;
};

static void add(struct ladder *ladder, enum gather_method method, double tolerance, int level) {
  if (ladder->count == TRADEOFF_MOST_RUNGS) return;
  ladder->rungs[ladder->count++] =
      (struct tradeoff_rung){.method = method,
                             .tolerance = tolerance,
                             .level = level,
                             .shadow_grid = ladder->usual->shadow_grid,
                             .shadow_edge = ladder->usual->shadow_edge};
}

/* 0.1, 0.03, 0.01, 0.003, ... */
static void add_tolerances(struct ladder *ladder, enum gather_method method, double finest) {
  double decade = 0.1;
  bool third = false;
  double tolerance = decade;
  do {
    add(ladder, method, tolerance, TRADEOFF_NO_LEVEL);
    if (third) decade /= 10;
    third = !third;
    tolerance = third ? 0.3 * decade : decade;
  } while (tolerance >= 0.999 * finest && ladder->count < TRADEOFF_MOST_RUNGS);
}

static void add_method(struct ladder *ladder, enum gather_method method, double finest,
                       int levels) {
  switch (gather_methods[method].dial) {
  case METHOD_NO_DIAL:
    add(ladder, method, 0, TRADEOFF_NO_LEVEL);
    return;
  case METHOD_BY_TOLERANCE:
    add_tolerances(ladder, method, finest);
    return;
  case METHOD_BY_LEVEL:
    for (int level = 0; level <= levels; ++level) add(ladder, method, usual_tolerance, level);
    add(ladder, method, usual_tolerance, -1);
  }
}

/* Edges from 1/8 up to twice as fine as usual, looked for in as fine blocks as pays. */
static void add_shadows(struct ladder *ladder) {
  const struct gather_settings *usual = ladder->usual;
  for (int edge = COARSEST_EDGE; edge <= 2 * usual->shadow_edge; edge *= 2) {
    int grid = edge / 16 > COARSEST_GRID ? edge / 16 : COARSEST_GRID, rung = ladder->count;
    add(ladder, GATHER_AUTO, usual_tolerance, TRADEOFF_NO_LEVEL);
    if (ladder->count == rung) return;
    ladder->rungs[rung].shadow_grid = grid < usual->shadow_grid ? grid : usual->shadow_grid;
    ladder->rungs[rung].shadow_edge = edge;
    ladder->rungs[rung].shadows = true;
  }
}

int tradeoff_ladder(const struct tradeoff_settings *settings, int levels,
                    struct tradeoff_rung rungs[TRADEOFF_MOST_RUNGS]) {
  struct ladder ladder = {.usual = &settings->gather, .rungs = rungs};
  for (int k = 0; k < GATHER_METHODS; ++k)
    if (settings->methods[k] && (!gather_methods[k].matte_only || settings->matte))
      add_method(&ladder, (enum gather_method)k, settings->finest, levels);
  if (settings->methods[GATHER_AUTO] && settings->gather.occlusion) add_shadows(&ladder);
  return ladder.count;
}
