/* focus.c
 *
 * 1. Find the lamp's opening (opening.h); only rays that are clear of its edge count below.
 * 2. For some depths: put the rays onto the plane there, and see how well those that are held out
 *    are told (rebin.h, without samples).
 * 3. At the best depth, rebin all rays into samples on that plane: a rectangle as large as the
 *    lines through aperture and window meet, with the aperture's spacing.
 * 4. A sample of the slab is what these say along its ray, by the part of its cell that is open.
 * Where the depth is d, neighbours in direction see points of the plane that are d times their
 * distance in slope apart: so many directions are made that this is one cell of the plane, or less.
 */
#include "import/pictures/focus.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/pictures/opening.h"
#include "slab/plane.h"

enum { MOST_ST = 64, MOST_NODES = 1 << 22 };
/* In widths of the aperture. */
static const double depths[] = {0, 0.125, 0.25, 0.375, 0.5, 0.75, 1};
enum { DEPTHS = sizeof depths / sizeof *depths };
/* From the best of them, halving. */
static const double first_step = 1. / 16, last_step = 1. / 32;
/* A depth other than 0 must be told better by this much: it costs light at the aperture's edge. */
static const double gain = 0.98;

/* The slope of a ray through (a, s), along either pair of axes. */
static double slope(const struct slab *slab, double a, double s) {
  return s - slab_kappa(slab) * a;
}

/* The plane at a depth as a slab without samples: a grid of places there and of the slab's own s
 * and t. */
static void lay_plane(const struct slab *slab, double depth, struct slab *plane) {
  *plane = *slab;
  plane->rgb = NULL;
  plane->json = NULL;
  for (int k = 0; k < 2; ++k) {
    double half = 0.5 * plane_edge(slab, SLAB_U + k), spacing = slab_spacing(slab, SLAB_U + k);
    double reach = half;
    for (int c = 0; c < 4; ++c) {
      double a = c % 2 ? half : -half, s = slab->st_window[2 * k + c / 2];
      reach = fmax(reach, fabs(a - depth * slope(slab, a, s)));
    }
    int samples = 2 * (int)ceil((reach - half) / spacing - 1e-9) + slab->samples[SLAB_U + k];
    double *edge = k ? plane->v : plane->u, factor = (double)samples / slab->samples[SLAB_U + k];
    for (int n = 0; n < 3; ++n) edge[n] *= factor;
    plane->samples[SLAB_U + k] = samples;
  }
  for (int n = 0; n < 3; ++n) plane->center[n] -= depth * slab->normal[n];
}

static double nodes(const struct slab *slab) {
  double product = 1;
  for (int axis = 0; axis < SLAB_AXES; ++axis) product *= slab->samples[axis];
  return product;
}

/* (a, b) of a ray on the plane at the depth; s and t stay what they are in the slab's window. */
static void carry(const struct slab *slab, double depth, const double abst[SLAB_AXES],
                  double ab[2]) {
  for (int k = 0; k < 2; ++k) ab[k] = abst[k] - depth * slope(slab, abst[k], abst[2 + k]);
}

static void carry_rays(const struct slab *slab, double depth, const struct slab *plane,
                       const struct rebin_ray *rays, size_t count, struct rebin_ray *carried) {
  for (size_t n = 0; n < count; ++n) {
    double abst[SLAB_AXES], ab[2];
    carried[n] = rays[n];
    for (int axis = 0; axis < SLAB_AXES; ++axis)
      abst[axis] =
          slab_position(slab, axis, 0) + (double)rays[n].at[axis] * slab_spacing(slab, axis);
    carry(slab, depth, abst, ab);
    for (int k = 0; k < 2; ++k)
      carried[n].at[k] = (float)((ab[k] - slab_position(plane, k, 0)) / slab_spacing(plane, k));
  }
}

/* ---- Steps 2 to 4 ---- */

struct search {
  const struct rebin_ray *rays;
  size_t count;
  const struct slab *slab;
  struct rebin_ray *carried; /* count of them; scratch */
  double depth, error;       /* the best so far, error as told there */
};

static enum result try_depth(struct search *search, double depth, struct error *error) {
  struct slab plane;
  struct rebin_report report;
  lay_plane(search->slab, depth, &plane);
  if (depth < 0 || nodes(&plane) > MOST_NODES) return RESULT_OK;
  carry_rays(search->slab, depth, &plane, search->rays, search->count, search->carried);
  enum result result = rebin(search->carried, search->count, &plane, NULL, &report, error);
  if (result != RESULT_OK) return result;
  if (search->depth > 0 && !(report.error < search->error)) return RESULT_OK;
  if (search->depth == 0 && depth > 0 && !(report.error < gain * search->error)) return RESULT_OK;
  search->depth = depth;
  search->error = report.error;
  return RESULT_OK;
}

static enum result find_depth(struct search *search, struct error *error) {
  double width = plane_width(search->slab);
  enum result result = RESULT_OK;
  for (int k = 0; k < DEPTHS && result == RESULT_OK; ++k)
    result = try_depth(search, depths[k] * width, error);
  for (double step = first_step; step >= last_step && search->depth > 0; step /= 2) {
    double middle = search->depth;
    if (result == RESULT_OK) result = try_depth(search, middle - step * width, error);
    if (result == RESULT_OK) result = try_depth(search, middle + step * width, error);
  }
  return result;
}

static void choose_directions(double depth, const int st[2], struct slab *slab) {
  for (int k = 0; k < 2; ++k) {
    double width = slab->st_window[2 * k + 1] - slab->st_window[2 * k];
    double wanted = ceil(width * depth / slab_spacing(slab, SLAB_U + k));
    int *samples = &slab->samples[SLAB_S + k];
    *samples = st[k] ? st[k] : (int)fmax(*samples, fmin(MOST_ST, wanted));
  }
}

/* The sample nearest to a place on an axis. */
static int nearest(const struct slab *slab, int axis, double x) {
  double at = round((x - slab_position(slab, axis, 0)) / slab_spacing(slab, axis));
  return (int)fmin(fmax(at, 0), slab->samples[axis] - 1);
}

static bool is_known(const struct slab *plane, const bool *known, const double abst[SLAB_AXES]) {
  int at[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis) at[axis] = nearest(plane, axis, abst[axis]);
  return known[(slab_at(plane, at[0], at[1], at[2], at[3]) - plane->rgb) / 3];
}

/* The radiance that the plane has along the rays of the slab's samples, and what is not known of
 * it. */
static void fill(const struct slab *plane, const bool *known, const struct opening *opening,
                 struct slab *slab, struct focus_report *report) {
  size_t count = slab_sample_count(slab), holes = 0;
  double all = 0, filled = 0;
  for (size_t n = 0; n < count; ++n) {
    int at[SLAB_AXES];
    double abst[SLAB_AXES], ab[2], rgb[3], square = 1;
    float *to = slab->rgb + 3 * n;
    slab_locate(slab, n, at);
    for (int axis = 0; axis < SLAB_AXES; ++axis) abst[axis] = slab_position(slab, axis, at[axis]);
    for (int k = 0; k < 2; ++k) {
      double across = slope(slab, abst[k], abst[2 + k]);
      square += across * across;
    }
    carry(slab, report->depth, abst, ab);
    memcpy(abst, ab, sizeof ab);
    slab_lookup(plane, abst[0], abst[1], abst[2], abst[3], rgb);
    double share = opening_share(opening, at[SLAB_U], at[SLAB_V]);
    for (int c = 0; c < 3; ++c) to[c] = (float)(share * rgb[c]);
    double flux = slab_luminance(to) / (square * square); /* the cosine's fourth power */
    all += flux;
    if (share == 0 || is_known(plane, known, abst)) continue;
    ++holes;
    filled += flux;
  }
  report->holes = (double)holes / (double)count;
  report->flux_holes = all > 0 ? filled / all : 0;
}

/* The rays that are clear of the opening's edge come first, then those at its edge, whose number is
 * returned. */
static size_t sort_rays(struct search *search, const struct opening *opening,
                        struct rebin_ray *sorted) {
  size_t clear = 0, edge = 0;
  for (int part = OPENING_CLEAR; part <= OPENING_EDGE; ++part)
    for (size_t n = 0; n < search->count; ++n) {
      if (opening_part(opening, &search->rays[n]) != (enum opening_part)part) continue;
      sorted[clear + edge] = search->rays[n];
      ++*(part == OPENING_CLEAR ? &clear : &edge);
    }
  search->rays = sorted;
  search->count = clear;
  return edge;
}

/* What the plane has along rays at the edge of the opening. */
static void compare_edges(const struct slab *plane, const struct search *search, size_t edges,
                          struct opening *opening) {
  const struct rebin_ray *edge = search->rays + search->count;
  carry_rays(search->slab, search->depth, plane, edge, edges, search->carried);
  for (size_t n = 0; n < edges; ++n) {
    double abst[SLAB_AXES], rgb[3];
    for (int axis = 0; axis < SLAB_AXES; ++axis)
      abst[axis] = slab_position(plane, axis, 0) +
                   (double)search->carried[n].at[axis] * slab_spacing(plane, axis);
    slab_lookup(plane, abst[0], abst[1], abst[2], abst[3], rgb);
    opening_compare(opening, &edge[n], 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
  }
}

/* Steps 3 and 4. */
static enum result make_slab(const struct search *search, size_t edges, struct opening *opening,
                             const int st[2], struct slab *slab, struct focus_report *report,
                             struct error *error) {
  struct slab plane;
  bool *known = NULL;
  double depth = search->depth;
  *report = (struct focus_report){.depth = depth};
  lay_plane(slab, depth, &plane);
  carry_rays(slab, depth, &plane, search->rays, search->count, search->carried);
  enum result result = slab_alloc(&plane, error);
  if (result == RESULT_OK) {
    known = calloc(slab_sample_count(&plane), sizeof *known);
    if (!known) result = result_no_memory(error);
  }
  if (result == RESULT_OK)
    result = rebin(search->carried, search->count, &plane, known, &report->rebin, error);
  if (result == RESULT_OK) compare_edges(&plane, search, edges, opening);
  choose_directions(depth, st, slab);
  if (result == RESULT_OK) result = slab_alloc(slab, error);
  if (result == RESULT_OK) fill(&plane, known, opening, slab, report);
  free(plane.rgb);
  free(known);
  return result;
}

enum result focus_rebin(const struct rebin_ray *rays, size_t count, const int st[2],
                        struct slab *slab, struct focus_report *report, struct error *error) {
  struct opening opening = {0};
  struct rebin_ray *room = calloc(2 * count + 1, sizeof *room);
  struct search search = {rays, count, slab, room ? room + count : NULL, 0, NAN};
  enum result result = room ? RESULT_OK : result_no_memory(error);
  size_t edges = 0;
  if (result == RESULT_OK) result = opening_find(rays, count, slab, &opening, error);
  if (result == RESULT_OK) edges = sort_rays(&search, &opening, room);
  if (result == RESULT_OK) result = find_depth(&search, error);
  if (result == RESULT_OK) result = make_slab(&search, edges, &opening, st, slab, report, error);
  opening_free(&opening);
  free(room);
  return result;
}
