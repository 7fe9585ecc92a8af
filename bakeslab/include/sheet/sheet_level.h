/* sheet_level.h - one level of a page's pyramid: so many lights an axis, and what they err. */
#ifndef SHEET_LEVEL_H
#define SHEET_LEVEL_H

#include "slab/slab.h"

enum { SHEET_DISTANCES = 5 };

/* Distances at which the error is told, in aperture widths (longer edge). */
extern const double sheet_distances[SHEET_DISTANCES];

struct sheet_level {
  struct slab views; /* block means of the page; owned */
  int left, bottom;  /* corner of its tiles in the image, texels */
  double peak;       /* radiance that the image holds as 1 */
  double height;     /* of the sheet before its lights, at Scale 1 */
  int lit;           /* lights whose view is not entirely black */
  char *mask;        /* '1' for a lit light, '0' for a black one, Nv rows of Nu; owned */
  double error[SHEET_DISTANCES]; /* relative RMSE of the irradiance, or INFINITY: too near */
};

#endif
