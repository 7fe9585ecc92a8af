/* image.h - a picture of the scene: what comes along N x N rays a pixel, averaged.
 *
 * Rays stand on a regular grid in the pixel (one: in its middle). Tiles of 8 x 8 pixels are
 * independent pieces of work, so the same picture comes out whatever the threads. */
#ifndef IMAGE_H
#define IMAGE_H

#include "camera.h"
#include "gather.h"
#include "shade.h"
#include "slab_exr.h"
#include "tiles.h"

enum { IMAGE_TILE = 8, IMAGE_MOST_SIZE = 65536, IMAGE_MOST_SAMPLES = 256 };

struct image_settings {
  struct shade shade;
  struct camera camera;
  struct gather_settings gather;
  int width, height;        /* 1..IMAGE_MOST_SIZE */
  int samples;              /* N, 1..IMAGE_MOST_SAMPLES */
  int threads;              /* >= 1 */
  tiles_progress *progress; /* may be NULL */
  void *progress_context;
};

/* Allocates and fills the picture; slab_picture_free frees it. Counts are added to *counts. */
enum slab_result image_render(const struct image_settings *settings, struct slab_picture *picture,
                              struct gather_counts *counts, struct slab_error *error);

#endif
