/* nnls.h - small dense least squares, from their normal equations. */
#ifndef NNLS_H
#define NNLS_H

#include <stdbool.h>

/* Solves A x = b for a symmetric positive definite A of n rows, of which only the
 * lower half is read and which becomes its Cholesky factor; b becomes x. False,
 * with b spoilt, where A is not positive definite. */
bool nnls_cholesky(int n, double *a, double *b);

/* The x >= 0 of least x'Ax/2 - b'x (Lawson and Hanson, "Solving Least Squares
 * Problems", 1974, chapter 23). `scratch` has room for n * (n + 4) numbers. */
void nnls_solve(int n, const double *a, const double *b, double *x, double *scratch);

#endif
