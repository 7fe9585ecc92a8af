/* ies_opening.c - a negative size is that of something round. The shapes, as (width, length,
 * height), with - for negative and + for positive:
 *               1986 to 1995         since 2002
 *   disc        - 0 0                - - 0
 *   cylinder    - 0 +                - - +          vertical
 *               0 + -                - + -          along the length
 *               + 0 -                + - -          along the width
 *   sphere      - 0 -                - - -          ellipsoids too
 *   ellipse     - + (0 or +), + - (0 or +)          a disc or cylinder that is not round
 *   ellipsoid   - + -, + - -
 *   upright disc                     - 0 -          towards the length
 *                                    0 - -          towards the width
 * Both are read whatever the file says of its year, but for the two that contradict each other. */
#include "import/photometric/ies_opening.h"

#include <math.h>

static void set(struct photometry *lamp, enum photometry_shape shape, int axis, double x, double y,
                double z) {
  lamp->shape = shape;
  lamp->axis = axis;
  lamp->size[0] = x;
  lamp->size[1] = y;
  lamp->size[2] = z;
}

/* Heights below 0. */
static void set_round_above(bool old, double width, double length, double height,
                            struct photometry *lamp) {
  double w = fabs(width), l = fabs(length), h = fabs(height);
  if (width == 0 && length == 0) {
    set(lamp, PHOTOMETRY_ELLIPSOID, 0, h, h, h);
  } else if (length == 0) {
    if (width > 0)
      set(lamp, PHOTOMETRY_CYLINDER, 2, h, h, w);
    else
      set(lamp, old ? PHOTOMETRY_ELLIPSOID : PHOTOMETRY_CYLINDER, 0, old ? w : 0, h, w);
  } else if (width == 0) {
    if (length > 0)
      set(lamp, PHOTOMETRY_CYLINDER, 0, l, h, h);
    else
      set(lamp, old ? PHOTOMETRY_ELLIPSOID : PHOTOMETRY_CYLINDER, 2, l, h, old ? l : 0);
  } else if (old || (width < 0) == (length < 0)) {
    set(lamp, PHOTOMETRY_ELLIPSOID, 0, l, h, w);
  } else {
    set(lamp, PHOTOMETRY_CYLINDER, width < 0 ? 0 : 2, l, h, w);
  }
}

enum result ies_opening(int year, double metres, double width, double length, double height,
                        struct photometry *lamp, struct warnings *notes, struct error *error) {
  width *= metres;
  length *= metres;
  height *= metres;
  double w = fabs(width), l = fabs(length), h = fabs(height);
  double least = INFINITY;
  const double all[3] = {w, l, h};
  for (int k = 0; k < 3; ++k)
    if (all[k] > 0) least = fmin(least, all[k]);
  if (!(fmax(w, fmax(l, h)) < 1e4) || least < 1e-6)
    return result_fail(error, RESULT_BAD, "an opening of %g x %g x %g m is no lamp's", width,
                       length, height);
  bool flat = !(height < 0);
  if (height < 0)
    set_round_above(year < 2002, width, length, height, lamp);
  else if (width < 0 || length < 0)
    set(lamp, PHOTOMETRY_CYLINDER, 1, l > 0 ? l : w, h, w > 0 ? w : l);
  else if (w == 0 && l == 0 && h == 0)
    set(lamp, PHOTOMETRY_POINT, 0, 0, 0, 0);
  else
    set(lamp, PHOTOMETRY_BOX, 0, l, h, w);
  for (int k = 0; k < 4; ++k) lamp->side[k] = lamp->size[1];
  if (!flat && ((width > 0 && length > 0) || (width == 0 && length == 0)))
    warnings_add(notes,
                 "the opening's sizes (width %g, length %g, height %g m) are no shape of "
                 "LM-63; taken for an ellipsoid",
                 width, length, height);
  return RESULT_OK;
}

void ies_opening_raise(struct photometry *lamp, struct warnings *notes) {
  double x = lamp->size[0], z = lamp->size[2];
  if (lamp->size[1] > 0 || !(fmin(x, z) > 0)) return;
  set(lamp, lamp->shape, 0, 0, x, z);
  for (int k = 0; k < 4; ++k) lamp->side[k] = lamp->size[1];
  warnings_add(notes,
               "it is of type A, whose light goes along the horizontal: its opening, flat in the "
               "file, faces that way, %g m wide and %g m high",
               z, x);
}
