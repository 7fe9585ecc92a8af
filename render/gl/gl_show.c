#include "gl/gl_show.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>

#include "gl/gl_program.h"

enum { SIDE = 64 }; /* of the samples of a change */

enum result gl_show_create(struct gl_show *show, struct error *error) {
  *show = (struct gl_show){0};
  glGenVertexArrays(1, &show->empty);
  show->samples = gl_receivers_texture(SIDE, SIDE);
  show->few = gl_target(show->samples);
  enum result result = gl_program_make(gl_all_vert, gl_radiance_frag, "", &show->draw, error);
  if (result == RESULT_OK)
    result = gl_program_make(gl_all_vert, gl_change_frag, "", &show->compare, error);
  if (result == RESULT_OK)
    result = gl_program_make(gl_all_vert, gl_screen_frag, "", &show->shown, error);
  if (result == RESULT_OK) result = gl_check("the picture", error);
  if (result != RESULT_OK) gl_show_free(show);
  return result;
}

static void free_pictures(struct gl_show *show) {
  const unsigned textures[] = {show->radiance, show->before, show->full, show->lamps, show->words};
  glDeleteTextures(5, textures);
  glDeleteFramebuffers(1, &show->target);
}

void gl_show_free(struct gl_show *show) {
  if (!show->empty) return; /* nothing was made; perhaps there is no context */
  free_pictures(show);
  glDeleteTextures(1, &show->samples);
  glDeleteFramebuffers(1, &show->few);
  glDeleteProgram(show->draw);
  glDeleteProgram(show->compare);
  glDeleteProgram(show->shown);
  glDeleteVertexArrays(1, &show->empty);
  *show = (struct gl_show){0};
}

enum result gl_show_resize(struct gl_show *show, const struct gl_receivers *receivers,
                           struct error *error) {
  static const float nothing[4] = {0};
  free_pictures(show);
  show->width = receivers->width;
  show->height = receivers->height;
  show->before = gl_receivers_texture(show->width, show->height);
  show->full = gl_receivers_texture(show->width, show->height);
  show->lamps = gl_receivers_texture(show->width, show->height);
  show->radiance = gl_receivers_texture(show->width, show->height);
  show->target = gl_target(show->lamps);
  glClearBufferfv(GL_COLOR, 0, nothing);
  glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, show->radiance, 0);
  show->words = gl_texture(GL_TEXTURE_2D, GL_NEAREST);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_R8, show->width, show->height);
  return gl_check("the picture", error);
}

void gl_show_set_lamps(struct gl_show *show, const float *pixels) {
  glBindTexture(GL_TEXTURE_2D, show->lamps);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, show->width, show->height, GL_RGBA, GL_FLOAT, pixels);
}

/* Runs a program for all pixels of a target. */
static void fill(const struct gl_show *show, unsigned program, unsigned target, int width,
                 int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, width, height);
  glUseProgram(program);
  glBindVertexArray(show->empty);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void gl_show_draw(const struct gl_show *show, const struct gl_receivers *receivers,
                  const struct gl_surfaces *surfaces, double unit, const double from[3]) {
  const struct {
    const char *name;
    unsigned texture;
  } textures[] = {{"position", receivers->position},
                  {"diffuse", surfaces->diffuse},
                  {"specular", surfaces->specular},
                  {"shows", surfaces->shows},
                  {"irradiance", receivers->irradiance},
                  {"gloss", receivers->gloss},
                  {"lamps", show->lamps}};
  double scale = unit / M_PI;
  for (int k = 0; k < (int)(sizeof textures / sizeof *textures); ++k)
    gl_set_texture(show->draw, textures[k].name, k, GL_TEXTURE_2D, textures[k].texture);
  gl_set_floats(show->draw, "from", 3, from);
  gl_set_floats(show->draw, "scale", 1, &scale);
  fill(show, show->draw, show->target, show->width, show->height);
}

double gl_show_change(const struct gl_show *show, unsigned earlier) {
  float squares[SIDE * SIDE][2];
  double step[2] = {show->width / (double)SIDE, show->height / (double)SIDE}, sum[2] = {0};
  gl_set_texture(show->compare, "radiance", 0, GL_TEXTURE_2D, show->radiance);
  gl_set_texture(show->compare, "earlier", 1, GL_TEXTURE_2D, earlier);
  gl_set_floats(show->compare, "step", 2, step);
  fill(show, show->compare, show->few, SIDE, SIDE);
  glReadPixels(0, 0, SIDE, SIDE, GL_RG, GL_FLOAT, squares);
  for (int k = 0; k < SIDE * SIDE; ++k)
    for (int c = 0; c < 2; ++c) sum[c] += (double)squares[k][c];
  return sum[0] > 0 ? sqrt(sum[1] / sum[0]) : 0;
}

void gl_show_keep(const struct gl_show *show, unsigned earlier) {
  glCopyImageSubData(show->radiance, GL_TEXTURE_2D, 0, 0, 0, 0, earlier, GL_TEXTURE_2D, 0, 0, 0, 0,
                     show->width, show->height, 1);
}

enum result gl_show_read(const struct gl_show *show, struct picture *picture, struct error *error) {
  size_t row = 3 * (size_t)show->width;
  *picture = (struct picture){.width = show->width,
                              .height = show->height,
                              .rgb = calloc(row * (size_t)show->height, sizeof(float))};
  if (!picture->rgb) return result_no_memory(error);
  glBindFramebuffer(GL_FRAMEBUFFER, show->target);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  for (int y = 0; y < show->height; ++y)
    glReadPixels(0, show->height - 1 - y, show->width, 1, GL_RGB, GL_FLOAT,
                 picture->rgb + (size_t)y * row);
  enum result result = gl_check("the picture", error);
  if (result != RESULT_OK) picture_free(picture);
  return result;
}

void gl_show_screen(const struct gl_show *show, double white, const unsigned char *words,
                    unsigned target) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glBindTexture(GL_TEXTURE_2D, show->words);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, show->width, show->height, GL_RED, GL_UNSIGNED_BYTE,
                  words);
  gl_set_texture(show->shown, "radiance", 0, GL_TEXTURE_2D, show->radiance);
  gl_set_texture(show->shown, "words", 1, GL_TEXTURE_2D, show->words);
  gl_set_floats(show->shown, "white", 1, &white);
  fill(show, show->shown, target, show->width, show->height);
}
