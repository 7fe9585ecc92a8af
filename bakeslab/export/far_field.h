/* far_field.h - a lamp as photometry sees it: the luminous intensity in every direction, on a grid
 * that is fine enough for its interpolation.
 *
 * Type C: gamma 0 is -y of lamp space, gamma 180 is +y, C0 is +x, C90 is +z. The intensity is the
 * integral of luminance times cosine over the apertures. Luminance is that of Rec. 709; a radiance
 * in W/(sr m2) counts 179 lm/W, and a relative one as cd/m2. */
#ifndef FAR_FIELD_H
#define FAR_FIELD_H

#include "export/far_grid.h"

struct far_field {
  struct far_grid grid;
  double lumens;  /* of the grid */
  double flux;    /* of the slabs */
  double size[3]; /* of the box around all apertures, along x, y, z, in metres */
  double loss;    /* relative RMS error of irradiance four aperture widths away, if all
                     light comes from one point */
};

/* Free with far_field_free, also after a failure. */
enum result far_field_make(const struct slab *slabs, int count, double tolerance,
                           struct far_field *field, struct error *error);
void far_field_free(struct far_field *field);

#endif
