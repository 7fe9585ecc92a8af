/* gl.c - the method gl beside the sum over views (numerics.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "numerics.h"

static const double allowed = 1e-5, holds = 1e-3, tolerance = 1e-3;

bool gl_is_here(const char **why) {
  static struct error error;
  static bool asked, here;
  if (!asked) {
    struct gl_context *context = NULL;
    here = gl_context_create(&context, &error) == RESULT_OK;
    gl_context_free(context);
    asked = true;
  }
  if (why) *why = error.text;
  return here;
}

/* Lengths of 1e-15 to 1e15 it must take. */
static bool must_take(const struct slab *slab) {
  double u = vector_length(slab->u), v = vector_length(slab->v);
  return fmin(u, v) > 1.01e-15 && fmax(u, v) < 0.99e15;
}

bool lamp_sum_gl(struct lamp *lamp, const struct surfel *from, double rgb[3]) {
  struct error error = {{0}};
  const struct gl_sum_settings settings = {.lights = &lamp->light, .light_count = 1};
  const struct receiver receiver = receiver_at(from);
  struct gathered got;
  if (!gl_is_here(NULL)) return false;
  if (!lamp->gl && gl_gather_create(&settings, &lamp->gl, &error) != RESULT_OK) {
    if (must_take(&lamp->slab) || !strstr(error.text, "takes lengths of 1e-15 to 1e+15;"))
      fail_msg("%s", error.text);
    return false;
  }
  if (gl_gather_light(lamp->gl, &receiver, 1, &got, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  memcpy(rgb, got.irradiance, sizeof got.irradiance);
  return true;
}

bool lamp_sum_any(struct lamp *lamp, int method, const struct surfel *receiver, double rgb[3]) {
  struct gathered got;
  if (method == GATHER_GL) return lamp_sum_gl(lamp, receiver, rgb);
  lamp_sum(lamp, (enum gather_method)method, tolerance, receiver, &got, NULL);
  memcpy(rgb, got.irradiance, sizeof got.irradiance);
  return true;
}

/* Sums over the views: of the light, of its amount, of what roundings can change. */
struct views {
  double sum[3], most, spread;
};

static struct views sum_views(const struct slab *slab, const struct surfel *receiver) {
  struct oracle_place place;
  long double sum[3] = {0}, most[3] = {0}, spread[3] = {0}, light[3], change[3];
  struct views views = {{0}, 0, 0};
  oracle_place(slab, receiver->p, receiver->n, &place);
  for (int j = 0; j < slab->samples[SLAB_V]; ++j)
    for (int i = 0; i < slab->samples[SLAB_U]; ++i) {
      oracle_view(slab, &place, i, j, light, change);
      for (int c = 0; c < 3; ++c) {
        sum[c] += light[c];
        most[c] += fabsl(light[c]);
        spread[c] += change[c];
      }
    }
  for (int c = 0; c < 3; ++c) {
    views.sum[c] = (double)sum[c];
    views.most = larger(views.most, (double)most[c]);
    views.spread = larger(views.spread, (double)spread[c]);
  }
  return views;
}

/* What is allowed, relative to the light. */
static double find_allowed(const struct lamp *lamp, const struct views *views, double *most) {
  if (isnan(views->most + views->spread)) fail_msg("the sum over views has no number");
  *most = fmax(fmax(views->most, NUMERICS_DARK * lamp->hemisphere), 1e-300);
  return views->spread <= holds * *most && isfinite(*most) ? allowed + views->spread / *most
                                                           : INFINITY;
}

double gl_allowed(const struct lamp *lamp, const struct surfel *receiver) {
  const struct views views = sum_views(&lamp->slab, receiver);
  double most;
  return find_allowed(lamp, &views, &most);
}

double gl_error(struct lamp *lamp, const struct surfel *receiver) {
  const struct views views = sum_views(&lamp->slab, receiver);
  double rgb[3], off = 0, most;
  if (isinf(find_allowed(lamp, &views, &most)) || !lamp_sum_gl(lamp, receiver, rgb)) return 0;
  for (int c = 0; c < 3; ++c) off = larger(off, fabs(rgb[c] - views.sum[c]));
  return off / most;
}

static void hold(struct trial *trial, const struct lamp *lamp, enum gather_method method,
                 const struct views *views, const double rgb[3]) {
  double off = 0, most;
  const double may = find_allowed(lamp, views, &most);
  bool never = false;
  for (int c = 0; c < 3; ++c) {
    if (!isfinite(rgb[c]) || (rgb[c] < 0 && lamp->positive)) never = true;
    off = larger(off, fabs(rgb[c] - views->sum[c]));
  }
  trial_note(trial, method, never ? NAN : isinf(may) ? 0 : off / most, may);
  if (trial->verbose)
    printf("  %-12s %.17g %.17g %.17g for views' %.17g %.17g %.17g; floats can change %.3g of it\n",
           gather_methods[method].name, rgb[0], rgb[1], rgb[2], views->sum[0], views->sum[1],
           views->sum[2], views->spread / most);
}

void trial_hold_views(struct trial *trial, struct lamp *lamp, const struct surfel *receiver) {
  const struct views views = sum_views(&lamp->slab, receiver);
  double rgb[3];
  lamp_sum_any(lamp, GATHER_VIEWS, receiver, rgb);
  hold(trial, lamp, GATHER_VIEWS, &views, rgb);
  if (lamp_sum_gl(lamp, receiver, rgb)) hold(trial, lamp, GATHER_GL, &views, rgb);
}
