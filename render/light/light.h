/* light.h - a canned light in a scene: its slabs, and where they are.
 *
 * `LIGHT` of the command line: FILE [at=X,Y,Z] [toward=X,Y,Z] [up=X,Y,Z] [matrix=12 numbers]
 * [scale=S] [gain=G or R,G,B or lumens=L] [kelvin=K] [metres=M] [gain.CHANNEL=G]. The lamp's point
 * p goes to at + scale R p, where R turns the first page's normal to toward - at and its v towards
 * up as nearly as it can; `matrix` is in POV-Ray's order and excludes at, toward and up. Scaling
 * keeps radiance; gain multiplies it, and so does the colour of a black body of K kelvin. With
 * lumens the gain is what makes the flux of the placed lamp L, in cd/m2: M is the scene's unit, by
 * default the slab's. That of a channel multiplies the radiance of its pages (slab->channel), after
 * all this.
 *
 * Only similarities (turning, mirroring, moving, one scale) leave a slab a slab: other
 * matrices are refused. */
#ifndef LIGHT_H
#define LIGHT_H

#include <stdbool.h>

#include "light/light_text.h"
#include "light/lit_rows.h"

/* One axis of a page: the aperture's (u or v), seen with the window's (s or t). Lengths in
 * scene units. */
struct light_axis {
  int near_count, far_count; /* samples along u or v, along s or t */
  double half;               /* of the aperture's edge */
  double near_step;          /* from sample to sample */
  double far_low, far_high;  /* the window, in slopes */
  double far_step;
  double kappa; /* 1/st_distance */
};

struct light_page {
  struct slab slab;   /* as loaded, in lamp space; owned */
  double gain;        /* of its channel, beside the light's */
  double center[3];   /* in scene space, as the frame below: */
  double frame[3][3]; /* unit vectors u', v' and n */
  struct light_axis axes[2];
  struct lit_row *lit; /* [rows of the raster]: where they are not black; owned */
  double unit; /* a power of two from 2^-100 on; samples divided by it are at most about 2^100, so
                  that sums in single precision neither overflow nor underflow */
};

struct light {
  char *path; /* of the slab; owned */
  int count;
  struct light_page *pages;                      /* owned */
  double gain[3];                                /* of all pages */
  struct light_channel channels[LIGHT_CHANNELS]; /* those of the slab, in the order of its pages */
  int channel_count;
  double scale;
  bool measured;       /* by lumens: radiance is in cd/m2 */
  bool resized;        /* measured, its scale is far from 1, and nothing is said of units */
  double matrix[4][3]; /* lamp to scene, POV-Ray's order: images of x, y, z; translation */
};

/* Parses the text and loads the slabs. Messages name the text or the file. */
enum result light_load(const char *text, struct light *light, struct error *error);
void light_free(struct light *light); /* zeroed light allowed */

/* Pages of the first `count` lights: the number of the next light's first page. */
int light_pages(const struct light *lights, int count);

/* Moves and turns the light, without scaling it: `matrix` as light->matrix. False, and nothing is
 * changed, where the result is not finite. */
bool light_move(struct light *light, const double matrix[4][3]);

/* Sets the gain of a channel, by its number. */
void light_set_channel(struct light *light, int channel, double gain);

/* Sets what depends on the slab's samples, after these have changed. Denormal samples become 0:
 * they have lost their digits, and processors are slow with them. */
enum result light_page_set_samples(struct light_page *page, struct error *error);
void light_page_free(struct light_page *page);

/* The unit of the placed lamp's radiance, as slab.h's radiance_unit. */
const char *light_unit(const struct light *light);

/* The corners of the page's aperture, in scene space. */
void light_page_corners(const struct light_page *page, double corners[4][3]);

/* What a camera sees of the lamps themselves: the nearest aperture that faces `origin` along the
 * unit `direction`, nearer than `limit`. Gives its radiance and returns the distance; INFINITY
 * where there is none. Apertures are transparent from behind. */
double light_seen(const struct light *lights, int count, const double origin[3],
                  const double direction[3], double limit, double rgb[3]);

#endif
