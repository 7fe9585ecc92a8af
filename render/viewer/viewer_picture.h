/* viewer_picture.h - the picture that the viewer shows: surfaces are rasterised, and views of the
 * lights added until all are in. Needs a current context, until it is freed; no window. */
#ifndef VIEWER_PICTURE_H
#define VIEWER_PICTURE_H

#include "gather/gather.h"
#include "gl/gl_show.h"
#include "picture/shade.h"
#include "viewer/viewer_lamps.h"

/* How the light is summed. */
struct viewer_sum {
  int level; /* of the hierarchy */
  bool shadows;
  int groups; /* of shadow maps along an axis; 0: one for each view */
};

struct viewer_world {
  const struct scene *scene;
  const struct occlusion *occlusion; /* of the scene */
  struct light *lights;
  int light_count;
  struct gather_prepared *prepared; /* of method gl */
  double background[3];
  int map_size; /* of shadow maps */
  int threads;
};

struct viewer_picture {
  const struct viewer_world *world;
  double low[3], high[3]; /* of the scene */
  struct camera camera;
  struct gl_raster raster;
  struct gl_receivers receivers;
  struct gl_surfaces surfaces;
  struct gl_show show;
  struct viewer_lamps lamps;
  struct gl_sum sum;
  int64_t views;         /* of all pages, without black ones */
  int64_t black, behind; /* views that are skipped: black ones, and those of pages with nothing in
                            front of them */
  double done;           /* share of the views that are in */
  double kept;           /* share of the picture that `change` compares with */
  double change;         /* relative RMS, since about half as many views; INFINITY: not known */
  struct viewer_sum how;
  bool full;    /* all views of level 0 have been seen, with all else as it is */
  double error; /* relative RMS against that, last told with `change`; INFINITY: not known. Shadow
                   maps are the same in both, so that their errors are not in it */
  /* Of viewer_picture_check: */
  struct picture taken; /* the picture that is checked; owned */
  int checked;          /* rows of pixels, of VIEWER_PICTURE_ROWS */
  double squares[2];    /* sums: of errors, of exact radiances */
  double exact;         /* relative RMS against exact sums; INFINITY: not known */
};

enum { VIEWER_PICTURE_ROWS = 16 };

/* The world outlives the picture. Sizes are those of the frame buffer. */
enum result viewer_picture_create(const struct viewer_world *world, const struct viewer_sum *how,
                                  int width, int height, struct viewer_picture *picture,
                                  struct error *error);
void viewer_picture_free(struct viewer_picture *picture); /* zeroed picture allowed */

/* After these, viewer_picture_start is due. */
enum result viewer_picture_set_sum(struct viewer_picture *picture, const struct viewer_sum *how,
                                   struct error *error);
enum result viewer_picture_resize(struct viewer_picture *picture, int width, int height,
                                  struct error *error);

/* Puts a light elsewhere, as light_move. */
bool viewer_picture_move(struct viewer_picture *picture, int light, const double matrix[4][3]);

/* Sets the gain of a light's channel, as light_set_channel; viewer_picture_set_sum is due too. */
void viewer_picture_dim(struct viewer_picture *picture, int light, int channel, double gain);

/* Draws the surfaces as the camera sees them, without light. */
void viewer_picture_start(struct viewer_picture *picture, const struct camera *camera);

/* Adds so large a share of the views, up to all; the picture shows the estimate of the whole. */
enum result viewer_picture_add(struct viewer_picture *picture, double share, struct error *error);

/* Once all views are in: compares one more row of 16 pixels with exact sums and, if the picture has
 * shadows, shadow rays. After 16 of them `exact` is the error, of views, shadow maps and edges. */
enum result viewer_picture_check(struct viewer_picture *picture, struct error *error);

#endif
