/* nnls.c - Cholesky's factorisation; Lawson and Hanson's active set. */
#include "include/cluster/nnls.h"

#include <math.h>

bool nnls_cholesky(int n, double *a, double *b) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = a[i * n + j];
      const double *x = a + i * n, *y = a + j * n;
      for (int k = 0; k < j; ++k) sum -= x[k] * y[k];
      if (i == j && !(sum > 0)) return false;
      a[i * n + j] = i == j ? sqrt(sum) : sum / a[j * n + j];
    }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
  return true;
}

/* The unconstrained solution of the unknowns in use, with a whiff of damping. */
static bool solve_used(int n, const double *a, const double *b, const double *used, double *matrix,
                       double *solution) {
  int m = 0;
  for (int i = 0; i < n; ++i) m += used[i] > 0;
  int row = 0;
  for (int i = 0; i < n; ++i) {
    if (!(used[i] > 0)) continue;
    int column = 0;
    for (int j = 0; j <= i; ++j)
      if (used[j] > 0) matrix[row * m + column++] = a[i * n + j] * (i == j ? 1 + 1e-9 : 1);
    solution[row++] = b[i];
  }
  if (!nnls_cholesky(m, matrix, solution)) return false;
  for (int i = n - 1; i >= 0; --i) solution[i] = used[i] > 0 ? solution[--row] : 0;
  return true;
}

/* Moves x towards the solution as far as it stays positive; what becomes 0 falls
 * out of use. Whether all of the way was gone. */
static bool step_towards(int n, const double *solution, double *x, double *used) {
  double step = 1;
  for (int i = 0; i < n; ++i)
    if (used[i] > 0 && solution[i] <= 0) step = fmin(step, x[i] / (x[i] - solution[i]));
  for (int i = 0; i < n; ++i) {
    bool stops = used[i] > 0 && solution[i] <= 0 && x[i] / (x[i] - solution[i]) <= step;
    x[i] += step * (solution[i] - x[i]);
    if (stops) x[i] = used[i] = 0;
  }
  return step >= 1;
}

void nnls_solve(int n, const double *a, const double *b, double *x, double *scratch) {
  double *used = scratch, *solution = scratch + n, *tried = scratch + 2 * n;
  double *matrix = scratch + 4 * n;
  for (int i = 0; i < n; ++i) x[i] = used[i] = tried[i] = 0;
  for (int round = 0; round < 3 * n; ++round) {
    int best = -1;
    double steepest = 0;
    for (int i = 0; i < n; ++i) {
      double gradient = b[i];
      for (int j = 0; j < n; ++j) gradient -= a[i * n + j] * x[j];
      if (used[i] > 0 || tried[i] > 0 || !(gradient > 1e-12 * fabs(b[i]))) continue;
      gradient /= sqrt(a[i * n + i]);
      if (gradient <= steepest) continue;
      steepest = gradient;
      best = i;
    }
    if (best < 0) return;
    used[best] = 1;
    for (int inner = 0; inner <= n; ++inner) {
      if (!solve_used(n, a, b, used, matrix, solution)) {
        used[best] = 0; /* it hardly differs from the others */
        break;
      }
      if (step_towards(n, solution, x, used)) break;
    }
    tried[best] = used[best] > 0 ? 0 : 1; /* no way in: not again */
  }
}
