/* method.h - the methods by which a receiver's light is summed. */
#ifndef METHOD_H
#define METHOD_H

#include <stdbool.h>

enum gather_method {
  GATHER_AUTO,         /* the cheapest that meets the tolerance */
  GATHER_REFERENCE,    /* Gauss rules whose order follows from the tolerance */
  GATHER_PAPER,        /* one random sample a micro light, as published */
  GATHER_MIDPOINT,     /* one in the middle */
  GATHER_PI,           /* hat functions integrated exactly, the kernel in the middle */
  GATHER_CLOSED,       /* closed form; matte receivers without occluders only */
  GATHER_VIEWS,        /* one sample a view, at the uv sample: what projective textures sum
                          (section 4.3), and POV-Ray's lights of the sheet include */
  GATHER_LEVELS,       /* the paper's hierarchy (section 4.2), kept in memory; pi on each level */
  GATHER_PAPER_LEVELS, /* the same as published: averaged on the fly, one random sample */
  GATHER_CUT,          /* blocks of views, as few as the tolerance allows (cut.h); micro lights
                          where that is no faster, and behind occluders */
  GATHER_METHODS,
  GATHER_GL = GATHER_METHODS /* as GATHER_VIEWS, by a graphics processor: gl_gather.h */
};

const char *gather_method_name(enum gather_method method);
/* Knows all but GATHER_GL. */
bool gather_method_parse(const char *name, enum gather_method *method);

#endif
