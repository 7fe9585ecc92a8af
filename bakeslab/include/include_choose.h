/* include_choose.h - which kind of include is the cheapest that is exact enough. */
#ifndef INCLUDE_CHOOSE_H
#define INCLUDE_CHOOSE_H

#include "include/cluster/cluster.h"
#include "include/point/point.h"
#include "include/sheet/sheet.h"
#include "slab/slab_accuracy.h"

enum include_mode { INCLUDE_SHEET = 1, INCLUDE_CLUSTER = 2, INCLUDE_POINT = 4 };
enum { INCLUDE_ANY = INCLUDE_SHEET | INCLUDE_CLUSTER | INCLUDE_POINT };

/* One of the three, as `mode` says; the others are zero. */
struct include_choice {
  enum include_mode mode;
  struct sheet sheet;
  struct cluster cluster;
  struct point point;
  char why[768]; /* one line; empty where there was no choice */
};

struct include_wish {
  int modes;                       /* that may be made */
  double tolerance, distance;      /* distance in aperture widths */
  const struct point_table *table; /* of the lamp's intensities (point.h), or NULL */
  struct progress *progress;       /* or NULL */
};

/* Of the kinds that may be made, the cheapest for POV-Ray whose irradiance is the tolerance
 * (relative RMSE) or less off on planes at the distance from each page; with as few lights as
 * that allows. Among all kinds also past an edge half way, and in bounded time; of a lamp with
 * channels no far field. Refuses a
 * tolerance that none meets, and says which comes closest. Free with include_choice_free, also
 * after a failure. */
enum result include_choose(const struct slab *slabs, int count, const struct include_wish *wish,
                           struct include_choice *choice, struct error *error);

/* One kind with a number of lights: an axis for the sheet (0: all), in all for the
 * cluster, which is fitted for `distance`. */
enum result include_make(const struct slab *slabs, int count, const struct include_wish *wish,
                         int lights, struct include_choice *choice, struct error *error);
/* Of a choice, as include_lights_error (include_own_error.h). */
void include_choice_error(const void *choice, int page, double error[SLAB_ACCURACY_DISTANCES]);
void include_choice_free(struct include_choice *choice);

#endif
