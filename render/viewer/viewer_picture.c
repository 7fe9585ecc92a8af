#include "viewer/viewer_picture.h"

#include <epoxy/gl.h>
#include <math.h>

#include "base/vector.h"
#include "viewer/viewer_camera.h"

enum result viewer_picture_create(const struct viewer_world *world, const struct viewer_sum *how,
                                  int width, int height, struct viewer_picture *picture,
                                  struct error *error) {
  struct gl_limits limits;
  *picture = (struct viewer_picture){.world = world};
  scene_box(world->scene, picture->low, picture->high);
  enum result result = gl_context_check(&limits, error);
  if (result == RESULT_OK)
    result = gl_raster_create(world->scene, &limits, &picture->raster, error);
  if (result == RESULT_OK) result = gl_show_create(&picture->show, error);
  if (result == RESULT_OK) result = viewer_picture_set_sum(picture, how, error);
  if (result == RESULT_OK) result = viewer_picture_resize(picture, width, height, error);
  if (result != RESULT_OK) viewer_picture_free(picture);
  return result;
}

static void forget_check(struct viewer_picture *picture) {
  picture_free(&picture->taken);
  picture->checked = 0;
  picture->squares[0] = picture->squares[1] = 0;
  picture->exact = INFINITY;
}

static void free_receivers(struct viewer_picture *picture) {
  viewer_lamps_free(&picture->lamps);
  if (picture->surfaces.target) gl_surfaces_free(&picture->surfaces);
  if (picture->receivers.target) gl_receivers_free(&picture->receivers);
}

void viewer_picture_free(struct viewer_picture *picture) {
  forget_check(picture);
  free_receivers(picture);
  gl_sum_free(&picture->sum);
  gl_show_free(&picture->show);
  gl_raster_free(&picture->raster);
  *picture = (struct viewer_picture){0};
}

/* Does the page have something in front of it? By the scene's box. */
static bool lights_something(const struct viewer_picture *picture, const struct light_page *page) {
  double farthest = 0;
  for (int c = 0; c < 3; ++c)
    farthest += fmax((picture->low[c] - page->center[c]) * page->frame[2][c],
                     (picture->high[c] - page->center[c]) * page->frame[2][c]);
  return farthest > 0;
}

static void count_views(struct viewer_picture *picture) {
  picture->views = picture->black = picture->behind = 0;
  for (int k = 0; k < picture->sum.pages; ++k) {
    struct gl_slides *slides = &picture->sum.slides[k];
    const struct light_axis *axes = slides->page->axes;
    slides->behind = !lights_something(picture, slides->page);
    picture->views += slides->behind ? 0 : slides->count;
    picture->behind += slides->behind ? slides->count : 0;
    picture->black += (int64_t)axes[0].near_count * axes[1].near_count - slides->count;
  }
}

enum result viewer_picture_set_sum(struct viewer_picture *picture, const struct viewer_sum *how,
                                   struct error *error) {
  const struct viewer_world *world = picture->world;
  struct gl_sum_settings settings = {.lights = world->lights,
                                     .light_count = world->light_count,
                                     .levels = world->prepared->levels,
                                     .level = how->level,
                                     .occluders = how->shadows ? world->scene : NULL,
                                     .map_size = world->map_size,
                                     .groups = how->groups};
  picture->full =
      picture->full && how->shadows == picture->how.shadows && how->groups == picture->how.groups;
  picture->how = *how;
  gl_sum_free(&picture->sum);
  enum result result = gl_sum_create(&settings, &picture->sum, error);
  if (result == RESULT_OK) count_views(picture);
  return result;
}

enum result viewer_picture_resize(struct viewer_picture *picture, int width, int height,
                                  struct error *error) {
  picture->full = false;
  free_receivers(picture);
  enum result result =
      gl_receivers_create(width, height, &picture->sum.limits, &picture->receivers, error);
  if (result == RESULT_OK)
    result = gl_surfaces_create(&picture->receivers, &picture->surfaces, error);
  if (result == RESULT_OK) result = gl_show_resize(&picture->show, &picture->receivers, error);
  if (result == RESULT_OK) result = viewer_lamps_create(width, height, &picture->lamps, error);
  return result;
}

bool viewer_picture_move(struct viewer_picture *picture, int light, const double matrix[4][3]) {
  struct light *lights = picture->world->lights;
  int number = light_pages(lights, light);
  if (!light_move(&lights[light], matrix)) return false;
  for (int k = 0; k < lights[light].count; ++k)
    levels_move(&picture->world->prepared->levels[number + k], &lights[light].pages[k]);
  gl_sum_moved(&picture->sum, light);
  picture->full = false;
  count_views(picture);
  return true;
}

void viewer_picture_dim(struct viewer_picture *picture, int light, int channel, double gain) {
  light_set_channel(&picture->world->lights[light], channel, gain);
  picture->full = false;
}

void viewer_picture_start(struct viewer_picture *picture, const struct camera *camera) {
  const struct viewer_world *world = picture->world;
  bool seen = picture->lamps.any;
  picture->full = picture->full && viewer_camera_same(camera, &picture->camera);
  picture->camera = *camera;
  picture->done = picture->kept = 0;
  picture->change = picture->error = INFINITY;
  forget_check(picture);
  gl_raster_draw(&picture->raster, camera, picture->sum.origin, world->background,
                 &picture->receivers, &picture->surfaces);
  gl_sum_clear(&picture->receivers);
  viewer_lamps_look(&picture->lamps, world->lights, world->light_count, camera, world->threads);
  if (seen || picture->lamps.any) gl_show_set_lamps(&picture->show, picture->lamps.pixels[0]);
}

/* Compares the picture with one of half as many views, whenever their number has doubled, and
 * with that of all views. */
static void tell_change(struct viewer_picture *picture) {
  const struct gl_show *show = &picture->show;
  if (picture->done < 1 && picture->done < 2 * picture->kept) return;
  if (picture->done >= 1 && picture->how.level == 0) {
    gl_show_keep(show, show->full);
    picture->full = true;
  }
  if (picture->kept > 0) picture->change = gl_show_change(show, show->before);
  if (picture->full) picture->error = gl_show_change(show, show->full);
  gl_show_keep(show, show->before);
  picture->kept = picture->done;
}

enum result viewer_picture_add(struct viewer_picture *picture, double share, struct error *error) {
  double from[3], to = fmin(picture->done + share, 1);
  enum result result = gl_sum_add(&picture->sum, &picture->receivers, picture->done, to,
                                  picture->raster.glossy, error);
  if (result != RESULT_OK) return result;
  picture->done = to;
  vector_subtract(picture->camera.from, picture->sum.origin, from);
  gl_show_draw(&picture->show, &picture->receivers, &picture->surfaces, picture->sum.unit / to,
               from);
  tell_change(picture);
  return RESULT_OK;
}
