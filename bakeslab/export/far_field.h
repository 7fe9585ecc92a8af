/* far_field.h - a lamp as photometry sees it: the luminous intensity in every direction, on a grid
 * that is fine enough for its interpolation.
 *
 * Type C: gamma 0 is -y of lamp space, gamma 180 is +y, C0 is +x, C90 is +z. The intensity is the
 * integral of luminance times cosine over the apertures. Luminance is that of Rec. 709; a radiance
 * in W/(sr m2) counts 179 lm/W, and a relative one as cd/m2. */
#ifndef FAR_FIELD_H
#define FAR_FIELD_H

#include "slab/slab.h"

struct far_field {
  int planes, angles;      /* a rotated lamp has one plane */
  double *c, *gamma;       /* degrees, increasing; C begins with 0 and ends below 360; owned */
  double plane_step, step; /* of the grid; 0 where dark planes or angles are left out of it */
  double *candela;         /* [planes][angles]; owned */
  double lumens;           /* of the grid, linear between its angles */
  double flux;             /* of the slabs */
  double error,
      peak;       /* RMS of interpolation, weighted by intensity, as a part of the peak; candela */
  double size[3]; /* of the box around all apertures, along x, y, z, in metres */
  double loss;    /* relative RMS error of irradiance four aperture widths away, if all
                     light comes from one point */
};

/* Free with far_field_free, also after a failure. The grid is made finer until its error is the
 * tolerance, and its flux a fifth of that off, or less; or until it is as fine as is affordable,
 * 0.08 degrees between angles and 0.23 between planes at most. Planes and angles between dark ones
 * are left out. */
enum result far_field_make(const struct slab *slabs, int count, double tolerance,
                           struct far_field *field, struct error *error);
void far_field_free(struct far_field *field);

#endif
