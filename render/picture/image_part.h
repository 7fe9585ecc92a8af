/* image_part.h - a rectangle of a picture's pixels, or of one that is smaller by a whole step, one
 * ray a pixel at a time: what the rays meet, and the sums of what comes along them. */
#ifndef IMAGE_PART_H
#define IMAGE_PART_H

#include "base/picture.h"
#include "picture/shade.h"

struct image_part {
  int left, top, width, height; /* pixels of the part; set by the caller */
  int step; /* a pixel of the part stands for step x step of the picture; 1, unless set */
  struct shade_hit *hits;     /* these and all below: of each pixel, row by row; owned */
  struct receiver *receivers; /* of those that are lit */
  struct gathered *gathered;  /* by the receivers */
  struct image_part_sum {
    double rgb[3], error[3];
  } * sums;
};

/* For up to `most` pixels. Freed with image_part_free, also after a failure. */
enum result image_part_create(size_t most, struct image_part *part, struct error *error);
void image_part_free(struct image_part *part); /* zeroed allowed */

/* Sets the sums to 0. */
void image_part_clear(struct image_part *part);

/* Traces a ray through each of the pixels first to end - 1: number `sample` of grid x grid. */
void image_part_trace(const struct shade *shade, int grid, int sample, int first, int end,
                      struct image_part *part);

/* Collects the receivers of all hits. Returns how many. */
int image_part_receivers(struct image_part *part);

/* Adds what the rays bring, once the receivers have gathered. Returns the largest relative error
 * that is predicted. */
double image_part_add(struct image_part *part);

/* Puts the means over so many rays a pixel into the picture, with an unknown error where pixels
 * share them. Returns the sum of the errors. */
double image_part_store(const struct image_part *part, int samples, struct picture *picture);

#endif
