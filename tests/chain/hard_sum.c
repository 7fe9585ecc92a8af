/* hard_sum.c - see hard.h. Written from light-slab(5), POV-Ray's manual and the include's
 * comments alone. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

/* What counts as on an edge, as a share of the window's or the aperture's width. */
static const double edge = 1e-6;

/* Texels are multiples of this share of the peak where they are less than 6e-5 of it. */
static const double half_step = 6e-8;

/* POV-Ray drops what a light adds below this in every channel, before the receiver's cosine. */
static const double dropped = 1e-10;

/* POV-Ray sees no shadow closer to a light or a surface. */
static const double shadow_tolerance = 0.001;

/* ---- Geometry ---- */

double hard_width(const struct slab *page) {
  return fmax(chain_length(page->u), chain_length(page->v));
}

double hard_height(const struct hard_case *lit, const struct slab *page, const int lights[2]) {
  const double edges[2] = {chain_length(page->u), chain_length(page->v)};
  double height = INFINITY;
  for (int k = 0; k < 2; ++k) {
    double pitch = edges[k] / lights[k], span = page->st_window[2 * k + 1] - page->st_window[2 * k];
    double texels = page->samples[2 + k] + 2;
    height =
        fmin(height, 1 / (texels * span / page->samples[2 + k] / pitch + 1 / page->st_distance));
    for (int end = 0; end < 2 && lit->page_count > 1; ++end) { /* no tile juts out over an edge */
      double slope = (end ? 1 : -1) * page->st_window[2 * k + end] + span / page->samples[2 + k];
      double steepest = slope - (edges[k] - pitch) / 2 / page->st_distance;
      if (steepest > 0) height = fmin(height, pitch / 2 / steepest);
    }
  }
  return height;
}

/* All views, at most --lights of them an axis, halved until there are at most `most`. */
void hard_lights(const struct hard_case *lit, const struct slab *page, int lights[2]) {
  for (int k = 0; k < 2; ++k) {
    lights[k] = page->samples[k];
    if (lit->lights > 0 && lights[k] > lit->lights) lights[k] = lit->lights;
  }
  while (lit->most > 0 && fmax(lights[0], lights[1]) > lit->most)
    for (int k = 0; k < 2; ++k) lights[k] = (lights[k] + 1) / 2;
}

/* A page as it stands in the scene: a point is (x, y) along u and v and z along the normal. */
struct standing {
  double center[3], axis[3][3]; /* unit */
  double edges[2], scale;
};

static void turn(const struct hard_lamp *lamp, const double x[3], double turned[3]) {
  chain_move(lamp->matrix, 1, x, 0, turned);
}

static void move(const struct hard_lamp *lamp, const double x[3], double moved[3]) {
  chain_move(lamp->matrix, lamp->scale, x, 1, moved);
}

static struct standing stand(const struct hard_lamp *lamp, const struct slab *page) {
  struct standing standing = {.scale = lamp->scale};
  const double *axes[3] = {page->u, page->v, page->normal};
  move(lamp, page->center, standing.center);
  for (int k = 0; k < 3; ++k) {
    double size = chain_length(axes[k]);
    turn(lamp, axes[k], standing.axis[k]);
    for (int c = 0; c < 3; ++c) standing.axis[k][c] /= size;
    if (k < 2) standing.edges[k] = size * lamp->scale;
  }
  return standing;
}

static void into(const struct standing *standing, const double at[3], double local[3]) {
  double from[3];
  for (int c = 0; c < 3; ++c) from[c] = at[c] - standing->center[c];
  for (int k = 0; k < 3; ++k) local[k] = chain_dot(from, standing->axis[k]);
}

/* ---- Shadows of the lamps' cases ---- */

/* Whether a way meets the sheet's case, which is from the aperture to the sheet's rim, grown
 * by some of its width on all sides. */
static bool meets_case(const struct hard_case *lit, int n, const struct slab *page,
                       const int lights[2], const double from[3], const double to[3], double grow) {
  const struct hard_lamp *lamp = &lit->lamps[n];
  struct standing standing = stand(lamp, page);
  double height = hard_height(lit, page, lights) * lamp->scale, p[2][3], enter = 0, leave = 1;
  into(&standing, from, p[0]);
  into(&standing, to, p[1]);
  double more = grow * fmax(standing.edges[0], standing.edges[1]);
  for (int side = 0; side < 6; ++side) {
    int k = side / 2;
    double sign = side % 2 ? 1 : -1, f[2];
    for (int end = 0; end < 2; ++end) { /* above 0 within */
      double z = p[end][2], limit = sign > 0 ? height : 0;
      if (k < 2) {
        const double *w = page->st_window + 2 * k;
        double ring = (w[1] - w[0]) / page->samples[2 + k];
        double last = standing.edges[k] / 2 * (1 - 1. / lights[k]); /* light's place */
        double rim = sign * last * (1 - height / page->st_distance / lamp->scale) +
                     height * (sign > 0 ? w[1] + ring : w[0] - ring);
        double base = sign * standing.edges[k] / 2;
        limit = base + (rim - base) * z / height;
      }
      f[end] = sign * (limit - (k < 2 ? p[end][k] : z)) + more;
    }
    if (f[0] < 0 && f[1] < 0) return false;
    double cross = f[0] / (f[0] - f[1]);
    if (f[0] < 0) enter = fmax(enter, cross);
    if (f[1] < 0) leave = fmin(leave, cross);
  }
  return enter < leave;
}

/* Share of the light on the way that passes the cases of other lamps and pages: 0 or 1, or
 * anything between, which is in doubt. */
static double passing(const struct hard_case *lit, int lamp, int page, const double from[3],
                      const double to[3]) {
  if (lit->kind != HARD_SHEET || lit->lamp_count * lit->page_count == 1) return 1;
  double open = 1;
  for (int n = 0; n < lit->lamp_count; ++n)
    for (int p = 0; p < lit->page_count; ++p) {
      if (n == lamp && p == page) continue;
      int lights[2];
      const struct slab *other = &lit->pages[p];
      hard_lights(lit, other, lights);
      double near = shadow_tolerance / (hard_width(other) * lit->lamps[n].scale);
      double grow = edge + 2 * near;
      if (!meets_case(lit, n, other, lights, from, to, grow)) continue;
      if (meets_case(lit, n, other, lights, from, to, -grow)) return 0;
      open = 0.5;
    }
  return open;
}

/* ---- Radiance ---- */

/* Radiance of the ray; returns 0 outside of the window, 1 inside, 1/2 on its edge. */
static double look(const struct slab *slab, const double place[2], const double slope[2],
                   double rgb[3]) {
  double ray[4], inside = 1;
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int k = 0; k < 2; ++k) {
    const double *w = slab->st_window + 2 * k;
    double near = edge * (w[1] - w[0]) + 1e-12 * fabs(slope[k]);
    double within = fmin(slope[k] - w[0], w[1] - slope[k]);
    if (within < -near) return 0;
    if (within < near) inside = 0.5;
    ray[k] = place[k];
    ray[2 + k] = fmin(fmax(slope[k], w[0]), w[1]);
  }
  oracle_lookup(slab, ray, rgb);
  return inside;
}

static double peak_of(const struct slab *slab) {
  double peak = 0;
  for (size_t k = 0; k < 3 * slab_sample_count(slab); ++k) peak = fmax(peak, slab->rgb[k]);
  return peak;
}

/* ---- A sheet's lights, or the slab's integral as many more ---- */

/* Whether a point is where light of the page may come, and errors are stated. */
static bool lit_there(const struct standing *standing, const struct slab *slab,
                      const double local[3]) {
  double spread = fabs(1 - local[2] / standing->scale / slab->st_distance);
  for (int k = 0; k < 2; ++k) {
    const double *w = slab->st_window + 2 * k;
    double rim = spread * standing->edges[k] / 2;
    if (local[k] < local[2] * w[0] - rim || local[k] > local[2] * w[1] + rim) return false;
  }
  return true;
}

static void add_views(const struct hard_case *lit, int n, int p, const struct slab *slab,
                      const int points[2], struct hard_sum *sum) {
  const struct hard_lamp *lamp = &lit->lamps[n];
  struct standing standing = stand(lamp, slab);
  double area = standing.edges[0] * standing.edges[1] / ((double)points[0] * points[1]);
  double rounding = lit->stated ? 0 : half_step * peak_of(slab);
  double lowest = 1.01 * hard_height(lit, slab, points) * lamp->scale + 2 * shadow_tolerance;
  for (int k = 0; k < lit->size * lit->size; ++k) {
    double at[3], local[3];
    chain_pixel(&lit->plane, lit->size, k, at);
    into(&standing, at, local);
    if (fabs(local[2]) < lowest || (lit->stated && !lit_there(&standing, slab, local)))
      sum->doubt[k] = INFINITY;
    for (int m = 0; m < points[0] * points[1] && local[2] > 0; ++m) {
      double from[3], place[2], slope[2], radiance[3], r2 = local[2] * local[2], facing = 0;
      for (int c = 0; c < 2; ++c) {
        int index = c ? m / points[0] : m % points[0];
        place[c] = ((index + 0.5) / points[c] - 0.5) * standing.edges[c];
        double away = local[c] - place[c];
        slope[c] = away / local[2] + place[c] / lamp->scale / slab->st_distance;
        r2 += away * away;
      }
      for (int c = 0; c < 3; ++c) {
        from[c] =
            standing.center[c] + place[0] * standing.axis[0][c] + place[1] * standing.axis[1][c];
        facing -= (at[c] - from[c]) * lit->plane.normal[c];
      }
      if (facing <= 0) continue;
      double weight = local[2] * facing / r2 / r2 * area / M_PI;
      for (int c = 0; c < 2; ++c) place[c] /= lamp->scale;
      double inside = look(slab, place, slope, radiance);
      double open = inside > 0 ? passing(lit, n, p, from, at) : 0, sure = inside * open;
      for (int c = 0; c < 3 && sure > 0; ++c) {
        double light = weight * fabs(lamp->gain[c]) * radiance[c];
        sum->rgb[k][c] += sure * weight * lamp->gain[c] * radiance[c];
        sum->doubt[k] += (sure < 1 ? light : 0) + weight * fabs(lamp->gain[c]) * rounding;
      }
    }
  }
}

static void add_sheet(const struct hard_case *lit, int n, int p, struct hard_sum *sum) {
  const struct slab *page = &lit->pages[p];
  int lights[2];
  if (lit->stated) { /* the slab's own integral: many points in each cell */
    for (int k = 0; k < 2; ++k) lights[k] = page->samples[k] * (int)ceil(24. / page->samples[k]);
    add_views(lit, n, p, page, lights, sum);
    return;
  }
  hard_lights(lit, page, lights);
  struct slab views = chain_means(page, lights[0], lights[1]);
  add_views(lit, n, p, &views, lights, sum);
  slab_free(&views);
}

/* ---- A cluster's lights, as its text has them ---- */

enum { MOST_LIGHTS = 8 };

static double lobe(const double numbers[6], double cosine) {
  double outer = cos(numbers[1] * M_PI / 180), inner = cos(numbers[0] * M_PI / 180);
  if (cosine <= fmax(outer, 0)) return 0;
  double p = cosine >= inner ? 1 : (cosine - outer) / (inner - outer);
  return pow(cosine, numbers[2]) * p * p * (3 - 2 * p);
}

static int halved(double size, double most) {
  while (size > 1 && most > 0 && size > most) size /= 2;
  return (int)size;
}

/* One light, whose numbers are those of a line of Places, Lobes and Colours. */
static void add_light(const struct hard_case *lit, const struct hard_lamp *lamp,
                      const double places[4][3], const double lobes[6], const double colour[3],
                      struct hard_sum *sum) {
  int nu = halved(lobes[3], lit->most), nv = halved(lobes[4], lit->most);
  double axis[3], size = lamp->scale * lobes[5], outer = cos(lobes[1] * M_PI / 180);
  bool sharp = cos(lobes[0] * M_PI / 180) - outer < 1e-4;
  turn(lamp, places[3], axis);
  for (int k = 0; k < lit->size * lit->size; ++k)
    for (int m = 0; m < nu * nv; ++m) {
      double at[3], from[3], away[3];
      double p = (m % nu + 0.5) / nu - 0.5, q = ((m / nu) + 0.5) / nv - 0.5;
      chain_pixel(&lit->plane, lit->size, k, at);
      for (int c = 0; c < 3; ++c) from[c] = places[0][c] + p * places[1][c] + q * places[2][c];
      move(lamp, from, away);
      for (int c = 0; c < 3; ++c) away[c] = at[c] - away[c];
      double r = chain_length(away), cosine = chain_dot(away, axis) / (r * chain_length(axis));
      double strength = (size / r) * (size / r) / nu / nv / M_PI, most = 0;
      double facing = -chain_dot(away, lit->plane.normal) / r;
      if (r < 0.2 * size) sum->doubt[k] = INFINITY; /* too near: it fades */
      if (facing <= 0) continue;
      for (int c = 0; c < 3; ++c) {
        double shown = lamp->gain[c] * colour[c] * strength;
        sum->rgb[k][c] += shown * lobe(lobes, cosine) * facing;
        most = fmax(most, fabs(shown) * lobe(lobes, cosine));
        if (sharp && fabs(cosine - outer) < edge) sum->doubt[k] += fabs(shown) * facing;
      }
      if (most < dropped) sum->doubt[k] += most * facing;
    }
}

static bool add_cluster(const struct hard_case *lit, int n, struct hard_sum *sum) {
  static double places[MOST_LIGHTS][4][3], lobes[MOST_LIGHTS][6], colours[MOST_LIGHTS][3];
  double count;
  if (!hard_numbers("Test_Lamp_Places = array[", &count, 1) || count > MOST_LIGHTS) return false;
  int lights = (int)count;
  char after[3][64];
  snprintf(after[0], sizeof after[0], "Test_Lamp_Places = array[%d][4] {", lights);
  snprintf(after[1], sizeof after[1], "Test_Lamp_Lobes = array[%d][6] {", lights);
  snprintf(after[2], sizeof after[2], "Test_Lamp_Colours = array[%d] {", lights);
  if (!hard_numbers(after[0], places[0][0], 12 * lights) ||
      !hard_numbers(after[1], lobes[0], 6 * lights) ||
      !hard_numbers(after[2], colours[0], 3 * lights))
    return false;
  for (int k = 0; k < lights; ++k)
    add_light(lit, &lit->lamps[n], (const double(*)[3])places[k], lobes[k], colours[k], sum);
  return true;
}

/* ---- The far field, as its image has it ---- */

/* The image's columns lie on longitudes 0 to 2 pi, its rows on latitudes from the upper pole to the
 * lower one. */
static void image_at(const struct picture *picture, const double direction[3], double rgb[3]) {
  double turns = atan2(direction[2], direction[0]) / (2 * M_PI);
  double x = (turns - floor(turns)) * (picture->width - 1);
  double y = (0.5 - asin(fmin(fmax(direction[1], -1), 1)) / M_PI) * (picture->height - 1);
  int column = (int)fmin(floor(x), picture->width - 2);
  int row = (int)fmin(floor(y), picture->height - 2);
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int k = 0; k < 4; ++k) {
    int i = column + (k & 1), j = row + (k >> 1);
    double weight = (k & 1 ? x - column : 1 - x + column) * (k >> 1 ? y - row : 1 - y + row);
    for (int c = 0; c < 3; ++c)
      rgb[c] +=
          weight *
          (double)picture->rgb[3 * ((size_t)j * (size_t)picture->width + (size_t)i) + (size_t)c];
  }
}

/* Whether the way meets the sphere of another lamp, which filters its light. */
static bool meets_sphere(const struct hard_lamp *lamp, const double numbers[12], double radius,
                         const double from[3], const double to[3]) {
  double center[3], way[3], relative[3];
  move(lamp, numbers + 9, center);
  for (int c = 0; c < 3; ++c) {
    relative[c] = center[c] - from[c];
    way[c] = to[c] - from[c];
  }
  double t = fmin(fmax(chain_dot(relative, way) / chain_dot(way, way), 0), 1);
  for (int c = 0; c < 3; ++c) relative[c] -= t * way[c];
  return chain_length(relative) < 1.01 * radius * lamp->scale;
}

double hard_radius(const struct hard_lamp *lamp, double width) {
  return fmax(0.05 * width, 0.002 / lamp->scale);
}

static void add_point(const struct hard_case *lit, int n, const struct picture *picture,
                      const double numbers[14], struct hard_sum *sum) {
  const struct hard_lamp *lamp = &lit->lamps[n];
  double axes[3][3], center[3], width = numbers[12];
  for (int k = 0; k < 3; ++k) turn(lamp, numbers + 3 * k, axes[k]);
  move(lamp, numbers + 9, center);
  for (int k = 0; k < lit->size * lit->size; ++k) {
    double at[3], away[3], local[3], rgb[3];
    chain_pixel(&lit->plane, lit->size, k, at);
    for (int c = 0; c < 3; ++c) away[c] = at[c] - center[c];
    double r = chain_length(away), facing = -chain_dot(away, lit->plane.normal) / r;
    double radius = hard_radius(lamp, width);
    if (r < 4 * radius * lamp->scale) sum->doubt[k] = INFINITY;
    if (facing <= 0) continue;
    for (int c = 0; c < 3; ++c) local[c] = chain_dot(away, axes[c]) / r;
    image_at(picture, local, rgb);
    for (int m = 0; m < lit->lamp_count; ++m)
      if (m != n && meets_sphere(&lit->lamps[m], numbers, radius, center, at))
        sum->doubt[k] = INFINITY;
    for (int c = 0; c < 3; ++c)
      sum->rgb[k][c] += lamp->gain[c] * rgb[c] * numbers[13] * facing / M_PI * (lamp->scale / r) *
                        (lamp->scale / r);
  }
}

static bool add_points(const struct hard_case *lit, struct hard_sum *sum) {
  struct picture picture;
  struct error error;
  double numbers[14]; /* frame, centre, width, what the image holds as 1 */
  if (!hard_numbers("Test_Lamp_Frame = array[4] {", numbers, 12) ||
      !hard_numbers("Test_Lamp_Width =", numbers + 12, 1) ||
      !hard_numbers("Test_Lamp_Peaks = array[1] {", numbers + 13, 1))
    return false;
  if (slab_exr_read(chain_path("lamp.exr"), &picture, &error) != RESULT_OK) return false;
  for (int n = 0; n < lit->lamp_count; ++n) add_point(lit, n, &picture, numbers, sum);
  picture_free(&picture);
  return true;
}

bool hard_add(const struct hard_case *lit, struct hard_sum *sum) {
  memset(sum, 0, sizeof *sum);
  if (lit->kind == HARD_POINT && !lit->stated) return add_points(lit, sum);
  for (int n = 0; n < lit->lamp_count; ++n)
    if (lit->kind == HARD_CLUSTER && !lit->stated) {
      if (!add_cluster(lit, n, sum)) return false;
    } else {
      for (int p = 0; p < lit->page_count; ++p) add_sheet(lit, n, p, sum);
    }
  return true;
}
