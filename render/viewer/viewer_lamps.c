#include "viewer/viewer_lamps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/tiles.h"
#include "base/vector.h"

/* Pixels from low to high - 1. */
struct area {
  int low[2], high[2];
};

struct look {
  struct viewer_lamps *lamps;
  const struct light *lights;
  int count;
  const struct camera *camera;
  struct area area;
};

enum result viewer_lamps_create(int width, int height, struct viewer_lamps *lamps,
                                struct error *error) {
  *lamps = (struct viewer_lamps){.width = width, .height = height};
  lamps->pixels = calloc((size_t)width * (size_t)height, sizeof *lamps->pixels);
  return lamps->pixels ? RESULT_OK : result_no_memory(error);
}

void viewer_lamps_free(struct viewer_lamps *lamps) {
  free(lamps->pixels);
  *lamps = (struct viewer_lamps){0};
}

static void widen(const double pixel[2], const int size[2], struct area *area) {
  for (int k = 0; k < 2; ++k) {
    int low = (int)fmin(fmax(floor(pixel[k]) - 1, 0), size[k]);
    int high = (int)fmin(fmax(ceil(pixel[k]) + 1, 0), size[k]);
    if (low < area->low[k]) area->low[k] = low;
    if (high > area->high[k]) area->high[k] = high;
  }
}

/* Widens the area by where the camera may see the page. */
static void add_page(const struct light_page *page, const struct camera *camera, const int size[2],
                     struct area *area) {
  double forward[3], right[3], up[3], half = tan(camera->fov * (M_PI / 360)), to[3], corners[4][3];
  static const double all[2][2] = {{-1e9, -1e9}, {1e9, 1e9}};
  vector_subtract(camera->from, page->center, to);
  if (!(vector_dot(to, page->frame[2]) > 0)) return;
  camera_axes(camera, forward, right, up);
  light_page_corners(page, corners);
  for (int k = 0; k < 4; ++k) {
    vector_subtract(corners[k], camera->from, to);
    double depth = half * vector_dot(to, forward);
    double pixel[2] = {(vector_dot(to, right) / depth + 1) / 2 * size[0],
                       (size[1] - vector_dot(to, up) / depth * size[0]) / 2};
    if (depth > 0) {
      widen(pixel, size, area);
    } else { /* behind the camera: it might be anywhere */
      widen(all[0], size, area);
      widen(all[1], size, area);
    }
  }
}

static enum result look_row(void *context, int row, int worker, struct error *error) {
  const struct look *look = context;
  struct viewer_lamps *lamps = look->lamps;
  int y = look->area.low[1] + row;
  (void)worker;
  (void)error;
  for (int x = look->area.low[0]; x < look->area.high[0]; ++x) {
    double direction[3], rgb[3];
    float *pixel = lamps->pixels[(size_t)y * (size_t)lamps->width + (size_t)x];
    camera_ray(look->camera, lamps->width, lamps->height, x + 0.5, y + 0.5, direction);
    double distance =
        light_seen(look->lights, look->count, look->camera->from, direction, INFINITY, rgb);
    if (!isfinite(distance)) continue;
    for (int c = 0; c < 3; ++c) pixel[c] = (float)rgb[c];
    pixel[3] = (float)distance;
  }
  return RESULT_OK;
}

void viewer_lamps_look(struct viewer_lamps *lamps, const struct light *lights, int count,
                       const struct camera *camera, int threads) {
  struct error error;
  const int size[2] = {lamps->width, lamps->height};
  struct look look = {.lamps = lamps,
                      .lights = lights,
                      .count = count,
                      .camera = camera,
                      .area = {{size[0], size[1]}, {0, 0}}};
  for (int l = 0; l < count; ++l)
    for (int page = 0; page < lights[l].count; ++page)
      add_page(&lights[l].pages[page], camera, size, &look.area);
  memset(lamps->pixels, 0, (size_t)size[0] * (size_t)size[1] * sizeof *lamps->pixels);
  lamps->any = look.area.low[0] < look.area.high[0] && look.area.low[1] < look.area.high[1];
  if (lamps->any)
    tiles_run(threads, look.area.high[1] - look.area.low[1], look_row, NULL, &look, &error);
}
