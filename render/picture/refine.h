/* refine.h - more rays for the pixels that want them.
 *
 * 1. Each pixel gathers along one ray through its middle; what that ray met is noted.
 * 2. A pixel wants more rays where an edge of a surface runs between it and one of its eight
 *    neighbours, or where its radiance, along one of the four lines through it and two of them,
 *    bends: by a second difference of more than 8 times the tolerance, relative to the brightest
 *    of the nine.
 * 3. N x N rays are traced there. What one of them meets takes its light from those of the nine
 *    middles that are on the same surface, by the least-squares plane over the picture, if planes
 *    through all but one of them predict that one to within three times the tolerance. Else the
 * rays in the pixel's corners gather, and the others take theirs from these and the middle, or
 * gather too.
 *
 * So silhouettes and textures cost camera rays, and only edges of shadows are gathered anew. What
 * is narrower than a pixel and was missed by all nine middles stays missed. */
#ifndef REFINE_H
#define REFINE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/picture.h"
#include "base/result.h"
#include "picture/image_part.h"
#include "picture/shade.h"

/* What the ray through a pixel's middle met, and its light. */
struct refine_seen {
  double position[3];
  float normal[3], shininess;
  float irradiance[3], gloss[3], error; /* as `gathered` */
  float rgb[3];                         /* the radiance that comes along it */
  bool lit;                             /* else only rgb is set */
};

struct refine {
  const struct shade *shade; /* not owned */
  double tolerance;          /* relative */
  struct refine_seen *seen;  /* of the picture's pixels, row by row; owned */
};

/* Freed with refine_free, also after a failure. */
enum result refine_create(const struct shade *shade, double tolerance, struct refine *refine,
                          struct error *error);
void refine_free(struct refine *refine); /* zeroed allowed */

/* Notes a part of one ray a pixel that has gathered. */
void refine_note(struct refine *refine, const struct image_part *part);

/* Once the neighbours are noted. */
bool refine_wants(const struct refine *refine, int x, int y);

/* Some pixels at a time, by one thread. */
struct refine_rays {
  int grid;                   /* N */
  int most, count;            /* pixels */
  int *pixels;                /* [count], numbered row by row; set by the caller */
  int asked;                  /* receivers that must gather */
  struct receiver *receivers; /* [asked] */
  struct gathered *gathered;  /* [asked]; set by the caller */
  int *askers;                /* [asked]: numbers of their rays */
  struct refine_ray *rays;    /* [count][grid^2] */
};

/* For up to `pixels` pixels, and fewer where N is large. Freed with refine_rays_free, also after
 * a failure. */
enum result refine_rays_create(int grid, int pixels, struct refine_rays *rays, struct error *error);
void refine_rays_free(struct refine_rays *rays); /* zeroed allowed */

/* Traces the rays of the pixels. */
void refine_trace(const struct refine *refine, struct refine_rays *rays);

/* Shares light, and sets `asked` and the receivers that must gather: those in the pixels' corners,
 * or, once these have taken theirs, the rest. */
void refine_ask(const struct refine *refine, bool corners, struct refine_rays *rays);

/* Gives the askers what was gathered. */
void refine_take(struct refine_rays *rays);

/* Puts the means into the picture. Returns the largest relative error that is predicted. */
double refine_store(const struct refine_rays *rays, struct picture *picture);

#endif
