#include "import/rays/ray_look.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum result ray_look_new(struct ray_look *look, size_t room, struct error *error) {
  *look = (struct ray_look){.every = 1,
                            .room = room,
                            .low = {INFINITY, INFINITY, INFINITY},
                            .high = {-INFINITY, -INFINITY, -INFINITY},
                            .kept = malloc(room * sizeof *look->kept)};
  return look->kept ? RESULT_OK : result_no_memory(error);
}

void ray_look_free(struct ray_look *look) {
  free(look->kept);
  *look = (struct ray_look){0};
}

/* Keeps a ray; where there is no room, every other one goes. */
static void keep(struct ray_look *look, const struct ray *ray) {
  if (look->rays & (look->every - 1)) return;
  if (look->kept_count == look->room) {
    look->kept_count /= 2;
    for (size_t n = 0; n < look->kept_count; ++n) look->kept[n] = look->kept[2 * n];
    look->every *= 2;
    if (look->rays & (look->every - 1)) return;
  }
  look->kept[look->kept_count++] = *ray;
}

void ray_look_add(struct ray_look *look, const struct ray *rays, size_t count) {
  for (size_t n = 0; n < count; ++n) {
    const struct ray *ray = &rays[n];
    const double *d = ray->direction, *o = ray->origin;
    double flux = ray_luminance(ray->flux), along = d[0] * o[0] + d[1] * o[1] + d[2] * o[2];
    if (!(flux > 0)) continue;
    keep(look, ray);
    ++look->rays;
    for (int c = 0; c < 3; ++c) {
      look->flux[c] += ray->flux[c];
      look->low[c] = o[c] < look->low[c] ? o[c] : look->low[c];
      look->high[c] = o[c] > look->high[c] ? o[c] : look->high[c];
      look->direction[c] += flux * d[c];
      look->lines[c] += flux * (1 - d[c] * d[c]);
      look->lines[3 + c] -= flux * d[c] * d[(c + 1) % 3];
      look->sum[c] += flux * (o[c] - along * d[c]);
    }
  }
}

/* Solves A x = sum, A being the sum of flux (1 - d d^T): its diagonal is lines[0..2], and
 * lines[3 + c] stands in row c and column c + 1. */
bool ray_look_focus(const struct ray_look *look, double focus[3]) {
  const double *a = look->lines, *b = look->sum;
  const double m[3][3] = {{a[0], a[3], a[5]}, {a[3], a[1], a[4]}, {a[5], a[4], a[2]}};
  double adjugate[3][3], trace = a[0] + a[1] + a[2], determinant = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      adjugate[c][r] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    }
  for (int c = 0; c < 3; ++c) determinant += m[0][c] * adjugate[c][0];
  if (!(determinant > 1e-12 * trace * trace * trace)) return false;
  for (int r = 0; r < 3; ++r)
    focus[r] =
        (adjugate[r][0] * b[0] + adjugate[r][1] * b[1] + adjugate[r][2] * b[2]) / determinant;
  return true;
}
