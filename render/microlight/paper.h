/* paper.h - the published algorithm, kept as the baseline (section 4.1, equations 2 and 3):
 * one uniform random sample in each visible micro light, quadrilinear interpolation and
 * kernel in scalar double precision, the cosine clamped at the tangent plane. */
#ifndef PAPER_H
#define PAPER_H

#include "microlight/row_sum.h"

/* Adds the light of all micro lights. `fine` is the page whose samples are read: the view's, or
 * the one of which the view's page is a level (levels.h): then each value is the mean of the
 * samples that it stands for, averaged on the fly as published (section 4.2). `seed` makes the
 * samples: same seed, same samples. */
void paper_sum(const struct seen_page *seen, const struct light_page *fine,
               const struct strips strips[2], uint64_t seed, double irradiance[3], double gloss[3],
               struct gather_counts *counts);

#endif
