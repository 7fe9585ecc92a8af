/* point.h - a slab's far field as one POV-Ray point light in a small sphere, on
 * which a lat-long image filters each ray.
 *
 * The light stands at the lamp's centre: that of its page, or the mean of its
 * pages by their flux. The sphere's x, y and z are u, v and the normal of the
 * first page with light. Each channel has its own far field in the image, one above
 * another: column i lies at the longitude 2 pi i/(columns - 1), from x to z, row j of
 * one, counted upwards, at the latitude pi j/(rows - 1) - pi/2.
 * Where there is a table of the lamp's intensities (point_table.h), that is the
 * image: the light stands at the table's centre, the sphere has its axes, and
 * texels lie on its nodes. */
#ifndef POINT_H
#define POINT_H

#include "base/picture.h"
#include "base/progress.h"
#include "include/point/point_far.h"
#include "include/point/point_table.h"
#include "include/text/include_text.h"

enum { POINT_DISTANCES = 3 };

struct point {
  struct include_lamp lamp;
  double center[3];
  double axes[3][3];      /* the sphere's x, y and z in lamp space: unit vectors */
  double width;           /* of the widest aperture */
  struct picture picture; /* intensity over each far field's peak; rows downwards, as in files */
  int columns, rows;      /* of one far field */
  int count;              /* of them: one for each channel with light */
  int channels[INCLUDE_CHANNELS + 1];     /* of each; 0: it belongs to none */
  double intensity[INCLUDE_CHANNELS + 1]; /* of what each holds as 1, in lamp units */
  const struct point_table *table;        /* that the image shows, the caller's; or NULL */
  double flux[3];                         /* at Scale 1, in lamp units, of slab and light alike */
  double error[POINT_DISTANCES]; /* relative RMSE of the irradiance, of the worst page, at the
                                    distances that point.inc.in names */
  double error_at, distance;     /* the same at the distance asked for, in aperture widths */
  double shadow_at;              /* and there past an edge half way (plane_shadow.h) */
};

/* `table`: the lamp's intensities, of which the slabs are made; or NULL. Errors are told
 * against the slabs all the same. Refuses negative radiance, lamps without light and what
 * POV-Ray's numbers cannot hold. Free with point_free, also after a failure. */
enum result point_make(const struct slab *slabs, int count, const struct point_table *table,
                       double distance, struct progress *progress, struct point *point,
                       struct error *error);
void point_free(struct point *point);

/* point_image.c: paints the pages' far fields, or the table's, into a point that has its lamp,
 * center, axes and table: sets its image, channels, intensities and flux. */
enum result point_paint(const struct point_far *pages, int count, struct point *point,
                        struct error *error);

/* point_image.c: the first far field along a unit vector in the image's own axes, as POV-Ray
 * interpolates it. */
void point_look_up(const struct point *point, const double direction[3], double rgb[3]);

/* point_text.c: the include file. The caller checks the stream. */
void point_print(const struct point *point, const struct include_text *text, FILE *out);

#endif
