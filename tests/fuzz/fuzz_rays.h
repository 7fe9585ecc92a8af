/* fuzz_rays.h - what the fuzzers of ray files share. */
#ifndef FUZZ_RAYS_H
#define FUZZ_RAYS_H

#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "fuzz.h"
#include "import/rays/ray_lay.h"

enum { FUZZ_RAYS = 64 }; /* read at a time */

/* The pages that are laid for rays are slabs, and their places are on them. */
static inline void fuzz_pages(const struct ray_look *look, bool box) {
  struct ray_pages pages = {0};
  struct error error = {""};
  double abst[SLAB_AXES];
  if ((box ? ray_lay_box : ray_lay_best)(look, &pages, &error) != RESULT_OK ||
      ray_lay_windows(look, &pages, &error) != RESULT_OK) {
    fuzz_check(error.text[0]);
    return;
  }
  for (int n = 0; n < pages.count; ++n)
    fuzz_check(slab_check(&pages.page[n].geometry, &error) == RESULT_OK);
  for (size_t n = 0; n < look->kept_count; ++n) {
    int page = ray_pages_find(&pages, &look->kept[n], abst);
    fuzz_check(page < pages.count);
    for (int k = 0; k < 2 && page >= 0; ++k) fuzz_check(fabs(abst[k]) <= pages.page[page].half[k]);
  }
}

static inline void fuzz_ray(const struct ray *ray, bool coloured) {
  const double *d = ray->direction;
  fuzz_check(fabs(sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - 1) < 1e-12);
  for (int c = 0; c < 3; ++c) {
    fuzz_check(isfinite(ray->origin[c]) && isfinite(ray->flux[c]));
    fuzz_check(coloured || ray->flux[c] >= 0);
  }
}

/* Reads the input as a file of that kind; the pages of what it took. */
static inline void fuzz_rays(const uint8_t *data, size_t size, const struct ray_format *format) {
  char path[64];
  struct ray_file file;
  struct ray rays[FUZZ_RAYS];
  struct ray_look look;
  struct warnings notes = {0};
  struct error error = {""};
  size_t count = 1;
  int fd = fuzz_file(data, size);
  snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
  fuzz_check(ray_look_new(&look, FUZZ_RAYS, &error) == RESULT_OK);
  enum result result = ray_file_open(path, format, 0.001, &notes, &file, &error);
  if (result == RESULT_OK) {
    while (result == RESULT_OK && count > 0) {
      result = ray_file_read(&file, rays, FUZZ_RAYS, &count, &error);
      for (size_t n = 0; n < count && result == RESULT_OK; ++n) fuzz_ray(&rays[n], file.coloured);
      if (result == RESULT_OK) ray_look_add(&look, rays, count);
    }
    ray_file_close(&file);
  }
  fuzz_check(result == RESULT_OK || error.text[0]);
  for (int box = 0; box < 2 && result == RESULT_OK && look.rays > 0; ++box) fuzz_pages(&look, box);
  ray_look_free(&look);
  close(fd);
}

#endif
