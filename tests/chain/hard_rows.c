/* hard_rows.c - see hard.h. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hard.h"

/* ---- An easy lamp, which the rows then make hard ---- */

/* Soft radiance, which few area lights can give. */
static void soften(struct slab *slab) {
  for (size_t m = 0; m < slab_sample_count(slab); ++m) {
    int at[4];
    double x[4];
    slab_locate(slab, m, at);
    for (int k = 0; k < 4; ++k) x[k] = (at[k] + 0.5) / slab->samples[k] - 0.5;
    double p = x[2] - x[0], q = x[3] + 0.3 * x[1], light = 1 + 4 * exp(-4 * (p * p + q * q));
    for (int c = 0; c < 3; ++c)
      slab->rgb[3 * m + (size_t)c] = (float)(light * (1 + x[2] * (c - 1)));
  }
}

static void scale_page(struct slab *slab, double size) {
  for (int c = 0; c < 3; ++c) {
    slab->u[c] *= size;
    slab->v[c] *= size;
    slab->center[c] *= size;
  }
  slab->st_distance *= size;
}

static void brighten(struct slab *slab, double by) {
  for (size_t k = 0; k < 3 * slab_sample_count(slab); ++k)
    slab->rgb[k] = (float)((double)slab->rgb[k] * by);
}

static void make_page(uint64_t *seed, enum hard_kind kind, struct slab *slab) {
  int samples[4];
  double edges[2] = {1, 1}, window[4];
  for (int k = 0; k < 2; ++k) {
    samples[k] = 1 + random_choose(seed, 5);
    samples[2 + k] = 4 + random_choose(seed, 10);
    window[2 * k] = random_between(seed, -1.5, 0.2);
    window[2 * k + 1] = window[2 * k] + random_between(seed, 0.5, 2);
  }
  edges[random_choose(seed, 2)] = random_between(seed, 0.3, 1);
  double distance = random_choose(seed, 2) ? INFINITY : random_log(seed, 0.6, 30);
  int mirrored = random_choose(seed, 2);
  *slab = chain_slab(samples, edges, window, distance, mirrored,
                     (uint64_t)(random_number(seed) * 0x1p53));
  if (kind == HARD_CLUSTER) soften(slab);
  if (random_choose(seed, 4) > 0) return;
  for (size_t k = 0; k < 3 * slab_sample_count(slab); ++k) slab->rgb[k] = slab->rgb[k / 3 * 3];
}

static void turn_lamp(uint64_t *seed, struct hard_lamp *lamp) {
  double frame[3][3];
  random_frame(seed, 0, frame);
  for (int k = 0; k < 9; ++k) lamp->matrix[k] = frame[k / 3][k % 3];
}

/* So many of its widths from the origin. */
static void move_lamp(uint64_t *seed, double widths, const struct slab *page,
                      struct hard_lamp *lamp) {
  double to[3];
  random_direction(seed, to);
  for (int c = 0; c < 3; ++c) lamp->matrix[9 + c] = widths * hard_width(page) * lamp->scale * to[c];
}

static void make_lamp(uint64_t *seed, struct hard_case *lit) {
  struct hard_lamp *lamp = &lit->lamps[0];
  *lamp = (struct hard_lamp){.scale = 1, .gain = {1, 1, 1}};
  turn_lamp(seed, lamp);
  move_lamp(seed, random_between(seed, 0, 3), &lit->pages[0], lamp);
  lit->lamp_count = 1;
}

static void easy(uint64_t *seed, struct hard_case *lit) {
  make_page(seed, lit->kind, &lit->pages[0]);
  lit->page_count = 1;
  if (lit->kind == HARD_CLUSTER) lit->lights = 1 + random_choose(seed, 2);
  make_lamp(seed, lit);
  lit->expect = HARD_RIGHT;
}

/* ---- What it shines at ---- */

/* What covers the lit part of the plane `widths` away, parallel to the aperture, askew so that
 * no row of pixels follows an edge; or, not squarely, a part of it, turned by up to a radian,
 * around a ray that leaves the middle of the aperture. */
static void face(uint64_t *seed, double widths, bool squarely, struct hard_case *lit) {
  const struct slab *page = &lit->pages[0];
  const double *w = page->st_window;
  double away = widths * hard_width(page), size[2], middle[3], frame[3][3], turned[3][3];
  double share = squarely ? 0.5 : 0, part = squarely ? 1 : random_log(seed, 0.1, 1);
  for (int c = 0; c < 3; ++c) middle[c] = page->center[c] + away * page->normal[c];
  for (int k = 0; k < 2; ++k) {
    const double *axis = k ? page->v : page->u;
    double edge = chain_length(axis);
    if (!squarely) share = random_between(seed, 0.05, 0.95);
    for (int c = 0; c < 3; ++c)
      middle[c] += away * (w[2 * k] + share * (w[2 * k + 1] - w[2 * k])) * axis[c] / edge;
    size[k] = part * (fabs(1 - away / page->st_distance) * edge + away * (w[2 * k + 1] - w[2 * k]));
    for (int c = 0; c < 3; ++c) frame[k][c] = axis[c] / edge;
  }
  /* A little of a random frame turns it; Gram and Schmidt keep it a frame. */
  for (int c = 0; c < 3; ++c)
    frame[2][c] = squarely ? -page->normal[c] : (page->center[c] - middle[c]) / away;
  if (!squarely) {
    double aside[3], tilt = random_between(seed, 0, 0.8);
    random_direction(seed, aside);
    for (int c = 0; c < 3; ++c) frame[2][c] += tilt * aside[c];
  }
  for (int k = 2; k >= 0; --k) {
    for (int m = 2; m > k; --m) {
      double along = chain_dot(frame[k], frame[m]);
      for (int c = 0; c < 3; ++c) frame[k][c] -= along * frame[m][c];
    }
    double length = chain_length(frame[k]);
    for (int c = 0; c < 3; ++c) frame[k][c] /= length;
    chain_move(lit->lamps[0].matrix, lit->lamps[0].scale, frame[k], 0, turned[k]);
  }
  chain_move(lit->lamps[0].matrix, lit->lamps[0].scale, middle, 1, lit->plane.center);
  double angle = squarely ? 0.4 : 0, co = cos(angle), si = sin(angle);
  double across = co * size[0] + si * size[1], down = si * size[0] + co * size[1];
  for (int c = 0; c < 3; ++c) {
    lit->plane.across[c] = across * (co * turned[0][c] + si * turned[1][c]);
    lit->plane.down[c] = down * (co * turned[1][c] - si * turned[0][c]);
    lit->plane.normal[c] = turned[2][c] / lit->lamps[0].scale;
  }
}

/* Widths from the origin that a lamp may be, with what it lights; and how wide it may be in the
 * scene. */
static const double farthest[HARD_KINDS] = {1e3, 1e6, 1e4}, widest = 1e9;

/* So many widths away, but not before a sheet, which stands far away where windows are narrow, not
 * among a cluster's points, and not beside a sphere, which is large where the lamp is small. */
static void look_from(uint64_t *seed, double widths, struct hard_case *lit) {
  const struct slab *page = &lit->pages[0];
  int lights[2];
  hard_lights(lit, page, lights);
  double width = hard_width(page), nearest = 0;
  if (lit->kind == HARD_SHEET) nearest = 2 * hard_height(lit, page, lights) / width;
  if (lit->kind == HARD_CLUSTER) nearest = 0.4;
  if (lit->kind == HARD_POINT) nearest = 8 * hard_radius(&lit->lamps[0], width) / width;
  face(seed, fmax(widths, nearest), false, lit);
}

static void look_at_it(uint64_t *seed, struct hard_case *lit) {
  look_from(seed, random_log(seed, 0.5, 20), lit);
}

/* ---- Rows: each makes the easy case hard ---- */

/* The least Scale, as the header's tables say it. */
static double least_scale(const struct hard_case *lit) {
  const struct slab *page = &lit->pages[0];
  int lights[2];
  hard_lights(lit, page, lights);
  switch (lit->kind) {
  case HARD_SHEET:
    return 0.0011 / hard_height(lit, page, lights);
  case HARD_CLUSTER:
    return 0.002 / hard_width(page);
  default:
    return 0.004 / hard_width(page);
  }
}

static void row_edge(uint64_t *seed, struct hard_case *lit) {
  scale_page(&lit->pages[0], random_log(seed, 1e-3, 1e3));
  double by =
      random_choose(seed, 3) ? 1 + random_log(seed, 3e-4, 1) : 1 - random_log(seed, 3e-4, 0.5);
  if (random_choose(seed, 2)) lit->most = 1 + random_choose(seed, 5);
  lit->lamps[0].scale = by * least_scale(lit);
  move_lamp(seed, random_log(seed, 0.01, 1e3), &lit->pages[0], &lit->lamps[0]);
  lit->expect = by > 1 ? HARD_RIGHT : HARD_REFUSED;
  look_at_it(seed, lit);
}

static void row_units(uint64_t *seed, struct hard_case *lit) {
  double far = random_choose(seed, 3) ? 1e12 : 1e140, unit = random_log(seed, 1 / far, far);
  double wide = random_log(seed, 1e-3, 1e10);
  scale_page(&lit->pages[0], unit);
  lit->lamps[0].scale = wide / hard_width(&lit->pages[0]);
  bool small = least_scale(lit) > lit->lamps[0].scale;
  bool large = wide > 1.002 * widest;
  for (int c = 0; c < 3; ++c) lit->lamps[0].gain[c] = random_log(seed, 0.01, 1e20);
  double most = fmin(farthest[lit->kind], 6e9 / wide);
  move_lamp(seed, random_log(seed, 1e-3, most), &lit->pages[0], &lit->lamps[0]);
  lit->expect = small || large ? HARD_REFUSED : HARD_RIGHT;
  look_at_it(seed, lit);
}

static void row_place(uint64_t *seed, struct hard_case *lit) {
  lit->lamps[0].scale = random_log(seed, 0.3, 1e3);
  double most = farthest[lit->kind] / 3; /* windows are oblique: receivers are farther off */
  move_lamp(seed, random_log(seed, 1, most), &lit->pages[0], &lit->lamps[0]);
  face(seed, random_log(seed, 0.5, random_choose(seed, 2) ? 20 : most), false, lit);
  for (int c = 0; c < 3; ++c) lit->lamps[0].gain[c] = 1e12;
}

static void row_gain(uint64_t *seed, struct hard_case *lit) {
  double bright = random_log(seed, 1e-30, 1e30), gain = random_log(seed, 1e-6, 1e30) / bright;
  brighten(&lit->pages[0], bright);
  for (int c = 0; c < 3; ++c)
    lit->lamps[0].gain[c] = gain * (random_choose(seed, 2) ? 1 : random_between(seed, -1, 1));
  lit->expect = HARD_EITHER;
  look_at_it(seed, lit);
}

/* Half floats end at 65504 and 6e-8. */
static void row_range(uint64_t *seed, struct hard_case *lit) {
  struct slab *slab = &lit->pages[0];
  size_t values = 3 * slab_sample_count(slab);
  double range = random_log(seed, 1, 1e20), peak = random_log(seed, 1e4, 1e10);
  int how = random_choose(seed, 3);
  for (size_t k = 0; k < values; ++k)
    slab->rgb[k] =
        how ? (float)random_between(seed, 1, 2) : (float)random_log(seed, 1 / range, 1e4);
  for (int k = 0; k < how; ++k)
    slab->rgb[random_choose(seed, (int)values)] =
        k ? (float)peak : 65504.0F * (float)(1 + random_choose(seed, 3));
  look_at_it(seed, lit);
}

/* Windows narrow, steep and off the normal; apertures thin. */
static void row_window(uint64_t *seed, struct hard_case *lit) {
  struct slab *slab = &lit->pages[0];
  for (int k = 0; k < 2; ++k) {
    double middle = (random_choose(seed, 2) ? 1 : -1) * random_log(seed, 0.01, 10);
    double half = random_log(seed, 1e-3, 10);
    slab->st_window[2 * k] = middle - half;
    slab->st_window[2 * k + 1] = middle + half;
  }
  double thin = random_log(seed, 1e-3, 1);
  for (int c = 0; c < 3; ++c) slab->v[c] *= thin;
  lit->lamps[0].scale = fmax(1, 1.1 * least_scale(lit));
  lit->expect = HARD_EITHER;
  look_at_it(seed, lit);
}

static void row_st_plane(uint64_t *seed, struct hard_case *lit) {
  struct slab *slab = &lit->pages[0];
  slab->st_distance = random_log(seed, 1e-3, 1e6) * hard_width(slab);
  lit->lamps[0].scale = fmax(1, 1.1 * least_scale(lit));
  lit->expect = HARD_EITHER;
  double there = fmin(slab->st_distance / hard_width(slab), farthest[lit->kind] / 3);
  look_from(seed, random_choose(seed, 2) ? random_log(seed, 0.5, 20) : there, lit);
}

static void row_lights(uint64_t *seed, struct hard_case *lit) {
  if (lit->kind == HARD_SHEET && random_choose(seed, 2)) lit->lights = 1 + random_choose(seed, 6);
  lit->most = random_between(seed, 1, 8);
  if (random_choose(seed, 2)) lit->most = floor(lit->most);
  look_at_it(seed, lit);
}

/* Side by side, facing the same way, of different sizes. */
static void row_pages(uint64_t *seed, struct hard_case *lit) {
  struct slab *first = &lit->pages[0], *second = &lit->pages[1];
  make_page(seed, lit->kind, second);
  lit->page_count = 2;
  if (lit->kind == HARD_CLUSTER) lit->lights = 2;
  double size = random_between(seed, 0.3, 2), aside = random_between(seed, 0.6, 2);
  scale_page(second, size);
  for (int c = 0; c < 3; ++c) {
    second->center[c] = first->center[c] + aside * (1 + size) * first->u[c];
    second->u[c] = first->u[c] * size;
    second->v[c] = first->v[c] * size;
    second->normal[c] = first->normal[c];
  }
  lit->expect = HARD_RIGHT;
  look_at_it(seed, lit);
}

/* Up to twenty lamps in each other's beams, which shade each other by their cases. */
static void row_beams(uint64_t *seed, struct hard_case *lit) {
  static const int most[HARD_KINDS] = {HARD_LAMPS, HARD_LAMPS, 3};
  if (lit->kind == HARD_SHEET) lit->most = 1 + random_choose(seed, 3);
  const struct slab *page = &lit->pages[0];
  double apart = hard_width(page) * 1.5;
  lit->lamp_count = 2 + random_choose(seed, most[lit->kind] - 1);
  for (int n = 1; n < lit->lamp_count; ++n) {
    struct hard_lamp *lamp = &lit->lamps[n];
    *lamp = (struct hard_lamp){.scale = 0.3, .gain = {1, 1, 1}};
    turn_lamp(seed, lamp);
    double nearest, at[3], other[3];
    do { /* in a ball before the first lamp, not in each other */
      double from[3];
      for (int c = 0; c < 3; ++c)
        from[c] = page->center[c] + apart * (2 * page->normal[c] + random_between(seed, -1.5, 1.5));
      chain_move(lit->lamps[0].matrix, lit->lamps[0].scale, from, 1, at);
      nearest = INFINITY;
      for (int m = 0; m < n; ++m) {
        chain_move(lit->lamps[m].matrix, lit->lamps[m].scale, page->center, 1, other);
        for (int c = 0; c < 3; ++c) other[c] -= at[c];
        nearest = fmin(nearest, chain_length(other));
      }
    } while (nearest < 0.6 * apart * 0.6);
    chain_move(lamp->matrix, lamp->scale, page->center, 0, other);
    for (int c = 0; c < 3; ++c) lamp->matrix[9 + c] = at[c] - other[c];
  }
  face(seed, 8, false, lit);
}

static void row_switches(uint64_t *seed, struct hard_case *lit) {
  static const char *const switches[] = {"+Q4",       "+Q5", "+Q11",   "+MB1",    "-MB", "+BM2",
                                         "+WT2 +BS5", "+UA", "-J +UL", "+Q9 -UV", "+HR", "+F +RP2"};
  lit->switches = switches[random_choose(seed, (int)(sizeof switches / sizeof *switches) - 1)];
  look_at_it(seed, lit);
}

/* What may stand for Scale and Gain. */
static void row_arguments(uint64_t *seed, struct hard_case *lit) {
  static const struct {
    const char *text;
    double scale, gain[3];
    enum hard_expect expect;
  } cases[] = {
      {"2, 3", 2, {3, 3, 3}, HARD_RIGHT},
      {"<2, 2, 2>, 1", 2, {1, 1, 1}, HARD_RIGHT},
      {"1, rgb <3, 0, 2>", 1, {3, 0, 2}, HARD_RIGHT},
      {"1, <3, 1, 2>", 1, {3, 1, 2}, HARD_RIGHT},
      {"1, color red 2", 1, {2, 0, 0}, HARD_RIGHT},
      {"1, rgbft <1, 2, 3, 0.5, 0.25>", 1, {1, 2, 3}, HARD_RIGHT},
      {"1, -2", 1, {-2, -2, -2}, HARD_RIGHT},
      {"1, <0, 0, 0>", 1, {0, 0, 0}, HARD_RIGHT},
      {"1, 0", 1, {0, 0, 0}, HARD_RIGHT},
      {"<1, 2, 1>, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"<1, 1, -1>, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"<-1, -1, -1>, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"x, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"-1, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"0, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"1e-300, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"1e30, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"1e400, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"1e400 - 1e400, 1", 1, {1, 1, 1}, HARD_REFUSED},
      {"1, 1e400", 1, {1, 1, 1}, HARD_REFUSED},
      {"1, 1e400 - 1e400", 1, {1, 1, 1}, HARD_REFUSED},
      {"1, rgb <1, 1, 1e38>", 1, {1, 1, 1}, HARD_REFUSED},
      {"1, 1e-30", 1, {1, 1, 1}, HARD_REFUSED},
  };
  int n = random_choose(seed, (int)(sizeof cases / sizeof *cases));
  struct hard_lamp *lamp = &lit->lamps[0];
  snprintf(lamp->arguments, sizeof lamp->arguments, "%s", cases[n].text);
  lamp->scale = cases[n].scale;
  memcpy(lamp->gain, cases[n].gain, sizeof lamp->gain);
  lit->expect = cases[n].expect;
  look_at_it(seed, lit);
}

static void row_stated(uint64_t *seed, struct hard_case *lit) {
  static const double sheets[] = {0.5, 1, 2, 4, 8}, others[] = {1, 4, 16};
  lit->stated = true;
  lit->size = 64; /* receivers must not miss thin edges */
  lit->away =
      lit->kind == HARD_SHEET ? sheets[random_choose(seed, 5)] : others[random_choose(seed, 3)];
  if (lit->kind == HARD_SHEET) lit->most = 1 + random_choose(seed, 5);
  face(seed, lit->away, true, lit);
}

const struct hard_row hard_rows[] = {
    {"pov-edge", "just above and just below the smallest Scale", row_edge},
    {"pov-units", "lamp units over 280 decades, the scene over 13, coloured Gain", row_units},
    {"pov-place", "turned, mirrored, as far from the origin as headers allow", row_place},
    {"pov-gain", "radiance and Gain to the ends of single precision", row_gain},
    {"pov-range", "peaks beyond half floats, samples over 24 decades", row_range},
    {"pov-window", "narrow, steep and oblique windows, thin apertures", row_window},
    {"pov-st-plane", "st plane at 1e-3 to 1e6 widths", row_st_plane},
    {"pov-lights", "numbers of lights, whole and broken", row_lights},
    {"pov-pages", "two pages", row_pages},
    {"pov-beams", "2 to 20 lamps in each other's beams", row_beams},
    {"pov-switches", "POV-Ray's switches", row_switches},
    {"pov-arguments", "what is given for Scale and Gain", row_arguments},
    {"pov-stated", "the errors that headers state", row_stated},
};
const int hard_row_count = (int)(sizeof hard_rows / sizeof *hard_rows);

void hard_make(int row, uint32_t seed, struct hard_case *lit) {
  uint64_t state = (uint64_t)seed << 8 | (uint64_t)row;
  memset(lit, 0, sizeof *lit);
  lit->kind = (enum hard_kind)(seed % HARD_KINDS);
  lit->size = 20;
  easy(&state, lit);
  hard_rows[row].make(&state, lit);
}
