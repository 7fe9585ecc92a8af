/* cluster.h - a slab as a few POV-Ray area lights, without an image.
 *
 * Each light is a parallelogram of the aperture whose points shine alike, with a
 * spotlight's lobe: of a ray at the angle theta to the lobe's axis, and with
 * c = cos(theta), the intensity is
 *     rgb c^tightness p^2 (3 - 2p),  p = (c - cos_falloff) / (cos_radius - cos_falloff)
 * between the cones of falloff and radius, rgb c^tightness inside, nothing outside.
 * With both cones at 90 degrees that is exactly c^tightness. No cone reaches behind
 * the aperture's plane, so that all light leaves through the aperture.
 *
 * The lights are found in two steps: cluster_seed.c groups the slab's 4D cells by
 * energy, cluster_fit.c refines all numbers against the slab's irradiance on planes
 * at several distances. Nothing is random.
 *
 * Lengths are in aperture widths (longer edge), x along u and y along v. */
#ifndef CLUSTER_H
#define CLUSTER_H

#include <stdbool.h>
#include <stdint.h>

#include "slab/plane.h"
#include "slab/slab.h"

enum {
  CLUSTER_MOST_LIGHTS = 64,
  CLUSTER_MOST_SAMPLES = 128,
  CLUSTER_MOST_PAGES = 64,
  CLUSTER_DISTANCES = 3
};

/* Distances at which the error is told, in aperture widths. */
extern const double cluster_distances[CLUSTER_DISTANCES];

struct cluster_light {
  double center[2], edge[2][2]; /* of the parallelogram; full edges */
  double axis[2];               /* slopes of the lobe's axis */
  double tightness, cos_radius, cos_falloff;
  double rgb[3]; /* radiance times widths squared */
  int size[2];   /* points along its edges, powers of 2 */
};

struct cluster_page {
  struct slab frame;            /* geometry of the page, without samples or text */
  struct cluster_light *lights; /* owned */
  int count;
  double flux[3];                  /* at Scale 1, in lamp units, of slab and lights alike */
  double error[CLUSTER_DISTANCES]; /* relative RMSE of the irradiance */
  double error_at;                 /* the same at the distance asked for */
};

struct cluster {
  struct cluster_page *pages; /* owned */
  int page_count;
  int black_pages; /* pages left out because they hold no light */
  double distance; /* asked for, in aperture widths */
  uint64_t stamp;  /* hash of all that the include says of the lights */
};

/* Fits the pages of one lamp with at most `lights` lights in all, but at least one a
 * page, and fewer where they fit better; or, where `lights` is 0, with as few as meet
 * `tolerance` (relative RMSE) at `distance` on each page. Where none do, the pages'
 * errors say so. Refuses negative radiance, lamps without light and more lights than
 * CLUSTER_MOST_LIGHTS for each page with light. Free with
 * cluster_free, also after a failure. */
enum result cluster_make(const struct slab *slabs, int count, int lights, double tolerance,
                         double distance, struct cluster *cluster, struct error *error);
void cluster_free(struct cluster *cluster);

int cluster_light_count(const struct cluster *cluster);
int cluster_point_count(const struct cluster *cluster);    /* of all lights */
double cluster_worst_error(const struct cluster *cluster); /* at its distance, of a page */

/* cluster_light.c.
 *
 * Irradiance at (x, y, z) facing the aperture, and flux, of a light of rgb 1. */
double cluster_irradiance(const struct cluster_light *light, const double at[3]);
double cluster_flux(const struct cluster_light *light);

/* The numbers that a fit changes: beside centre and axis, the logarithms of factors of
 * both edges and of 1 + tightness, cos_falloff, and the soft edge's share of the cone,
 * (cos_radius - cos_falloff) / (1 - cos_falloff). */
enum {
  CLUSTER_CENTER,
  CLUSTER_SCALE = CLUSTER_CENTER + 2,
  CLUSTER_AXIS = CLUSTER_SCALE + 2,
  CLUSTER_TIGHTNESS = CLUSTER_AXIS + 2,
  CLUSTER_FALLOFF,
  CLUSTER_SOFTNESS,
  CLUSTER_NUMBERS
};

/* cluster_gradient.c: derivatives of cluster_irradiance by them. */
void cluster_gradient(const struct cluster_light *light, const double at[3],
                      double slopes[CLUSTER_NUMBERS]);

/* What lights are fitted to: receivers, and the flux as a last one. */
struct cluster_target {
  double edge[2];   /* of the aperture */
  double slopes[4]; /* the window, as seen from its centre */
  int count;        /* of receivers, without the flux */
  double narrowest; /* lobe that the receivers see, radians: their coarsest step */
  double (*at)[3];  /* owned */
  double (*rgb)[3]; /* irradiance, count + 1; owned */
  double *weight;   /* count + 1; owned */
};

/* cluster_target.c: receivers on planes around `distance`. Irradiance and flux
 * are in units of `unit`, which it sets. */
enum result cluster_target_make(const struct slab *slab, double distance, double *unit,
                                struct cluster_target *target, struct error *error);
void cluster_target_free(struct cluster_target *target);

/* An empty target with room for so many receivers; and a plane's receivers added to it, at
 * equal angles, whose squared irradiance, times the weights', sums to the weight's. */
enum result cluster_target_room(int count, struct cluster_target *target, struct error *error);
void cluster_target_add(const struct slab *slab, const struct plane *plane, double weight,
                        struct cluster_target *target);

/* cluster_error.c: the relative RMSE of lights, their rgb in units of `unit`, on the whole
 * plane at a distance: on many receivers, none of which the lights were fitted to. */
enum result cluster_gauge_make(const struct slab *slab, double distance,
                               struct cluster_target *gauge, struct error *error);
double cluster_error(const struct cluster_target *gauge, const struct cluster_light *lights,
                     int count, double unit);

/* cluster_light.c: what a light of rgb 1 gives to each receiver, times its weight, and
 * to the flux; count + 1 numbers, `step` apart. */
void cluster_rows(const struct cluster_target *target, const struct cluster_light *light,
                  double *table, size_t step);

/* Room to solve for the colours of some lights; of the results, `rest` is the
 * target minus the lights, weighted. */
struct cluster_system {
  int lights;
  double (*rgb)[3], (*rest)[3]; /* lights; rows of the target; owned, as all below */
  double *gram, *side, *scratch;
};
bool cluster_system_make(int lights, int rows, struct cluster_system *system);
void cluster_system_free(struct cluster_system *system);

/* The colours, not negative, that leave least of the target; returns the squared rest.
 * `base` is a table of the lights' rows: a row of the target a line. */
double cluster_solve(const struct cluster_target *target, struct cluster_system *system,
                     const double *base);

/* cluster_seed.c: candidates for lights: groups of the slab's cells, many and few,
 * with lobes narrower and wider; their rgb is nothing. `candidates` is owned by
 * the caller. */
enum result cluster_seed(const struct slab *slab, double distance,
                         struct cluster_light **candidates, int *count, struct error *error);

/* Points along the lights' edges: close enough for soft shadows, and at most so many in
 * all, but one for each light. */
void cluster_set_sizes(struct cluster_light *lights, int count, int most);

/* cluster_grow.c: adds those candidates that explain most of what the lights leave
 * of the target, until there are `wanted`. `lights`
 * has room for them. */
enum result cluster_grow(const struct cluster_target *target,
                         const struct cluster_light *candidates, int candidate_count,
                         struct cluster_light *lights, int *count, int wanted, struct error *error);

/* cluster_fit.c: keeps a light on the aperture, and its lobe such that the receivers see it. */
void cluster_limit(const struct cluster_target *target, struct cluster_light *light);

/* cluster_fit.c: refines the lights, drops those that are dark then, and makes their
 * flux that of the target in each channel. */
enum result cluster_fit(const struct cluster_target *target, struct cluster_light *lights,
                        int *count, struct error *error);

/* cluster_light.c: leaves out lights that shine nothing; returns how many remain. */
int cluster_drop_dark(struct cluster_light *lights, int count);

#endif
