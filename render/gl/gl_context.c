#include "gl/gl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct gl_context {
  EGLDisplay display;
  EGLContext context;
};

enum result gl_fail(struct error *error, enum result result, const char *format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return result_fail(error, result,
                     "OpenGL: %s; `renderslab image --method views' sums the same on the CPU",
                     text);
}

enum result gl_check(const char *what, struct error *error) {
  GLenum code = glGetError();
  if (code == GL_NO_ERROR) return RESULT_OK;
  if (code == GL_OUT_OF_MEMORY)
    return gl_fail(error, RESULT_MEMORY, "out of graphics memory for %s", what);
  return gl_fail(error, RESULT_IO, "error 0x%04x at %s", code, what);
}

/* libepoxy aborts where a library is missing, so look first. */
static bool have_library(const char *name) {
  void *library = dlopen(name, RTLD_LAZY);
  if (library) dlclose(library);
  return library != NULL;
}

/* Surfaceless where the driver can: it needs no display. */
static EGLDisplay find_display(void) {
  const char *known = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  EGLDisplay display = EGL_NO_DISPLAY;
  if (known && strstr(known, "EGL_MESA_platform_surfaceless"))
    display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, NULL, NULL)) return display;
  display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, NULL, NULL)) return display;
  return EGL_NO_DISPLAY;
}

static enum result open_context(struct gl_context *context, struct error *error) {
  static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
  if (!have_library("libEGL.so.1")) return gl_fail(error, RESULT_IO, "no EGL here (libEGL.so.1)");
  context->display = find_display();
  if (context->display == EGL_NO_DISPLAY)
    return gl_fail(error, RESULT_IO, "EGL finds no display and no driver without one");
  if (!eglBindAPI(EGL_OPENGL_API))
    return gl_fail(error, RESULT_IO, "EGL has OpenGL ES only; 4.3 is needed");
  context->context = eglCreateContext(context->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (context->context == EGL_NO_CONTEXT)
    return gl_fail(error, RESULT_IO, "the driver has no version 4.3");
  if (!eglMakeCurrent(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->context))
    return gl_fail(error, RESULT_IO, "the driver cannot do without a window");
  return RESULT_OK;
}

enum result gl_context_create(struct gl_context **context, struct error *error) {
  *context = calloc(1, sizeof **context);
  if (!*context) return result_no_memory(error);
  (*context)->display = EGL_NO_DISPLAY;
  (*context)->context = EGL_NO_CONTEXT;
  enum result result = open_context(*context, error);
  if (result != RESULT_OK) {
    gl_context_free(*context);
    *context = NULL;
  }
  return result;
}

void gl_context_use(const struct gl_context *context) {
  eglMakeCurrent(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->context);
}

/* The display is not terminated: it is one for the whole process. */
void gl_context_free(struct gl_context *context) {
  if (context && context->display != EGL_NO_DISPLAY) {
    eglMakeCurrent(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context->context != EGL_NO_CONTEXT) eglDestroyContext(context->display, context->context);
  }
  free(context);
}

unsigned gl_texture(unsigned target, int filter) {
  unsigned texture;
  glGenTextures(1, &texture);
  glBindTexture(target, texture);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
  return texture;
}

unsigned gl_target(unsigned texture) {
  unsigned target;
  glGenFramebuffers(1, &target);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0);
  return target;
}

static bool has_float_targets(void) {
  unsigned texture = gl_texture(GL_TEXTURE_2D, GL_NEAREST);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, 4, 4);
  unsigned target = gl_target(texture);
  bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &target);
  glDeleteTextures(1, &texture);
  return complete;
}

enum result gl_context_check(struct gl_limits *limits, struct error *error) {
  const char *name = (const char *)glGetString(GL_RENDERER);
  int version = epoxy_gl_version();
  snprintf(limits->name, sizeof limits->name, "%s", name ? name : "unnamed");
  if (version < 43)
    return gl_fail(error, RESULT_IO, "%s has version %d.%d; 4.3 is needed", limits->name,
                   version / 10, version % 10);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits->texture);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limits->layers);
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limits->buffer);
  if (!has_float_targets())
    return gl_fail(error, RESULT_IO, "%s cannot render to 32-bit floats", limits->name);
  return gl_check("the first texture", error);
}
