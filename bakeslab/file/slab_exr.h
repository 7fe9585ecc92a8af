/* slab_exr.h - RGB pictures in OpenEXR files, by OpenEXRCore.
 *
 * Pixels are interleaved float RGB, rows downwards. A single picture is all
 * that POV-Ray's frames, sheet images and results need; slab_file.c reads
 * and writes the pages of slabs with the second half. */
#ifndef SLAB_EXR_H
#define SLAB_EXR_H

#include "base/picture.h"
#include "base/result.h"

struct output;
struct slab_raster;

/* Reads channels R, G and B (half or float) of the first part. Non-finite
 * pixels are delivered as they are. */
enum result slab_exr_read(const char *path, struct picture *picture, struct error *error);

/* Writes one part, half or float, losslessly compressed, whole or not at all.
 * `comment` goes into the string attribute "comments"; NULL for none. A value
 * that half cannot hold is refused. A picture's `error` becomes the channels error.R, error.G and
 * error.B of a part of their own, `error`, so that readers of pictures need not know of it; with
 * float only. Its `about` goes into the string attribute "error". Readers leave both NULL. */
enum result slab_exr_write(const char *path, const struct picture *picture, int half,
                           const char *comment, struct error *error);

/* The same into a file that is already open. */
enum result slab_exr_put(struct output *output, const struct picture *picture, int half,
                         const char *comment, struct error *error);

/* The same, several parts: part p is named
 * "pageP" and carries its text in the string attribute `text_name`. */
enum result slab_exr_write_parts(struct output *output, const struct slab_raster *parts, int count,
                                 const char *text_name, struct error *error);

/* A file of parts that is read by blocks. Part numbers start at 0 here and at
 * 1 in messages. */
struct slab_exr; /* owned by whoever opened it */

/* Reads the headers. Takes over `fd`, also when it fails; `path`, for messages, must
 * stay. The text of each part is that of the string attribute `text_name`; where that is NULL,
 * only the first part is looked at. */
enum result slab_exr_open(int fd, const char *path, const char *text_name, struct slab_exr **exr,
                          struct error *error);
void slab_exr_close(struct slab_exr *exr); /* NULL allowed */
int slab_exr_parts(const struct slab_exr *exr);
struct slab_raster *slab_exr_part(struct slab_exr *exr, int part); /* owned by the file */

/* Reads a block into slab_raster_block_pixels pixels. */
enum result slab_exr_read_block(struct slab_exr *exr, int part, int column, int row, float *rgb,
                                struct error *error);

#endif
