/* method.h - the methods by which a receiver's light is summed: one table, a row each. What
 * differs from method to method is asked of it, by the sums, the commands and the tradeoff. */
#ifndef METHOD_H
#define METHOD_H

#include <stdbool.h>

enum gather_method {
  GATHER_AUTO,
  GATHER_REFERENCE,
  GATHER_PAPER,
  GATHER_MIDPOINT,
  GATHER_PI,
  GATHER_CLOSED,
  GATHER_VIEWS,
  GATHER_LEVELS,
  GATHER_PAPER_LEVELS,
  GATHER_CUT,
  GATHER_GL,
  GATHER_METHODS
};

/* What is made of the slabs before the first receiver (gather_prepare). */
enum method_makes {
  METHOD_NOTHING,
  METHOD_LEVELS,        /* the paper's hierarchy (levels.h) */
  METHOD_TREES,         /* of blocks of views (cut.h), and a cut is tried first */
  METHOD_TREES_FOR_MANY /* the same, where there are so many receivers that it pays */
};

/* How the micro lights of a page are summed. */
enum method_sum {
  METHOD_CHEAPEST, /* as METHOD_MEANS if its predicted error is within the tolerance, else GAUSS */
  METHOD_GAUSS,    /* Gauss rules whose order follows from the tolerance */
  METHOD_MEANS,    /* hat functions integrated exactly, the kernel in the middle */
  METHOD_MIDPOINT, /* both in the middle */
  METHOD_VIEWS,    /* both in the middle, of the views in place of micro lights */
  METHOD_RANDOM,   /* one random sample each (paper.h) */
  METHOD_CLOSED,   /* closed form (closed_form.h) */
  METHOD_OPENGL    /* views by a graphics processor: by gl_gather.h, not by gather.h */
};

/* What a user trades accuracy for time by. */
enum method_dial { METHOD_NO_DIAL, METHOD_BY_TOLERANCE, METHOD_BY_LEVEL };

/* Options that not all methods take, a bit each. */
enum {
  METHOD_TAKES_LEVEL = 1,
  METHOD_TAKES_SEED = 2,
  METHOD_TAKES_SHADOW_RAYS = 4, /* their grid and edge (visible.h) */
  METHOD_TAKES_SHADOW_MAPS = 8  /* their size and number, and passes (gl_sum.h) */
};

struct method {
  const char *name;
  enum method_makes makes;
  enum method_sum sum;
  enum method_dial dial;
  unsigned takes;
  double tolerance; /* relative, unless the user gives one */
  bool predicts;    /* the error of a receiver's light */
  bool matte_only;  /* no highlights and no occluders */
  const char *help;
};

extern const struct method gather_methods[GATHER_METHODS];

/* False where no method is called so. */
bool method_parse(const char *name, enum gather_method *method);

#endif
