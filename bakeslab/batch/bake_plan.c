#include "batch/bake_plan.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The longest side of a box. */
static int longest_side(enum bake_form form) {
  return form == BAKE_MESH ? BAKE_MESH_SIDE : INT_MAX;
}

/* ---- Tiles ---- */

/* The axes that a camera covers: s and t or, transposed, u and v; and the others. k: 0 or 1. */
static int covered_axis(const struct bake_tiles *tiles, int k) {
  return (tiles->transposed ? SLAB_U : SLAB_S) + k;
}

static int fixed_axis(const struct bake_tiles *tiles, int k) {
  return (tiles->transposed ? SLAB_S : SLAB_U) + k;
}

/* Width of a tile along an axis. */
static int tile_size(const struct bake_tiles *tiles, int page, int axis) {
  int n = tiles->slabs[page].samples[axis];
  if (axis == fixed_axis(tiles, 0) || axis == fixed_axis(tiles, 1)) return 1;
  return n < 2 * tiles->side ? n : tiles->side;
}

void bake_tile_grid(const struct bake_tiles *tiles, int page, int grid[SLAB_AXES]) {
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    int size = tile_size(tiles, page, axis);
    grid[axis] = (tiles->slabs[page].samples[axis] + size - 1) / size;
  }
}

static int count_apertures(const struct slab *slabs, int pages) {
  int n = 1;
  while (n < pages && slab_same_channel(&slabs[n], &slabs[0])) ++n;
  return n;
}

enum result bake_tiles_init(struct bake_tiles *tiles, const struct slab *slabs, int pages,
                            bool transposed, int side, struct error *error) {
  *tiles = (struct bake_tiles){.pages = pages,
                               .apertures = count_apertures(slabs, pages),
                               .slabs = slabs,
                               .transposed = transposed,
                               .side = side};
  tiles->first_tile = calloc((size_t)pages + 1, sizeof *tiles->first_tile);
  if (!tiles->first_tile) return result_no_memory(error);
  for (int page = 0; page < pages; ++page) {
    int grid[SLAB_AXES];
    bake_tile_grid(tiles, page, grid);
    int64_t count = (int64_t)grid[0] * grid[1] * grid[2] * grid[3];
    if (count > INT32_MAX / 2 - tiles->first_tile[page])
      return result_fail(error, RESULT_BAD, "too many samples; choose fewer with --uv or --st");
    tiles->first_tile[page + 1] = tiles->first_tile[page] + (int)count;
  }
  return RESULT_OK;
}

void bake_tiles_free(struct bake_tiles *tiles) {
  free(tiles->first_tile);
  *tiles = (struct bake_tiles){0};
}

int bake_tile_count(const struct bake_tiles *tiles) {
  return tiles->first_tile[tiles->pages];
}

bool bake_tile_next(const int grid[SLAB_AXES], int at[SLAB_AXES]) {
  static const int fastest_first[SLAB_AXES] = {SLAB_S, SLAB_T, SLAB_U, SLAB_V};
  for (int n = 0; n < SLAB_AXES; ++n) {
    int axis = fastest_first[n];
    if (++at[axis] < grid[axis]) return true;
    at[axis] = 0;
  }
  return false;
}

struct bake_box bake_tile_box(const struct bake_tiles *tiles, int page, const int at[SLAB_AXES]) {
  struct bake_box box = {.page = page};
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    int size = tile_size(tiles, page, axis), n = tiles->slabs[page].samples[axis];
    box.first[axis] = at[axis] * size;
    box.size[axis] = box.first[axis] + size > n ? n - box.first[axis] : size;
  }
  return box;
}

int bake_tile_number(const struct bake_tiles *tiles, int page, const int at[SLAB_AXES]) {
  int grid[SLAB_AXES];
  bake_tile_grid(tiles, page, grid);
  int n = ((at[SLAB_V] * grid[SLAB_U] + at[SLAB_U]) * grid[SLAB_T] + at[SLAB_T]) * grid[SLAB_S] +
          at[SLAB_S];
  return tiles->first_tile[page] + n;
}

int bake_tile_at(const struct bake_tiles *tiles, int page, const int sample[SLAB_AXES]) {
  int at[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    at[axis] = sample[axis] / tile_size(tiles, page, axis);
  return bake_tile_number(tiles, page, at);
}

/* ---- Rounds ---- */

void bake_round_free(struct bake_round *round) {
  free(round->boxes);
  free(round->units);
  free(round->batches);
  *round = (struct bake_round){0};
}

static bool add_box(struct bake_round *round, struct bake_box box) {
  size_t count = round->box_count;
  if (!(count & (count - 1))) { /* 0 or a power of two: full */
    struct bake_box *grown = realloc(round->boxes, (count ? 2 * count : 1) * sizeof *grown);
    if (!grown) return false;
    round->boxes = grown;
  }
  round->boxes[round->box_count++] = box;
  return true;
}

/* Adds a box in parts with sides of at most `most`. */
static bool add_parts(struct bake_round *round, struct bake_box box, int most) {
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    if (box.size[axis] <= most) continue;
    struct bake_box rest = box;
    box.size[axis] = most;
    rest.first[axis] += most;
    rest.size[axis] -= most;
    return add_parts(round, box, most) && add_parts(round, rest, most);
  }
  return add_box(round, box);
}

/* A stride that visits each of `count` things once, consecutive ones far apart: near the golden
 * section of the count, and without a common factor. */
static size_t spreading_stride(size_t count) {
  size_t stride = (size_t)(0.6180339887498949 * (double)count);
  for (;; ++stride) {
    size_t a = count, b = stride;
    while (b) {
      size_t rest = a % b;
      a = b, b = rest;
    }
    if (a == 1) return stride;
  }
}

static int channel_of(const struct bake_round *round, size_t box) {
  return round->boxes[box].page / round->apertures;
}

/* All passes from `from` to before `to` of the boxes from `box` on, channel by channel, pairs
 * together. Each batch samples interreflection anew and comes out a little brighter or darker than
 * others: `spread` puts neighbouring boxes into different batches, so that no seam runs through the
 * slab. */
static bool add_passes(struct bake_round *round, size_t box, int from, int to, bool spread) {
  size_t room = round->unit_count + (round->box_count - box) * (size_t)(to - from) + 1;
  struct bake_unit *units = realloc(round->units, room * sizeof *units);
  if (!units) return false;
  round->units = units;
  for (size_t end; box < round->box_count; box = end) {
    for (end = box; end < round->box_count && channel_of(round, end) == channel_of(round, box);)
      ++end;
    size_t count = end - box, stride = spread ? spreading_stride(count) : 1;
    for (int pair = from; pair < to; pair += 2)
      for (size_t n = 0, at = 0; n < count; ++n, at = (at + stride) % count)
        for (int pass = pair; pass < pair + 2 && pass < to; ++pass)
          units[round->unit_count++] = (struct bake_unit){(int)(box + at), pass};
  }
  return true;
}

/* The box among those from `first` on that `box` continues downwards without growing
 * longer than `most`; or the number of boxes. */
static size_t find_above(const struct bake_round *round, size_t first, const struct bake_box *box,
                         int x_axis, int y_axis, int most) {
  size_t n = first;
  for (; n < round->box_count; ++n) {
    const struct bake_box *above = &round->boxes[n];
    if (above->first[x_axis] == box->first[x_axis] && above->size[x_axis] == box->size[x_axis] &&
        above->first[y_axis] + above->size[y_axis] == box->first[y_axis] &&
        above->size[y_axis] <= most - box->size[y_axis])
      break;
  }
  return n;
}

/* Covers the tiles of one camera that want more than `passes` by rectangles: runs of
 * tiles along a row, joined with a run of the same extent in the row before. */
static bool add_covering(const struct bake_tiles *tiles, int page, int at[SLAB_AXES],
                         const int *wanted, int passes, int most, struct bake_round *round) {
  int x_axis = covered_axis(tiles, 0), y_axis = covered_axis(tiles, 1), grid[SLAB_AXES];
  bake_tile_grid(tiles, page, grid);
  size_t first = round->box_count;
  for (int y = 0; y < grid[y_axis]; ++y)
    for (int x = 0; x < grid[x_axis]; ++x) {
      at[x_axis] = x, at[y_axis] = y;
      if (wanted[bake_tile_number(tiles, page, at)] <= passes) continue;
      struct bake_box box = bake_tile_box(tiles, page, at);
      for (; x + 1 < grid[x_axis]; ++x) {
        at[x_axis] = x + 1;
        int width = bake_tile_box(tiles, page, at).size[x_axis];
        if (wanted[bake_tile_number(tiles, page, at)] <= passes) break;
        if (box.size[x_axis] > most - width) break;
        box.size[x_axis] += width;
      }
      size_t above = find_above(round, first, &box, x_axis, y_axis, most);
      if (above < round->box_count)
        round->boxes[above].size[y_axis] += box.size[y_axis];
      else if (!add_box(round, box))
        return false;
    }
  return true;
}

/* The whole image of one camera, in as few boxes as `most` allows. */
static bool add_whole(const struct bake_tiles *tiles, int page, const int at[SLAB_AXES], int most,
                      struct bake_round *round) {
  struct bake_box box = {.page = page};
  for (int k = 0; k < 2; ++k) {
    box.first[fixed_axis(tiles, k)] = at[fixed_axis(tiles, k)];
    box.size[fixed_axis(tiles, k)] = 1;
    box.size[covered_axis(tiles, k)] = tiles->slabs[page].samples[covered_axis(tiles, k)];
  }
  return add_parts(round, box, most);
}

/* The boxes of all cameras: of the tiles that want more than `passes`, or of all (NULL). */
static bool add_boxes(const struct bake_tiles *tiles, const int *wanted, int passes, int most,
                      struct bake_round *round) {
  bool good = true;
  for (int page = 0; page < tiles->pages; ++page) {
    const int *n = tiles->slabs[page].samples;
    for (int y = 0; y < n[fixed_axis(tiles, 1)]; ++y)
      for (int x = 0; x < n[fixed_axis(tiles, 0)] && good; ++x) {
        int at[SLAB_AXES] = {0};
        at[fixed_axis(tiles, 0)] = x, at[fixed_axis(tiles, 1)] = y;
        good = wanted ? add_covering(tiles, page, at, wanted, passes, most, round)
                      : add_whole(tiles, page, at, most, round);
      }
  }
  return good;
}

enum result bake_plan_whole(const struct bake_tiles *tiles, int from, int to, enum bake_form form,
                            struct bake_round *round, struct error *error) {
  *round = (struct bake_round){.apertures = tiles->apertures};
  if (!add_boxes(tiles, NULL, 0, longest_side(form), round) ||
      !add_passes(round, 0, from, to, true))
    return result_no_memory(error);
  return bake_plan_cut(tiles, round, form, error);
}

/* The least that any tile has of those that lack passes, and the most that any is to get. */
static void find_range(const struct bake_tiles *tiles, const int *done, const int *wanted,
                       int range[2]) {
  range[0] = INT_MAX, range[1] = 0;
  for (int tile = 0; tile < bake_tile_count(tiles); ++tile) {
    if (wanted[tile] > done[tile] && done[tile] < range[0]) range[0] = done[tile];
    if (wanted[tile] > range[1]) range[1] = wanted[tile];
  }
}

enum result bake_plan_rest(const struct bake_tiles *tiles, const int *done, const int *wanted,
                           enum bake_form form, struct bake_round *round, struct error *error) {
  int count = bake_tile_count(tiles), range[2];
  int *step = malloc((size_t)count * sizeof *step); /* wanted, of tiles that lack all of a step */
  bool good = step != NULL;
  *round = (struct bake_round){.apertures = tiles->apertures};
  find_range(tiles, done, wanted, range);
  for (int from = range[0], to; from < range[1] && good; from = to) {
    size_t box = round->box_count;
    to = from < 4 ? 4 : 2 * from;
    if (to > range[1]) to = range[1];
    for (int tile = 0; tile < count; ++tile) step[tile] = done[tile] <= from ? wanted[tile] : 0;
    good = add_boxes(tiles, step, from, longest_side(form), round) &&
           add_passes(round, box, from, to, form == BAKE_MESH);
  }
  free(step);
  return good ? bake_plan_cut(tiles, round, form, error) : result_no_memory(error);
}
