/* viewer_camera.h - moving a camera around what it looks at. Angles in radians. */
#ifndef VIEWER_CAMERA_H
#define VIEWER_CAMERA_H

#include "scene/camera.h"
#include "scene/scene.h"

/* One that sees the whole scene from its front, a little from above. */
struct camera viewer_camera_outside(const struct scene *scene);

bool viewer_camera_same(const struct camera *a, const struct camera *b);

/* From the camera to the point that it looks at. */
double viewer_camera_distance(const struct camera *camera);

/* Moves around that point, to the camera's right and upwards, up to straight above it. */
void viewer_camera_orbit(struct camera *camera, double right, double up);

/* Moves to its own right and upwards, in lengths. */
void viewer_camera_pan(struct camera *camera, double right, double up);

/* Multiplies the distance. */
void viewer_camera_zoom(struct camera *camera, double factor);

/* Turns a vector in the plane of two unit vectors that are perpendicular, from p towards q. */
void viewer_camera_turn(double vector[3], const double p[3], const double q[3], double angle);

#endif
