/* point.h - a slab's far field as one POV-Ray point light in a small sphere, on
 * which a lat-long image filters each ray.
 *
 * The light stands at the lamp's centre: that of its page, or the mean of its
 * pages by their flux. The sphere's x, y and z are u, v and the normal of the
 * first page with light. Of the image, column i lies at the longitude
 * (i + 1/2) 2 pi/width, from x to z, row j, counted upwards, at the latitude
 * ((j + 1/2)/height - 1/2) pi.
 * Where there is a table of the lamp's intensities (point_table.h), that is the
 * image: the light stands at the table's centre, the sphere has its axes, and
 * texels lie on its nodes. */
#ifndef POINT_H
#define POINT_H

#include "base/picture.h"
#include "base/progress.h"
#include "include/point/point_table.h"
#include "include/text/include_text.h"

enum { POINT_DISTANCES = 3 };

struct point {
  struct include_lamp lamp;
  double center[3];
  double axes[3][3];        /* the sphere's x, y and z in lamp space: unit vectors */
  double width;             /* of the widest aperture */
  struct picture picture;   /* intensity over its channel's peak; rows downwards, as in files */
  double first[2], step[2]; /* texel (i, j), rows counted upwards, lies at the longitude first[0] +
                               i step[0] and the latitude first[1] + j step[1] */
  const struct point_table *table; /* that the image shows, the caller's; or NULL */
  double intensity[3];             /* of what the image holds as 1, in lamp units */
  double flux[3];                  /* at Scale 1, in lamp units, of slab and light alike */
  double error[POINT_DISTANCES];   /* relative RMSE of the irradiance, of the worst page, at the
                                      distances that point.inc.in names */
  double error_at, distance;       /* the same at the distance asked for, in aperture widths */
  double shadow_at;                /* and there past an edge half way (plane_shadow.h) */
};

/* `table`: the lamp's intensities, of which the slabs are made; or NULL. Errors are told
 * against the slabs all the same. Refuses negative radiance, lamps without light and what
 * POV-Ray's numbers cannot hold. Free with point_free, also after a failure. */
enum result point_make(const struct slab *slabs, int count, const struct point_table *table,
                       double distance, struct progress *progress, struct point *point,
                       struct error *error);
void point_free(struct point *point);

/* point_text.c: the include file. The caller checks the stream. */
void point_print(const struct point *point, const struct include_text *text, FILE *out);

#endif
