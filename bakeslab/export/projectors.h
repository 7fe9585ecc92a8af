/* projectors.h - a page as Mitsuba's own emitters: a `projector`, a point with a picture, on each
 * of some positions of the aperture, as POV-Ray's sheet has lights.
 *
 * 1. The page is taken on so many positions, and on directions so close that the texels below are
 *    nearly straight between them: an odd number of new samples for each old one, so that the old
 *    ones are among the new.
 * 2. From its position (a, b) a projector sees a receiver at the depth z along the normal n, with
 *    the slopes x and y. Its matrix has the columns -h u', -k v' and n + c, where c is the middle
 *    of the window as it is seen from there, and h and k are half its sizes. Mitsuba gives
 *        pi texel/(z^2 cos (1 + c.(x, y)))                     (projector.cpp, sample_direction)
 *    where cos is that of the angle to n. The light of a cell of the area A is L A cos^3/z^2, so
 *        texel = L A cos^4 (1 + c.(x, y))/pi.
 * 3. The fewest positions whose sum over projectors, texels interpolated as Mitsuba does, errs by
 *    the tolerance or less four aperture widths away. Nearer by, it errs more. */
#ifndef PROJECTORS_H
#define PROJECTORS_H

#include <stdio.h>

#include "export/export_errors.h"
#include "slab/slab.h"

struct projectors {
  struct slab texels;             /* the page on their positions, texels for radiance; owned */
  double error[EXPORT_DISTANCES]; /* relative RMS of irradiance on a plane at each distance */
};

/* Refuses a page that no projectors can carry: a window far aside, and an error four
 * aperture widths away that is above the tolerance with 32 positions along the longer edge, or with
 * as many as 2^25 texels allow. The message does not name the page. */
enum result projectors_make(const struct slab *slab, double tolerance,
                            struct projectors *projectors, struct error *error);
void projectors_free(struct projectors *projectors);

/* How many have light; the others are left out. */
int projectors_lit(const struct projectors *projectors);

/* Their pictures, STEM_I_J.exr in a folder, and their XML, which takes the parameters place and
 * gain. */
enum result projectors_write(const struct projectors *projectors, const char *stem,
                             const char *folder, struct error *error);
void projectors_put(const struct projectors *projectors, const char *stem, FILE *out);

#endif
