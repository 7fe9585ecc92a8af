/* bake_energy.c - the balance of a lamp's light.
 *
 * 1. Without bulbs: a small bake of the pages. What is left is given by other things that glow,
 *    whose flux is not known unless Canned_Glow tells it.
 * 2. Around the pages (bake_planes.h): their rectangles in a window twice as wide, where most of
 *    what they miss goes, and in a far wider one, whose outermost directions stand for all beyond;
 *    and wider rectangles in the same planes, with the sides of the box around all pages that have
 *    no page. A ray that passes through no page is missed; the last rectangle that it passes counts
 *    it, or else such a side, or else the last wider one.
 * Both run beside the bake.
 * 3. After it: the flux of its pages, over that of the sources.
 *
 * The projected solid angle of a rectangle of slopes, seen from its corner, is in closed form that
 * of Lambert's formula for a rectangle. */
#include "bake/bake_energy.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "slab/flux_box.h"
#include "slab/plane.h"

/* Positions and directions along an axis of the small bake without bulbs. */
enum { DARK_POSITIONS = 8, DARK_DIRECTIONS = 16 };
static const double very_far = 1e6;

/* Parts of a lamp's light that are told, and what a balance may be off without a warning. */
static const double negligible = 0.005, most_missed = 0.01, most_gained = 0.02;

static double luminance(const double rgb[3]) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/* ---- 1. Without bulbs ---- */

static enum result start_dark(const struct bake_work *work, struct bake_energy_bakes *bakes,
                              struct error *error) {
  static const int samples[SLAB_AXES] = {DARK_POSITIONS, DARK_POSITIONS, DARK_DIRECTIONS,
                                         DARK_DIRECTIONS};
  struct bake_work dark = *work;
  struct effects effects = *work->look.effects;
  if (!work->lamp->bulbs) return RESULT_OK;
  effects.setting[CAUSTICS] = 0; /* there is nothing to shoot photons */
  dark.look.dark = true;
  return probe_bake_start(&dark, work->slabs, &effects, samples, 1, &bakes->dark, error);
}

/* ---- 2. Around the pages ---- */

/* The integral of 1/(1 + x^2 + y^2)^2 from 0 to x and y. */
static double corner_angle(double x, double y) {
  double a = sqrt(1 + x * x), b = sqrt(1 + y * y);
  return 0.5 * (x / a * atan(y / a) + y / b * atan(x / b));
}

/* A ray of a plane: where it was shot in the cell of its sample, in grid coordinates and in lamp
 * space, and the projected solid angle that it stands for. */
struct ray {
  double abst[SLAB_AXES], point[3], direction[3], angle;
};

/* Where cells are `endless`, the outermost go on for ever. Within a cell the kernel is that of the
 * ray, since radiance and kernel often fall together. */
static double ray_angle(const struct slab *slab, const int at[SLAB_AXES], const double slope[2],
                        bool endless) {
  double edge[2][2], r = 1 + slope[0] * slope[0] + slope[1] * slope[1];
  bool outermost = false;
  for (int k = 0; k < 2; ++k) {
    int axis = SLAB_S + k, last = slab->samples[axis] - 1;
    double half = slab_spacing(slab, axis) / 2;
    double middle = slab_position(slab, axis, at[axis]) -
                    slab_kappa(slab) * slab_position(slab, SLAB_U + k, at[SLAB_U + k]);
    outermost |= at[axis] == 0 || at[axis] == last;
    edge[k][0] = at[axis] == 0 ? -very_far : middle - half;
    edge[k][1] = at[axis] == last ? very_far : middle + half;
  }
  if (!outermost || !endless)
    return slab_spacing(slab, SLAB_S) * slab_spacing(slab, SLAB_T) / (r * r);
  return corner_angle(edge[0][1], edge[1][1]) - corner_angle(edge[0][0], edge[1][1]) -
         corner_angle(edge[0][1], edge[1][0]) + corner_angle(edge[0][0], edge[1][0]);
}

/* `number` is the plane's among those of the small bake. */
static struct ray ray_of(const struct slab *slab, int number, bool endless,
                         const int at[SLAB_AXES]) {
  const int *n = slab->samples;
  const struct bake_box view = {number, {at[SLAB_U], at[SLAB_V]}, {1, 1, n[SLAB_S], n[SLAB_T]}};
  double offset[SLAB_AXES], slope[2];
  struct ray ray;
  bake_offset(BAKE_OWN, &view, 0, offset);
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    ray.abst[axis] = slab_position(slab, axis, at[axis]) + offset[axis] * slab_spacing(slab, axis);
  for (int k = 0; k < 2; ++k)
    slope[k] = ray.abst[SLAB_S + k] - slab_kappa(slab) * ray.abst[SLAB_U + k];
  ray.angle = ray_angle(slab, at, slope, endless);
  double u = plane_edge(slab, SLAB_U), v = plane_edge(slab, SLAB_V);
  for (int c = 0; c < 3; ++c) {
    ray.point[c] = slab->center[c] + ray.abst[0] * slab->u[c] / u + ray.abst[1] * slab->v[c] / v;
    ray.direction[c] = slab->normal[c] + slope[0] * slab->u[c] / u + slope[1] * slab->v[c] / v;
  }
  return ray;
}

static bool passes(const struct slab *plane, const struct ray *ray, double *ahead) {
  return flux_box_leaves(plane, ray->point, ray->direction, ahead);
}

/* Whether a ray of plane number `plane` is missed and counts there. */
static bool is_missed(const struct bake_planes *planes, int plane, const struct ray *ray) {
  double ahead;
  int count = planes->count, self = plane % count;
  enum bake_planes_kind kind =
      (enum bake_planes_kind)(plane < PLANES_SIDE * count ? plane / count : PLANES_SIDE);
  if (kind == PLANES_FAR && passes(&planes->baked[self], ray, &ahead)) return false;
  for (int n = 0; n < count; ++n) {
    const struct slab *rectangle = &planes->open[n];
    if (passes(&planes->pages[n], ray, &ahead)) return false;
    if (passes(rectangle, ray, &ahead) && (kind >= PLANES_WIDE || (n != self && ahead > 0)))
      return false;
  }
  for (int n = (int)kind * count; kind >= PLANES_WIDE && n < PLANES_SIDE * count + planes->sides;
       ++n) {
    bool first = kind == PLANES_WIDE && n >= PLANES_SIDE * count;
    if (n != plane && passes(&planes->open[n], ray, &ahead) && (first || ahead > 0)) return false;
  }
  return true;
}

static void add_plane(const struct bake_planes *planes, const struct slab *slab, int self,
                      double missed[3]) {
  double area = slab_spacing(slab, SLAB_U) * slab_spacing(slab, SLAB_V);
  for (size_t n = 0; n < slab_sample_count(slab); ++n) {
    int at[SLAB_AXES];
    const float *rgb = slab->rgb + 3 * n;
    if (rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0) continue;
    slab_locate(slab, n, at);
    const struct ray ray = ray_of(slab, self, self >= planes->count, at);
    if (!is_missed(planes, self, &ray)) continue;
    for (int c = 0; c < 3; ++c) missed[c] += area * ray.angle * (double)rgb[c];
  }
}

static enum result start_around(const struct bake_work *work, struct bake_energy_bakes *bakes,
                                struct error *error) {
  struct bake_work around = *work;
  enum result result = bake_planes_make(work, &bakes->planes, error);
  if (result != RESULT_OK) return result;
  bakes->lamp = *work->lamp;
  bakes->lamp.slab_count = PLANES_SIDE * work->lamp->slab_count + bakes->planes.sides;
  around.lamp = &bakes->lamp;
  return probe_bake_start(&around, bakes->planes.baked, work->look.effects, NULL, 1, &bakes->around,
                          error);
}

static void add_planes(const struct bake_energy_bakes *bakes, struct bake_energy *energy) {
  for (int n = 0; n < bakes->around.count; ++n)
    add_plane(&bakes->planes, &bakes->around.pages[n], n,
              n < PLANES_WIDE * bakes->planes.count ? energy->window : energy->beside);
}

/* ---- Both ---- */

enum result bake_energy_start(const struct bake_work *work, struct bake_energy_bakes *bakes,
                              struct error *error) {
  *bakes = (struct bake_energy_bakes){0};
  enum result result = start_dark(work, bakes, error);
  return result == RESULT_OK ? start_around(work, bakes, error) : result;
}

void bake_energy_free(struct bake_energy_bakes *bakes) {
  probe_bake_free(&bakes->dark);
  probe_bake_free(&bakes->around);
  bake_planes_free(&bakes->planes);
}

/* ---- 3. The balance ---- */

/* Why the efficiency is not known, or NULL. */
static const char *unknown(const struct bake_work *work, const struct bake_energy *energy) {
  const struct lamp *lamp = work->lamp;
  if (luminance(energy->sources) <= 0)
    return "nothing in the script tells the flux of its light (Canned_Bulb, Canned_Glow)";
  bool glows = luminance(energy->dark) > negligible * luminance(energy->pages);
  if ((glows || lamp->lights) && luminance(lamp->glow_flux) <= 0)
    return "there is more light than Canned_Bulb's, and Canned_Glow does not tell its flux";
  if (lamp->all_lights - lamp->lights != lamp->bulbs)
    return "POV-Ray does not count a light for each call of Canned_Bulb: one is in an object that "
           "is there several times, or never, or in a light_group";
  return NULL;
}

/* Without the exponent that %.2g gives 100. */
static const char *two_digits(double value, char text[16]) {
  snprintf(text, 16, value < 9.95 ? "%.2g" : "%.0f", value);
  return text;
}

static void say(const struct bake_work *work, const char *why, double noise,
                struct bake_energy *energy) {
  const struct slab *page = &work->slabs[0];
  const char *unit = slab_flux_unit(page);
  double metres2 = page->metres_per_unit * page->metres_per_unit;
  char *line = energy->line, share[32] = "";
  if (luminance(energy->dark) > negligible * luminance(energy->pages))
    snprintf(share, sizeof share, " (%.3g %% not of bulbs)",
             100 * luminance(energy->dark) / luminance(energy->pages));
  char known[40] = "", digits[16];
  if (noise > 0.003)
    snprintf(known, sizeof known, " (known to %s %% of that)", two_digits(300 * noise, digits));
  if (isnan(noise)) strcpy(known, " (not known how well)");
  if (why)
    snprintf(line, BAKE_ENERGY_LINE, "%.4g %s leaves through the pages%s; efficiency not known: %s",
             metres2 * luminance(energy->pages), unit, share, why);
  else
    snprintf(
        line, BAKE_ENERGY_LINE,
        "of %.4g %s that the sources give, %.4g leaves through the pages%s: efficiency %.3g %%%s",
        metres2 * luminance(energy->sources), unit, metres2 * luminance(energy->pages), share,
        100 * energy->efficiency, known);
}

/* More light than its sources give, in any channel. Of a lamp in which something else glows, the
 * light of its bulbs alone is looked at. */
static double gain(const struct bake_work *work, const struct bake_energy *energy, bool known) {
  double most = 0;
  for (int c = 0; c < 3; ++c) {
    double given = known ? energy->sources[c] : work->lamp->bulb_flux[c];
    double leaves = energy->pages[c] - (known ? 0 : energy->dark[c]);
    if (given > 0) most = fmax(most, leaves / given);
  }
  return most;
}

static void warn(const struct bake_work *work, const struct bake_energy *energy, bool known,
                 double noise, struct warnings *warnings) {
  double gained = gain(work, energy, known);
  double window = luminance(energy->window), beside = luminance(energy->beside);
  char text[3][16];
  double percent = 100 * energy->missed / (window + beside);
  if (gained > 1 + most_gained + 3 * noise)
    warnings_add(
        warnings, "%.3g times as much light leaves the lamp as its bulbs give%s", gained,
        work->look.effects->setting[CAUSTICS]
            ? "; POV-Ray shows photons through a translucent surface (diffuse with two numbers) up "
              "to ten times too bright: leave caustics out of --effects"
            : "; a surface may give back more than it gets (pigment, diffuse, reflection above 1 "
              "together), or a Canned_Bulb may be in an object that is there several times");
  if (energy->missed > most_missed)
    warnings_add(warnings,
                 "the pages miss %s %% of the light: %s %% leaves beyond their windows, %s %% "
                 "beside them; %s",
                 two_digits(100 * energy->missed, text[0]), two_digits(percent * window, text[1]),
                 two_digits(percent * beside, text[2]),
                 beside > window ? "enlarge the rectangles in Canned_Slab, or add pages"
                 : work->options->window == BAKE_WINDOW_AUTO
                     ? "enlarge the windows in Canned_Slab"
                     : "enlarge the windows in Canned_Slab, or bake with --window auto");
}

enum result bake_energy_cost(const struct bake_work *work, int *bakes, double *rays,
                             struct error *error) {
  struct bake_planes planes;
  enum result result = bake_planes_make(work, &planes, error);
  *bakes = work->lamp->bulbs ? 2 : 1;
  *rays = work->lamp->bulbs ? work->lamp->slab_count * pow(DARK_POSITIONS * DARK_DIRECTIONS, 2) : 0;
  for (int n = 0; n < PLANES_SIDE * planes.count + planes.sides && result == RESULT_OK; ++n)
    *rays += (double)slab_sample_count(&planes.baked[n]);
  bake_planes_free(&planes);
  return result;
}

enum result bake_energy(const struct bake_work *work, const struct slab *pages, int count,
                        const struct bake_noise *noise, struct bake_energy_bakes *bakes,
                        struct bake_energy *energy, struct bake_report *report,
                        struct error *error) {
  const struct lamp *lamp = work->lamp;
  *energy = (struct bake_energy){.efficiency = NAN};
  for (int c = 0; c < 3; ++c) energy->sources[c] = lamp->bulb_flux[c] + lamp->glow_flux[c];
  enum result result = flux_box_lamp(pages, count, energy->pages, error);
  if (result == RESULT_OK) result = probe_bake_wait(&bakes->dark, report, error);
  if (result == RESULT_OK && bakes->dark.count)
    result = flux_box_lamp(bakes->dark.pages, bakes->dark.count, energy->dark, error);
  if (result != RESULT_OK) return result;
  result = probe_bake_wait(&bakes->around, report, error);
  if (result == RESULT_OK) add_planes(bakes, energy);
  double missed = luminance(energy->window) + luminance(energy->beside);
  double all = luminance(energy->pages) + missed;
  energy->missed = all > 0 ? missed / all : 0;
  if (result == RESULT_BAD) energy->missed = NAN; /* what is beside a lamp may be too bright */
  if (result != RESULT_OK && result != RESULT_BAD) return result;
  double flux_noise = isnan(noise->flux) ? 0 : noise->flux;
  const char *why = unknown(work, energy);
  if (!why) energy->efficiency = luminance(energy->pages) / luminance(energy->sources);
  say(work, why, noise->flux, energy);
  memcpy(report->energy, energy->line, sizeof energy->line);
  warn(work, energy, !why, flux_noise, &report->warnings);
  return RESULT_OK;
}
