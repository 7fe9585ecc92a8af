/* cluster.h - a slab as a few POV-Ray area lights, without an image. */
#ifndef CLUSTER_H
#define CLUSTER_H

#include "base/progress.h"
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
  double shadow_at;                /* and past an edge half way (plane_shadow.h) */
};

/* What is asked of the fit. */
struct cluster_wish {
  int lights;                /* at most, in all; 0: as few as meet the tolerance */
  double tolerance;          /* relative RMSE of each page */
  double distance;           /* where, in aperture widths */
  bool shadows;              /* also past an edge half way */
  bool intensity;            /* errors count by solid angle (cluster_target.h) */
  double work;               /* at most about so much (cluster_fit.h), shared among the pages;
                                0: no bound */
  struct progress *progress; /* or NULL */
};

struct cluster {
  struct include_lamp lamp;
  struct cluster_page *pages; /* with light; owned */
  int page_count;
  double distance; /* asked for, in aperture widths */
  bool cut_short;  /* the work's bound ended the fit of some page */
};

/* Fits the pages of one lamp with as many lights as are wished, but at least one a
 * page, and fewer where they fit better. Where the tolerance is not met, the pages'
 * errors say so. The bound counts work, not time: the same lights on any machine. Refuses negative
 * radiance, lamps without light and more lights than CLUSTER_MOST_LIGHTS for each page with light.
 * Free with cluster_free, also after a failure. */
enum result cluster_make(const struct slab *slabs, int count, const struct cluster_wish *wish,
                         struct cluster *cluster, struct error *error);
void cluster_free(struct cluster *cluster);

int cluster_light_count(const struct cluster *cluster);
int cluster_page_points(const struct cluster_page *page); /* of its lights */

/* cluster_text.c: the include file. The caller checks the stream. */
void cluster_print(const struct cluster *cluster, const struct include_text *text, FILE *out);

#endif
