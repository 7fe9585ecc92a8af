/* point_table.h - a photometric file's table of intensities as a grid over the whole sphere, of
 * which the image of a point include has a texel at each node.
 *
 * Node (i, j) lies at the longitude 2 pi i / (columns - 1), from axes[0] to axes[2], and the
 * latitude pi j / (rows - 1) - pi/2, axes[1] being the pole: both ends are there, so that the last
 * column is the first once more. Between nodes intensity is bilinear in the two angles, as it is
 * between the table's own (photometry.h). Past the end of a table that ends with light it falls to
 * 0 within a step, 0.25 degrees at most. */
#ifndef POINT_TABLE_H
#define POINT_TABLE_H

#include "import/photometric/photometry.h"

struct point_table {
  double axes[3][3]; /* in lamp space: unit vectors */
  int columns, rows; /* at least 2 */
  double *intensity; /* [row * columns + column], cd; owned */
  bool exact;        /* the table's angles are all among the nodes: nothing is lost */
};

/* Refuses negative intensities, which no light of POV-Ray's can give. Free with point_table_free,
 * also after a failure. */
enum result point_table_make(const struct photometry *lamp, struct point_table *table,
                             struct error *error);
void point_table_free(struct point_table *table);

#endif
