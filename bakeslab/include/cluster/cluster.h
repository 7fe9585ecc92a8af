/* cluster.h - a slab as a few POV-Ray area lights, without an image. */
#ifndef CLUSTER_H
#define CLUSTER_H

#include "include/cluster/cluster_light.h"
#include "include/text/include_text.h"

enum { CLUSTER_MOST_PAGES = 64, CLUSTER_DISTANCES = 3 };

/* Distances at which the error is told, in aperture widths (longer edge), as
 * cluster_page.inc.in says. */
extern const double cluster_distances[CLUSTER_DISTANCES];

struct cluster_page {
  struct slab frame; /* geometry of the page, without samples or text */
  struct cluster_light lights[CLUSTER_MOST_LIGHTS];
  int count;
  double flux[3];                  /* at Scale 1, in lamp units, of slab and lights alike */
  double error[CLUSTER_DISTANCES]; /* relative RMSE of the irradiance */
  double error_at;                 /* the same at the distance asked for */
};

struct cluster {
  struct include_lamp lamp;
  struct cluster_page *pages; /* with light; owned */
  int page_count;
  double distance; /* asked for, in aperture widths */
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
int cluster_page_points(const struct cluster_page *page); /* of its lights */

/* cluster_text.c: the include file. The caller checks the stream. */
void cluster_print(const struct cluster *cluster, const struct include_text *text, FILE *out);

#endif
