/* helpers.h - what the tests of renderslab share: rough slabs in any
 * frame, receivers that see something of them, the program run as a
 * user runs it, and the library's sums. */
#ifndef HELPERS_H
#define HELPERS_H

#include "file/slab_file.h"
#include "gather/gather.h"
#include "oracle/random.h"
#include "testing.h"

enum { COUNT_MAX = 4096 }; /* receivers in one run */

/* An element of a surface, in lamp space: position and unit normal. */
struct surfel {
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

/* A slab with samples; the caller frees it. `distance` may be INFINITY. */
struct slab rough_slab(const int samples[SLAB_AXES], double distance, const double window[4],
                       enum frame frame, enum fill fill, uint64_t seed);
/* Fills the samples anew. */
void fill_slab(struct slab *slab, enum fill fill, uint64_t seed);

/* The point that is (a, b) along the unit edges and z along the normal. */
void slab_point(const struct slab *slab, double a, double b, double z, double p[3]);

/* A receiver at height z that lies on a ray of the slab: through any point of the aperture,
 * through the window or a tenth of its size beside it. */
struct surfel aimed_receiver(const struct slab *slab, double z, enum receiver_kind kind,
                             uint64_t *seed);
/* Many, at heights evenly in the logarithm; RECEIVER_KINDS: of each kind in turn. */
void aim(const struct slab *slab, const double z[2], enum receiver_kind kind, uint64_t *seed,
         struct surfel *receivers, int count);

/* Writes float samples; fails the test where it cannot. Name as scratch's. */
const char *write_light(const char *name, const struct slab *slabs, int count);

/* Runs `renderslab irradiance` with `arguments` (shell words, as printf) and
 * the receivers on its standard input. Fails the test unless it exits with 0
 * and prints one line of three finite numbers for each. */
void irradiance(const struct surfel *receivers, int count, double rgb[][3], const char *arguments,
                ...) __attribute__((format(printf, 4, 5)));

/* Root mean square of a - b over that of b. */
double relative_rms(double (*a)[3], double (*b)[3], int count);

/* The slabs as the program loads them, the caller frees it; and the program's receiver. */
struct light load_light(const struct slab *slabs, int count);
struct receiver receiver_at(const struct surfel *at);

/* The library's sums, with how much work they were; fails the test where it cannot. */
struct gather_counts sum_light(const struct gather_settings *settings,
                               const struct receiver *receivers, int count,
                               struct gathered *gathered);

#endif
