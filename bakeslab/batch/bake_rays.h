/* bake_rays.h - the rays of a bake: where each pass puts them in the samples'
 * cells, and the camera that shoots a box of them.
 *
 * A sample is the mean of the radiance over its 4D cell, taken by passes; a pass
 * shoots one ray a sample, off the cell's centre by a point of a low-discrepancy
 * sequence. Offsets come in antithetic pairs: passes 2q and 2q+1 are mirror images, so
 * that a radiance linear over the cell comes out exact. */
#ifndef BAKE_RAYS_H
#define BAKE_RAYS_H

#include "slab/slab.h"

/* A box of samples of one page that one camera covers in one pass: either all
 * the directions wanted at one position, or all the positions wanted of one
 * direction. Rays are ordered as the raster is: v slowest, then t, u, s. */
struct bake_box {
  int page;
  int first[SLAB_AXES], size[SLAB_AXES];
};

int bake_box_rays(const struct bake_box *box);

/* Where a pass puts its rays. CENTRE: through the centres of the cells. SHARED: all samples have
 * the same offset, so that positions and directions stay on grids and every form of camera shoots
 * the same rays. OWN: each camera shifts the sequence for itself; where tiles get few passes, what
 * these miss then differs from view to view and averages out, instead of aliasing with
 * parts of the lamp that repeat as the cells do. */
enum bake_offsets { BAKE_CENTRE, BAKE_SHARED, BAKE_OWN };

/* The pass that looks for light, before all others. Its cameras are at the middles of the cells,
 * and a camera's rays one cell apart: a beam that is a sample wide along every axis is met by just
 * one of its rays, wherever it lies. No sample contains them. */
enum { BAKE_SEARCH = -1 };

/* The offset of a box's rays in a pass, in cells, each in (-1/2, 1/2). */
void bake_offset(enum bake_offsets kind, const struct bake_box *box, int pass,
                 double offset[SLAB_AXES]);

/* The camera of a box: pixel x of 0..width-1 and y of 0..height-1 (row 0 on top)
 * look from `origin` (or, orthographic, from origin + x, y along across and down)
 * along -(toward + across and down). Lengths of across and down span the image. */
struct bake_camera {
  bool orthographic;
  int width, height;
  double origin[3];
  double toward[3]; /* direction in which the light comes, of the image's middle */
  double across[3], down[3];
};

void bake_camera(const struct slab *slab, const struct bake_box *box,
                 const double offset[SLAB_AXES], struct bake_camera *camera);

/* The rows of the matrix that places a copy of the direction mesh of
 * include-pov/canned_bake.inc as this (perspective) camera. */
void bake_camera_matrix(const struct slab *slab, const struct bake_camera *camera,
                        double rows[4][3]);
/* The power of two e of that mesh. */
double bake_mesh_epsilon(int width, int height);

#endif
