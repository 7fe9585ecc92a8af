/* slab_gauss.h - Gauss quadrature rules, also for weights that are only known
 * as a sum of points (Golub and Welsch 1969; Stieltjes' procedure). */
#ifndef SLAB_GAUSS_H
#define SLAB_GAUSS_H

enum { SLAB_GAUSS_MAX = 24 };

/* The rule of n <= SLAB_GAUSS_MAX nodes on [-1, 1]; weights sum to 2. */
void slab_gauss_legendre(int n, double *nodes, double *weights);

/* Replaces `count` points x[] with weights w[] >= 0 by n nodes that integrate
 * polynomials up to degree 2n - 1 alike. Returns how many were needed: fewer
 * where the points are fewer. `scratch` has room for 2 count numbers. */
int slab_gauss_compress(int count, const double *x, const double *w, int n, double *nodes,
                        double *weights, double *scratch);

/* Nodes that Gauss's rule on [low, high] needs for a relative error of
 * `tolerance` in a function with its nearest poles at +-i. */
int slab_gauss_order(double low, double high, double tolerance);

#endif
