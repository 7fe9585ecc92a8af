/* posed_rays.h - the pixels of posed pictures as rays of a lamp's pages: each pixel is the radiance
 * of the light that comes along its line of sight. Pixels of a picture that meet the same half
 * cell, along all four axes, become one ray, their mean. */
#ifndef POSED_RAYS_H
#define POSED_RAYS_H

#include "base/picture.h"
#include "import/pictures/poses.h"
#include "import/pictures/rebin.h"
#include "import/rays/ray_pages.h"

struct posed_rays {
  const struct ray_pages *pages; /* with samples, windows and distances */
  struct {
    struct rebin_ray *ray; /* owned */
    size_t count, room;
  } page[RAY_PAGES_MOST];
  double seen;   /* light of all pixels: luminance times solid angle */
  double missed; /* of those that meet no page */
  double beyond; /* of those that meet one outside its window */
};

/* Adds a picture, of the pose's size or any where that says none; `source` is its number. The
 * picture's values are divided by 1 + k1 r^2 + k2 r^4 + k3 r^6, with r the distance from its
 * middle, 1 in its corners (the polynomial of Lensfun's vignetting model "pa"). */
enum result posed_rays_add(struct posed_rays *rays, const struct pose *pose,
                           const struct picture *picture, const double vignetting[3],
                           uint32_t source, struct error *error);
void posed_rays_free(struct posed_rays *rays);

#endif
