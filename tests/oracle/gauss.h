/* gauss.h - Gauss-Legendre quadrature on (-1, 1) in long double. */
#ifndef GAUSS_H
#define GAUSS_H

enum { GAUSS_MOST = 64 };

struct gauss {
  int count;
  long double x[GAUSS_MOST], w[GAUSS_MOST];
};

/* The rule of n nodes, 1 to GAUSS_MOST, which integrates polynomials of degree 2n - 1 exactly.
 * It stays; not for several threads. */
const struct gauss *gauss_rule(int n);

#endif
