/* photometry_body.h - the luminous body of a lamp and the box around it.
 *
 * The body is convex and centred on the origin. All rays in a direction that meet it carry the same
 * radiance, and they leave the box around it through exactly one of its faces, so that none counts
 * twice. A face is a rectangle with edges u and v and an outward normal; its points are
 * (a, b), distances from its middle along u and v. */
#ifndef PHOTOMETRY_BODY_H
#define PHOTOMETRY_BODY_H

#include "import/photometric/photometry.h"

enum { BODY_FACES = 6 }; /* down, up, then towards C0, C90, C180, C270 */

struct photometry_face {
  double center[3], u[3], v[3], normal[3];
  double size[2]; /* lengths of u and v; 0: the face sends nothing */
};

struct photometry_body {
  enum photometry_shape shape; /* a point has become a box */
  int axis;
  double size[3];
  struct photometry_face face[BODY_FACES];
};

/* The lamp's body. What has no size gets one: a point a square of PHOTOMETRY_POINT_SIZE metres that
 * faces down, or +x if it is of type A, a line BODY_THIN of its length. With `thick`, something
 * flat gets sides too: a point's square becomes a cube, others get at least BODY_THIN of their next
 * larger size. */
#define PHOTOMETRY_POINT_SIZE 0.01
#define BODY_THIN 0.05
void photometry_body(const struct photometry *lamp, bool thick, struct photometry_body *body);

/* Whether a face shines alike in all directions: boxes, and what is flat. */
bool photometry_is_even(const struct photometry_body *body);

/* Whether u (axis 0) or v of a face runs along the side of a cylinder. */
bool photometry_runs_along(const struct photometry_body *body, int face, int axis);

/* Flat, or so thin that it is nearly so. */
bool photometry_is_thin(const struct photometry_body *body);

/* Its projected area towards a unit vector, m2. */
double photometry_area(const struct photometry_body *body, const double direction[3]);

/* The same of the rays that leave the box through one face. */
double photometry_face_area(const struct photometry_body *body, int face,
                            const double direction[3]);

/* From where to where along u the rays that leave a face at `b` in a direction come from the body;
 * within the face. False: none does. */
bool photometry_row(const struct photometry_body *body, int face, const double direction[3],
                    double b, double from_to[2]);

#endif
