/* gl_sum.h - the sum over views on a graphics processor (the paper's section 4.3, equation 4):
 * the method `views` of gather.h, for a whole picture of receivers at once.
 *
 * Receivers are textures of floats: from camera rays on the CPU (gl_gather.h), or rasterised
 * (gl_raster.h). Their light is added up in two more, so that views may be added one by one, by
 * parts, or all in one pass; all give the same to float rounding. Shadows are by gl_maps.h, whose
 * maps are kept where all find room. Light is zero below the receiver's tangent plane, and at most
 * 1e30 times the unit: beside a view's middle its inverse square has no bound. */
#ifndef GL_SUM_H
#define GL_SUM_H

#include <stdbool.h>

#include "gl/gl_maps.h"
#include "gl/gl_slides.h"
#include "microlight/levels.h"

/* A picture of receivers and of their light; owned textures of width x height. */
struct gl_receivers {
  int width, height;
  unsigned position; /* relative to the origin; w: exponent of the highlight, 0 for matte,
                        below 0 where there is no receiver */
  unsigned normal, lift, eye;
  unsigned irradiance, gloss; /* divided by gl_sum.unit */
  unsigned target;            /* the frame buffer of these two */
};

enum result gl_receivers_create(int width, int height, const struct gl_limits *limits,
                                struct gl_receivers *receivers, struct error *error);
/* One more such texture of four floats a pixel, deleted with glDeleteTextures. */
unsigned gl_receivers_texture(int width, int height);
void gl_receivers_free(struct gl_receivers *receivers); /* zeroed receivers allowed */

struct gl_sum_settings {
  const struct light *lights; /* outlive the sum, as the levels */
  int light_count;
  const struct levels *levels;   /* [all pages]; NULL for level 0 */
  int level;                     /* of the hierarchy: fewer views; the last where there is none */
  const struct scene *occluders; /* NULL: no shadows */
  int map_size;                  /* texels a side of a shadow map */
  int groups;                    /* x groups shadow maps a page; 0: one for each view */
  bool separate;                 /* a pass for each view, as published */
};

struct gl_sum {
  struct gl_sum_settings settings;
  struct gl_limits limits;
  double origin[3]; /* of positions in textures */
  double unit;      /* of light in textures */
  int pages;
  struct gl_slides *slides; /* [pages] */
  struct gl_maps maps;
  bool kept;              /* all shadow maps have layers of their own */
  unsigned programs[4];   /* by gloss and shadows */
  unsigned empty;         /* vertex array without attributes */
  uint64_t views, passes; /* summed, and drawn for that */
};

/* Needs a current context, until it is freed. */
enum result gl_sum_create(const struct gl_sum_settings *settings, struct gl_sum *sum,
                          struct error *error);
void gl_sum_free(struct gl_sum *sum); /* zeroed sum allowed */

/* Sets the receivers' light to 0. */
void gl_sum_clear(const struct gl_receivers *receivers);

/* Adds a share of each page's views, from `from` to `to` of 0..1; highlights too if `gloss`. A
 * view in which a share ends counts by its part, so that the sum from 0 to x, divided by x,
 * estimates the whole, of pages with few views too. */
enum result gl_sum_add(struct gl_sum *sum, const struct gl_receivers *receivers, double from,
                       double to, bool gloss, struct error *error);

/* To be called after light_move: the light's views are elsewhere. */
void gl_sum_moved(struct gl_sum *sum, int light);

#endif
