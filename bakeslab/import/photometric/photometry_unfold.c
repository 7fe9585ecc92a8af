#include "import/photometric/photometry_unfold.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct image {
  double angle;
  int source; /* the file's plane */
};

static int compare(const void *left, const void *right) {
  const struct image *a = left, *b = right;
  if (a->angle != b->angle) return a->angle < b->angle ? -1 : 1;
  return a->source - b->source;
}

/* All images of the planes in [0, 360), ascending, each angle once; returns how many. */
static int make_images(const double *c, int planes, enum photometry_symmetry symmetry,
                       struct image *images) {
  int count = 0, kept = 0;
  for (int n = 0; n < planes; ++n)
    for (int mirrored = 0; mirrored < 4; ++mirrored) {
      if (mirrored & ~(int)symmetry) continue;
      double angle = c[n];
      if (mirrored & PHOTOMETRY_C0_C180) angle = 360 - angle;
      if (mirrored & PHOTOMETRY_C90_C270) angle = 180 - angle;
      angle = fmod(angle + 720, 360);
      images[count++] = (struct image){angle, n};
    }
  qsort(images, (size_t)count, sizeof *images, compare);
  for (int n = 0; n < count; ++n)
    if (kept == 0 || images[n].angle > images[kept - 1].angle) images[kept++] = images[n];
  return kept;
}

static void take(struct photometry *lamp, int plane, const double *candela, int source) {
  size_t rows = (size_t)lamp->rows;
  memcpy(lamp->candela + (size_t)plane * rows, candela + (size_t)source * rows,
         rows * sizeof *candela);
}

/* Allocates planes for the rows that are there. */
static enum result alloc_planes(struct photometry *lamp, int planes, struct error *error) {
  struct photometry fresh = {.planes = planes, .rows = lamp->rows};
  enum result result = photometry_alloc(&fresh, error);
  if (result == RESULT_OK) {
    memcpy(fresh.row, lamp->row, (size_t)lamp->rows * sizeof *lamp->row);
    free(lamp->plane);
    free(lamp->row);
    free(lamp->candela);
    lamp->planes = planes;
    lamp->plane = fresh.plane;
    lamp->row = fresh.row;
    lamp->candela = fresh.candela;
  } else {
    photometry_free(&fresh);
  }
  return result;
}

enum result photometry_unfold(struct photometry *lamp, const double *c, int planes,
                              const double *candela, enum photometry_symmetry symmetry,
                              struct error *error) {
  if (planes == 1 || symmetry == PHOTOMETRY_ROTATED) {
    enum result result = alloc_planes(lamp, 1, error);
    if (result == RESULT_OK) take(lamp, 0, candela, 0);
    return result;
  }
  struct image *images = calloc(4 * (size_t)planes, sizeof *images);
  if (!images) return result_no_memory(error);
  int count = make_images(c, planes, symmetry, images);
  enum result result = RESULT_OK;
  if (images[0].angle > 0) result = result_fail(error, RESULT_BAD, "no plane is at C0");
  if (result == RESULT_OK) result = alloc_planes(lamp, count + 1, error);
  for (int n = 0; n <= count && result == RESULT_OK; ++n) {
    int last = n == count; /* 360 is 0 */
    lamp->plane[n] = last ? 360 : images[n].angle;
    take(lamp, n, candela, images[last ? 0 : n].source);
  }
  free(images);
  return result;
}

/* Ascending values, with their negatives where they begin at 0. Returns how many. */
static int mirror(const double *values, int count, struct image *all) {
  int out = 0;
  for (int n = values[0] == 0 ? count - 1 : 0; n > 0; --n)
    all[out++] = (struct image){-values[n], n};
  for (int n = 0; n < count; ++n) all[out++] = (struct image){values[n], n};
  return out;
}

enum result photometry_unfold_sides(struct photometry *lamp, const double *h, int planes,
                                    const double *v, int rows, const double *candela,
                                    struct error *error) {
  struct image *across = calloc(2 * (size_t)planes, sizeof *across);
  struct image *along = calloc(2 * (size_t)rows, sizeof *along);
  enum result result = across && along ? RESULT_OK : result_no_memory(error);
  if (result == RESULT_OK) {
    lamp->planes = mirror(h, planes, across);
    lamp->rows = mirror(v, rows, along);
    result = photometry_alloc(lamp, error);
  }
  for (int i = 0; i < lamp->planes && result == RESULT_OK; ++i) {
    lamp->plane[i] = across[i].angle;
    for (int j = 0; j < lamp->rows; ++j) {
      lamp->row[j] = along[j].angle;
      lamp->candela[i * lamp->rows + j] = candela[across[i].source * rows + along[j].source];
    }
  }
  free(across);
  free(along);
  return result;
}
