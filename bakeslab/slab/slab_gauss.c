/* slab_gauss.c - nodes are the eigenvalues of the Jacobi matrix of the
 * orthogonal polynomials, weights the squares of the eigenvectors' first
 * components. */
#include "slab/slab_gauss.h"

#include <math.h>

/* Eigenvalues of the symmetric tridiagonal matrix with `diagonal` and
 * `off` (off[k] couples k and k + 1), and the first components of its
 * eigenvectors, by QL with implicit shifts. */
static void eigen(int n, double *diagonal, double *off, double *first) {
  for (int k = 0; k < n; ++k) first[k] = k == 0;
  off[n - 1] = 0;
  for (int l = 0; l < n; ++l)
    for (int sweep = 0; sweep < 60; ++sweep) {
      int m = l;
      while (m < n - 1 && fabs(off[m]) > 1e-17 * (fabs(diagonal[m]) + fabs(diagonal[m + 1]))) ++m;
      if (m == l) break;
      double g = (diagonal[l + 1] - diagonal[l]) / (2 * off[l]);
      g = diagonal[m] - diagonal[l] + off[l] / (g + copysign(hypot(g, 1), g));
      double sine = 1, cosine = 1, p = 0;
      for (int k = m - 1; k >= l; --k) {
        double f = sine * off[k], b = cosine * off[k];
        double r = hypot(f, g);
        off[k + 1] = r;
        if (r == 0) { /* split: the shift hit an eigenvalue */
          diagonal[k + 1] -= p;
          off[m] = 0;
          break;
        }
        sine = f / r;
        cosine = g / r;
        g = diagonal[k + 1] - p;
        r = (diagonal[k] - g) * sine + 2 * cosine * b;
        p = sine * r;
        diagonal[k + 1] = g + p;
        g = cosine * r - b;
        f = first[k + 1];
        first[k + 1] = sine * first[k] + cosine * f;
        first[k] = cosine * first[k] - sine * f;
        if (k == l) {
          diagonal[l] -= p;
          off[l] = g;
          off[m] = 0;
        }
      }
    }
}

void slab_gauss_legendre(int n, double *nodes, double *weights) {
  double off[SLAB_GAUSS_MAX];
  for (int k = 0; k < n; ++k) {
    nodes[k] = 0;
    off[k] = (k + 1) / sqrt(4.0 * (k + 1) * (k + 1) - 1);
  }
  eigen(n, nodes, off, weights);
  for (int k = 0; k < n; ++k) weights[k] = 2 * weights[k] * weights[k];
}

int slab_gauss_compress(int count, const double *x, const double *w, int n, double *nodes,
                        double *weights, double *scratch) {
  double total = 0, off[SLAB_GAUSS_MAX];
  for (int k = 0; k < count; ++k) total += w[k];
  if (!(total > 0)) return 0;
  if (n > count) n = count;
  /* Stieltjes: values of the last two monic polynomials at the points. */
  double *before = scratch, *here = scratch + count, norm = total, norm_before = 1;
  for (int k = 0; k < count; ++k) before[k] = 0, here[k] = 1;
  for (int degree = 0; degree < n; ++degree) {
    double mean = 0;
    for (int k = 0; k < count; ++k) mean += w[k] * x[k] * here[k] * here[k];
    nodes[degree] = mean / norm;
    double beta = degree ? norm / norm_before : 0, next_norm = 0;
    for (int k = 0; k < count; ++k) {
      double next = (x[k] - nodes[degree]) * here[k] - beta * before[k];
      before[k] = here[k];
      here[k] = next;
      next_norm += w[k] * next * next;
    }
    off[degree] = sqrt(next_norm / norm);
    norm_before = norm;
    norm = next_norm;
    if (!(norm > 0)) n = degree + 1;
  }
  eigen(n, nodes, off, weights);
  for (int k = 0; k < n; ++k) weights[k] = total * weights[k] * weights[k];
  return n;
}

int slab_gauss_order(double low, double high, double tolerance) {
  double middle = (low + high) / 2, half = (high - low) / 2;
  if (!(half > 0)) return 1;
  /* The ellipse with foci low and high that runs through the poles. */
  double s = (hypot(middle / half + 1, 1 / half) + hypot(middle / half - 1, 1 / half)) / 2;
  double rate = log(s + sqrt(s * s - 1));
  double order = ceil(-log(tolerance) / (2 * rate));
  return order < 1 ? 1 : order > 1000 ? 1000 : (int)order;
}
