#include "gl/gl_gather.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1024, HEIGHT = GL_GATHER_MOST / WIDTH };

struct gl_gather {
  struct gl_context *context;
  struct gl_sum sum;
  struct gl_receivers receivers;
  struct gather_counts counts;
  float (*pixels)[4]; /* [GL_GATHER_MOST]: to be uploaded, or downloaded */
};

enum result gl_gather_create(const struct gl_sum_settings *settings, struct gl_gather **gather,
                             struct error *error) {
  enum result result = RESULT_OK;
  *gather = calloc(1, sizeof **gather);
  if (*gather) (*gather)->pixels = calloc(GL_GATHER_MOST, sizeof *(*gather)->pixels);
  if (!*gather || !(*gather)->pixels) result = result_no_memory(error);
  if (result == RESULT_OK) result = gl_context_create(&(*gather)->context, error);
  if (result == RESULT_OK) result = gl_sum_create(settings, &(*gather)->sum, error);
  if (result == RESULT_OK)
    result =
        gl_receivers_create(WIDTH, HEIGHT, &(*gather)->sum.limits, &(*gather)->receivers, error);
  if (result != RESULT_OK) {
    gl_gather_free(*gather);
    *gather = NULL;
  }
  return result;
}

void gl_gather_free(struct gl_gather *gather) {
  if (!gather) return;
  if (gather->context) gl_context_use(gather->context);
  if (gather->receivers.target) gl_receivers_free(&gather->receivers);
  gl_sum_free(&gather->sum);
  gl_context_free(gather->context);
  free(gather->pixels);
  free(gather);
}

const struct gather_counts *gl_gather_counts(const struct gl_gather *gather) {
  return &gather->counts;
}

/* So far away that its position, or its light, is beyond floats. */
static bool is_beyond(const struct receiver *receiver, const double origin[3]) {
  for (int c = 0; c < 3; ++c)
    if (!(fabs(receiver->position[c] - origin[c]) < 1e36)) return true;
  return false;
}

/* Vectors of the receivers, `offset` bytes from their start, less `origin`. */
static void upload(struct gl_gather *gather, unsigned texture, const struct receiver *receivers,
                   int count, size_t offset, const double origin[3]) {
  int rows = (count + WIDTH - 1) / WIDTH;
  for (int k = 0; k < rows * WIDTH; ++k) {
    double vector[3] = {0};
    bool here = k < count && !is_beyond(&receivers[k], gather->sum.origin);
    if (here) memcpy(vector, (const char *)&receivers[k] + offset, sizeof vector);
    for (int c = 0; c < 3; ++c) gather->pixels[k][c] = (float)(vector[c] - origin[c]);
    gather->pixels[k][3] = here ? (float)receivers[k].shininess : -1;
  }
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, rows, GL_RGBA, GL_FLOAT, gather->pixels);
}

static void download(struct gl_gather *gather, GLenum attachment, int count, size_t offset,
                     struct gathered *gathered) {
  int rows = (count + WIDTH - 1) / WIDTH;
  glBindFramebuffer(GL_FRAMEBUFFER, gather->receivers.target);
  glReadBuffer(attachment);
  glReadPixels(0, 0, WIDTH, rows, GL_RGBA, GL_FLOAT, gather->pixels);
  for (int k = 0; k < count; ++k) {
    double rgb[3];
    for (int c = 0; c < 3; ++c) rgb[c] = gather->sum.unit * (double)gather->pixels[k][c];
    memcpy((char *)&gathered[k] + offset, rgb, sizeof rgb);
  }
}

enum result gl_gather_light(struct gl_gather *gather, const struct receiver *receivers, int count,
                            struct gathered *gathered, struct error *error) {
  static const double none[3] = {0};
  const struct gl_receivers *textures = &gather->receivers;
  struct gl_sum *sum = &gather->sum;
  bool gloss = false;
  gl_context_use(gather->context);
  for (int k = 0; k < count; ++k) {
    gathered[k] = (struct gathered){.error = INFINITY};
    gloss = gloss || receivers[k].shininess > 0;
  }
  upload(gather, textures->position, receivers, count, offsetof(struct receiver, position),
         sum->origin);
  upload(gather, textures->normal, receivers, count, offsetof(struct receiver, normal), none);
  if (sum->settings.occluders)
    upload(gather, textures->lift, receivers, count, offsetof(struct receiver, lift), none);
  if (gloss) upload(gather, textures->eye, receivers, count, offsetof(struct receiver, eye), none);
  struct gl_receivers used = *textures;
  used.height = (count + WIDTH - 1) / WIDTH;
  gl_sum_clear(&used);
  uint64_t views = sum->views;
  enum result result = gl_sum_add(sum, &used, 0, 1, gloss, error);
  if (result != RESULT_OK) return result;
  download(gather, GL_COLOR_ATTACHMENT0, count, offsetof(struct gathered, irradiance), gathered);
  if (gloss)
    download(gather, GL_COLOR_ATTACHMENT1, count, offsetof(struct gathered, gloss), gathered);
  gather->counts.receivers += (uint64_t)count;
  gather->counts.microlights += (sum->views - views) * (uint64_t)count;
  gather->counts.nodes = gather->counts.microlights;
  gather->counts.error = INFINITY;
  return gl_check("the sum over views", error);
}
