#include "import/pictures/import_pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/pictures/light_picture.h"
#include "import/pictures/posed.h"
#include "import/pictures/views.h"
#include "slab/slab_resample.h"

/* ---- An array of views ---- */

/* The slab without samples, but for the numbers of directions, which the views tell. */
static enum result views_geometry(const struct import_wish *wish, struct slab *slab,
                                  struct error *error) {
  const struct import_aperture *aperture = &wish->apertures[0];
  double length = 0, metres = wish->metres > 0 ? wish->metres : 1;
  if (wish->aperture_count != 1 || !(wish->window[0] < wish->window[1]))
    return result_fail(error, RESULT_BAD,
                       "views do not say where they were taken: give --center, --u, --v, --normal "
                       "once, and --window");
  *slab = slab_default();
  for (int c = 0; c < 3; ++c) {
    slab->center[c] = aperture->center[c] * metres;
    slab->u[c] = aperture->u[c] * metres;
    slab->v[c] = aperture->v[c] * metres;
    length = hypot(length, aperture->normal[c]);
  }
  for (int c = 0; c < 3; ++c) slab->normal[c] = aperture->normal[c] / length;
  memcpy(slab->st_window, wish->window, sizeof slab->st_window);
  if (wish->distance > 0) slab->st_distance = wish->distance * metres;
  enum result result = views_check(wish->files[0], error);
  if (result == RESULT_OK) result = slab_check(slab, error);
  return result == RESULT_OK ? views_count(wish->files[0], slab->samples, error) : result;
}

/* Puts view (i, j) into the slab; the first allocates it. */
static enum result add_view(const struct import_wish *wish, struct slab_images *images, int i,
                            int j, struct slab *slab, struct error *error) {
  struct picture picture = {0};
  char *path = views_name(wish->files[0], i, j);
  if (!path) return result_no_memory(error);
  enum result result =
      light_picture_read(images, path, wish->exposure > 0 ? wish->exposure : 1, &picture, error);
  if (result == RESULT_OK && !slab->rgb) {
    slab->samples[SLAB_S] = picture.width;
    slab->samples[SLAB_T] = picture.height;
    result = slab_alloc(slab, error);
  }
  if (result == RESULT_OK &&
      (picture.width != slab->samples[SLAB_S] || picture.height != slab->samples[SLAB_T]))
    result =
        result_fail(error, RESULT_BAD, "%s: is %d x %d pixels, not %d x %d as the first view", path,
                    picture.width, picture.height, slab->samples[SLAB_S], slab->samples[SLAB_T]);
  for (int l = 0; l < picture.height && result == RESULT_OK; ++l)
    memcpy(slab_at(slab, i, j, 0, l), picture.rgb + 3 * (size_t)l * (size_t)picture.width,
           3 * sizeof(float) * (size_t)picture.width);
  picture_free(&picture);
  free(path);
  return result;
}

/* Other resolutions, where they are asked for. */
static enum result resample(const struct import_wish *wish, struct slab *slab,
                            struct error *error) {
  struct slab other;
  int samples[SLAB_AXES];
  for (int k = 0; k < 2; ++k) {
    samples[SLAB_U + k] = wish->uv[k] ? wish->uv[k] : slab->samples[SLAB_U + k];
    samples[SLAB_S + k] = wish->st[k] ? wish->st[k] : slab->samples[SLAB_S + k];
  }
  if (!memcmp(samples, slab->samples, sizeof samples)) return RESULT_OK;
  enum result result = slab_resample(slab, samples, &other, error);
  if (result != RESULT_OK) return result;
  slab_free(slab);
  *slab = other;
  return RESULT_OK;
}

static enum result views_slabs(const struct import_wish *wish, struct import_light *light,
                               struct error *error) {
  double rgb[3];
  light->slabs = calloc(1, sizeof *light->slabs);
  if (!light->slabs) return result_no_memory(error);
  light->count = 1;
  struct slab *slab = light->slabs;
  enum result result = result_at(views_geometry(wish, slab, error), error, "%s", wish->files[0]);
  struct slab_images images = {0};
  int views[2] = {slab->samples[SLAB_U], slab->samples[SLAB_V]};
  for (int j = 0; j < views[1] && result == RESULT_OK; ++j)
    for (int i = 0; i < views[0] && result == RESULT_OK; ++i)
      result = add_view(wish, &images, i, j, slab, error);
  slab_images_close(&images);
  if (result == RESULT_OK) result = resample(wish, slab, error);
  if (result == RESULT_OK) result = slab_flux_metric(slab, rgb, error);
  if (result != RESULT_OK) return result;
  light->story = (struct import_story){
      .flux_in = NAN,
      .flux_out = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2],
      .error = NAN,
      .sample_error = NAN,
      .flux_error = NAN,
      .points = true,
      .assumptions = "Each picture was taken from the middle of its cell of the aperture, and its "
                     "pixels are radiance in the directions of the middles of the window's cells.",
      .error_is = "Not known: the samples are the pictures' pixels."};
  return RESULT_OK;
}

/* ---- Pictures with poses ---- */

/* JSON: no other file that can be imported begins with a brace. */
static bool is_posed(const char *head, size_t size, const char *path) {
  (void)size, (void)path;
  if (!strncmp(head, "\xef\xbb\xbf", 3)) head += 3;
  return head[strspn(head, " \t\r\n")] == '{';
}

/* The names of views are asked for, not found by content. */
static bool is_views(const char *head, size_t size, const char *path) {
  (void)head, (void)size, (void)path;
  return false;
}

const struct import_kind import_views = {"views", is_views, IMPORT_PICTURES, views_slabs};
const struct import_kind import_posed = {"posed pictures", is_posed, IMPORT_PICTURES, posed_slabs};
