/* ray_range.h - where along an axis rays carry their light. */
#ifndef RAY_RANGE_H
#define RAY_RANGE_H

#include <stddef.h>

struct ray_weighed {
  double value, flux;
};

/* The range of all values, and a little more; or, where that is `much_longer` times as long, of the
 * values without the part `negligible` of the flux at each end: a few rays graze an aperture, or
 * come from far beside the lamp. Even about 0 where it is nearly so. There is at least one value;
 * they are sorted. */
void ray_range(struct ray_weighed *values, size_t count, double negligible, double much_longer,
               double range[2]);

#endif
