/* helpers.h - what the tests of renderslab share: rough slabs in any
 * frame, receivers that see something of them, and the program run as a
 * user runs it. */
#ifndef HELPERS_H
#define HELPERS_H

#include "file/slab_file.h"
#include "testing.h"

enum { COUNT_MAX = 4096 }; /* receivers in one run */

struct receiver {
  double p[3], n[3];
};

enum receiver_kind {
  RECEIVER_FACING,  /* normal = -slab's normal */
  RECEIVER_GENERAL, /* sees the point it was made for */
  RECEIVER_CUT,     /* its tangent plane passes through a point of the aperture */
  RECEIVER_KINDS
};

enum fill {
  FILL_CONSTANT, /* 1 */
  FILL_UNIFORM,  /* 0..1 */
  FILL_EXTREME,  /* 0 or 2: as rough as it gets */
  FILL_SIGNED    /* -1..1 */
};

enum frame {
  FRAME_PLAIN,   /* u = x, v = y, n = z; at the origin; sides 1 and 1 */
  FRAME_TURNED,  /* any rotation, off the origin, two lengths */
  FRAME_MIRRORED /* the same with u x v = -n */
};

/* A number in [0, 1) from a seed; the same on every machine. */
double random_number(uint32_t *seed);
/* A unit vector, uniform on the sphere. */
void random_direction(uint32_t *seed, double direction[3]);

/* A slab with samples; the caller frees it. `distance` may be INFINITY. */
struct slab rough_slab(const int samples[SLAB_AXES], double distance, const double window[4],
                       enum frame frame, enum fill fill, uint32_t seed);
/* Fills the samples anew. */
void fill_slab(struct slab *slab, enum fill fill, uint32_t seed);

/* The point that is (a, b) along the unit edges and z along the normal. */
void slab_point(const struct slab *slab, double a, double b, double z, double p[3]);

/* A receiver at height z that lies on a ray of the slab: through any point of the aperture,
 * through the window or a tenth of its size beside it. */
struct receiver aimed_receiver(const struct slab *slab, double z, enum receiver_kind kind,
                               uint32_t *seed);

/* Writes float samples; fails the test where it cannot. Name as scratch's. */
const char *write_light(const char *name, const struct slab *slabs, int count);

/* Skips the test where RENDERSLAB does not name a program. */
void need_program(void);

/* Runs `renderslab irradiance` with `arguments` (shell words, as printf) and
 * the receivers on its standard input. Fails the test unless it exits with 0
 * and prints one line of three finite numbers for each. */
void irradiance(const struct receiver *receivers, int count, double rgb[][3], const char *arguments,
                ...) __attribute__((format(printf, 4, 5)));

#endif
