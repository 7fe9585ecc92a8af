/* lambert.c - closed forms of lambert.h, and two simple answers that the oracle is held against:
 * Lambert's polygon formula, and a midpoint sum (oracle.h). */
#include "oracle/lambert.h"

#include <math.h>

#include "oracle/gauss.h"
#include "oracle/lookup.h"
#include "oracle/oracle.h"

/* The integral over [0, x] x [0, y]. */
static long double corner(long double x, long double y) {
  long double cx = sqrtl(1 + x * x), cy = sqrtl(1 + y * y);
  return (x / cx * atanl(y / cx) + y / cy * atanl(x / cy)) / 2;
}

double lambert_window(const double w[4]) {
  return (double)(corner(w[1], w[3]) - corner(w[0], w[3]) - corner(w[1], w[2]) +
                  corner(w[0], w[2]));
}

double lambert_exchange(const double a[4], const double b[4], double apart) {
  const struct gauss *rule = gauss_rule(GAUSS_MOST);
  long double sum = 0, wide = ((long double)a[1] - a[0]) / 2, high = ((long double)a[3] - a[2]) / 2;
  for (int i = 0; i < rule->count; ++i)
    for (int j = 0; j < rule->count; ++j) {
      double at[2] = {(double)(a[0] + wide * (1 + rule->x[i])),
                      (double)(a[2] + high * (1 + rule->x[j]))},
             window[4];
      for (int k = 0; k < 4; ++k) window[k] = (b[k] - at[k / 2]) / apart;
      sum += rule->w[i] * rule->w[j] * lambert_window(window);
    }
  return (double)(sum * wide * high);
}

/* The visible interval of slopes along an axis. */
static void visible(const struct oracle_place *place, const double window[2], int axis,
                    long double x[2]) {
  long double height = place->p[2], lean = 1 - place->kappa * height;
  long double s = place->kappa * place->p[axis];
  x[0] = (-place->half[axis] - place->p[axis]) / height;
  x[1] = (place->half[axis] - place->p[axis]) / height;
  if (lean == 0) {
    if (s < (long double)window[0] || s > (long double)window[1]) x[1] = x[0];
    return;
  }
  long double a = (s - (long double)window[0]) / lean, b = (s - (long double)window[1]) / lean;
  x[0] = fmaxl(x[0], fminl(a, b));
  x[1] = fminl(x[1], fmaxl(a, b));
}

int lambert_clip(const long double from[][3], int count, const long double n[3],
                 long double to[][3]) {
  int kept = 0;
  for (int k = 0; k < count; ++k) {
    const long double *a = from[k], *b = from[(k + 1) % count];
    long double da = a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
    long double db = b[0] * n[0] + b[1] * n[1] + b[2] * n[2];
    if (da >= 0) {
      for (int c = 0; c < 3; ++c) to[kept][c] = a[c];
      ++kept;
    }
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      for (int c = 0; c < 3; ++c) to[kept][c] = a[c] + (b[c] - a[c]) * (da / (da - db));
      ++kept;
    }
  }
  return kept;
}

long double lambert_polygon(const long double corners[][3], int count, const long double n[3]) {
  long double sum = 0;
  for (int k = 0; k < count; ++k) {
    const long double *a = corners[k], *b = corners[(k + 1) % count];
    long double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0]};
    long double size = sqrtl(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    long double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if (size > 0)
      sum += atan2l(size, dot) / size * (cross[0] * n[0] + cross[1] * n[1] + cross[2] * n[2]);
  }
  return fabsl(sum) / 2;
}

long double oracle_lambert(const struct slab *slab, const double p[3], const double n[3]) {
  struct oracle_place place;
  long double x[2], y[2];
  oracle_place(slab, p, n, &place);
  visible(&place, slab->st_window, 0, x);
  visible(&place, slab->st_window + 2, 1, y);
  if (!(x[0] < x[1] && y[0] < y[1])) return 0;
  const long double whole[4][3] = {
      {x[0], y[0], -1}, {x[1], y[0], -1}, {x[1], y[1], -1}, {x[0], y[1], -1}};
  long double part[8][3];
  int count = lambert_clip(whole, 4, place.n, part);
  return lambert_polygon(part, count, place.n);
}

/* The power of the cosine between the normal and the half vector. */
static double highlight(const double to[3], const double n[3], const double eye[3],
                        double shininess) {
  double cosine = 0, square = 0;
  for (int c = 0; c < 3; ++c) {
    cosine += (to[c] + eye[c]) * n[c];
    square += (to[c] + eye[c]) * (to[c] + eye[c]);
  }
  return pow(fmax(cosine, 0) / sqrt(square), shininess);
}

void oracle_brute(const struct slab *slab, const double p[3], const double n[3],
                  const double eye[3], double shininess, int count, double rgb[3]) {
  struct oracle_place place, towards;
  oracle_place(slab, p, n, &place);
  oracle_place(slab, p, eye ? eye : n, &towards);
  double normal[3], seen[3], z = (double)place.p[2], kappa = (double)place.kappa;
  double edges[2] = {2 * (double)place.half[0], 2 * (double)place.half[1]};
  for (int c = 0; c < 3; ++c) {
    normal[c] = (double)place.n[c], seen[c] = (double)towards.n[c];
    rgb[c] = 0;
  }
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      double a = ((i + 0.5) / count - 0.5) * edges[0], b = ((j + 0.5) / count - 0.5) * edges[1];
      double to[3] = {a - (double)place.p[0], b - (double)place.p[1], -z}, colour[3];
      double square = to[0] * to[0] + to[1] * to[1] + z * z, r = sqrt(square);
      const double abst[4] = {a, b, kappa * a - to[0] / z, kappa * b - to[1] / z};
      for (int c = 0; c < 3; ++c) to[c] /= r;
      double weight = to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2];
      if (weight <= 0) continue;
      if (eye) weight = highlight(to, normal, seen, shininess);
      oracle_lookup(slab, abst, colour);
      weight *= z / (square * r) * edges[0] * edges[1] / count / count;
      for (int c = 0; c < 3; ++c) rgb[c] += weight * colour[c];
    }
}
