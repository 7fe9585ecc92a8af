/* slab_precision.h - how a file holds samples. */
#ifndef SLAB_PRECISION_H
#define SLAB_PRECISION_H

enum slab_precision {
  SLAB_PRECISION_DEFAULT, /* LogLuv for .tif, float for .exr */
  SLAB_PRECISION_LOGLUV,
  SLAB_PRECISION_FLOAT,
  SLAB_PRECISION_HALF
};

#endif
