/* image.h - a picture of the scene: what comes along a ray through each pixel's middle, or, where
 * a pixel wants them (refine.h), along N x N rays on a regular grid, averaged.
 *
 * The mean over N x N receivers has edges of shadows N times as fine as each of them, so that
 * these are looked at N times as coarsely. Tiles of 8 x 8 pixels are
 * independent pieces of work, so the same picture comes out whatever the threads. */
#ifndef IMAGE_H
#define IMAGE_H

#include <stdbool.h>

#include "base/picture.h"
#include "base/result.h"
#include "base/tiles.h"
#include "gather/gather.h"
#include "gl/gl_sum.h"
#include "picture/shade.h"

enum { IMAGE_TILE = 8, IMAGE_MOST_SAMPLES = 256 };

struct image_settings {
  struct shade shade; /* sizes: 1..NUMBERS_MOST_SIZE */
  struct gather_settings gather;
  const struct gl_sum_settings *gl; /* for the method gl, which takes the place of `gather` */
  int samples;                      /* N, 1..IMAGE_MOST_SAMPLES; method gl: N x N everywhere */
  int threads;                      /* >= 1 */
  int first_row, end_row;           /* of tiles, to render these alone; 0, 0: all. Neither with the
                                       method gl nor with a time to end */
  tiles_progress *progress;         /* may be NULL */
  void *progress_context;
  /* When a picture in which up to step x step pixels share a ray must be there, on progress_now's
   * clock; NULL: whenever it is. */
  double (*until)(void *context, int step);
  void *until_context;
};

/* What came out. */
struct image_report {
  struct gather_counts counts;
  int passes;
  int worst_step; /* pixels of up to step x step share a ray; 1: none do */
  double error; /* the largest predicted relative error of rays, whether pixels share them or not */
  double worst_tolerance, best_tolerance; /* with which its tiles were gathered */
};

/* With a time to end, the first pass has a ray for step x step pixels. */
int image_first_step(int width, int height);

/* Allocates and fills the picture and its errors; picture_free frees it. Pixels of rows that are
 * not rendered stay 0; the others are those of the whole picture, to the last bit.
 *
 * With a time to end, the whole picture is first made with a few hundred rays and a tolerance of
 * 0.3, then with ever more rays, up to one a pixel; then tile by tile, those with the largest
 * errors first, with a tenth of that tolerance, and so on until the time is over or the tolerance
 * asked for is reached everywhere; then with more rays where pixels want them. The first pass is
 * always finished. Edges of shadows follow: to about half the tolerance of a pass. */
enum result image_render(const struct image_settings *settings, struct picture *picture,
                         struct image_report *report, struct error *error);

/* The same by the method gl (image_gl.c), into a picture that is allocated; image_render calls
 * it. */
enum result image_render_gl(const struct image_settings *settings, struct picture *picture,
                            struct image_report *report, struct error *error);

#endif
