/* image_gl.c - a picture by the method gl: camera rays by the CPU's threads, the light of as many
 * rows of receivers at a time as gl_gather.h takes. */
#include <math.h>

#include "gl/gl_gather.h"
#include "picture/image.h"
#include "picture/image_part.h"

enum { BLOCK = 256 }; /* pixels that a thread traces at a time */

/* Rows of the picture. */
struct band {
  const struct image_settings *settings;
  struct image_part part;
  int sample; /* that is being traced */
};

static enum result trace_block(void *context, int block, int worker, struct error *error) {
  struct band *band = context;
  int pixels = band->part.width * band->part.height, end = (block + 1) * BLOCK;
  (void)worker;
  (void)error;
  image_part_trace(&band->settings->shade, band->settings->samples, band->sample, block * BLOCK,
                   end < pixels ? end : pixels, &band->part);
  return RESULT_OK;
}

static enum result render_band(struct band *band, struct gl_gather *gl, struct picture *picture,
                               struct error *error) {
  const struct image_settings *settings = band->settings;
  struct image_part *part = &band->part;
  int samples = settings->samples * settings->samples;
  int blocks = (part->width * part->height + BLOCK - 1) / BLOCK;
  image_part_clear(part);
  for (band->sample = 0; band->sample < samples; ++band->sample) {
    enum result result = tiles_run(settings->threads, blocks, trace_block, NULL, band, error);
    int lit = result == RESULT_OK ? image_part_receivers(part) : 0;
    if (lit > 0) result = gl_gather_light(gl, part->receivers, lit, part->gathered, error);
    if (result != RESULT_OK) return result;
    image_part_add(part);
  }
  image_part_store(part, samples, picture);
  return RESULT_OK;
}

enum result image_render_gl(const struct image_settings *settings, struct picture *picture,
                            struct image_report *report, struct error *error) {
  struct band band = {.settings = settings};
  struct gl_gather *gl = NULL;
  int rows = GL_GATHER_MOST / picture->width;
  if (rows > picture->height) rows = picture->height;
  enum result result = gl_gather_create(settings->gl, &gl, error);
  if (result == RESULT_OK)
    result = image_part_create((size_t)rows * (size_t)picture->width, &band.part, error);
  band.part.width = picture->width;
  for (int end, top = 0; result == RESULT_OK && top < picture->height; top = end) {
    end = top + rows < picture->height ? top + rows : picture->height;
    band.part.top = top;
    band.part.height = end - top;
    result = render_band(&band, gl, picture, error);
    if (settings->progress)
      settings->progress(settings->progress_context, (double)end / picture->height);
  }
  if (result == RESULT_OK) {
    gather_counts_add(&report->counts, gl_gather_counts(gl));
    report->passes = 1;
    report->error = INFINITY;
  }
  image_part_free(&band.part);
  gl_gather_free(gl);
  return result;
}
