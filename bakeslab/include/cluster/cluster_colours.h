/* cluster_colours.h - the colours of lights, by non-negative least squares. */
#ifndef CLUSTER_COLOURS_H
#define CLUSTER_COLOURS_H

#include "include/cluster/cluster_target.h"

/* Of some lights, the colours and the room to solve for them; `rest` is the target minus the
 * lights, weighted. */
struct cluster_colours {
  double (*rest)[3]; /* of each row of the target: the caller's */
  double rgb[CLUSTER_MOST_LIGHTS][3];
  double gram[CLUSTER_MOST_LIGHTS * CLUSTER_MOST_LIGHTS], side[CLUSTER_MOST_LIGHTS];
  double scratch[CLUSTER_MOST_LIGHTS * (CLUSTER_MOST_LIGHTS + 4)];
};

/* What a light of rgb 1 gives to each receiver, times its weight, and to the flux: a row of the
 * target each, `step` apart in the table. */
void cluster_rows(const struct cluster_target *target, const struct cluster_light *light,
                  double *table, int step);

/* The colours, not negative, that leave least of the target; returns the squared rest.
 * `base` is a table of the lights' rows: a row of the target a line. */
double cluster_solve(const struct cluster_target *target, int lights, const double *base,
                     struct cluster_colours *colours);

#endif
