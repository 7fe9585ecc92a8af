#include "picture/refine.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "picture/prediction.h"

/* Points whose normals are within 11 degrees and of which one lies that near to the tangent
 * plane of the other, in terms of their distance, are on one surface. */
static const double same_normal = 0.98, same_plane = 0.1;

/* A second difference is allowed to be so many times the tolerance: a smooth picture's mean over a
 * pixel is within a twelfth of it. */
static const double contrast = 8;

/* Light that is shared is predicted to within so many times the tolerance. */
static const double most_off = 3;

/* Rays that a thread has in memory, if one pixel does not need more. */
enum { MOST_RAYS = 4096, CORNERS = 4, AROUND = 9 };

struct refine_ray {
  struct shade_hit hit;
  struct gathered light; /* once it is known */
  bool known, own;       /* own: gathered for this ray */
};

enum result refine_create(const struct shade *shade, double tolerance, struct refine *refine,
                          struct error *error) {
  size_t pixels = (size_t)shade->width * (size_t)shade->height;
  *refine = (struct refine){
      .shade = shade, .tolerance = tolerance, .seen = calloc(pixels, sizeof *refine->seen)};
  if (refine->seen) return RESULT_OK;
  return result_fail(error, RESULT_MEMORY, "out of memory for the samples of %dx%d pixels",
                     shade->width, shade->height);
}

void refine_free(struct refine *refine) {
  free(refine->seen);
  *refine = (struct refine){0};
}

static void set_light(const struct receiver *receiver, const struct gathered *gathered,
                      struct refine_seen *seen) {
  seen->lit = true;
  memcpy(seen->position, receiver->position, sizeof seen->position);
  seen->shininess = (float)receiver->shininess;
  seen->error = (float)gathered->error;
  for (int c = 0; c < 3; ++c) {
    seen->normal[c] = (float)receiver->normal[c];
    seen->irradiance[c] = (float)gathered->irradiance[c];
    seen->gloss[c] = (float)gathered->gloss[c];
  }
}

void refine_note(struct refine *refine, const struct image_part *part) {
  int lit = 0;
  for (int pixel = 0; pixel < part->width * part->height; ++pixel) {
    const struct shade_hit *hit = &part->hits[pixel];
    size_t x = (size_t)(part->left + pixel % part->width);
    size_t y = (size_t)(part->top + pixel / part->width);
    struct refine_seen *seen = &refine->seen[y * (size_t)refine->shade->width + x];
    *seen = (struct refine_seen){0};
    if (hit->lit) set_light(&hit->receiver, &part->gathered[lit++], seen);
    for (int c = 0; c < 3; ++c) seen->rgb[c] = (float)part->sums[pixel].rgb[c];
  }
}

/* The pixel and its neighbours, row by row; beyond the picture's edge, those at the edge. */
static void find_around(const struct refine *refine, int x, int y,
                        const struct refine_seen *around[AROUND]) {
  int width = refine->shade->width, height = refine->shade->height;
  for (int k = 0; k < AROUND; ++k) {
    int i = x + k % 3 - 1, j = y + k / 3 - 1;
    i = i < 0 ? 0 : i < width ? i : width - 1;
    j = j < 0 ? 0 : j < height ? j : height - 1;
    around[k] = &refine->seen[(size_t)j * (size_t)width + (size_t)i];
  }
}

/* Whether a point with that normal is on the surface of what was seen. */
static bool same_surface(const double position[3], const double normal[3], double shininess,
                         const struct refine_seen *seen) {
  double across[3];
  const double other[3] = {seen->normal[0], seen->normal[1], seen->normal[2]};
  if (!seen->lit || seen->shininess != (float)shininess) return false;
  if (vector_dot(normal, other) < same_normal) return false;
  vector_subtract(position, seen->position, across);
  return fabs(vector_dot(across, other)) <= same_plane * vector_length(across);
}

/* Whether an edge of a surface runs between the pixel's middle and a neighbour. */
static bool at_edge(const struct refine_seen *const around[AROUND]) {
  const struct refine_seen *middle = around[AROUND / 2];
  const double normal[3] = {middle->normal[0], middle->normal[1], middle->normal[2]};
  for (int k = 0; k < AROUND; ++k)
    if (middle->lit ? !same_surface(middle->position, normal, middle->shininess, around[k])
                    : around[k]->lit)
      return true;
  return false;
}

bool refine_wants(const struct refine *refine, int x, int y) {
  const struct refine_seen *around[AROUND];
  double brightest = 0, bends = 0;
  find_around(refine, x, y, around);
  const float *middle = around[AROUND / 2]->rgb;
  for (int k = 0; k < AROUND; ++k)
    for (int c = 0; c < 3; ++c) brightest = fmax(brightest, fabs((double)around[k]->rgb[c]));
  for (int k = 0; k < AROUND / 2; ++k)
    for (int c = 0; c < 3; ++c) {
      double ends = (double)around[k]->rgb[c] + around[AROUND - 1 - k]->rgb[c];
      bends = fmax(bends, fabs(ends - 2 * (double)middle[c]));
    }
  return bends > contrast * refine->tolerance * brightest || at_edge(around);
}

enum result refine_rays_create(int grid, int pixels, struct refine_rays *rays,
                               struct error *error) {
  int each = grid * grid, most = MOST_RAYS / each > 1 ? MOST_RAYS / each : 1;
  if (most > pixels) most = pixels;
  size_t all = (size_t)most * (size_t)each;
  *rays = (struct refine_rays){.grid = grid,
                               .most = most,
                               .pixels = calloc((size_t)most, sizeof *rays->pixels),
                               .receivers = calloc(all, sizeof *rays->receivers),
                               .gathered = calloc(all, sizeof *rays->gathered),
                               .askers = calloc(all, sizeof *rays->askers),
                               .rays = calloc(all, sizeof *rays->rays)};
  if (rays->pixels && rays->receivers && rays->gathered && rays->askers && rays->rays)
    return RESULT_OK;
  return result_no_memory(error);
}

void refine_rays_free(struct refine_rays *rays) {
  free(rays->pixels);
  free(rays->receivers);
  free(rays->gathered);
  free(rays->askers);
  free(rays->rays);
  *rays = (struct refine_rays){0};
}

void refine_trace(const struct refine *refine, struct refine_rays *rays) {
  int grid = rays->grid, each = grid * grid, width = refine->shade->width;
  for (int k = 0; k < rays->count * each; ++k) {
    struct refine_ray *ray = &rays->rays[k];
    int pixel = rays->pixels[k / each], sample = k % each;
    double x = pixel % width + (sample % grid + 0.5) / grid;
    double y = pixel / width + (sample / grid + 0.5) / grid;
    uint64_t index = (uint64_t)pixel * (uint64_t)each + (uint64_t)sample;
    shade_ray(refine->shade, x, y, index, &ray->hit);
    ray->own = false;
    ray->known = !ray->hit.lit;
  }
}

/* Places on the receiver's surface where light is known, by their distance from the middle of its
 * pixel, in pixels. */
struct places {
  struct prediction_places where;
  const struct refine_seen *seen[PREDICTION_MOST];
};

static void add_place(const struct receiver *receiver, const struct refine_seen *seen, double x,
                      double y, struct places *places) {
  if (!same_surface(receiver->position, receiver->normal, receiver->shininess, seen)) return;
  int number = places->where.count++;
  places->where.at[number][0] = x;
  places->where.at[number][1] = y;
  places->seen[number] = seen;
}

/* Light at (x, y) from that at the places; false where they do not predict each other. */
static bool share(double tolerance, const struct places *places, double x, double y,
                  struct gathered *light) {
  struct prediction prediction;
  double values[PREDICTION_MOST], brightest = 0, off = 0, error = 0;
  if (places->where.count < 2) return false;
  prediction_make(&places->where, &prediction);
  for (int c = 0; c < 6; ++c) {
    for (int k = 0; k < places->where.count; ++k) {
      const struct refine_seen *seen = places->seen[k];
      values[k] = c < 3 ? seen->irradiance[c] : seen->gloss[c - 3];
      brightest = fmax(brightest, values[k]);
      error = fmax(error, (double)seen->error);
    }
    off = fmax(off, prediction_value(&places->where, &prediction, values, x, y,
                                     c < 3 ? &light->irradiance[c] : &light->gloss[c - 3]));
  }
  light->error = error + (brightest > 0 ? off / brightest : 0);
  return off <= most_off * tolerance * brightest;
}

/* How far the sample lies from its pixel's middle. */
static void find_sample(int grid, int sample, double *x, double *y) {
  *x = (sample % grid + 0.5) / grid - 0.5;
  *y = (sample / grid + 0.5) / grid - 0.5;
}

/* Light from the middles around the ray's pixel. */
static bool share_around(const struct refine *refine, const struct refine_seen *const around[],
                         int grid, int sample, const struct receiver *receiver,
                         struct gathered *light) {
  struct places places = {0};
  double x, y;
  find_sample(grid, sample, &x, &y);
  for (int k = 0; k < AROUND; ++k) add_place(receiver, around[k], k % 3 - 1, k / 3 - 1, &places);
  return share(refine->tolerance, &places, x, y, light);
}

static bool in_corner(int grid, int sample) {
  int x = sample % grid, y = sample / grid;
  return (x == 0 || x == grid - 1) && (y == 0 || y == grid - 1);
}

/* Light from those of the pixel's corners that gathered, and its middle. */
static bool share_corners(const struct refine *refine, const struct refine_ray *rays,
                          const struct refine_seen *middle, int grid, int sample,
                          struct gathered *light) {
  const int corners[CORNERS] = {0, grid - 1, grid * (grid - 1), grid * grid - 1};
  const struct receiver *receiver = &rays[sample].hit.receiver;
  struct refine_seen made[CORNERS];
  struct places places = {0};
  double x, y;
  add_place(receiver, middle, 0, 0, &places);
  for (int k = 0; k < CORNERS; ++k) {
    const struct refine_ray *corner = &rays[corners[k]];
    if (!corner->own) continue;
    set_light(&corner->hit.receiver, &corner->light, &made[k]);
    find_sample(grid, corners[k], &x, &y);
    add_place(receiver, &made[k], x, y, &places);
  }
  find_sample(grid, sample, &x, &y);
  return share(refine->tolerance, &places, x, y, light);
}

void refine_ask(const struct refine *refine, bool corners, struct refine_rays *rays) {
  int each = rays->grid * rays->grid, width = refine->shade->width;
  rays->asked = 0;
  for (int pixel = 0; pixel < rays->count; ++pixel) {
    const struct refine_seen *around[AROUND];
    struct refine_ray *own = &rays->rays[pixel * each];
    find_around(refine, rays->pixels[pixel] % width, rays->pixels[pixel] / width, around);
    for (int k = 0; k < each; ++k) {
      const struct receiver *receiver = &own[k].hit.receiver;
      if (own[k].known) continue;
      own[k].known =
          corners ? share_around(refine, around, rays->grid, k, receiver, &own[k].light)
                  : share_corners(refine, own, around[AROUND / 2], rays->grid, k, &own[k].light);
      if (own[k].known || (corners && !in_corner(rays->grid, k))) continue;
      rays->receivers[rays->asked] = *receiver;
      rays->askers[rays->asked++] = pixel * each + k;
    }
  }
}

void refine_take(struct refine_rays *rays) {
  for (int k = 0; k < rays->asked; ++k) {
    struct refine_ray *ray = &rays->rays[rays->askers[k]];
    ray->light = rays->gathered[k];
    ray->known = ray->own = true;
  }
}

double refine_store(const struct refine_rays *rays, struct picture *picture) {
  int each = rays->grid * rays->grid;
  double worst = 0;
  for (int pixel = 0; pixel < rays->count; ++pixel) {
    double rgb[3] = {0}, error[3] = {0}, one[3], errs[3];
    for (int k = 0; k < each; ++k) {
      const struct refine_ray *ray = &rays->rays[pixel * each + k];
      shade_radiance(&ray->hit, &ray->light, one, errs);
      if (ray->hit.lit) worst = fmax(worst, ray->light.error);
      for (int c = 0; c < 3; ++c) {
        rgb[c] += one[c];
        error[c] += errs[c];
      }
    }
    size_t first = 3 * (size_t)rays->pixels[pixel];
    for (size_t c = 0; c < 3; ++c) {
      picture->rgb[first + c] = (float)(rgb[c] / each);
      picture->error[first + c] = (float)(error[c] / each);
    }
  }
  return worst;
}
