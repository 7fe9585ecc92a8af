#include "import/pictures/light_picture.h"

#include <math.h>
#include <stddef.h>

enum result light_picture_read(struct slab_images *images, const char *path, double factor,
                               struct picture *picture, struct error *error) {
  struct slab_image_says says;
  enum result result =
      slab_images_read(images, path, NULL, 0, NULL, SLAB_IMAGE_OWN, picture, &says, error);
  if (result != RESULT_OK) return result;
  if (says.integers)
    result = result_fail(error, RESULT_BAD,
                         "%s: is not linear: it holds integers; give a floating-point picture of "
                         "the light itself (OpenEXR, Radiance's HDR, PFM, TIFF)",
                         path);
  else if (says.transparent)
    result =
        result_fail(error, RESULT_BAD, "%s: has transparent pixels; save it without alpha", path);
  else if (says.several)
    result =
        result_fail(error, RESULT_BAD, "%s: has several pictures; keep the one that counts", path);
  else if (!(fabs(says.pixel_aspect - 1) <= 0.01))
    result = result_fail(error, RESULT_BAD, "%s: says that its pixels are not square", path);
  size_t count = 3 * (size_t)picture->width * (size_t)picture->height;
  for (size_t n = 0; n < count && result == RESULT_OK; ++n) {
    picture->rgb[n] = (float)(factor * (double)picture->rgb[n]);
    if (!isfinite(picture->rgb[n]))
      result = result_fail(error, RESULT_BAD, "%s: is too bright for the factor %g", path, factor);
  }
  if (result != RESULT_OK) picture_free(picture);
  return result;
}
