/* ray_bins.h - sums of rays on a page's grid of 4D cells.
 *
 * A ray in four, at random, is held out: it is summed with the others, and once more alone, to
 * tell what an estimate by the others is worth. Flux is in the page's unit, lengths as in slab.h.
 * Memory: 16 bytes a cell (32 where coloured), whatever the number of rays. */
#ifndef RAY_BINS_H
#define RAY_BINS_H

#include "slab/slab.h"

struct ray_bins {
  struct slab page;                      /* geometry and grid; owned */
  int channels;                          /* luminance, or CIE X, Y and Z */
  int luminance;                         /* which channel that is */
  double low[SLAB_AXES], per[SLAB_AXES]; /* a cell's index along an axis is (x - low) * per */
  size_t step[SLAB_AXES];                /* of cells, in the order of slab->rgb's pixels */
  double *sums;   /* of each cell: flux by channel, then luminance of the rays held out; owned */
  double *blocks; /* of each block: flux and squared flux by channel; owned */
  unsigned char
      *block[SLAB_AXES]; /* of each cell of an axis: its block there; owned by the first */
  unsigned long long rays;
  double flux[3], square[3]; /* by channel: of all rays together; squared */
  double held;               /* luminance of those held out */
  int threads;               /* to estimate by; 1 unless it is set */
};

enum result ray_bins_new(const struct slab *page, bool coloured, struct ray_bins *bins,
                         struct error *error);
void ray_bins_free(struct ray_bins *bins);

/* As ray_estimate_expect and ray_estimate_add. */
void ray_bins_expect(const struct ray_bins *bins, const double abst[SLAB_AXES]);
bool ray_bins_add(struct ray_bins *bins, const double abst[SLAB_AXES], const double rgb[3]);

/* Whether each axis can be halved so often: its blocks (ray_bins.c) then stay whole. */
bool ray_bins_halves(const struct ray_bins *bins, const int halvings[SLAB_AXES]);

/* The same rays on a grid with 2^halvings[] times fewer cells along each axis. */
enum result ray_bins_coarser(const struct ray_bins *bins, const int halvings[SLAB_AXES],
                             struct ray_bins *coarser, struct error *error);

/* Flux that a ray carries where the cell is, on average weighted by flux: the variance of a sum of
 * rays over their expected flux. */
double ray_bins_quantum(const struct ray_bins *bins, size_t cell, int channel);

/* Fills count[] and exposure[] for the estimate of a channel, by all rays or by those not held out.
 * Either gives densities that stand for the flux of all. `etendue`: of each cell. */
void ray_bins_cells(const struct ray_bins *bins, const double *etendue, int channel, bool all,
                    float *count, float *exposure);

#endif
