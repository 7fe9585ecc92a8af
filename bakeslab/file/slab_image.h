/* slab_image.h - images: PNG, JPEG, TIFF, EXR, Radiance's HDR, GIF, BMP, WebP, PNM, PFM and TGA,
 * but no light slabs. The program lib/canned/bakeslab-image reads them by OpenImageIO. */
#ifndef SLAB_IMAGE_H
#define SLAB_IMAGE_H

#include <stdbool.h>
#include <stddef.h>

#include <stdio.h>

#include "base/picture.h"
#include "base/process.h"

/* What counts for the colours of an image. */
enum slab_image_colours {
  SLAB_IMAGE_OWN, /* what it says of itself */
  SLAB_IMAGE_SRGB /* sRGB, whatever it says, as glTF 2.0 asks; floats are linear */
};

/* What else an image says of itself. */
struct slab_image_says {
  bool transparent;    /* is alpha below 1 anywhere? */
  bool several;        /* are there other pictures in the file, which are not read? */
  bool integers;       /* does it hold these, rather than floating-point numbers? */
  double pixel_aspect; /* a pixel's width by its height */
};

/* Reads an image as linear Rec. 709, row 0 at the top, the right way up (EXIF's orientation,
 * Radiance's order of axes), within the display window of EXR, black where nothing is stored;
 * picture_free frees it. Colours are what the file says by its ICC profile (of curves and a
 * matrix, or grey), PNG's cICP, sRGB, gAMA and cHRM, chromaticities of EXR and TIFF (the same
 * light, without adaptation of white), EXPOSURE and COLORCORR of Radiance; where it says nothing,
 * floating-point files are linear, all others sRGB. One channel is grey. Alpha does not change
 * colours. Of several pictures in a file the first is read.
 *
 * `path` is the file or, where `bytes` are given, only what messages call it. `suffix` is what
 * names of such files end in, which only TGA needs; NULL: as `path` ends. `says` may be NULL.
 * RESULT_BAD for what is no image, what is refused by name (other profiles, CMYK, Lab, XYZE, more
 * than 2^27 pixels, more than 2 GiB) and values that are negative, not finite or outside Rec. 709;
 * RESULT_IO without the file or the program. */
enum result slab_image_read(const char *path, const void *bytes, size_t size, const char *suffix,
                            enum slab_image_colours colours, struct picture *picture,
                            struct slab_image_says *says, struct error *error);

/* The program, kept running for one image after the other: starting it takes as long as reading
 * many small ones. Zeroed ones have not been started; to be closed in any case. */
struct slab_images {
  char *program;        /* its path; owned; NULL: not started */
  const char *words[2]; /* of the command */
  struct process process;
  int requests;  /* a socket */
  FILE *answers; /* a pipe */
};

/* As slab_image_read. */
enum result slab_images_read(struct slab_images *images, const char *path, const void *bytes,
                             size_t size, const char *suffix, enum slab_image_colours colours,
                             struct picture *picture, struct slab_image_says *says,
                             struct error *error);
void slab_images_close(struct slab_images *images);

#endif
