/* slab_exr.h - RGB pictures in OpenEXR files, by OpenEXRCore.
 *
 * Pixels are interleaved float RGB, rows downwards. A single picture is all
 * that POV-Ray's frames, sheet images and results need; slab_file.c reads
 * and writes the pages of slabs with the rest. */
#ifndef SLAB_EXR_H
#define SLAB_EXR_H

#include "slab_error.h"

#ifdef __cplusplus
extern "C" {
#endif

struct slab_picture {
  int width, height;
  float *rgb; /* owned */
};

void slab_picture_free(struct slab_picture *picture);

/* Reads channels R, G and B (half or float) of the first part. Non-finite
 * pixels are delivered as they are. */
enum slab_result slab_exr_read(const char *path, struct slab_picture *picture,
                               struct slab_error *error);

/* Writes one part, half or float, losslessly compressed, whole or not at all.
 * `comment` goes into the string attribute "comments"; NULL for none. A value
 * that half cannot hold is refused. */
enum slab_result slab_exr_write(const char *path, const struct slab_picture *picture,
                                int half, const char *comment, struct slab_error *error);

#ifdef __cplusplus
}
#endif
#endif
