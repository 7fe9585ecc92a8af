/* viewer_error.c - how far the picture is from exact sums and shadow rays, by some of its pixels.
 */
#include <math.h>

#include "viewer/viewer_picture.h"

enum { COLUMNS = 16 };

/* Much less than views and shadow maps err by. */
static const double tolerance = 0.003;

/* What the camera sees there: the pixels in the middles of COLUMNS x VIEWER_PICTURE_ROWS. */
static enum result sum_row(const struct viewer_picture *picture, int y, const int x[COLUMNS],
                           double exact[COLUMNS][3], struct error *error) {
  const struct viewer_world *world = picture->world;
  const struct gather_settings settings = {.lights = world->lights,
                                           .light_count = world->light_count,
                                           .method = GATHER_AUTO,
                                           .tolerance = tolerance,
                                           .occlusion =
                                               picture->how.shadows ? world->occlusion : NULL,
                                           .shadow_grid = 16,
                                           .shadow_edge = 256};
  struct shade shade = {.scene = world->scene,
                        .occlusion = world->occlusion,
                        .lights = world->lights,
                        .light_count = world->light_count,
                        .camera = picture->camera,
                        .width = picture->taken.width,
                        .height = picture->taken.height};
  for (int c = 0; c < 3; ++c) shade.background[c] = world->background[c];
  struct shade_hit hits[COLUMNS];
  struct gather *gather = NULL;
  enum result result = gather_create(&settings, &gather, error);
  for (int k = 0; k < COLUMNS && result == RESULT_OK; ++k) {
    struct gathered gathered = {0};
    double unused[3];
    shade_ray(&shade, x[k] + 0.5, y + 0.5, 0, &hits[k]);
    if (hits[k].lit) result = gather_light(gather, &hits[k].receiver, 1, &gathered, error);
    shade_radiance(&hits[k], &gathered, exact[k], unused);
  }
  gather_free(gather);
  return result;
}

enum result viewer_picture_check(struct viewer_picture *picture, struct error *error) {
  struct picture *taken = &picture->taken;
  enum result result = RESULT_OK;
  if (picture->done < 1 || picture->checked == VIEWER_PICTURE_ROWS) return RESULT_OK;
  if (!taken->rgb) result = gl_show_read(&picture->show, taken, error);
  if (result != RESULT_OK) return result;
  double exact[COLUMNS][3];
  int x[COLUMNS], y = (2 * picture->checked + 1) * taken->height / (2 * VIEWER_PICTURE_ROWS);
  for (int k = 0; k < COLUMNS; ++k) x[k] = (2 * k + 1) * taken->width / (2 * COLUMNS);
  result = sum_row(picture, y, x, exact, error);
  if (result != RESULT_OK) return result;
  for (int k = 0; k < COLUMNS; ++k)
    for (int c = 0; c < 3; ++c) {
      size_t at = 3 * ((size_t)y * (size_t)taken->width + (size_t)x[k]) + (size_t)c;
      picture->squares[0] += pow((double)taken->rgb[at] - exact[k][c], 2);
      picture->squares[1] += pow(exact[k][c], 2);
    }
  if (++picture->checked == VIEWER_PICTURE_ROWS)
    picture->exact = picture->squares[1] > 0 ? sqrt(picture->squares[0] / picture->squares[1]) : 0;
  return RESULT_OK;
}
