/* include_choose.c - what each kind would cost and miss, and the cheapest. */
#include "include/include_choose.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>


/* Microseconds that POV-Ray 3.7 takes for each shaded point: for a light of the sheet,
 * a point of an area light, a spotlight, the far field's light. Their ratios count. */
static const double sheet_cost = 1.1, area_cost = 0.19, spot_cost = 0.06, point_cost = 0.5;

/* One way to make the include. */
struct offer {
  enum include_mode mode;
  int lights, points; /* an axis for the sheet, in all for the cluster */
  double cost, error;
};

enum { MOST_OFFERS = 24 };

struct offers {
  struct offer list[MOST_OFFERS]; /* dearer ones of one kind are more exact */
  int count;
};

static void add_offer(struct offers *offers, struct offer offer) {
  if (offers->count < MOST_OFFERS) offers->list[offers->count++] = offer;
}

/* The finest level of a page with at most `lights` lights an axis. */
static int level_for(const struct sheet_page *page, int lights) {
  int k = 0;
  while (k + 1 < page->level_count) {
    const int *samples = page->levels[k].views.samples;
    if (samples[SLAB_U] <= lights && samples[SLAB_V] <= lights) break;
    ++k;
  }
  return k;
}

static void offer_sheets(const struct sheet *sheet, struct offers *offers) {
  for (int lights = sheet_most_lights(sheet);; lights = (lights + 1) / 2) {
    struct offer offer = {.mode = INCLUDE_SHEET, .lights = lights};
    for (int p = 0; p < sheet->page_count; ++p) {
      const struct sheet_level *level =
          &sheet->pages[p].levels[level_for(&sheet->pages[p], lights)];
      offer.cost += sheet_cost * level->lit;
      offer.error = fmax(offer.error, level->error_at);
    }
    add_offer(offers, offer);
    if (lights == 1) return;
  }
}

static void offer_cluster(const struct cluster *cluster, struct offers *offers) {
  struct offer offer = {.mode = INCLUDE_CLUSTER,
                        .lights = cluster_light_count(cluster),
                        .error = cluster_worst_error(cluster)};
  for (int p = 0; p < cluster->page_count; ++p) {
    offer.points += cluster_page_points(&cluster->pages[p]);
    for (int k = 0; k < cluster->pages[p].count; ++k) {
      const int *size = cluster->pages[p].lights[k].size;
      offer.cost += size[0] * size[1] > 1 ? area_cost * size[0] * size[1] : spot_cost;
    }
  }
  add_offer(offers, offer);
}

static void describe(const struct offer *offer, char *text, size_t size) {
  char what[64];
  if (offer->mode == INCLUDE_SHEET)
    snprintf(what, sizeof what, "sheet of %dx%d lights", offer->lights, offer->lights);
  else if (offer->mode == INCLUDE_CLUSTER)
    snprintf(what, sizeof what, "cluster of %d light%s (%d point%s)", offer->lights,
             offer->lights > 1 ? "s" : "", offer->points, offer->points > 1 ? "s" : "");
  else
    snprintf(what, sizeof what, "point");
  if (isfinite(offer->error))
    snprintf(text, size, "%s: %.2g %% off, cost %.3g", what, 100 * offer->error, offer->cost);
  else
    snprintf(text, size, "%s: stands farther away", what);
}

/* The offers that explain the choice: of each other kind the cheapest that would do,
 * or else the most exact. */
static void explain(const struct offers *offers, int best, double tolerance, double distance,
                    char *why, size_t size) {
  char text[128];
  describe(&offers->list[best], text, sizeof text);
  size_t used = (size_t)snprintf(why, size, "at %g aperture widths, with %g %% allowed, %s",
                                 distance, 100 * tolerance, text);
  for (int mode = 1; mode <= INCLUDE_POINT; mode *= 2) {
    int other = -1;
    for (int k = 0; k < offers->count && mode != (int)offers->list[best].mode; ++k) {
      const struct offer *offer = &offers->list[k];
      if ((int)offer->mode != mode) continue;
      if (other < 0 || (offer->error <= tolerance ? offer->cost < offers->list[other].cost
                                                  : offer->error < offers->list[other].error))
        other = k;
    }
    if (other < 0 || used >= size) continue;
    describe(&offers->list[other], text, sizeof text);
    used += (size_t)snprintf(why + used, size - used, "; %s", text);
  }
}

static int cheapest(const struct offers *offers, double tolerance) {
  int best = -1;
  for (int k = 0; k < offers->count; ++k)
    if (offers->list[k].error <= tolerance &&
        (best < 0 || offers->list[k].cost < offers->list[best].cost))
      best = k;
  return best;
}

static enum result none_meets(const struct offers *offers, double tolerance, double distance,
                              struct error *error) {
  char text[128];
  int closest = 0;
  for (int k = 1; k < offers->count; ++k)
    if (offers->list[k].error < offers->list[closest].error) closest = k;
  if (!isfinite(offers->list[closest].error))
    return result_fail(error, RESULT_BAD,
                       "sheets stand farther away than %g aperture widths; ask for a larger "
                       "--distance, or for --mode auto",
                       distance);
  describe(&offers->list[closest], text, sizeof text);
  return result_fail(error, RESULT_BAD,
                     "no light is within %g at %g aperture widths; closest is the %s: ask for "
                     "--tolerance %.2g",
                     tolerance, distance, text, 1.05 * offers->list[closest].error);
}

enum result include_choose(const struct slab *slabs, int count, int modes, double tolerance,
                           double distance, struct include_choice *choice, struct error *error) {
  struct offers offers = {.count = 0};
  enum result result = RESULT_OK;
  memset(choice, 0, sizeof *choice);
  if (modes & INCLUDE_POINT) {
    result = point_make(slabs, count, distance, &choice->point, error);
    if (result == RESULT_OK)
      add_offer(&offers, (struct offer){.mode = INCLUDE_POINT,
                                        .lights = 1,
                                        .cost = point_cost,
                                        .error = choice->point.error_at});
  }
  if (result == RESULT_OK && modes & INCLUDE_SHEET) {
    result = sheet_make(slabs, count, 0, distance, &choice->sheet, error);
    if (result == RESULT_OK) offer_sheets(&choice->sheet, &offers);
  }
  if (result == RESULT_OK && modes & INCLUDE_CLUSTER) {
    result = cluster_make(slabs, count, 0, tolerance, distance, &choice->cluster, error);
    if (result == RESULT_OK) offer_cluster(&choice->cluster, &offers);
  }
  if (result != RESULT_OK) return result;
  int best = cheapest(&offers, tolerance);
  if (best < 0) return none_meets(&offers, tolerance, distance, error);
  const struct offer *chosen = &offers.list[best];
  choice->mode = chosen->mode;
  explain(&offers, best, tolerance, distance, choice->why, sizeof choice->why);
  if (chosen->mode != INCLUDE_SHEET) return RESULT_OK;
  sheet_free(&choice->sheet); /* once more, with only what is needed and its errors */
  return sheet_make(slabs, count, chosen->lights, 0, &choice->sheet, error);
}

enum result include_make(const struct slab *slabs, int count, enum include_mode mode, int lights,
                         double distance, struct include_choice *choice, struct error *error) {
  memset(choice, 0, sizeof *choice);
  choice->mode = mode;
  switch (mode) {
  case INCLUDE_CLUSTER:
    return cluster_make(slabs, count, lights, 0, distance, &choice->cluster, error);
  case INCLUDE_POINT:
    return point_make(slabs, count, distance, &choice->point, error);
  default:
    return sheet_make(slabs, count, lights, 0, &choice->sheet, error);
  }
}

void include_choice_free(struct include_choice *choice) {
  sheet_free(&choice->sheet);
  cluster_free(&choice->cluster);
  point_free(&choice->point);
}
