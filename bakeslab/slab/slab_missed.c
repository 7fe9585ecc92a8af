#include "slab/slab_missed.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "slab/plane.h"
#include "slab/slab_profile.h"

/* |L| of the last samples at one end of s or t, times the projected solid angle beyond them. The
 * integral of 1/(1 + x^2 + y^2)^2 from x on is in closed form, by y it is a sum over samples. */
static double beyond(const struct slab *slab, int axis, int end) {
  int other = axis == SLAB_S ? SLAB_T : SLAB_S, at[SLAB_AXES];
  double sum = 0, sign = end ? 1 : -1, kappa = slab_kappa(slab);
  double area = slab_spacing(slab, SLAB_U) * slab_spacing(slab, SLAB_V);
  for (size_t n = 0; n < slab_sample_count(slab); ++n) {
    slab_locate(slab, n, at);
    if (at[axis] != (end ? slab->samples[axis] - 1 : 0)) continue;
    double x = sign * (slab->st_window[2 * (axis - SLAB_S) + end] -
                       kappa * slab_position(slab, axis - SLAB_S, at[axis - SLAB_S]));
    double y = slab_position(slab, other, at[other]) -
               kappa * slab_position(slab, other - SLAB_S, at[other - SLAB_S]);
    double q = 1 + y * y, angle = atan2(sqrt(q), x) / (2 * q * sqrt(q)) - x / (2 * q * (q + x * x));
    const float *rgb = slab->rgb + 3 * n;
    sum += (fabs((double)rgb[0]) + fabs((double)rgb[1]) + fabs((double)rgb[2])) * angle;
  }
  return sum * area * slab_spacing(slab, other);
}

/* Whether the middle of a rectangle's edge lies on another page, where light goes on. */
static bool goes_on(const struct slab *page, int axis, int end, const struct slab *other) {
  double point[3], away = 0, along[2] = {0, 0}, small = 1e-3 * plane_width(page);
  const double *edge = axis == SLAB_U ? page->u : page->v;
  for (int c = 0; c < 3; ++c) point[c] = page->center[c] + (end ? 0.5 : -0.5) * edge[c];
  for (int c = 0; c < 3; ++c) {
    away += (point[c] - other->center[c]) * other->normal[c];
    along[0] += (point[c] - other->center[c]) * other->u[c] / plane_edge(other, SLAB_U);
    along[1] += (point[c] - other->center[c]) * other->v[c] / plane_edge(other, SLAB_V);
  }
  return fabs(away) <= small && fabs(along[0]) <= plane_edge(other, SLAB_U) / 2 + small &&
         fabs(along[1]) <= plane_edge(other, SLAB_V) / 2 + small;
}

enum result slab_missed_add(const struct slab *page, int number, int count,
                            const struct slab *(*pages)(const void *of, int n), const void *of,
                            struct slab_missed *missed, struct error *error) {
  struct slab_profile profile;
  double flux[3];
  enum result result = slab_profile(page, &profile, error);
  if (result == RESULT_OK) result = slab_flux(page, flux, error);
  for (int c = 0; c < 3 && result == RESULT_OK; ++c) missed->flux += fabs(flux[c]);
  for (int k = 0; k < 2 * SLAB_AXES && result == RESULT_OK; ++k) {
    int axis = k / 2, end = k % 2;
    bool shared = false;
    if (slab_profile_cut_off(&profile, axis, end) == 0) continue;
    for (int n = 0; axis < SLAB_S && n < count; ++n)
      shared |= n != number && slab_same_channel(page, pages(of, n)) &&
                goes_on(page, axis, end, pages(of, n));
    if (shared) continue;
    if (axis >= SLAB_S) missed->beyond += beyond(page, axis, end);
    size_t used = strlen(missed->where);
    snprintf(missed->where + used, sizeof missed->where - used, "%spage %d %s %c", used ? ", " : "",
             number + 1, end ? "high" : "low", "uvst"[axis]);
  }
  slab_profile_free(&profile);
  return result;
}
