/* gl_receivers.c - the textures of gl_sum.h's receivers. */
#include <epoxy/gl.h>

#include "gl/gl_sum.h"

unsigned gl_receivers_texture(int width, int height) {
  unsigned texture = gl_texture(GL_TEXTURE_2D, GL_NEAREST);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, height);
  return texture;
}

enum result gl_receivers_create(int width, int height, const struct gl_limits *limits,
                                struct gl_receivers *receivers, struct error *error) {
  *receivers = (struct gl_receivers){.width = width, .height = height};
  if (width > limits->texture || height > limits->texture)
    return gl_fail(error, RESULT_BAD, "a picture of %d x %d; this driver's textures have %d", width,
                   height, limits->texture);
  receivers->position = gl_receivers_texture(width, height);
  receivers->normal = gl_receivers_texture(width, height);
  receivers->lift = gl_receivers_texture(width, height);
  receivers->eye = gl_receivers_texture(width, height);
  receivers->irradiance = gl_receivers_texture(width, height);
  receivers->gloss = gl_receivers_texture(width, height);
  enum result result = gl_check("the picture", error);
  receivers->target = gl_target(receivers->irradiance);
  glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, receivers->gloss, 0);
  if (result == RESULT_OK && glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    result = gl_fail(error, RESULT_IO, "the driver cannot draw a picture of %d x %d floats", width,
                     height);
  if (result != RESULT_OK) gl_receivers_free(receivers);
  return result;
}

void gl_receivers_free(struct gl_receivers *receivers) {
  const unsigned textures[] = {receivers->position, receivers->normal,     receivers->lift,
                               receivers->eye,      receivers->irradiance, receivers->gloss};
  glDeleteFramebuffers(1, &receivers->target);
  glDeleteTextures(6, textures);
  *receivers = (struct gl_receivers){0};
}
