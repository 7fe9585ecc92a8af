/* flux_box.c - the flux on a closed box, by quasi-Monte Carlo integration.
 *
 * 1. Find the part of the aperture and of the window that is not black.
 * 2. For each of the box's five faces, find the part that rays from there may reach.
 * 3. Take pairs of a point of the aperture and a point of the face, from Roberts' sequence in four
 *    dimensions. Each contributes L cos cos' / r^2, by the ray that joins them.
 * 4. Sum in blocks of consecutive points. The scatter of the blocks' sums is the standard error.
 *
 * M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
 *
 * Lengths are in aperture widths here, x along u, y along v and z along the normal, from the
 * aperture's middle. */
#include "slab/flux_box.h"

#include <math.h>

#include "slab/plane.h"
#include "slab/slab_profile.h"

enum { BLOCKS = 16, BLOCK_POINTS = 1 << 14, TWICE_POINTS = 1 << 16, WALLS = 4 };

/* Fewer points than this with light are too few. */
static const double points_needed = 1000;

struct range {
  double low, high;
};

static struct range intersect(struct range a, struct range b) {
  return (struct range){fmax(a.low, b.low), fmin(a.high, b.high)};
}

static double along(struct range range, double share) {
  return range.low + share * (range.high - range.low);
}

static double size(struct range range) {
  return fmax(range.high - range.low, 0);
}

/* The part of the aperture and of the window that is not black. */
struct source {
  const struct slab *slab;
  double width, kappa;
  double frame[3][3]; /* u, v and normal, one width long, in lamp space */
  struct range axis[SLAB_AXES];
};

static enum result make_source(const struct slab *slab, struct source *source,
                               struct error *error) {
  double width = plane_width(slab);
  *source = (struct source){.slab = slab, .width = width, .kappa = slab_kappa(slab) * width};
  for (int c = 0; c < 3; ++c) {
    source->frame[0][c] = slab->u[c] / plane_edge(slab, SLAB_U) * width;
    source->frame[1][c] = slab->v[c] / plane_edge(slab, SLAB_V) * width;
    source->frame[2][c] = slab->normal[c] * width;
  }
  struct slab_profile profile;
  enum result result = slab_profile(slab, &profile, error);
  for (int axis = 0; axis < SLAB_AXES && result == RESULT_OK; ++axis) {
    int first = 0, last = slab->samples[axis] - 1;
    double unit = axis < SLAB_S ? width : 1, spacing = slab_spacing(slab, axis);
    struct range lit, all;
    while (first < last && profile.axis[axis][first] == 0) ++first;
    while (last > first && profile.axis[axis][last] == 0) --last;
    /* As far as interpolation carries the outermost light. */
    lit.low = slab_position(slab, axis, first) - spacing;
    lit.high = slab_position(slab, axis, last) + spacing;
    all.low = slab_position(slab, axis, 0) - spacing / 2;
    all.high = slab_position(slab, axis, slab->samples[axis] - 1) + spacing / 2;
    source->axis[axis] = intersect(lit, all);
    source->axis[axis].low /= unit;
    source->axis[axis].high /= unit;
  }
  slab_profile_free(&profile);
  return result;
}

/* A face of the box: z = height, or axis k = side * place. */
struct face {
  int axis, side;
  double place;
  struct range lit[3]; /* where light may arrive; along `axis`, the face itself */
};

/* Slopes of rays along x or y: s - kappa a. */
static struct range slopes(const struct source *source, int k) {
  struct range place = source->axis[SLAB_U + k], slope = source->axis[SLAB_S + k];
  return (struct range){slope.low - source->kappa * place.high,
                        slope.high - source->kappa * place.low};
}

static double half_box(const struct source *source, int k) {
  return 1 + plane_edge(source->slab, SLAB_U + k) / source->width / 2;
}

/* What rays reach along axis k of the box from z.low to z.high. */
static struct range reach(const struct source *source, int k, struct range z) {
  struct range place = source->axis[SLAB_U + k], slope = slopes(source, k);
  struct range reached = {place.low + fmin(slope.low * z.low, slope.low * z.high),
                          place.high + fmax(slope.high * z.low, slope.high * z.high)};
  return intersect(reached, (struct range){-half_box(source, k), half_box(source, k)});
}

static struct face make_lid(const struct source *source) {
  struct face face = {.axis = 2, .side = 1, .place = 1};
  face.lit[2] = (struct range){1, 1};
  for (int k = 0; k < 2; ++k) face.lit[k] = reach(source, k, face.lit[2]);
  return face;
}

static struct face make_wall(const struct source *source, int k, int side) {
  struct face face = {.axis = k, .side = side, .place = half_box(source, k)};
  struct range slope = slopes(source, k), place = source->axis[SLAB_U + k];
  double nearest = face.place - (side > 0 ? place.high : -place.low);
  double farthest = face.place - (side > 0 ? place.low : -place.high);
  double steepest = side > 0 ? slope.high : -slope.low;
  double flattest = side > 0 ? slope.low : -slope.high;
  face.lit[k] = (struct range){side * face.place, side * face.place};
  face.lit[2] = steepest > 0 ? (struct range){nearest / steepest, 1} : (struct range){1, 1};
  if (flattest > 0) face.lit[2].high = fmin(1, farthest / flattest);
  face.lit[1 - k] = reach(source, 1 - k, face.lit[2]);
  return face;
}

static double face_area(const struct face *face) {
  double area = 1;
  for (int k = 0; k < 3; ++k) area *= k == face->axis ? 1 : size(face->lit[k]);
  return area;
}

/* Point n of Roberts' sequence: powers of the root of x^5 = x + 1. */
static void sequence(int n, double share[4]) {
  static const double step[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378086,
                                 0.5385972572236100};
  for (int k = 0; k < 4; ++k) share[k] = fmod(0.5 + (n + 1) * step[k], 1);
}

/* Point n of step 3. */
static void sample(const struct source *source, const struct face *face, int n, double rgb[3]) {
  const struct slab *slab = source->slab;
  double share[4], way[3], point[3] = {0}, direction[3] = {0}, abst[SLAB_AXES], square = 0;
  sequence(n, share);
  for (int k = 0, next = 2; k < 3; ++k) {
    double from = k < 2 ? along(source->axis[SLAB_U + k], share[k]) : 0;
    double to = k == face->axis ? face->side * face->place : along(face->lit[k], share[next++]);
    way[k] = to - from;
    square += way[k] * way[k];
    for (int c = 0; c < 3; ++c) {
      direction[c] += way[k] * source->frame[k][c];
      point[c] += to * source->frame[k][c];
    }
  }
  for (int c = 0; c < 3; ++c) point[c] += slab->center[c];
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!slab_ray(slab, point, direction, abst)) return;
  slab_lookup(slab, abst[0], abst[1], abst[2], abst[3], rgb);
  double weight = way[2] / square * (face->side * way[face->axis] / square);
  for (int c = 0; c < 3; ++c) rgb[c] *= weight;
}

/* Sums over all points so far, of the whole box. */
struct sums {
  double block[BLOCKS][3];
  double all, squares; /* of |radiance| */
};

static void add_face(const struct source *source, const struct face *face, struct sums *sums) {
  double weight = face_area(face) * size(source->axis[SLAB_U]) * size(source->axis[SLAB_V]) *
                  source->width * source->width / BLOCK_POINTS;
  if (weight == 0) return;
  for (int block = 0; block < BLOCKS; ++block)
    for (int n = 0; n < BLOCK_POINTS; ++n) {
      double rgb[3], all = 0;
      sample(source, face, block * BLOCK_POINTS + n, rgb);
      for (int c = 0; c < 3; ++c) {
        sums->block[block][c] += weight * rgb[c];
        all += fabs(weight * rgb[c]);
      }
      sums->all += all;
      sums->squares += all * all;
    }
}

/* The uncertainty is three standard errors; the sum itself converges faster. */
static void compare(const struct sums *sums, struct flux_box *flux) {
  double worst = 0, variance = 0, all = sums->all / BLOCKS;
  bool black = sums->all == 0;
  for (int c = 0; c < 3; ++c) black = black && flux->aperture[c] == 0;
  if (black) return;
  for (int c = 0; c < 3; ++c) {
    double mean = 0, squares = 0;
    for (int n = 0; n < BLOCKS; ++n) mean += sums->block[n][c] / BLOCKS;
    for (int n = 0; n < BLOCKS; ++n) squares += pow(sums->block[n][c] - mean, 2);
    flux->box[c] = mean;
    if (fabs(mean - flux->aperture[c]) > fabs(worst)) worst = mean - flux->aperture[c];
    variance += squares / (BLOCKS - 1) / BLOCKS;
  }
  flux->difference = worst / all;
  flux->uncertainty = 3 * sqrt(variance) / all;
  if (!(sums->all * sums->all >= points_needed * sums->squares)) flux->uncertainty = INFINITY;
}

enum result flux_box_measure(const struct slab *slab, struct flux_box *flux, struct error *error) {
  struct source source;
  struct sums sums = {0};
  *flux = (struct flux_box){0};
  enum result result = make_source(slab, &source, error);
  if (result == RESULT_OK) result = slab_flux(slab, flux->aperture, error);
  if (result != RESULT_OK) return result;
  struct face face = make_lid(&source);
  add_face(&source, &face, &sums);
  for (int wall = 0; wall < WALLS; ++wall) {
    face = make_wall(&source, wall / 2, wall % 2 ? 1 : -1);
    add_face(&source, &face, &sums);
  }
  compare(&sums, flux);
  return RESULT_OK;
}

bool flux_box_leaves(const struct slab *page, const double point[3], const double direction[3],
                     double *ahead) {
  double abst[SLAB_AXES];
  *ahead = 0;
  if (!slab_ray(page, point, direction, abst)) return false;
  for (int c = 0; c < 3; ++c) *ahead += (page->center[c] - point[c]) * page->normal[c];
  for (int k = 0; k < 2; ++k)
    if (fabs(abst[k]) > plane_edge(page, k) / 2) return false;
  return abst[SLAB_S] >= page->st_window[0] && abst[SLAB_S] <= page->st_window[1] &&
         abst[SLAB_T] >= page->st_window[2] && abst[SLAB_T] <= page->st_window[3];
}

/* Which pages a ray of page `self` must not leave by later on: of `count`, or one on the side. */
struct later {
  const struct slab *pages;
  int count, self; /* self: -1 where the slab is none of the pages */
};

/* A point on a page's plane, within rounding, counts, but of two pages in one plane only the
 * second. Pages of another channel hold other light. */
static bool leaves_later(const struct later *later, const double point[3],
                         const double direction[3]) {
  for (int n = 0; n < later->count; ++n) {
    const struct slab *page = &later->pages[n];
    double ahead, least = plane_width(page) * (n > later->self ? -1e-9 : 1e-9);
    if (later->self >= 0 && !slab_same_channel(page, &later->pages[later->self])) continue;
    if (n != later->self && flux_box_leaves(page, point, direction, &ahead) && ahead >= least)
      return true;
  }
  return false;
}

/* The part of the slab's flux, of |radiance|, that leaves once more. */
static enum result find_share(const struct slab *slab, const struct later *later, double *share,
                              struct error *error) {
  struct source source;
  enum result result = make_source(slab, &source, error);
  double all = 0, twice = 0;
  for (int n = 0; n < TWICE_POINTS && result == RESULT_OK; ++n) {
    double shares[SLAB_AXES], at[SLAB_AXES], way[3] = {0, 0, 1}, rgb[3], square = 1;
    double point[3], direction[3] = {0};
    sequence(n, shares);
    for (int axis = 0; axis < SLAB_AXES; ++axis) at[axis] = along(source.axis[axis], shares[axis]);
    slab_lookup(slab, at[0] * source.width, at[1] * source.width, at[2], at[3], rgb);
    for (int k = 0; k < 2; ++k) {
      way[k] = at[SLAB_S + k] - source.kappa * at[k];
      square += way[k] * way[k];
    }
    for (int c = 0; c < 3; ++c) {
      point[c] = slab->center[c];
      for (int k = 0; k < 3; ++k) {
        point[c] += (k < 2 ? at[k] : 0) * source.frame[k][c];
        direction[c] += way[k] * source.frame[k][c];
      }
    }
    double light = (fabs(rgb[0]) + fabs(rgb[1]) + fabs(rgb[2])) / (square * square);
    all += light;
    if (light > 0 && leaves_later(later, point, direction)) twice += light;
  }
  *share = all > 0 ? twice / all : 0;
  return result;
}

enum result flux_box_twice(const struct slab *slab, const struct slab *other, double *share,
                           struct error *error) {
  return find_share(slab, &(struct later){other, 1, -1}, share, error);
}

enum result flux_box_lamp(const struct slab *pages, int count, double rgb[3], struct error *error) {
  enum result result = RESULT_OK;
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int n = 0; n < count && result == RESULT_OK; ++n) {
    double flux[3], twice = 0;
    result = slab_flux(&pages[n], flux, error);
    if (result == RESULT_OK && count > 1)
      result = find_share(&pages[n], &(struct later){pages, count, n}, &twice, error);
    for (int c = 0; c < 3; ++c) rgb[c] += (1 - twice) * flux[c];
  }
  return result;
}
