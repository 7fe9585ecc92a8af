/* sheet.h - the gobo sheet: a canned light as a POV-Ray include that lights a
 * scene exactly as the slab's sum over its uv samples does.
 *
 * One point light stands on each uv sample. A sheet at a small height h before
 * them carries the views as a tiled image, so that the shadow ray of each light
 * passes its own tile and is multiplied by L(u,v,s,t)/peak; an aperture
 * (`projected_through`) keeps it from its neighbours' tiles, an opaque box
 * keeps the light of others out.
 *
 * The image holds, for every page, a pyramid of levels: the page's uv samples,
 * and block means of them, halved (rounded up) down to 1x1, so that a scene
 * can ask for fewer lights. Each tile is a view with a ring of repeated edge
 * samples, because radiance is constant in the half cell at the window's
 * border. Pages that share an aperture and are alike, as those of channels are, share its lights:
 * the pigment of its sheet is the mean of their tiles. Rows of the image are counted upwards here,
 * with growing v and t, as POV-Ray's image_map does. */
#ifndef SHEET_H
#define SHEET_H

#include "base/picture.h"
#include "base/progress.h"
#include "include/text/include_text.h"

enum { SHEET_DISTANCES = 5, SHEET_RING = 1, SHEET_MOST_LEVELS = 32 };

struct sheet_level {
  struct slab views;             /* block means of the page; owned */
  int left, bottom;              /* corner of its tiles in the image, texels */
  double peak;                   /* radiance that the image holds as 1 */
  double height;                 /* of the sheet before its lights, at Scale 1 */
  int lit;                       /* lights whose view is not entirely black */
  double error[SHEET_DISTANCES]; /* relative RMSE of the irradiance on planes parallel to the
                                    aperture, or INFINITY: the sheet is farther */
  double error_at;               /* the same at the distance asked for */
  double shadow_at;              /* and past an edge half way (plane_shadow.h) */
};

struct sheet_page {
  struct sheet_level levels[SHEET_MOST_LEVELS]; /* finest first */
  int level_count;
  int first, next; /* pages of the same aperture: the first of them; the one after this, or -1 */
  int channel;     /* include_channel */
  double flux[3];  /* at Scale 1, by slab_flux_metric */
  double faintest; /* smallest radiance above zero over the peak */
};

struct sheet {
  struct include_lamp lamp; /* its check: 0.25 and two values that differ from sheet to sheet */
  struct sheet_page *pages; /* with light; owned */
  int page_count;
  struct picture picture; /* rows downwards, as files have them */
};

/* Builds levels, errors and image from the slabs of one lamp, with at most
 * `lights` lights an axis (0: all). The errors are told at `distance`, too, in aperture widths,
 * unless that is 0; that is some 4000 look-ups of the slab for each of its positions, and 1e7 for
 * each page, which `progress` (or NULL) shows. Refuses negative radiance, light that POV-Ray's
 * numbers cannot hold, and a lamp without any light. Free with sheet_free, also after a failure. */
enum result sheet_make(const struct slab *slabs, int count, int lights, double distance,
                       struct progress *progress, struct sheet *sheet, struct error *error);
/* The level's error at so many aperture widths, or at the next smaller distance at which it is
 * told; INFINITY: not known. */
double sheet_level_error(const struct sheet_level *level, double apertures);
void sheet_free(struct sheet *sheet);

/* Most lights that the sheet has along an axis. */
int sheet_most_lights(const struct sheet *sheet);

/* How many apertures the pages have. */
int sheet_apertures(const struct sheet *sheet);

/* Whether the view (i, j) of a level is not entirely black. */
bool sheet_is_lit(const struct slab *views, int i, int j);

/* sheet_image.c: places the levels' tiles and paints them. */
enum result sheet_paint(struct sheet *sheet, struct error *error);

/* sheet_text.c: the include file. The caller checks the stream. */
void sheet_print(const struct sheet *sheet, const struct include_text *text, FILE *out);

#endif
