/* paper.h - the published algorithm, kept as the baseline (section 4.1, equations 2 and 3):
 * one uniform random sample in each visible micro light, quadrilinear interpolation and
 * kernel in scalar double precision, the cosine clamped at the tangent plane. */
#ifndef PAPER_H
#define PAPER_H

#include "cells.h"

/* Adds the light of all micro lights. `seed` makes the samples: same seed, same samples. */
void paper_sum(const struct view *view, const struct strips strips[2], uint64_t seed,
               double irradiance[3], double gloss[3], struct cells_counts *counts);

#endif
