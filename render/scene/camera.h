/* camera.h - a perspective camera, POV-Ray's: `right` is to the right of `up` and the view in
 * a left-handed frame, pixels are square, and rays go through the middle of pixels. */
#ifndef CAMERA_H
#define CAMERA_H

#include "base/result.h"

struct camera {
  double from[3], at[3], up[3]; /* as given */
  double fov;                   /* horizontal, degrees */
};

/* Parses "from=X,Y,Z at=X,Y,Z [up=X,Y,Z] [fov=DEG]"; up is 0,1,0 and fov 60 by default.
 * Refuses numbers that are not finite, from = at, up along the view, and fov outside ]0,180[. */
enum result camera_parse(const char *text, struct camera *camera, struct error *error);

/* The same refusals, for one that comes from elsewhere; `what` names it. */
enum result camera_check(const char *what, const struct camera *camera, struct error *error);

/* Unit vectors along the view, to the right and up. */
void camera_axes(const struct camera *camera, double forward[3], double right[3], double up[3]);

/* The unit direction through (x, y), in pixels from the top left corner of the image. */
void camera_ray(const struct camera *camera, int width, int height, double x, double y,
                double direction[3]);

#endif
