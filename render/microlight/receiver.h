/* receiver.h - a point of the scene that gathers light, what it gathers, and the work done. */
#ifndef RECEIVER_H
#define RECEIVER_H

#include <stdint.h>

/* `index` seeds the method `paper`. */
struct receiver {
  double position[3], normal[3]; /* scene space; normal unit */
  double lift[3];                /* unit geometric normal, along which shadow rays start */
  double eye[3];                 /* unit, towards the camera; for highlights only */
  double shininess;              /* exponent of the highlight; 0: matte */
  uint64_t index;
};

struct gathered {
  double irradiance[3];
  double gloss[3]; /* integral of L (N.H)^shininess over the solid angle above the tangent
                      plane; 0 for matte receivers */
  double error;    /* predicted, relative, of the irradiance: the largest of its pages'; INFINITY:
                      not known */
};

struct gather_counts {
  uint64_t receivers;
  uint64_t microlights; /* visited */
  uint64_t nodes;       /* at which the kernel was evaluated */
  uint64_t black;       /* micro lights that were skipped: all their samples are 0 */
  uint64_t shadow_rays;
  uint64_t open_views;   /* pages for which none were traced: nothing can stand between */
  uint64_t pages_behind; /* pages that were skipped: the receiver is behind them or outside all
                            that they emit, or they are below its tangent plane */
  double error;          /* the largest of the receivers' */
};

/* Adds the work of another thread: sums, and the larger error. */
void gather_counts_add(struct gather_counts *sum, const struct gather_counts *counts);

#endif
