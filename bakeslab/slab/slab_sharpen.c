/* slab_sharpen.c - works on one view at a time, in double: an array
 * [t][s][rgb].
 *
 * 1. Solve A x = m along all lines of s, then of t: m are the view's samples, which are means over
 *    cells, and A is the matrix of interpolation and means over cells (slab_sharpen.h). It is
 * tridiagonal: elimination without pivots, since the diagonal dominates.
 * 2. EXACT ends here. POSITIVE goes on where a sample became negative, by flux-corrected transport
 *    (Zalesak 1979). The low-order solution is m itself. The antidiffusive flux between neighbours
 *    is what the exact solution moves between them.
 * 3. The limiter of a sample is the part of its outgoing fluxes that it can give without becoming
 *    negative (Zalesak's R-), the least of all channels.
 * 4. Move each flux, times the limiter of the sample that gives it; keep the rest. Steps 3 and 4
 *    are done PASSES times, since what arrived may be given on.
 *
 * S. T. Zalesak, "Fully multidimensional flux-corrected transport algorithms for fluids", Journal
 * of Computational Physics 31, 1979. */
#include "slab/slab_sharpen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PASSES = 4 };

/* ---- 1. A line ---- */

/* The diagonal of 8 A; beside it there are ones. A border's half cell is constant. */
static double diagonal(int k, int count) {
  return k == 0 || k == count - 1 ? 7 : 6;
}

void slab_sharpen_line(double *line, int count, size_t stride, double *scratch) {
  if (count < 2) return;
  double *upper = scratch, *right = scratch + count;
  upper[0] = 1 / diagonal(0, count);
  right[0] = 8 * line[0] * upper[0];
  for (int k = 1; k < count; ++k) {
    upper[k] = 1 / (diagonal(k, count) - upper[k - 1]);
    right[k] = (8 * line[(size_t)k * stride] - right[k - 1]) * upper[k];
  }
  for (int k = count - 1; k >= 0; --k) {
    if (k < count - 1) right[k] -= upper[k] * right[k + 1];
    line[(size_t)k * stride] = right[k];
  }
}

void slab_unsharpen_line(double *line, int count, size_t stride) {
  if (count < 2) return;
  double before = line[0], here = line[0];
  for (int k = 0; k < count; ++k) {
    double after = k + 1 < count ? line[(size_t)(k + 1) * stride] : here;
    line[(size_t)k * stride] = (before + 6 * here + after) / 8;
    before = here;
    here = after;
  }
}

/* ---- A view ---- */

struct view {
  int ns, nt;
  size_t count;                   /* 3 ns nt */
  double *mean, *sharp, *flux[2]; /* flux: what a sample gives to the next along s, t */
  double *limit;                  /* of each sample */
  double *scratch;                /* for a line */
};

static enum result make_view(const struct slab *slab, struct view *view, struct error *error) {
  int ns = slab->samples[SLAB_S], nt = slab->samples[SLAB_T];
  size_t count = 3 * (size_t)ns * (size_t)nt, longest = (size_t)(ns > nt ? ns : nt);
  double *room = calloc(5 * count + 2 * longest, sizeof *room);
  if (!room) return result_no_memory(error);
  *view = (struct view){.ns = ns,
                        .nt = nt,
                        .count = count,
                        .mean = room, /* the block that is to be freed */
                        .sharp = room + count,
                        .flux = {room + 2 * count, room + 3 * count},
                        .limit = room + 4 * count,
                        .scratch = room + 5 * count};
  return RESULT_OK;
}

static size_t step(const struct view *view, int axis) {
  return axis ? 3 * (size_t)view->ns : 3;
}

/* Along all lines of the view, of one axis (0: s, 1: t) and all channels. */
static void each_line(const struct view *view, double *x, int axis, bool sharpen) {
  size_t lines = (size_t)(axis ? view->ns : view->nt), count = (size_t)(axis ? view->nt : view->ns);
  for (size_t line = 0; line < lines; ++line)
    for (size_t c = 0; c < 3; ++c) {
      double *first = x + line * step(view, !axis) + c;
      if (sharpen)
        slab_sharpen_line(first, (int)count, step(view, axis), view->scratch);
      else
        slab_unsharpen_line(first, (int)count, step(view, axis));
    }
}

/* x - A x is the difference of (x[k+1] - x[k])/8 on a cell's two sides: along s of x, along t of
 * what A makes of x along s. */
static void find_fluxes(struct view *view) {
  double *x = view->limit; /* not in use yet */
  memcpy(x, view->sharp, view->count * sizeof *x);
  for (int axis = 0; axis < 2; ++axis) {
    size_t next = step(view, axis), last = (size_t)(axis ? view->nt : view->ns) - 1;
    for (size_t n = 0; n < view->count; ++n) {
      size_t at = axis ? n / step(view, 1) : n % step(view, 1) / 3;
      view->flux[axis][n] = at < last ? (x[n + next] - x[n]) / 8 : 0;
    }
    if (axis == 0) each_line(view, x, 0, false);
  }
}

static void find_limits(struct view *view) {
  for (size_t n = 0; n < view->count; n += 3) {
    double limit = 1;
    for (size_t c = n; c < n + 3; ++c) {
      double outgoing = 0;
      for (int axis = 0; axis < 2; ++axis) {
        size_t next = step(view, axis);
        outgoing += fmax(view->flux[axis][c], 0);
        if (c >= next) outgoing += fmax(-view->flux[axis][c - next], 0);
      }
      if (outgoing > view->mean[c]) limit = fmin(limit, fmax(view->mean[c], 0) / outgoing);
    }
    for (size_t c = n; c < n + 3; ++c) view->limit[c] = limit;
  }
}

static void move_fluxes(struct view *view) {
  for (int axis = 0; axis < 2; ++axis) {
    size_t next = step(view, axis);
    for (size_t n = 0; n + next < view->count; n += 3) {
      double limit = 1;
      for (size_t c = n; c < n + 3; ++c) {
        if (view->flux[axis][c] > 0) limit = fmin(limit, view->limit[c]);
        if (view->flux[axis][c] < 0) limit = fmin(limit, view->limit[c + next]);
      }
      for (size_t c = n; c < n + 3; ++c) {
        double moved = limit * view->flux[axis][c];
        view->mean[c] -= moved;
        view->mean[c + next] += moved;
        view->flux[axis][c] -= moved;
      }
    }
  }
}

/* From view->mean to view->sharp, without negative samples where there were none. */
static void sharpen_limited(struct view *view) {
  find_fluxes(view);
  memcpy(view->sharp, view->mean, view->count * sizeof *view->sharp);
  for (int pass = 0; pass < PASSES; ++pass) {
    find_limits(view);
    move_fluxes(view);
  }
  for (size_t n = 0; n < view->count; ++n) {
    bool rounding = view->mean[n] < 0 && view->sharp[n] >= 0;
    view->sharp[n] = rounding ? 0 : view->mean[n];
  }
}

/* ---- A slab ---- */

enum task { SHARPEN, SHARPEN_POSITIVE, UNSHARPEN };

static void do_view(struct view *view, enum task task) {
  memcpy(view->sharp, view->mean, view->count * sizeof *view->sharp);
  for (int axis = 0; axis < 2; ++axis) each_line(view, view->sharp, axis, task != UNSHARPEN);
  bool negative = false;
  for (size_t n = 0; n < view->count; ++n) negative |= view->sharp[n] < 0;
  if (negative && task == SHARPEN_POSITIVE) sharpen_limited(view);
}

static enum result do_slab(struct slab *slab, enum task task, struct error *error) {
  struct view view = {0};
  enum result result = make_view(slab, &view, error);
  if (result != RESULT_OK) return result;
  size_t width = step(&view, 1);
  for (int j = 0; j < slab->samples[SLAB_V]; ++j)
    for (int i = 0; i < slab->samples[SLAB_U]; ++i) {
      bool black = true;
      for (size_t n = 0; n < view.count; ++n) {
        view.mean[n] = (double)slab_at(slab, i, j, 0, (int)(n / width))[n % width];
        black &= view.mean[n] == 0;
      }
      if (black) continue;
      do_view(&view, task);
      for (size_t n = 0; n < view.count; ++n)
        slab_at(slab, i, j, 0, (int)(n / width))[n % width] = (float)view.sharp[n];
    }
  free(view.mean);
  return RESULT_OK;
}

enum result slab_sharpen(struct slab *slab, enum slab_sharpening how, struct error *error) {
  return do_slab(slab, how == SLAB_SHARPEN_POSITIVE ? SHARPEN_POSITIVE : SHARPEN, error);
}

enum result slab_unsharpen(struct slab *slab, struct error *error) {
  return do_slab(slab, UNSHARPEN, error);
}
