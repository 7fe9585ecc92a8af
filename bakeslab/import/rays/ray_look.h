/* ray_look.h - a first look at rays, before apertures are laid where they leave: where they start,
 * where their lines come closest together, and some of them, evenly taken from all. */
#ifndef RAY_LOOK_H
#define RAY_LOOK_H

#include "import/rays/ray_file.h"

struct ray_look {
  unsigned long long rays; /* that carry flux */
  double flux[3];
  double low[3], high[3];  /* the box of their origins */
  double direction[3];     /* sum of flux times direction */
  double lines[6], sum[3]; /* of the virtual focus: see ray_look_focus */
  struct ray *kept;        /* every `every`-th of them; owned */
  size_t kept_count, room;
  unsigned long long every; /* a power of 2 */
};

/* Empty, with memory for `room` rays that are kept, an even number. */
enum result ray_look_new(struct ray_look *look, size_t room, struct error *error);
void ray_look_free(struct ray_look *look); /* zeroed ones allowed */

void ray_look_add(struct ray_look *look, const struct ray *rays, size_t count);

/* The point whose squared distance from the rays' lines, weighted by their flux, is the least
 * (Muschaweck, "Computing the virtual focus of a ray data source"); false where all rays are
 * parallel. */
bool ray_look_focus(const struct ray_look *look, double focus[3]);

/* Rec. 709 luminance of a ray's flux. */
static inline double ray_luminance(const double flux[3]) {
  return 0.2126 * flux[0] + 0.7152 * flux[1] + 0.0722 * flux[2];
}

#endif
