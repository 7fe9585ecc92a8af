/* rebin.h - scattered rays become the samples of a slab, after S. J. Gortler, R. Grzeszczuk,
 * R. Szeliski and M. F. Cohen, "The Lumigraph", SIGGRAPH 96, section 3.4: rays are splatted with
 * the samples' basis functions; samples without rays are filled in from coarser levels (pull and
 * push). */
#ifndef REBIN_H
#define REBIN_H

#include <stddef.h>
#include <stdint.h>

#include "slab/slab.h"

/* One ray, or the mean of some close to each other. */
struct rebin_ray {
  float at[SLAB_AXES]; /* in samples: 0 is the middle of the first, from -1/2 to samples - 1/2 */
  float rgb[3];
  float weight;    /* in the error: the flux that the ray stands for */
  uint32_t source; /* the picture that it is of: a source is held out as a whole */
};

/* Rounds at most: the first bins the rays, the others mend what the slab gets wrong of them. */
enum { REBIN_ROUNDS = 12 };
/* The last of so many sources with rays is held out to tell the error; of fewer, the last of all;
 * of one, none. */
enum { REBIN_HELD_OUT = 8 };

struct rebin_report {
  int rounds;        /* chosen by the sources that were held out */
  double error;      /* relative RMS over their rays, by weight; NAN: too few sources */
  double mean_error; /* the same of sources as a whole, that is of light in one direction; NAN */
};

/* Fills the slab's samples, whose geometry and `samples` are given and which are allocated; where
 * they are not, only the report is made. known[] (NULL allowed) receives for each pixel of the
 * raster whether a ray touches that sample. `rays` are in any order; the same order gives the same
 * bits. Without any ray all samples are 0. */
enum result rebin(const struct rebin_ray *rays, size_t count, struct slab *slab, bool *known,
                  struct rebin_report *report, struct error *error);

#endif
