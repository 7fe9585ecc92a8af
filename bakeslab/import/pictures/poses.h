/* poses.h - transforms.json of Instant-NGP and Nerfstudio: pictures, the cameras that took them,
 * and where these stood.
 *
 * The file's frame is right-handed with z up, as Blender's: its point (x, y, z) is the lamp point
 * (x, z, y), left-handed with y up. A camera looks along its own -z, x to the right and y up;
 * transform_matrix takes its coordinates to the file's. Read are camera_angle_x, camera_angle_y,
 * fl_x, fl_y, cx, cy, w and h, of the file or of a frame, and frames[].file_path and
 * .transform_matrix. Lens distortion (k1 to k6, p1, p2), fisheye and panoramic cameras, rolling
 * shutters and masks are refused by name; other keys are not looked at. */
#ifndef POSES_H
#define POSES_H

#include <stddef.h>

#include "base/result.h"

struct pose {
  char *file;           /* as written, with .exr where the name has no ending; owned */
  double width, height; /* of the picture in pixels; 0: not said */
  double angle[2];      /* camera_angle_x, _y: radians between opposite edges; 0: not said */
  double focal[2];      /* fl_x, fl_y, pixels; 0: not said */
  double middle[2];     /* cx, cy, pixels from the left and the top; NAN: not said */
  double origin[3];     /* lamp space, in the file's unit */
  double right[3], up[3], back[3]; /* unit vectors in lamp space, perpendicular */
};

struct poses {
  int count;
  struct pose *pose; /* owned */
};

/* Reads the text of such a file. Messages do not name it. At least one pose; numbers are finite,
 * focal lengths and sizes positive, and each pose says angle[0] or focal[0]. Free it in any case.
 */
enum result poses_read(const char *text, struct poses *poses, struct error *error);
void poses_free(struct poses *poses);

/* A pose's camera for pictures of a size: complete focal lengths and middle. */
void poses_complete(struct pose *pose, int width, int height);

/* The direction in lamp space, of any length, in which the camera sees a point of the picture, in
 * pixels from its left and its top. The pose is complete. */
void poses_look(const struct pose *pose, double column, double row, double direction[3]);

#endif
