/* light_picture.h - a picture whose values are radiance, up to a factor. */
#ifndef LIGHT_PICTURE_H
#define LIGHT_PICTURE_H

#include "file/slab_image.h"

/* Reads a picture as slab_images_read does, times a factor; picture_free frees it. Refused, naming
 * the file: integers, which no camera stores in proportion to light, transparent pixels, several
 * pictures in a file, pixels that are not square. */
enum result light_picture_read(struct slab_images *images, const char *path, double factor,
                               struct picture *picture, struct error *error);

#endif
