/* photometry_pages.c -
 *  1. Shares out the intensities of a grid of directions among the faces, by their projected areas,
 *     and sums the flux of each face by slope along u and along v.
 *  2. Cuts each of the four ends of a window where the flux beyond it is a small part of the lamp's
 *     and the intensity there is small too.
 *  3. Where too much lies beyond the steepest slope of all, and of round bodies always, neighbours
 *     take it over; what is flat or thin gets sides for that, or thicker ones, and step 1 begins
 *     again. */
#include "import/photometric/photometry_pages.h"

#include <math.h>
#include <stdlib.h>

enum {
  STEPS_C = 240, /* directions, in C and in gamma */
  STEPS_GAMMA = 240,
  BINS = 358, /* of slopes: half degrees from -steepest to steepest */
};
static const double steepest = 89.5;    /* degrees */
static const double steep_slope = 28.6; /* 88 degrees: where windows end, but along cylinders */

/* Beyond an end: part of the lamp's flux, and the intensity there over the lamp's largest, as a
 * part of the tolerance (of flat ones, that lose it only along themselves, more); where a neighbour
 * takes it over, part of the flux, or of the area in each direction: so much brighter the neighbour
 * becomes there. */
static const double cut_flux = 0.0005, cut_peak = 0.3, cut_flat = 0.8, cut_shared = 0.0002,
                    cut_narrow = 0.002, cut_share = 0.015, cut_round = 0.03;
/* Slopes beyond which a neighbour may go on: it faces such directions more than the page does; of
 * round bodies where the page's part of the area is small, too. */
static const double least_shared = 2, least_small = 0.25;
/* Thin bodies' windows end here at the latest: their sides are bright beyond. */
static const double most_thin = 8;
/* Where a page fades: from this part of the slope at the end on. */
static const double fade_from = 0.6;
/* A flat opening may lose as much beyond steep_slope. */
static const double lost_flux = 0.002, lost_peak = 0.05;

/* What a face sends, by slope. */
struct profile {
  double flux[2][BINS];  /* along u, along v */
  double peak[2][BINS];  /* largest intensity */
  double share[2][BINS]; /* largest part of a direction's projected area */
  double beyond, beyond_peak;
};

struct survey {
  struct profile face[BODY_FACES];
  double flux, peak; /* of all directions */
};

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void face_slopes(const struct photometry_face *face, const double direction[3],
                        double cosine, double st[2]) {
  st[0] = dot(direction, face->u) / face->size[0] / cosine;
  st[1] = dot(direction, face->v) / face->size[1] / cosine;
}

static int bin_of(double slope) {
  double bin = (atan(slope) * 180 / M_PI + steepest) * BINS / (2 * steepest);
  return bin < 0 || bin >= BINS ? -1 : (int)bin;
}

static void count_direction(const struct photometry_body *body, const double d[3], double candela,
                            double solid_angle, struct survey *survey) {
  double area = photometry_area(body, d), share_peak = fabs(candela);
  survey->flux += fabs(candela) * solid_angle;
  survey->peak = fmax(survey->peak, fabs(candela));
  for (int f = 0; f < BODY_FACES; ++f) {
    const struct photometry_face *face = &body->face[f];
    struct profile *profile = &survey->face[f];
    double cosine = dot(d, face->normal), st[2];
    if (!(face->size[0] > 0) || !(cosine > 0) || candela == 0) continue;
    double share = area > 0 ? fmin(1, photometry_face_area(body, f, d) / area) : 1;
    double flux = share * fabs(candela) * solid_angle;
    face_slopes(face, d, cosine, st);
    int bin[2] = {bin_of(st[0]), bin_of(st[1])};
    if (fmax(fabs(st[0]), fabs(st[1])) > steep_slope) {
      profile->beyond += flux;
      profile->beyond_peak = fmax(profile->beyond_peak, share * share_peak);
    }
    for (int k = 0; k < 2; ++k) {
      if (bin[k] < 0) continue;
      profile->flux[k][bin[k]] += flux;
      profile->peak[k][bin[k]] = fmax(profile->peak[k][bin[k]], share * share_peak);
      profile->share[k][bin[k]] = fmax(profile->share[k][bin[k]], share);
    }
  }
}

static void look(const struct photometry *lamp, const struct photometry_body *body,
                 struct survey *survey) {
  size_t count = (size_t)lamp->planes * (size_t)lamp->rows;
  *survey = (struct survey){0};
  for (int j = 0; j < STEPS_GAMMA; ++j) {
    double gamma = (j + 0.5) * M_PI / STEPS_GAMMA;
    double ring = sin(gamma) * 2 * sin(M_PI / STEPS_GAMMA / 2) * 2 * M_PI / STEPS_C;
    for (int i = 0; i < STEPS_C; ++i) {
      double c = (i + 0.5) * 2 * M_PI / STEPS_C;
      double d[3] = {sin(gamma) * cos(c), -cos(gamma), sin(gamma) * sin(c)};
      count_direction(body, d, photometry_candela(lamp, d), ring, survey);
    }
  }
  for (size_t n = 0; n < count; ++n) { /* narrow beams' largest may lie between those */
    double d[3];
    photometry_table_direction(lamp, n, d);
    count_direction(body, d, lamp->candela[n], 0, survey);
  }
}

/* Whether the body has a face towards which u or v, times `sign`, points. */
static bool has_neighbour(const struct photometry_body *body, int face, int axis, int sign) {
  const double *along = axis == 0 ? body->face[face].u : body->face[face].v;
  for (int f = 0; f < BODY_FACES; ++f)
    if (body->face[f].size[0] > 0 && sign * dot(body->face[f].normal, along) > 0) return true;
  return false;
}

static double slope_of(int edge) {
  return tan((edge * 2 * steepest / BINS - steepest) * M_PI / 180);
}

/* How many bins beyond an end are cut off: those, from the steepest on, that hold little. Where a
 * neighbour takes them over, steep ones of which it has most, and of thin bodies all. Not `along`
 * a cylinder: what its end would take over there lies within a few degrees of the end's normal, too
 * few for the end's cells. */
static int cut_end(const struct survey *survey, const struct profile *profile, int axis, int sign,
                   const struct photometry_pages *pages, bool shared, bool along, double peak_cut) {
  bool even = photometry_is_even(&pages->body);
  double sum = 0, share_cut = even ? cut_share : cut_round;
  double least_slope = even ? least_shared : least_small;
  for (int n = 0; n < BINS - 2; ++n) {
    int bin = sign > 0 ? BINS - 1 - n : n;
    double slope = sign * slope_of(sign > 0 ? bin : bin + 1);
    bool others = shared && slope >= least_shared;
    bool small = shared && slope >= least_slope && profile->share[axis][bin] <= share_cut;
    sum += profile->flux[axis][bin];
    if (slope > steep_slope && !along) continue;
    if (small || (others && pages->thick && slope >= most_thin)) continue;
    if (sum > (!others ? cut_flux : pages->narrow ? cut_narrow : cut_shared) * survey->flux)
      return n;
    if (!others && profile->peak[axis][bin] > peak_cut * survey->peak) return n;
  }
  return BINS - 2;
}

/* Puts 0 into the middle of a window that is nearly so. */
static void centre(double ends[2]) {
  double longer = fmax(-ends[0], ends[1]), shorter = fmin(-ends[0], ends[1]);
  if (shorter < longer / 4) return;
  ends[0] = -longer;
  ends[1] = longer;
}

static void cut(const struct survey *survey, const struct photometry_pages *pages, double peak_cut,
                struct photometry_page *page) {
  const struct profile *profile = &survey->face[page->face];
  for (int axis = 0; axis < 2; ++axis) {
    int ends[2] = {0, BINS};
    for (int high = 0; high < 2; ++high) {
      int sign = high ? 1 : -1;
      bool shared = pages->shared && has_neighbour(&pages->body, page->face, axis, sign);
      bool along = !pages->narrow && photometry_runs_along(&pages->body, page->face, axis);
      int count = cut_end(survey, profile, axis, sign, pages, shared && !along, along, peak_cut);
      ends[high] = high ? BINS - count : count;
      page->fades[2 * axis + high] =
          shared && sign * slope_of(ends[high]) >
                        (photometry_is_even(&pages->body) ? least_shared : least_small);
    }
    if (ends[0] >= ends[1]) ends[1] = ends[0] + 1;
    page->window[2 * axis] = slope_of(ends[0]);
    page->window[2 * axis + 1] = slope_of(ends[1]);
    if (!photometry_is_even(&pages->body)) centre(page->window + 2 * axis);
  }
}

static int count_faces(const struct photometry_body *body) {
  int count = 0;
  for (int f = 0; f < BODY_FACES; ++f) count += body->face[f].size[0] > 0;
  return count;
}

static bool loses(const struct survey *survey, const struct photometry_body *body) {
  double flux = 0, held = 0;
  for (int f = 0; f < BODY_FACES; ++f) {
    const struct profile *profile = &survey->face[f];
    if (!(body->face[f].size[0] > 0)) continue;
    flux += profile->beyond;
    held += profile->beyond;
    for (int n = 0; n < BINS; ++n) held += profile->flux[0][n];
    if (profile->beyond_peak > lost_peak * survey->peak) return true;
  }
  return flux > lost_flux * survey->flux || held < (1 - lost_flux) * survey->flux;
}

static void choose(const struct survey *survey, double tolerance, struct photometry_pages *pages) {
  double peak_cut = tolerance * (count_faces(&pages->body) > 2 ? cut_peak : cut_flat);
  pages->count = 0;
  for (int f = 0; f < BODY_FACES; ++f) {
    struct photometry_page *page = &pages->page[pages->count];
    const struct profile *profile = &survey->face[f];
    double flux = 0, peak = 0;
    for (int n = 0; n < BINS; ++n) {
      flux += profile->flux[0][n];
      peak = fmax(peak, profile->peak[0][n]);
    }
    if (flux <= cut_flux * survey->flux && peak <= peak_cut * survey->peak) continue;
    page->face = f;
    cut(survey, pages, peak_cut, page);
    ++pages->count;
  }
}

enum result photometry_pages(const struct photometry *lamp, double tolerance, bool narrow,
                             struct photometry_pages *pages, struct error *error) {
  struct survey *survey = malloc(sizeof *survey);
  if (!survey) return result_no_memory(error);
  *pages = (struct photometry_pages){0};
  photometry_body(lamp, false, &pages->body);
  look(lamp, &pages->body, survey);
  bool lost = loses(survey, &pages->body);
  pages->narrow = narrow && count_faces(&pages->body) > 2;
  pages->shared = lost || pages->narrow || !photometry_is_even(&pages->body);
  if (lost && photometry_is_thin(&pages->body)) {
    pages->thick = true;
    photometry_body(lamp, true, &pages->body);
    look(lamp, &pages->body, survey);
  }
  choose(survey, tolerance, pages);
  bool dark = !(survey->flux > 0);
  free(survey);
  if (!dark && pages->count > 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "the lamp has no light: all intensities are 0");
}

void photometry_positions(const struct photometry_pages *pages, int page, int along, int uv[2]) {
  const struct photometry_body *body = &pages->body;
  const struct photometry_face *face = &body->face[pages->page[page].face];
  double longer = fmax(face->size[0], face->size[1]);
  for (int axis = 0; axis < 2; ++axis) {
    double part = face->size[axis] / longer;
    const double *edge = axis == 0 ? face->u : face->v;
    if (body->shape == PHOTOMETRY_CYLINDER && edge[body->axis] != 0)
      part = fmax(part / 4, 2.0 / along);
    else if (body->shape != PHOTOMETRY_BOX)
      part = 1;
    uv[axis] = (int)fmax(1, round(along * part));
  }
}

void photometry_direction(const struct photometry_pages *pages, int page, double s, double t,
                          double direction[3]) {
  const struct photometry_face *face = &pages->body.face[pages->page[page].face];
  double length = sqrt(1 + s * s + t * t);
  for (int k = 0; k < 3; ++k)
    direction[k] =
        (face->normal[k] + s * face->u[k] / face->size[0] + t * face->v[k] / face->size[1]) /
        length;
}

bool photometry_slopes(const struct photometry_pages *pages, int page, const double direction[3],
                       double st[2]) {
  const struct photometry_face *face = &pages->body.face[pages->page[page].face];
  double cosine = dot(direction, face->normal);
  if (!(cosine > 0)) return false;
  face_slopes(face, direction, cosine, st);
  return true;
}

/* The weight of a page towards a direction. */
static double weight_of(const struct photometry_pages *pages, int page, const double direction[3]) {
  const struct photometry_page *at = &pages->page[page];
  double st[2], weight = 1;
  if (!photometry_slopes(pages, page, direction, st)) return 0;
  for (int end = 0; end < 4; ++end) {
    double limit = at->window[end], slope = st[end / 2];
    bool beyond = end % 2 ? slope > limit : slope < limit;
    if (beyond) return 0;
    if (at->fades[end] && slope / limit > fade_from)
      weight *= (1 - slope / limit) / (1 - fade_from);
  }
  return weight;
}

double photometry_gain(const struct photometry_pages *pages, int page, const double direction[3]) {
  const struct photometry_body *body = &pages->body;
  double weight[BODY_FACES] = {0}, held = 0, whole = 0;
  bool all = true;
  if (!pages->shared) return 1 / photometry_area(body, direction);
  double own = weight_of(pages, page, direction);
  if (!(own > 0)) return 0;
  for (int n = 0; n < pages->count; ++n)
    weight[pages->page[n].face] = n == page ? own : weight_of(pages, n, direction);
  for (int f = 0; f < BODY_FACES; ++f)
    all = all && (weight[f] == 1 || !(body->face[f].size[0] > 0) ||
                  dot(direction, body->face[f].normal) <= 0);
  if (all) return 1 / photometry_area(body, direction);
  for (int f = 0; f < BODY_FACES; ++f) {
    double area = photometry_face_area(body, f, direction);
    whole += area;
    held += weight[f] * area;
  }
  return held > 0 ? own * whole / held / photometry_area(body, direction) : 0;
}

double photometry_radiance(const struct photometry *lamp, const struct photometry_pages *pages,
                           int page, const double direction[3]) {
  double candela = photometry_candela(lamp, direction);
  return candela == 0 ? 0 : candela * photometry_gain(pages, page, direction);
}
