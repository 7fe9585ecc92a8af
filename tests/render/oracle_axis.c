/* oracle_axis.c - the lines of both grids along one axis, in exact rationals.
 * Only |u| is rounded, to long double: it is a square root. */
#include <gmp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle.h"

/* One axis of the aperture and the receiver over it. */
struct line {
  mpq_t length, foot, height; /* |u|, qx, z */
  mpq_t kappa, lean;          /* 1/D, 1 - kappa z */
  mpq_t low, high;            /* of the window */
  int uv, st;                 /* samples */
};

struct cuts {
  int count, room;
  bool bounded;
  mpq_t low, high; /* what is visible */
  mpq_t at[ORACLE_PIECES + 1];
};

static long double rounded(const mpq_t q) {
  mpq_t rest;
  mpq_init(rest);
  double high = mpq_get_d(q);
  mpq_set_d(rest, high);
  mpq_sub(rest, q, rest);
  long double value = (long double)high + (long double)mpq_get_d(rest);
  mpq_clear(rest);
  return value;
}

static void set_long(mpq_t q, long double x) {
  mpq_t rest;
  mpq_init(rest);
  mpq_set_d(q, (double)x);
  mpq_set_d(rest, (double)(x - (long double)(double)x));
  mpq_add(q, q, rest);
  mpq_clear(rest);
}

/* (p - center) . axis */
static void dot_from(mpq_t sum, const double p[3], const double center[3], const double axis[3]) {
  mpq_t x, y;
  mpq_inits(x, y, NULL);
  mpq_set_ui(sum, 0, 1);
  for (int k = 0; k < 3; ++k) {
    mpq_set_d(x, p[k]);
    mpq_set_d(y, center[k]);
    mpq_sub(x, x, y);
    mpq_set_d(y, axis[k]);
    mpq_mul(x, x, y);
    mpq_add(sum, sum, x);
  }
  mpq_clears(x, y, NULL);
}

static void line_open(struct line *line, const struct slab *slab, const double p[3], int which) {
  static const double origin[3];
  const double *edge = which ? slab->v : slab->u;
  mpq_t square;
  mpq_inits(line->length, line->foot, line->height, line->kappa, line->lean, line->low, line->high,
            square, NULL);
  dot_from(square, edge, origin, edge);
  set_long(line->length, sqrtl(rounded(square)));
  dot_from(line->foot, p, slab->center, edge);
  mpq_div(line->foot, line->foot, square);
  mpq_mul(line->foot, line->foot, line->length);
  dot_from(line->height, p, slab->center, slab->normal);
  if (!isinf(slab->st_distance)) {
    mpq_set_d(line->kappa, slab->st_distance);
    mpq_inv(line->kappa, line->kappa);
  }
  mpq_mul(line->lean, line->kappa, line->height);
  mpq_set_ui(square, 1, 1);
  mpq_sub(line->lean, square, line->lean);
  mpq_set_d(line->low, slab->st_window[2 * which]);
  mpq_set_d(line->high, slab->st_window[2 * which + 1]);
  line->uv = slab->samples[which];
  line->st = slab->samples[2 + which];
  mpq_clear(square);
}

static void line_close(struct line *line) {
  mpq_clears(line->length, line->foot, line->height, line->kappa, line->lean, line->low, line->high,
             NULL);
}

/* x where a is `half` half cells from the rectangle's border. */
static void uv_line(mpq_t x, const struct line *line, int half) {
  mpq_set_si(x, half - line->uv, 2 * (unsigned)line->uv);
  mpq_canonicalize(x);
  mpq_mul(x, x, line->length);
  mpq_sub(x, x, line->foot);
  mpq_div(x, x, line->height);
}

/* x where s is `half` half cells from the window's border. */
static void st_line(mpq_t x, const struct line *line, int half) {
  mpq_t s;
  mpq_init(s);
  mpq_set_si(x, half, 2 * (unsigned)line->st);
  mpq_canonicalize(x);
  mpq_sub(s, line->high, line->low);
  mpq_mul(s, s, x);
  mpq_add(s, s, line->low);
  mpq_mul(x, line->kappa, line->foot);
  mpq_sub(x, x, s);
  mpq_div(x, x, line->lean);
  mpq_clear(s);
}

/* The place on the grid, in samples: sample i is at i. */
static void uv_place(mpq_t g, const struct line *line, const mpq_t x) {
  mpq_t half;
  mpq_init(half);
  mpq_mul(g, x, line->height);
  mpq_add(g, g, line->foot);
  mpq_div(g, g, line->length);
  mpq_set_ui(half, 1, 2);
  mpq_add(g, g, half);
  mpq_set_si(half, line->uv, 1);
  mpq_mul(g, g, half);
  mpq_set_ui(half, 1, 2);
  mpq_sub(g, g, half);
  mpq_clear(half);
}

static void st_place(mpq_t g, const struct line *line, const mpq_t x) {
  mpq_t t;
  mpq_init(t);
  mpq_mul(g, line->kappa, line->foot);
  mpq_mul(t, line->lean, x);
  mpq_sub(g, g, t);
  mpq_sub(g, g, line->low);
  mpq_sub(t, line->high, line->low);
  mpq_div(g, g, t);
  mpq_set_si(t, line->st, 1);
  mpq_mul(g, g, t);
  mpq_set_ui(t, 1, 2);
  mpq_sub(g, g, t);
  mpq_clear(t);
}

static void cuts_open(struct cuts *cuts) {
  cuts->count = 0;
  cuts->bounded = false;
  mpq_inits(cuts->low, cuts->high, NULL);
  for (int k = 0; k <= ORACLE_PIECES; ++k) mpq_init(cuts->at[k]);
}

static void cuts_close(struct cuts *cuts) {
  mpq_clears(cuts->low, cuts->high, NULL);
  for (int k = 0; k <= ORACLE_PIECES; ++k) mpq_clear(cuts->at[k]);
}

static void cuts_add(struct cuts *cuts, const mpq_t x) {
  if (cuts->count > ORACLE_PIECES) abort();
  mpq_set(cuts->at[cuts->count++], x);
}

/* Visible is what lies between two lines, whichever is lower. */
static void cuts_narrow(struct cuts *cuts, const mpq_t a, const mpq_t b) {
  bool up = mpq_cmp(a, b) < 0;
  const mpq_t *low = up ? (const mpq_t *)a : (const mpq_t *)b;
  const mpq_t *high = up ? (const mpq_t *)b : (const mpq_t *)a;
  if (!cuts->bounded || mpq_cmp(*low, cuts->low) > 0) mpq_set(cuts->low, *low);
  if (!cuts->bounded || mpq_cmp(*high, cuts->high) < 0) mpq_set(cuts->high, *high);
  cuts->bounded = true;
}

typedef void line_at(mpq_t x, const struct line *line, int half);

static void cuts_grid(struct cuts *cuts, const struct line *line, line_at *at, int samples) {
  mpq_t first, last;
  mpq_inits(first, last, NULL);
  at(first, line, 0);
  at(last, line, 2 * samples);
  cuts_narrow(cuts, first, last);
  for (int k = 0; k < samples; ++k) {
    at(first, line, 2 * k + 1);
    cuts_add(cuts, first);
  }
  mpq_clears(first, last, NULL);
}

/* The limit from above: -1, 0, 1 where the border is at -infinity, 0,
 * +infinity, as seen from the foot. */
static void cuts_touch(struct cuts *cuts, const struct line *line) {
  mpq_t border, zero;
  mpq_inits(border, zero, NULL);
  for (int side = -1; side <= 1; side += 2) {
    mpq_set_si(border, side, 2);
    mpq_mul(border, border, line->length);
    int where = side * mpq_cmp(border, line->foot);
    bool hides = side < 0 ? mpq_sgn(cuts->low) < 0 : mpq_sgn(cuts->high) > 0;
    if (where < 0) mpq_set(cuts->low, cuts->high);
    if (where == 0 && hides) mpq_set(side < 0 ? cuts->low : cuts->high, zero);
  }
  mpq_clears(border, zero, NULL);
}

static void cuts_find(struct cuts *cuts, const struct line *line) {
  if (mpq_sgn(line->height) > 0) cuts_grid(cuts, line, uv_line, line->uv);
  if (mpq_sgn(line->lean) != 0) {
    cuts_grid(cuts, line, st_line, line->st);
  } else { /* on the st plane: one s for all of the aperture */
    mpq_t s;
    mpq_init(s);
    mpq_mul(s, line->kappa, line->foot);
    if (mpq_cmp(s, line->low) < 0 || mpq_cmp(s, line->high) > 0) mpq_set(cuts->low, cuts->high);
    mpq_clear(s);
  }
  if (mpq_sgn(line->height) == 0) cuts_touch(cuts, line);
}

static int compare(const void *a, const void *b) {
  return mpq_cmp(*(const mpq_t *)a, *(const mpq_t *)b);
}

/* Keeps what is inside, in order, each once, with both ends. */
static void cuts_merge(struct cuts *cuts) {
  if (mpq_cmp(cuts->low, cuts->high) >= 0) {
    cuts->count = 0;
    return;
  }
  cuts_add(cuts, cuts->low);
  cuts_add(cuts, cuts->high);
  qsort(cuts->at, (size_t)cuts->count, sizeof cuts->at[0], compare);
  int kept = 0;
  for (int k = 0; k < cuts->count; ++k) {
    bool inside = mpq_cmp(cuts->at[k], cuts->low) >= 0 && mpq_cmp(cuts->at[k], cuts->high) <= 0;
    if (inside && (!kept || mpq_cmp(cuts->at[k], cuts->at[kept - 1]) != 0))
      mpq_set(cuts->at[kept++], cuts->at[k]);
  }
  cuts->count = kept;
}

typedef void place_at(mpq_t g, const struct line *line, const mpq_t x);

/* The two samples around a piece and the place between them at its ends. */
static void piece_grid(const struct line *line, place_at *place, int samples, mpq_t *ends,
                       int index[2], long double at[2]) {
  mpq_t middle, g, floor;
  mpq_inits(middle, g, floor, NULL);
  mpq_add(middle, ends[0], ends[1]);
  mpq_div_2exp(middle, middle, 1);
  place(g, line, middle);
  bool first = mpq_sgn(g) <= 0, last = mpq_cmp_si(g, samples - 1, 1) >= 0;
  at[0] = at[1] = 0;
  if (first || last) {
    index[0] = index[1] = first ? 0 : samples - 1;
  } else {
    mpz_fdiv_q(mpq_numref(floor), mpq_numref(g), mpq_denref(g));
    index[0] = (int)mpz_get_si(mpq_numref(floor));
    index[1] = index[0] + 1;
    for (int k = 0; k < 2; ++k) {
      place(g, line, ends[k]);
      mpq_sub(g, g, floor);
      at[k] = rounded(g);
    }
  }
  mpq_clears(middle, g, floor, NULL);
}

void oracle_axis(const struct slab *slab, const double p[3], int which, struct oracle_axis *axis) {
  struct line line;
  struct cuts cuts;
  mpq_t width, sum;
  mpq_inits(width, sum, NULL);
  line_open(&line, slab, p, which);
  cuts_open(&cuts);
  if (mpq_sgn(line.height) >= 0) {
    cuts_find(&cuts, &line);
    cuts_merge(&cuts);
  }
  axis->count = cuts.count ? cuts.count - 1 : 0;
  for (int k = 0; k < axis->count; ++k) {
    struct oracle_piece *piece = &axis->piece[k];
    mpq_sub(width, cuts.at[k + 1], cuts.at[k]);
    mpq_add(sum, sum, width);
    piece->x = rounded(cuts.at[k]);
    piece->width = rounded(width);
    piece_grid(&line, uv_place, line.uv, cuts.at + k, piece->uv, piece->uv_at);
    piece_grid(&line, st_place, line.st, cuts.at + k, piece->st, piece->st_at);
  }
  mpq_sub(width, cuts.high, cuts.low);
  if (axis->count && !mpq_equal(sum, width)) abort();
  cuts_close(&cuts);
  line_close(&line);
  mpq_clears(width, sum, NULL);
}
