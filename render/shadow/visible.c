/* visible.c - the visible cells of a rectangle, as the rule of visible.h says.
 *   1. Cut the rectangle into grid x grid blocks.
 *   2. Trace rays to the corners and the middle of each block (ask_blocks, trace).
 *   3. Mark blocks whose rays are all clear as visible; quarter those whose rays disagree, down to
 *      cells of 1/n of the sides, n = grid * 2^levels, and go on with 2 (decide).
 *   4. Merge the visible cells into rectangles, rows or columns of cells: what makes fewer of them
 *      and, if both are as many, has more ends at shadows (merge).
 *   5. Put these ends where rays along the rectangles' middle lines change (place_ends).
 * Rays go to points of a lattice of 2n x 2n steps: cells' corners are at even steps and their
 * middles at odd ones, and so are those of blocks of any size. A point is traced once. */
#include "shadow/visible.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "shadow/occlusion.h"

enum { BATCH = 256 };  /* rays */
enum { HALVINGS = 3 }; /* of a cell in which a rectangle ends */
enum { UNKNOWN = 0, CLEAR, BLOCKED, ASKED };

struct place {
  int x, y; /* lattice steps */
};

struct run {
  int low, high, since; /* cells along the row; its first row */
};

struct end {
  double *place;        /* in a rectangle, on the axis of the rows */
  double clear, hidden; /* places on that axis between which it is */
  double middle;        /* of the rectangle across it */
};

struct places {
  struct place *place; /* owned */
  int count, room;
};

struct visible_work {
  int cells;               /* n, for which the arrays below were made */
  unsigned char *state;    /* [(2n+1)^2] of the lattice */
  unsigned char *clear[2]; /* [n^2] of the cells, by rows and by columns */
  struct run *runs[2];     /* [n/2 + 1] each */
  struct places asked;     /* places whose state is not UNKNOWN */
  int traced;              /* of those */
  struct places blocks[2]; /* places of blocks, of this level and the next */
};

static bool append(struct places *list, struct place place) {
  if (list->count == list->room &&
      !array_reserve(&list->place, &list->room, list->count + 1, sizeof place))
    return false;
  list->place[list->count++] = place;
  return true;
}

static void work_free(struct visible_work *work) {
  if (!work) return;
  free(work->state);
  for (int k = 0; k < 2; ++k) {
    free(work->clear[k]);
    free(work->runs[k]);
    free(work->blocks[k].place);
  }
  free(work->asked.place);
  free(work);
}

void visible_free(struct visible *visible) {
  free(visible->rectangles);
  work_free(visible->work);
  *visible = (struct visible){0};
}

/* The arrays for n cells a side, kept from call to call. */
static bool prepare(struct visible *visible, int cells) {
  struct visible_work *work = visible->work;
  if (work && work->cells == cells) return true;
  work_free(work);
  visible->work = work = calloc(1, sizeof *work);
  if (!work) return false;
  size_t n = (size_t)cells;
  bool good = (work->state = calloc((2 * n + 1) * (2 * n + 1), 1)) != NULL;
  for (int k = 0; k < 2; ++k) {
    good = (work->clear[k] = malloc(n * n)) && good;
    good = (work->runs[k] = malloc((n / 2 + 1) * sizeof *work->runs[k])) && good;
  }
  if (!good) {
    work_free(work);
    visible->work = NULL;
    return false;
  }
  work->cells = cells;
  return true;
}

static unsigned char *state_at(const struct visible_work *work, int x, int y) {
  return &work->state[(size_t)y * (size_t)(2 * work->cells + 1) + (size_t)x];
}

static bool ask(struct visible_work *work, int x, int y) {
  unsigned char *state = state_at(work, x, y);
  if (*state != UNKNOWN) return true;
  if (!append(&work->asked, (struct place){x, y})) return false;
  *state = ASKED;
  return true;
}

/* Exact at both ends. */
static double coordinate(const struct visible_rectangle *whole, int axis, int step, int steps) {
  if (step == steps) return whole->high[axis];
  return whole->low[axis] + (whole->high[axis] - whole->low[axis]) * step / steps;
}

static void trace(const struct visible_query *query, struct visible *visible) {
  struct visible_work *work = visible->work;
  double points[BATCH][3];
  bool blocked[BATCH];
  while (work->traced < work->asked.count) {
    int left = work->asked.count - work->traced, count = left < BATCH ? left : BATCH;
    for (int k = 0; k < count; ++k) {
      struct place place = work->asked.place[work->traced + k];
      double x = coordinate(&query->whole, 0, place.x, 2 * work->cells);
      double y = coordinate(&query->whole, 1, place.y, 2 * work->cells);
      for (int c = 0; c < 3; ++c)
        points[k][c] = query->origin[c] + x * query->along[0][c] + y * query->along[1][c];
    }
    occlusion_blocked(query->occlusion, query->lifted, (const double(*)[3])points, count, blocked);
    for (int k = 0; k < count; ++k) {
      struct place place = work->asked.place[work->traced + k];
      *state_at(work, place.x, place.y) = blocked[k] ? BLOCKED : CLEAR;
    }
    work->traced += count;
    visible->shadow_rays += (uint64_t)count;
  }
}

/* Asks for what decides about blocks of `size` steps; cells are decided by their middles. */
static bool ask_blocks(struct visible_work *work, const struct places *blocks, int size) {
  bool good = true;
  for (int k = 0; k < blocks->count && good; ++k) {
    struct place at = blocks->place[k];
    good = ask(work, at.x + size / 2, at.y + size / 2);
    for (int corner = 0; corner < 4 && size > 2 && good; ++corner)
      good = ask(work, at.x + (corner & 1) * size, at.y + (corner >> 1) * size);
  }
  return good;
}

static void mark(struct visible_work *work, struct place at, int size) {
  size_t n = (size_t)work->cells, side = (size_t)size / 2;
  size_t x = (size_t)at.x / 2, y = (size_t)at.y / 2;
  for (size_t k = 0; k < side; ++k) {
    memset(work->clear[0] + (y + k) * n + x, 1, side);
    memset(work->clear[1] + (x + k) * n + y, 1, side);
  }
}

/* Marks the blocks that are visible and quarters those that may be in part. Returns the
 * number of cells marked, or -1 without memory. */
static long decide(struct visible_work *work, const struct places *blocks, int size,
                   struct places *quarters) {
  long marked = 0;
  quarters->count = 0;
  for (int k = 0; k < blocks->count; ++k) {
    struct place at = blocks->place[k];
    unsigned char middle = *state_at(work, at.x + size / 2, at.y + size / 2);
    bool agree = true;
    for (int corner = 0; corner < 4 && size > 2; ++corner)
      agree &= *state_at(work, at.x + (corner & 1) * size, at.y + (corner >> 1) * size) == middle;
    for (int corner = 0; corner < 4 && !agree; ++corner)
      if (!append(quarters,
                  (struct place){at.x + (corner & 1) * size / 2, at.y + (corner >> 1) * size / 2}))
        return -1;
    if (!agree || middle != CLEAR) continue;
    mark(work, at, size);
    marked += (long)(size / 2) * (size / 2);
  }
  return marked;
}

static bool unanimous(const struct visible_work *work) {
  struct place first = work->asked.place[0];
  for (int k = 1; k < work->asked.count; ++k) {
    struct place place = work->asked.place[k];
    if (*state_at(work, place.x, place.y) != *state_at(work, first.x, first.y)) return false;
  }
  return true;
}

/* Asks and traces for a level of blocks; false without memory. */
static bool look(const struct visible_query *query, struct visible *visible,
                 const struct places *blocks, int size) {
  if (!ask_blocks(visible->work, blocks, size)) return false;
  trace(query, visible);
  return true;
}

static long find_levels(const struct visible_query *query, struct visible *visible) {
  struct visible_work *work = visible->work;
  size_t n = (size_t)work->cells;
  struct places *blocks = &work->blocks[0], *quarters = &work->blocks[1];
  int size = 2 * work->cells / query->grid;
  long total = 0;
  blocks->count = 0;
  for (int k = 0; k < query->grid * query->grid; ++k)
    if (!append(blocks, (struct place){k % query->grid * size, k / query->grid * size})) return -1;
  if (!look(query, visible, blocks, size)) return -1;
  if (unanimous(work)) /* most receivers */
    return *state_at(work, size / 2, size / 2) == CLEAR ? (long)(n * n) : 0;
  memset(work->clear[0], 0, n * n);
  memset(work->clear[1], 0, n * n);
  for (;;) {
    long marked = decide(work, blocks, size, quarters);
    if (marked < 0) return -1;
    total += marked;
    if (quarters->count == 0) return total;
    struct places *swap = blocks;
    blocks = quarters;
    quarters = swap;
    size /= 2;
    if (!look(query, visible, blocks, size)) return -1;
  }
}

/* Finds the visible cells; returns their number, or -1 without memory. The map of them is
 * made only where some are visible and some are not. */
static long find_cells(const struct visible_query *query, struct visible *visible) {
  struct visible_work *work = visible->work;
  work->asked.count = work->traced = 0;
  long total = find_levels(query, visible);
  for (int k = 0; k < work->asked.count; ++k) {
    struct place place = work->asked.place[k];
    *state_at(work, place.x, place.y) = UNKNOWN;
  }
  return total;
}

static bool emit(const struct visible_query *query, struct visible *visible, int axis,
                 const struct run *run, int until) {
  int steps = visible->work->cells;
  struct visible_rectangle r;
  r.low[axis] = coordinate(&query->whole, axis, run->low, steps);
  r.high[axis] = coordinate(&query->whole, axis, run->high, steps);
  r.low[1 - axis] = coordinate(&query->whole, 1 - axis, run->since, steps);
  r.high[1 - axis] = coordinate(&query->whole, 1 - axis, until, steps);
  if (!(r.low[0] < r.high[0] && r.low[1] < r.high[1])) return true; /* rounded away */
  if (!array_reserve(&visible->rectangles, &visible->room, visible->count + 1, sizeof r))
    return false;
  visible->rectangles[visible->count++] = r;
  return true;
}

static int find_runs(const unsigned char *row, int cells, int since, struct run *runs) {
  int count = 0;
  for (int x = 0; x < cells;) {
    const unsigned char *low = memchr(row + x, 1, (size_t)(cells - x));
    if (!low) break;
    x = (int)(low - row);
    const unsigned char *high = memchr(low, 0, (size_t)(cells - x));
    int end = high ? (int)(high - row) : cells;
    runs[count++] = (struct run){x, end, since};
    x = end;
  }
  return count;
}

/* Runs of visible cells along the axis, and equal runs of successive rows as one rectangle.
 * Counts them and their ends inside; writes them too where `query` is given. -1 without memory. */
static int merge(const struct visible_query *query, struct visible *visible, int axis, int *ends) {
  struct visible_work *work = visible->work;
  int n = work->cells, open_count = 0, total = 0;
  *ends = 0;
  struct run *open = work->runs[0], *next = work->runs[1];
  for (int y = 0; y <= n; ++y) {
    const unsigned char *row = work->clear[axis] + (size_t)y * (size_t)n;
    if (y > 0 && y < n && memcmp(row, row - n, (size_t)n) == 0) continue;
    int count = y < n ? find_runs(row, n, y, next) : 0;
    for (int k = 0, m = 0; k < open_count; ++k) {
      while (m < count && next[m].low < open[k].low) ++m;
      if (m < count && next[m].low == open[k].low && next[m].high == open[k].high) {
        next[m].since = open[k].since;
      } else {
        ++total;
        *ends += (open[k].low > 0) + (open[k].high < n);
        if (query && !emit(query, visible, axis, &open[k], y)) return -1;
      }
    }
    struct run *swap = open;
    open = next;
    next = swap;
    open_count = count;
  }
  return total;
}

/* The ends inside the whole of some rectangles, each between the middles of the last visible cell
 * and of the next one. */
static int ends_of(const struct visible_query *query, const struct visible *visible, int axis,
                   struct visible_rectangle *r, struct end *ends) {
  const struct visible_rectangle *whole = &query->whole;
  double half = (whole->high[axis] - whole->low[axis]) / visible->work->cells / 2;
  double middle = (r->low[1 - axis] + r->high[1 - axis]) / 2;
  int count = 0;
  if (r->low[axis] > whole->low[axis])
    ends[count++] = (struct end){&r->low[axis], r->low[axis] + half, r->low[axis] - half, middle};
  if (r->high[axis] < whole->high[axis])
    ends[count++] =
        (struct end){&r->high[axis], r->high[axis] - half, r->high[axis] + half, middle};
  return count;
}

/* Ends move by less than half a cell: rectangles stay disjoint, and inside. */
static void place_ends(const struct visible_query *query, struct visible *visible, int axis) {
  struct end ends[BATCH];
  double points[BATCH][3];
  bool blocked[BATCH];
  for (int r = 0; r < visible->count;) {
    int count = 0;
    while (r < visible->count && count + 2 <= BATCH)
      count += ends_of(query, visible, axis, &visible->rectangles[r++], &ends[count]);
    for (int halving = 0; halving < HALVINGS; ++halving) {
      for (int k = 0; k < count; ++k) {
        double at = (ends[k].clear + ends[k].hidden) / 2;
        for (int c = 0; c < 3; ++c)
          points[k][c] = query->origin[c] + at * query->along[axis][c] +
                         ends[k].middle * query->along[1 - axis][c];
      }
      occlusion_blocked(query->occlusion, query->lifted, (const double(*)[3])points, count,
                        blocked);
      for (int k = 0; k < count; ++k)
        *(blocked[k] ? &ends[k].hidden : &ends[k].clear) = (ends[k].clear + ends[k].hidden) / 2;
    }
    for (int k = 0; k < count; ++k) *ends[k].place = (ends[k].clear + ends[k].hidden) / 2;
    visible->shadow_rays += (uint64_t)(HALVINGS * count);
  }
}

enum result visible_find(const struct visible_query *query, struct visible *visible,
                         struct error *error) {
  const struct visible_rectangle *whole = &query->whole;
  visible->count = 0;
  if (query->grid < 1 || query->edge < query->grid || query->edge > VISIBLE_MOST_EDGE)
    return result_fail(error, RESULT_BAD,
                       "shadow grid %d and edge %d: 1 <= grid <= edge <= %d is possible",
                       query->grid, query->edge, VISIBLE_MOST_EDGE);
  if (!(whole->low[0] < whole->high[0] && whole->low[1] < whole->high[1])) return RESULT_OK;
  int cells = query->grid;
  while (cells < query->edge) cells *= 2;
  if (!prepare(visible, cells)) return result_no_memory(error);
  long found = find_cells(query, visible);
  if (found < 0) return result_no_memory(error);
  if (found == 0) return RESULT_OK;
  if (found == (long)cells * cells) {
    const struct run all = {0, cells, 0};
    return emit(query, visible, 0, &all, cells) ? RESULT_OK : result_no_memory(error);
  }
  int ends[2], rows = merge(NULL, visible, 0, &ends[0]),
               columns = merge(NULL, visible, 1, &ends[1]);
  int axis = rows < columns || (rows == columns && ends[0] >= ends[1]) ? 0 : 1;
  if (merge(query, visible, axis, ends) < 0) return result_no_memory(error);
  place_ends(query, visible, axis);
  return RESULT_OK;
}
