/* costs.h - what batches cost, by measured ones: a table that measure.sh prints, with a line
 * "LAMP KIND BAKE ROUND RAYS CAMERAS SECONDS" for each batch (KIND: interreflection, caustics or
 * none; BAKE: batches of one were rendered together), and lines
 * "LAMP KIND start|join|read|plan|finish SECONDS" of what else a process does.
 *
 * A batch takes a + b * (rays + 256 * cameras) seconds, by least squares over batches of the first
 * round; one of the last round a multiple of it, by a bake of both. What is left over is how unlike
 * batches are. */
#ifndef COSTS_H
#define COSTS_H

#include <stdbool.h>
#include <stddef.h>

enum { COSTS_NAME = 32 };

struct costs {
  char lamp[COSTS_NAME], kind[COSTS_NAME];
  double process, ray;             /* a and b */
  double last;                     /* the multiple */
  double start;                    /* of POV-Ray, before it counts; seconds */
  double join, read, plan, finish; /* farm.h; plan for each sample */
  double *spread;                  /* [spread_count]: batches over what the fit says; owned */
  size_t spread_count;
};

/* Reads all of a lamp. Returns false, having said why, where it cannot. */
bool costs_read(const char *path, const char *lamp, struct costs *costs);
void costs_free(struct costs *costs);

/* Seconds of the n-th batch of a round. */
double costs_batch(const struct costs *costs, bool last, double rays, double cameras, size_t n);

#endif
