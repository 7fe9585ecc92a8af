/* bake_scene.h - the POV-Ray scene of one batch: the lamp script, its effects, and the cameras of
 * the batch's units in one of three forms. One image by a mesh_camera of many cameras is cheapest,
 * since it is one POV-Ray process and one parse of the script; an animation, a frame a camera, is
 * for a POV-Ray whose mesh_camera does not work; transposed, a frame shows all positions in one
 * direction. */
#ifndef BAKE_SCENE_H
#define BAKE_SCENE_H

#include "batch/bake_plan.h"
#include "lamp/effects.h"
#include "lamp/lamp.h"

struct bake_look {
  enum bake_form form;
  int defect_rows; /* image rows that mesh_camera wastes */
  enum bake_offsets offsets;
  bool dark;   /* without the bulbs: what else gives light */
  double gain; /* power of two by which the picture is brighter than the lamp */
  const struct effects *effects;
};

/* The text of scene.pov; the caller frees it. NULL without memory. */
char *bake_scene_text(const struct bake_look *look, const struct slab *slabs, int pages,
                      const struct bake_round *round, const struct bake_batch *batch);

/* Size and number of the images. */
void bake_scene_size(const struct bake_look *look, const struct bake_round *round,
                     const struct bake_batch *batch, struct povray_job *job);

/* Reads the batch's rays from its frames: rgb gets 3 floats a ray, unit by unit.
 * Refuses frames of the wrong size and rays that are not finite. */
enum result bake_scene_read(const struct bake_look *look, const struct bake_round *round,
                            const struct bake_batch *batch, const struct povray_job *job,
                            float *rgb, struct error *error);

#endif
