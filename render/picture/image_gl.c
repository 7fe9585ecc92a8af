/* image_gl.c - a picture by the method gl: camera rays by the CPU's threads, the light of as many
 * receivers at a time as gl_gather.h takes. */
#include <math.h>
#include <stdlib.h>

#include "gl/gl_gather.h"
#include "picture/image.h"

enum { BLOCK = 256 }; /* pixels that a thread traces at a time */

/* Consecutive pixels, row by row. */
struct band {
  const struct image_settings *settings;
  int64_t first;
  int count;  /* <= GL_GATHER_MOST */
  int sample; /* that is being traced */
  struct shade_hit *hits;
  struct receiver *receivers;
  struct gathered *gathered;
  double (*sum)[3], (*error)[3];
};

static void free_band(struct band *band) {
  free(band->hits);
  free(band->receivers);
  free(band->gathered);
  free(band->sum);
  free(band->error);
}

static enum result make_band(int64_t pixels, struct band *band, struct error *error) {
  size_t most = pixels < GL_GATHER_MOST ? (size_t)pixels : GL_GATHER_MOST;
  band->hits = calloc(most, sizeof *band->hits);
  band->receivers = calloc(most, sizeof *band->receivers);
  band->gathered = calloc(most, sizeof *band->gathered);
  band->sum = calloc(most, sizeof *band->sum);
  band->error = calloc(most, sizeof *band->error);
  if (band->hits && band->receivers && band->gathered && band->sum && band->error) return RESULT_OK;
  return result_fail(error, RESULT_MEMORY, "out of memory");
}

static enum result trace_block(void *context, int block, int worker, struct error *error) {
  struct band *band = context;
  int width = band->settings->width, end = (block + 1) * BLOCK;
  (void)worker;
  (void)error;
  for (int k = block * BLOCK; k < end && k < band->count; ++k)
    image_trace(band->settings, (int)((band->first + k) % width), (int)((band->first + k) / width),
                band->sample, &band->hits[k]);
  return RESULT_OK;
}

static enum result gather_hits(struct band *band, struct gl_gather *gl, struct error *error) {
  int lit = 0;
  for (int k = 0; k < band->count; ++k)
    if (band->hits[k].lit) band->receivers[lit++] = band->hits[k].receiver;
  if (lit == 0) return RESULT_OK;
  return gl_gather_light(gl, band->receivers, lit, band->gathered, error);
}

static void add_hits(struct band *band) {
  for (int k = 0, lit = 0; k < band->count; ++k) {
    const struct shade_hit *hit = &band->hits[k];
    double rgb[3], error[3];
    shade_radiance(hit, hit->lit ? &band->gathered[lit++] : NULL, rgb, error);
    for (int c = 0; c < 3; ++c) {
      band->sum[k][c] += rgb[c];
      band->error[k][c] += error[c];
    }
  }
}

static void store(const struct band *band, int samples, struct picture *picture) {
  for (int k = 0; k < band->count; ++k)
    for (int c = 0; c < 3; ++c) {
      picture->rgb[3 * (band->first + k) + c] = (float)(band->sum[k][c] / samples);
      picture->error[3 * (band->first + k) + c] = (float)(band->error[k][c] / samples);
    }
}

static enum result render_band(struct band *band, struct gl_gather *gl, struct picture *picture,
                               struct error *error) {
  int samples = band->settings->samples * band->settings->samples;
  int blocks = (band->count + BLOCK - 1) / BLOCK;
  for (int k = 0; k < band->count; ++k)
    for (int c = 0; c < 3; ++c) band->sum[k][c] = band->error[k][c] = 0;
  for (band->sample = 0; band->sample < samples; ++band->sample) {
    enum result result = tiles_run(band->settings->threads, blocks, trace_block, NULL, band, error);
    if (result == RESULT_OK) result = gather_hits(band, gl, error);
    if (result != RESULT_OK) return result;
    add_hits(band);
  }
  store(band, samples, picture);
  return RESULT_OK;
}

enum result image_render_gl(const struct image_settings *settings, struct picture *picture,
                            struct image_report *report, struct error *error) {
  int64_t pixels = (int64_t)settings->width * settings->height;
  struct band band = {.settings = settings};
  struct gl_gather *gl = NULL;
  enum result result = gl_gather_create(settings->gl, &gl, error);
  if (result == RESULT_OK) result = make_band(pixels, &band, error);
  while (result == RESULT_OK && band.first < pixels) {
    int64_t left = pixels - band.first;
    band.count = left < GL_GATHER_MOST ? (int)left : GL_GATHER_MOST;
    result = render_band(&band, gl, picture, error);
    band.first += band.count;
    if (settings->progress)
      settings->progress(settings->progress_context, (double)band.first / (double)pixels);
  }
  if (result == RESULT_OK) {
    gather_counts_add(&report->counts, gl_gather_counts(gl));
    report->passes = 1;
    report->error = INFINITY;
  }
  free_band(&band);
  gl_gather_free(gl);
  return result;
}
