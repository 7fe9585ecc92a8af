/* sheet.c - from a lamp's slabs to the levels of its sheet.
 *
 * 1. A page's finest level has a light on each uv sample, or on each of at most `lights` blocks
 *    of them an axis; each further level has half as many (block means, slab_resample), down
 *    to one.
 * 2. A level's sheet stands where the tiles of neighbouring lights just do not overlap, or lower
 *    where they would shade the light of other pages.
 * 3. A level's error is that of its lights, summed, against the integral of the quadrilinear
 *    slab (plane_errors); that in a shadow the same, past an edge half way (plane_shadow.h).
 * 4. All levels' tiles go into one image (sheet_image.c). */
#include "include/sheet/sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/plane.h"
#include "slab/plane_shadow.h"
#include "slab/slab_resample.h"

/* In aperture widths, as the heads of the tables in sheet_page.inc.in say. */
static const double distances[SHEET_DISTANCES] = {0.5, 1, 2, 4, 8};

static double faintest_of(const struct slab *slab) {
  double faintest = INFINITY;
  size_t values = 3 * slab_sample_count(slab);
  for (size_t k = 0; k < values; ++k)
    if (slab->rgb[k] > 0) faintest = fmin(faintest, slab->rgb[k]);
  return faintest;
}

bool sheet_is_lit(const struct slab *views, int i, int j) {
  for (int l = 0; l < views->samples[SLAB_T]; ++l) {
    const float *row = slab_at(views, i, j, 0, l);
    for (int k = 0; k < 3 * views->samples[SLAB_S]; ++k)
      if (row[k] > 0) return true;
  }
  return false;
}

/* Height at which tiles of Ns+2 by Nt+2 texels, one before each light, just do not overlap: along
 * the tighter axis they meet. Where there are other pages, lower, so that no tile juts out over an
 * edge of the aperture: it would shade what they send past it. */
static double sheet_height(const struct slab *views, bool others) {
  double height = INFINITY, kappa = slab_kappa(views);
  for (int k = 0; k < 2; ++k) {
    double pitch = slab_spacing(views, SLAB_U + k), slope = slab_spacing(views, SLAB_S + k);
    const double *window = views->st_window + 2 * k;
    int texels = views->samples[SLAB_S + k] + 2 * SHEET_RING;
    height = fmin(height, pitch / (texels * slope + kappa * pitch));
    double last = (plane_edge(views, SLAB_U + k) - pitch) / 2;
    double jut = fmax(window[1], -window[0]) + SHEET_RING * slope - kappa * last;
    if (others && jut > 0) height = fmin(height, pitch / 2 / jut);
  }
  return height;
}

static enum result make_level(const struct slab *slab, int page, bool others, const int lights[2],
                              struct sheet_level *level, struct error *error) {
  const int samples[SLAB_AXES] = {lights[0], lights[1], slab->samples[SLAB_S],
                                  slab->samples[SLAB_T]};
  struct slab *views = &level->views;
  enum result result = slab_resample(slab, samples, views, error);
  if (result != RESULT_OK) return result;
  for (int j = 0; j < lights[1]; ++j)
    for (int i = 0; i < lights[0]; ++i) level->lit += sheet_is_lit(views, i, j);
  level->peak = include_peak(views);
  level->height = sheet_height(views, others);
  /* The colour that the include gives to a light, at Scale 1 and Gain 1. */
  double du = slab_spacing(views, SLAB_U), dv = slab_spacing(views, SLAB_V);
  double fade = 1e-3 * plane_width(views);
  return include_check_colour(level->peak * (du / fade) * (dv / fade) / (2 * M_PI), page, error);
}

static void add_lights(const void *levels, int k, const double at[3], double rgb[3]) {
  const struct slab *views = &((const struct sheet_level *)levels)[k].views;
  plane_irradiance(views, views->samples, at, at[2], rgb);
}

/* All levels' errors at a distance in aperture widths. */
static void measure(const struct slab *slab, double distance, const struct sheet_page *page,
                    double errors[SHEET_MOST_LEVELS]) {
  double away = distance * plane_width(slab);
  plane_errors(slab, away, 1, add_lights, page->levels, page->level_count, errors);
  for (int k = 0; k < page->level_count; ++k)
    if (page->levels[k].height >= away) errors[k] = INFINITY;
}

/* The lights that a receiver sees past the edge: whole cells. */
static void add_seen(const void *levels, int k, const struct plane_shadow_receiver *receiver,
                     double rgb[3]) {
  const struct slab *views = &((const struct sheet_level *)levels)[k].views;
  double until[2];
  for (int axis = 0; axis < 2; ++axis) {
    double du = slab_spacing(views, axis), half = plane_edge(views, axis) / 2;
    until[axis] = du * floor((receiver->until[axis] + half) / du + 0.5) - half;
  }
  plane_irradiance_until(views, views->samples, until, receiver->at, receiver->at[2], rgb);
}

static enum result measure_shadows(const struct slab *slab, double distance,
                                   struct sheet_page *page, struct error *error) {
  struct plane_shadow shadow;
  enum result result = plane_shadow_make(slab, distance * plane_width(slab), &shadow, error);
  for (int k = 0; k < page->level_count && result == RESULT_OK; ++k)
    page->levels[k].shadow_at = plane_shadow_error(&shadow, add_seen, page->levels, k);
  plane_shadow_free(&shadow);
  return result;
}

/* A page's share of what progress shows. */
struct shown {
  struct progress *progress; /* or NULL */
  double begun, part;
};

static void show(const struct shown *shown, int steps) {
  if (shown->progress)
    progress_show(shown->progress, shown->begun + shown->part * steps / (SHEET_DISTANCES + 2),
                  "measuring sheets");
}

static enum result make_page(const struct slab *slab, int number, bool others, int most,
                             double distance, const struct shown *shown, struct sheet_page *page,
                             struct error *error) {
  double errors[SHEET_MOST_LEVELS];
  int lights[2] = {slab->samples[SLAB_U], slab->samples[SLAB_V]};
  for (int k = 0; k < 2; ++k)
    if (most > 0 && lights[k] > most) lights[k] = most;
  for (bool last = false; !last;) {
    enum result result =
        make_level(slab, number, others, lights, &page->levels[page->level_count++], error);
    if (result != RESULT_OK) return result;
    last = lights[0] == 1 && lights[1] == 1;
    for (int k = 0; k < 2; ++k) lights[k] = (lights[k] + 1) / 2;
  }
  page->faintest = faintest_of(slab) / page->levels[0].peak;
  for (int d = 0; d < SHEET_DISTANCES; ++d) {
    show(shown, d);
    measure(slab, distances[d], page, errors);
    for (int k = 0; k < page->level_count; ++k) page->levels[k].error[d] = errors[k];
  }
  show(shown, SHEET_DISTANCES);
  if (distance > 0) measure(slab, distance, page, errors);
  for (int k = 0; k < page->level_count && distance > 0; ++k) page->levels[k].error_at = errors[k];
  show(shown, SHEET_DISTANCES + 1);
  if (distance > 0) {
    enum result result = measure_shadows(slab, distance, page, error);
    if (result != RESULT_OK) return result;
  }
  return slab_flux_metric(slab, page->flux, error);
}

/* Joins pages whose samples can be added. */
static void find_apertures(const struct slab *const *lit, int count, struct sheet *sheet) {
  for (int p = 0; p < count; ++p) {
    struct sheet_page *page = &sheet->pages[p];
    page->first = p;
    page->next = -1;
    page->channel = include_channel(&sheet->lamp, lit[p]);
    for (int k = p - 1; k >= 0 && page->first == p; --k) {
      if (!slab_alike(lit[k], lit[p])) continue;
      page->first = sheet->pages[k].first;
      sheet->pages[k].next = p;
    }
  }
}

int sheet_apertures(const struct sheet *sheet) {
  int count = 0;
  for (int p = 0; p < sheet->page_count; ++p) count += sheet->pages[p].first == p;
  return count;
}

enum result sheet_make(const struct slab *slabs, int count, int lights, double distance,
                       struct progress *progress, struct sheet *sheet, struct error *error) {
  const struct slab **lit = NULL;
  int lit_count = 0;
  memset(sheet, 0, sizeof *sheet);
  enum result result = include_lit_pages(slabs, count, &sheet->lamp, &lit, &lit_count, error);
  if (result == RESULT_OK) {
    sheet->pages = calloc((size_t)lit_count, sizeof *sheet->pages);
    if (!sheet->pages) result = result_no_memory(error);
  }
  if (result == RESULT_OK) find_apertures(lit, lit_count, sheet);
  bool others = false;
  for (int p = 0; p < lit_count && result == RESULT_OK; ++p) others |= sheet->pages[p].first > 0;
  for (int p = 0; p < lit_count && result == RESULT_OK; ++p) {
    const struct shown shown = {progress, (double)p / lit_count, 1.0 / lit_count};
    result = make_page(lit[p], (int)(lit[p] - slabs), others, lights, distance, &shown,
                       &sheet->pages[sheet->page_count++], error);
  }
  if (result == RESULT_OK) result = sheet_paint(sheet, error);
  free(lit);
  return result;
}

double sheet_level_error(const struct sheet_level *level, double apertures) {
  int d = SHEET_DISTANCES - 1;
  while (d > 0 && distances[d] > apertures) --d;
  return distances[d] > apertures ? INFINITY : level->error[d];
}

void sheet_free(struct sheet *sheet) {
  for (int p = 0; p < sheet->page_count; ++p)
    for (int k = 0; k < sheet->pages[p].level_count; ++k)
      slab_free(&sheet->pages[p].levels[k].views);
  free(sheet->pages);
  picture_free(&sheet->picture);
  memset(sheet, 0, sizeof *sheet);
}

int sheet_most_lights(const struct sheet *sheet) {
  int most = 1;
  for (int p = 0; p < sheet->page_count; ++p)
    for (int axis = SLAB_U; axis <= SLAB_V; ++axis) {
      int lights = sheet->pages[p].levels[0].views.samples[axis];
      if (lights > most) most = lights;
    }
  return most;
}
