/* random.h - the random numbers of the tests, the same on every machine: SplitMix64 (Steele, Lea
 * and Flood, "Fast splittable pseudorandom number generators", 2014). The seed is the state. */
#ifndef RANDOM_H
#define RANDOM_H

#include <stdint.h>

uint64_t random_bits(uint64_t *seed);
double random_number(uint64_t *seed);                           /* in [0, 1) */
double random_between(uint64_t *seed, double low, double high); /* evenly */
double random_log(uint64_t *seed, double low, double high);     /* evenly in the logarithm */
int random_choose(uint64_t *seed, int count);                   /* 0 to count - 1 */

/* A unit vector, uniform on the sphere. */
void random_direction(uint64_t *seed, double direction[3]);

/* Three unit vectors perpendicular to each other, turned at random; the sign of their triple
 * product is that of `hand`, or either where it is 0. */
void random_frame(uint64_t *seed, int hand, double frame[3][3]);

#endif
