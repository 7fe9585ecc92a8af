/* slab_sampling.h - how a slab's samples were taken, as far as its JSON tells. */
#ifndef SLAB_SAMPLING_H
#define SLAB_SAMPLING_H

#include "slab/slab.h"

/* By slab_json_sampling. */
struct slab_sampling {
  bool points;                     /* rather than means over their cells */
  bool sharpened;                  /* slab_sharpen.h */
  double sample_noise, flux_noise; /* as the bake recorded them (bake_sum.h); NAN: not known */
  bool logluv;                     /* they were rounded to LogLuv, with this factor on XYZ: */
  double white[3];
};

#endif
