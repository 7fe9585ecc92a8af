/* sheet.h - the gobo sheet: a canned light as a POV-Ray include that lights a
 * scene exactly as the slab's sum over its uv samples does.
 *
 * One point light stands on each uv sample. A sheet at a small height h before
 * them carries the views as a tiled image, so that the shadow ray of each light
 * passes its own tile and is multiplied by L(u,v,s,t)/peak; an aperture
 * (`projected_through`) keeps it from its neighbours' tiles, an opaque case
 * keeps the light of others out.
 *
 * The image holds, for every page, a pyramid of levels: the page's uv samples,
 * and block means of them, halved (rounded up) down to 1x1, so that a scene
 * can ask for fewer lights. Each tile is a view with a ring of repeated edge
 * samples, because radiance is constant in the half cell at the window's
 * border. Rows of the image are counted upwards here, with growing v and t, as
 * POV-Ray's image_map does. */
#ifndef SHEET_H
#define SHEET_H

#include <stdint.h>
#include <stdio.h>

#include "base/picture.h"
#include "include/sheet/sheet_level.h"
#include "include/text/include_text.h"

/* Height of the openings that keep lights to their tiles, as a share of the sheet's height.
 * The higher, the wider they are, and the farther from the origin a lamp may stand: POV-Ray
 * tests their bounding boxes in single precision. It also wants its SMALL_TOLERANCE, 0.001
 * scene units, between an opening and what casts a shadow behind it, which is the gap that
 * is left at least; and the lowest sheet that this leaves room for. */
extern const double sheet_gate, sheet_gap, sheet_least_height;

struct sheet_page {
  struct sheet_level *levels; /* finest first; owned */
  int level_count;
  double flux[3];  /* at Scale 1, by slab_flux_metric */
  double faintest; /* smallest radiance above zero over the peak */
};

struct sheet {
  struct sheet_page *pages; /* owned */
  int page_count;
  int black_pages;              /* pages left out because they hold no light */
  struct picture picture;       /* rows downwards, as files have them */
  int check_left, check_bottom; /* sheet_check_size^2 texels of sheet_check */
  float check[3];               /* 0.25 and two values that differ from sheet to sheet */
  uint64_t stamp;               /* hash of the image and the frames */
};

enum { SHEET_CHECK_SIZE = 3, SHEET_RING = 1 };

/* Builds levels, errors and image from the slabs of one lamp, with at most
 * `lights` lights an axis (0: all). Refuses negative radiance, light that
 * POV-Ray's numbers cannot hold, and a lamp without any light. Free with
 * sheet_free, also after a failure. */
enum result sheet_make(const struct slab *slabs, int count, int lights, struct sheet *sheet,
                       struct error *error);
void sheet_free(struct sheet *sheet);

/* sheet_image.c: places the levels' tiles and paints them. */
enum result sheet_paint(struct sheet *sheet, struct error *error);

/* sheet_text.c: the include file. The caller checks the stream. */
void sheet_print(const struct sheet *sheet, const struct include_text *text, FILE *out);

/* sheet_macros.c: the macros of the include, with @ for the lamp's name; and how the one that
 * scenes call goes on (include_canned). */
extern const char sheet_macros[], sheet_canned[];

#endif
