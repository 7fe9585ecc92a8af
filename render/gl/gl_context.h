/* gl_context.h - OpenGL 4.3 without a window (by EGL), and checks and errors of any context.
 *
 * A context belongs to the thread that made it. Messages say what is missing, and that
 * --method views is the same sum on the CPU. */
#ifndef GL_CONTEXT_H
#define GL_CONTEXT_H

#include "base/result.h"

struct gl_context; /* owned by whoever created it */

/* Makes a context and makes it current. */
enum result gl_context_create(struct gl_context **context, struct error *error);
void gl_context_use(const struct gl_context *context); /* makes it current again */
void gl_context_free(struct gl_context *context);      /* NULL allowed */

struct gl_limits {
  int texture;    /* samples along a side of a texture */
  int layers;     /* of a texture array */
  int buffer;     /* texels of a buffer that is read as a texture */
  char name[128]; /* of the renderer */
};

/* Checks the current context: version, float targets. */
enum result gl_context_check(struct gl_limits *limits, struct error *error);

/* A new texture that is read by the filter, GL_NEAREST or GL_LINEAR, and a new frame buffer that
 * draws into a texture; both are bound. */
unsigned gl_texture(unsigned target, int filter);
unsigned gl_target(unsigned texture);

/* As result_fail; adds to the message that --method views needs no OpenGL. */
enum result gl_fail(struct error *error, enum result result, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Fails if OpenGL has an error pending. `what` was being made: "the shadow maps". */
enum result gl_check(const char *what, struct error *error);

#endif
