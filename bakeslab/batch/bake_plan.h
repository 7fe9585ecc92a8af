/* bake_plan.h - what a bake renders: which boxes in which passes, cut into batches.
 *
 * Tiles (a position and a tile of directions, or the transpose) get their passes round by round
 * (bake_rounds.c). Nothing in a plan depends on the number of jobs, so that several processes make
 * the same one from the same sums. */
#ifndef BAKE_PLAN_H
#define BAKE_PLAN_H

#include "batch/bake_rays.h"

/* The side of the largest mesh of directions, whose parsing grows faster than its faces do. */
enum { BAKE_MESH_SIDE = 64 };

enum bake_form { BAKE_MESH, BAKE_PERSPECTIVE, BAKE_TRANSPOSED };

/* A grid of tiles over each page: a tile is one sample wide along the axes that a
 * camera doesn't cover. Tiles of all pages are numbered through. Of a lamp with channels, the pages
 * of one come after those of another, all alike. */
struct bake_tiles {
  int pages;
  int apertures;            /* pages of one channel */
  const struct slab *slabs; /* not owned */
  bool transposed;          /* a camera covers u and v rather than s and t */
  bool dear;                /* photons or interreflection: each process costs many rays */
  int side;                 /* of a tile, in samples; of shorter axes the whole */
  int *first_tile;          /* [pages + 1] */
};

enum result bake_tiles_init(struct bake_tiles *tiles, const struct slab *slabs, int pages,
                            bool transposed, int side, struct error *error);
void bake_tiles_free(struct bake_tiles *tiles);
int bake_tile_count(const struct bake_tiles *tiles);
/* Tiles along each axis of a page. */
void bake_tile_grid(const struct bake_tiles *tiles, int page, int grid[SLAB_AXES]);
/* Moves to the next place in that grid, in the order of numbers; false after the last. */
bool bake_tile_next(const int grid[SLAB_AXES], int at[SLAB_AXES]);
/* The box of a tile, given its place in that grid. */
struct bake_box bake_tile_box(const struct bake_tiles *tiles, int page, const int at[SLAB_AXES]);
/* The number of a tile, given its place in its page's grid. */
int bake_tile_number(const struct bake_tiles *tiles, int page, const int at[SLAB_AXES]);
/* The number of the tile that holds a sample. */
int bake_tile_at(const struct bake_tiles *tiles, int page, const int sample[SLAB_AXES]);

struct bake_unit {
  int box, pass; /* one image of one camera */
};

/* Units rendered by one POV-Ray process, all of one channel. Both passes of a pair are in the same
 * batch if they are in the same round. */
struct bake_batch {
  size_t first, count; /* in units[] */
  size_t rays;
  char key[33]; /* under which the store has it; by bake_run_keys */
};

struct bake_round {
  struct bake_box *boxes;
  struct bake_unit *units;
  struct bake_batch *batches;
  size_t box_count, unit_count, batch_count;
  int apertures;     /* of its tiles */
  const char *label; /* what it is, for progress; NULL until it is run; not owned */
};
void bake_round_free(struct bake_round *round);

/* Cuts a round's units into batches (bake_cut.c). Another version cuts otherwise: what lies of it
 * in a folder is of another plan. */
enum { BAKE_PLAN_CUT_VERSION = 2 };
enum result bake_plan_cut(const struct bake_tiles *tiles, struct bake_round *round,
                          enum bake_form form, struct error *error);

/* Passes from `from` to before `to` everywhere, one box a camera. */
enum result bake_plan_whole(const struct bake_tiles *tiles, int from, int to, enum bake_form form,
                            struct bake_round *round, struct error *error);

/* About how many batches as many passes everywhere have, the rays of the largest, and how many
 * frames of animations there are in all. */
struct bake_plan_size {
  double batches, largest, frames;
};
void bake_plan_count(const struct slab *slabs, int pages, int passes, enum bake_form form,
                     bool dear, struct bake_plan_size *size);

/* What bounds the rays of a bake. */
struct bake_limits {
  int rays;        /* a sample, on average */
  int rays_max;    /* of a tile */
  double variance; /* of the flux's, this part of what it is by now is little enough */
};

/* Passes for each tile (bake_allocate.c): as few as reach the limit of variance, but at most the
 * limits' rays; in proportion to the tile's deviation (Neyman's allocation), each what the tile has
 * times a power of two, or rays_max. deviation[] is the standard deviation of what a pair of passes
 * adds to the flux by a sample, by tile; passes[] what tiles have, and then what they are to get,
 * which is nothing where they have none. */
enum result bake_plan_allocate(const struct bake_tiles *tiles, const double *deviation,
                               const struct bake_limits *limits, int *passes, struct error *error);

/* The passes that tiles lack: from done[] to wanted[], in as few boxes as possible. Both are 0,
 * 4, 8, 16, ..., but the greatest wanted[] may be any number. */
enum result bake_plan_rest(const struct bake_tiles *tiles, const int *done, const int *wanted,
                           enum bake_form form, struct bake_round *round, struct error *error);

#endif
