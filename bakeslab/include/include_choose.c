/* include_choose.c - what each kind would cost and miss, and the cheapest.
 *
 * 1. Each kind makes offers: the far field one; the sheet one for each number of lights, from
 *    all of them halved down to one an axis; the cluster one, as small as the tolerance allows.
 *    Where all kinds are asked for, the cluster's fit, by far the longest, is bounded by the size
 *    of the bake, in counted work: the same lights on any machine. The other two take a number of
 *    look-ups that is given by the slab's positions and pages (sheet.h), far less than the rays.
 * 2. An offer's cost is the time that POV-Ray takes for it at a shaded point; its error the
 *    relative RMSE of the irradiance on a plane at the distance, of the worst page: by plane_errors
 *    for the sheet and the far field, by cluster_error for the cluster, each against the integral
 *    of the quadrilinear slab (plane.h). Its shadow's error is the same past an edge half way
 *    (plane_shadow.h).
 * 3. The cheapest offer within the tolerance is taken, by its shadow, too, where all kinds are
 *    asked for; if there is none, the error says which comes closest. */
#include "include/include_choose.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "file/slab_json.h"

/* Microseconds that POV-Ray 3.7 takes for each shaded point: for a light of the sheet,
 * a spotlight, of which the cluster's area lights are made, the far field's light. Their
 * ratios count. */
static const double sheet_cost = 1.1, spot_cost = 0.08, point_cost = 0.8;

/* How long the cluster's fit may take, by what some work (cluster_fit.h) takes: as long as the
 * quickest of lamps, without radiosity or photons, takes for the slab's rays on one core, and no
 * less than a few seconds. */
static const double ray_seconds = 1e-6, least_seconds = 8, work_seconds = 30e-9;

/* An opening that is seen under more, in degrees, throws soft shadows. */
static const double soft_angle = 1;

/* One way to make the include. */
struct offer {
  int mode;           /* an include_mode */
  int lights, points; /* an axis for the sheet, in all for the cluster */
  bool cut_short;     /* the cluster's fit was */
  double cost, error, shadow;
  double worst; /* what the tolerance is for: the error, or the larger of both */
};

struct offers {
  struct offer list[SHEET_MOST_LEVELS + 2]; /* dearer ones of one kind are more exact */
  int count;
};

/* The finest level of a page with at most `lights` lights an axis. */
static const struct sheet_level *level_for(const struct sheet_page *page, int lights) {
  const struct sheet_level *level = page->levels, *last = level + page->level_count - 1;
  while (level < last &&
         (level->views.samples[SLAB_U] > lights || level->views.samples[SLAB_V] > lights))
    ++level;
  return level;
}

static void offer_sheets(const struct sheet *sheet, struct offers *offers) {
  for (int lights = sheet_most_lights(sheet);; lights = (lights + 1) / 2) {
    struct offer offer = {.mode = INCLUDE_SHEET, .lights = lights};
    for (int p = 0; p < sheet->page_count; ++p) {
      const struct sheet_level *level = level_for(&sheet->pages[p], lights);
      offer.cost += sheet_cost * level->lit;
      offer.error = fmax(offer.error, level->error_at);
      offer.shadow = fmax(offer.shadow, level->shadow_at);
    }
    offers->list[offers->count++] = offer;
    if (lights == 1) return;
  }
}

static void offer_cluster(const struct cluster *cluster, struct offers *offers) {
  struct offer offer = {.mode = INCLUDE_CLUSTER,
                        .lights = cluster_light_count(cluster),
                        .cut_short = cluster->cut_short};
  for (int p = 0; p < cluster->page_count; ++p) {
    offer.error = fmax(offer.error, cluster->pages[p].error_at);
    offer.shadow = fmax(offer.shadow, cluster->pages[p].shadow_at);
    offer.points += cluster_page_points(&cluster->pages[p]);
  }
  offer.cost = spot_cost * offer.points;
  offers->list[offers->count++] = offer;
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
    snprintf(text, size, "%s: %.2g %% off, %.2g %% in the shadow of an edge half way, cost %.3g%s",
             what, 100 * offer->error, 100 * offer->shadow, offer->cost,
             offer->cut_short ? ", its fit cut short" : "");
  else
    snprintf(text, size, "%s: stands farther away", what);
}

/* Of the offers of some kinds the cheapest within the tolerance, or else the most exact; NULL
 * where there is none of them. */
static const struct offer *best_of(const struct offers *offers, int modes, double tolerance) {
  const struct offer *best = NULL;
  for (int k = 0; k < offers->count; ++k) {
    const struct offer *offer = &offers->list[k];
    if (!(offer->mode & modes)) continue;
    bool cheaper = best && offer->worst <= tolerance && offer->cost < best->cost;
    if (!best || (best->worst <= tolerance ? cheaper : offer->worst < best->worst)) best = offer;
  }
  return best;
}

/* The choice, and the best offers of the other kinds. */
static void explain(const struct offers *offers, const struct offer *chosen, double tolerance,
                    double distance, char *why, size_t size) {
  char text[192];
  double angle = 2 * atan(0.5 / distance) * 180 / M_PI;
  describe(chosen, text, sizeof text);
  size_t used = (size_t)snprintf(why, size, "at %g aperture widths, with %g %% allowed, %s",
                                 distance, 100 * tolerance, text);
  if (chosen->mode != INCLUDE_CLUSTER && chosen->lights == 1 && angle > soft_angle)
    used +=
        (size_t)snprintf(why + used, size - used,
                         " (hard shadows, though the opening is seen under %.2g degrees)", angle);
  for (int mode = 1; mode <= INCLUDE_POINT; mode *= 2) {
    const struct offer *other = best_of(offers, mode & ~chosen->mode, tolerance);
    if (!other || used >= size) continue;
    describe(other, text, sizeof text);
    used += (size_t)snprintf(why + used, size - used, "; %s", text);
  }
}

static enum result none_meets(const struct offer *closest, double tolerance, double distance,
                              struct error *error) {
  char text[192];
  if (!closest || !isfinite(closest->error))
    return result_fail(error, RESULT_BAD,
                       "sheets stand farther away than %g aperture widths; ask for a larger "
                       "--distance, or for --mode auto",
                       distance);
  describe(closest, text, sizeof text);
  return result_fail(error, RESULT_BAD,
                     "no light is within %g at %g aperture widths; closest is the %s: ask for "
                     "--tolerance %.2g",
                     tolerance, distance, text, 1.05 * closest->worst);
}

/* All pages' rays of the bake, as far as their provenance tells. */
static enum result count_rays(const struct slab *slabs, int count, double *rays,
                              struct error *error) {
  *rays = 0;
  for (int n = 0; n < count; ++n) {
    json_t *root = NULL;
    enum result result = slab_json_root(&slabs[n], &root, error);
    if (result != RESULT_OK) return result;
    json_t *a_sample = json_object_get(json_object_get(root, "provenance"), "rays");
    *rays += fmax(0, json_number_value(a_sample)) * (double)slab_sample_count(&slabs[n]);
    json_decref(root);
  }
  return RESULT_OK;
}

static enum result choose_cluster(const struct slab *slabs, int count,
                                  const struct include_wish *wish, struct cluster *cluster,
                                  struct error *error) {
  bool all_kinds = wish->modes == INCLUDE_ANY;
  double rays = 0;
  enum result result = count_rays(slabs, count, &rays, error);
  if (result != RESULT_OK) return result;
  const struct cluster_wish fit = {
      .tolerance = wish->tolerance,
      .distance = wish->distance,
      .shadows = all_kinds,
      .intensity = wish->table,
      .work = all_kinds ? fmax(least_seconds, ray_seconds * rays) / work_seconds : 0,
      .progress = wish->progress};
  return cluster_make(slabs, count, &fit, cluster, error);
}

static enum result make_offers(const struct slab *slabs, int count, const struct include_wish *wish,
                               struct include_choice *choice, struct offers *offers,
                               struct error *error) {
  double distance = wish->distance;
  enum result result = RESULT_OK;
  bool all_kinds = wish->modes == INCLUDE_ANY;
  if (wish->modes & INCLUDE_POINT) {
    result = point_make(slabs, count, wish->table, distance, wish->progress, &choice->point, error);
    if (result == RESULT_OK)
      offers->list[offers->count++] = (struct offer){.mode = INCLUDE_POINT,
                                                     .lights = 1,
                                                     .cost = point_cost,
                                                     .error = choice->point.error_at,
                                                     .shadow = choice->point.shadow_at};
  }
  if (result == RESULT_OK && wish->modes & INCLUDE_SHEET) {
    result = sheet_make(slabs, count, 0, distance, wish->progress, &choice->sheet, error);
    if (result == RESULT_OK) offer_sheets(&choice->sheet, offers);
  }
  if (result == RESULT_OK && wish->modes & INCLUDE_CLUSTER) {
    result = choose_cluster(slabs, count, wish, &choice->cluster, error);
    if (result == RESULT_OK) offer_cluster(&choice->cluster, offers);
  }
  for (int k = 0; k < offers->count; ++k) {
    struct offer *offer = &offers->list[k];
    offer->worst = all_kinds ? fmax(offer->error, offer->shadow) : offer->error;
  }
  return result;
}

enum result include_choose(const struct slab *slabs, int count, const struct include_wish *wish,
                           struct include_choice *choice, struct error *error) {
  struct offers offers = {.count = 0};
  double tolerance = wish->tolerance, distance = wish->distance;
  memset(choice, 0, sizeof *choice);
  enum result result = make_offers(slabs, count, wish, choice, &offers, error);
  if (result != RESULT_OK) return result;
  const struct offer *chosen = best_of(&offers, wish->modes, tolerance);
  if (!chosen || !(chosen->worst <= tolerance))
    return none_meets(chosen, tolerance, distance, error);
  choice->mode = (enum include_mode)chosen->mode;
  explain(&offers, chosen, tolerance, distance, choice->why, sizeof choice->why);
  if (chosen->mode != INCLUDE_SHEET) return RESULT_OK;
  sheet_free(&choice->sheet); /* once more, with only what is needed and its errors */
  return sheet_make(slabs, count, chosen->lights, 0, wish->progress, &choice->sheet, error);
}

enum result include_make(const struct slab *slabs, int count, const struct include_wish *wish,
                         int lights, struct include_choice *choice, struct error *error) {
  memset(choice, 0, sizeof *choice);
  choice->mode = (enum include_mode)wish->modes;
  switch (choice->mode) {
  case INCLUDE_CLUSTER:
    return cluster_make(slabs, count,
                        &(struct cluster_wish){
                            .lights = lights, .distance = wish->distance, .intensity = wish->table},
                        &choice->cluster, error);
  case INCLUDE_POINT:
    return point_make(slabs, count, wish->table, wish->distance, NULL, &choice->point, error);
  default:
    return sheet_make(slabs, count, lights, 0, NULL, &choice->sheet, error);
  }
}

/* The sheet's errors are known at other distances: those farthest away that are nearer, which are
 * rather larger. */
void include_choice_error(const void *of, int page, double error[SLAB_ACCURACY_DISTANCES]) {
  const struct include_choice *choice = of;
  for (int d = 0; d < SLAB_ACCURACY_DISTANCES; ++d) {
    double apertures = slab_accuracy_apertures[d];
    if (choice->mode == INCLUDE_SHEET)
      error[d] = sheet_level_error(&choice->sheet.pages[page].levels[0], apertures);
    else if (choice->mode == INCLUDE_CLUSTER)
      error[d] = choice->cluster.pages[page].error[d];
    else
      error[d] = choice->point.error[d];
  }
}

void include_choice_free(struct include_choice *choice) {
  sheet_free(&choice->sheet);
  cluster_free(&choice->cluster);
  point_free(&choice->point);
}
