/* slab_image.h - images of any format that OpenImageIO knows: PNG, JPEG, TIFF, EXR and many
 * more, but no light slabs. The program lib/canned/bakeslab-image reads them. */
#ifndef SLAB_IMAGE_H
#define SLAB_IMAGE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/picture.h"
#include "base/result.h"

/* Reads an image as linear RGB, row 0 at the top; picture_free frees it. Floating-point
 * files and files that say so are linear, all others sRGB. One channel is grey. Alpha does not
 * change colours; `transparent` (NULL allowed) tells whether it is below 1 anywhere.
 *
 * `path` is the file or, where `bytes` are given, only what messages call it. `suffix` is the
 * format's name, as in file names; NULL: as `path` ends. RESULT_BAD for what is no image and for
 * values that are negative or not finite, RESULT_IO without the file or the program. */
enum result slab_image_read(const char *path, const void *bytes, size_t size, const char *suffix,
                            struct picture *picture, bool *transparent, struct error *error);

#endif
