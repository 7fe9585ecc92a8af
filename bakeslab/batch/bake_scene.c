#include "batch/bake_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "slab/plane.h"

/* Of a mesh_camera image, in pixels. The faces of a mesh run on from row to row; in a narrow image
 * the rays of one of POV-Ray's blocks, 32 x 32 pixels, are close together. */
enum { IMAGE_WIDTH = 256 };

static const struct bake_box *unit_box(const struct bake_round *round, size_t unit) {
  return &round->boxes[round->units[unit].box];
}

static void print_vector(FILE *out, const double vector[3], double factor) {
  fprintf(out, "<%.17g,%.17g,%.17g>", factor * vector[0], factor * vector[1], factor * vector[2]);
}

/* ---- Gain ---- */

/* Every camera looks at the lamp through a filter that multiplies radiance by the gain. It lies
 * just outside each uv plane, and the cameras just outside of it, so that nothing in the lamp can
 * touch it. It works on camera rays only, and only from outside: rays that leave an open lamp
 * through another slab are multiplied already. POV-Ray ignores what is nearer to a camera than
 * 1e-4, its MIN_ISECT_DEPTH. */
static double camera_distance(const struct slab *slab) {
  return 2e-5 * fmax(10, plane_edge(slab, SLAB_U));
}
static const double filter_distance = 0.2; /* of the camera's */

/* Half an edge of the filter, so that every ray of a camera behind it passes through. */
static double filter_reach(const struct slab *slab, int axis) {
  double length = plane_edge(slab, axis);
  const double *window = slab->st_window + 2 * axis;
  double slope = fmax(fabs(window[0]), fabs(window[1])) + 0.5 * slab_kappa(slab) * length;
  return 0.51 * length + 2 * camera_distance(slab) * slope;
}

/* Whether u x v points against the normal. */
static bool is_mirrored(const struct slab *slab) {
  double triple = 0;
  for (int x = 0; x < 3; ++x) {
    int y = (x + 1) % 3, z = (x + 2) % 3;
    triple += slab->normal[x] * (slab->u[y] * slab->v[z] - slab->u[z] * slab->v[y]);
  }
  return triple < 0;
}

static void print_filter(FILE *out, double gain, const struct slab *slab) {
  /* POV-Ray puts the texture on the side of u x v, for corners in this order. */
  static const double at[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  const char *sides[2] = {"texture", "interior_texture"};
  bool mirrored = is_mirrored(slab);
  double reach[2];
  for (int axis = SLAB_U; axis <= SLAB_V; ++axis)
    reach[axis] = filter_reach(slab, axis) / plane_edge(slab, axis);
  fputs("polygon { 5, ", out);
  for (int c = 0; c < 5; ++c) {
    double corner[3];
    for (int axis = 0; axis < 3; ++axis)
      corner[axis] = slab->center[axis] + at[c][0] * reach[0] * slab->u[axis] +
                     at[c][1] * reach[1] * slab->v[axis] +
                     filter_distance * camera_distance(slab) * slab->normal[axis];
    print_vector(out, corner, 1);
  }
  for (int side = 0; side < 2; ++side)
    fprintf(out, "\n  %s { pigment { rgb %.17g filter 1 } finish { ambient 0 diffuse 0 } }",
            sides[side], (side == 1) == mirrored ? gain : 1);
  fputs("\n  no_shadow no_radiosity no_reflection photons { pass_through } }\n", out);
}

static bool same_vector(const double a[3], const double b[3]) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Whether another page in the same plane has a filter that serves this one too. */
static bool has_wider(const struct slab *slabs, int pages, int page) {
  const struct slab *slab = &slabs[page];
  for (int n = 0; n < pages; ++n) {
    const struct slab *other = &slabs[n];
    double more[2];
    if (n == page || !same_vector(slab->center, other->center) ||
        !same_vector(slab->normal, other->normal))
      continue;
    for (int axis = 0; axis < 2; ++axis)
      more[axis] = filter_reach(other, axis) - filter_reach(slab, axis);
    if (more[0] >= 0 && more[1] >= 0 && (more[0] + more[1] > 0 || n > page)) return true;
  }
  return false;
}

static void print_head(FILE *out, const struct bake_look *look, const struct slab *slabs, int pages,
                       const char *channel, const struct povray_job *job) {
  fputs("// Written by bakeslab: one batch of a bake. Again: povray render.ini (but with "
        "highlights)\n#version 3.7;\n",
        out);
  effects_declare(look->effects, out);
  if (look->dark) fputs("#declare Canned_Bake_Dark = 1;\n", out);
  if (*channel) fprintf(out, "#declare Canned_Bake_Channel = \"%s\";\n", channel);
  /* A radiosity pretrace finer than every 16th pixel costs much and changes 0.01 %. */
  if (look->effects->setting[INTERREFLECTION])
    fprintf(out, "#declare Canned_Bake_Pretrace = 16/%d;\n",
            job->height > job->width ? job->height : job->width);
  fputs("#include \"canned_bake.inc\"\n#include \"" LAMP_SCRIPT "\"\nCanned_Neutral()\n", out);
  if (look->gain != 1) {
    fprintf(out, "global_settings { adc_bailout %.17g }\n", fmin(1, look->gain) / 255);
    for (int page = 0; page < pages; ++page)
      if (!has_wider(slabs, pages, page)) print_filter(out, look->gain, &slabs[page]);
  }
}

/* ---- Cameras ---- */

static void unit_camera(const struct bake_look *look, const struct slab *slabs,
                        const struct bake_round *round, size_t unit, struct bake_camera *camera) {
  double offset[SLAB_AXES];
  const struct bake_box *box = unit_box(round, unit);
  bake_offset(look->offsets, box, round->units[unit].pass, offset);
  const struct slab *slab = &slabs[box->page];
  bake_camera(slab, box, offset, camera);
  if (look->gain != 1) /* back along its middle ray, behind the filter */
    for (int axis = 0; axis < 3; ++axis)
      camera->origin[axis] += camera_distance(slab) * camera->toward[axis];
}

static void print_matrix(FILE *out, const struct slab *slab, const struct bake_camera *camera) {
  double rows[4][3];
  bake_camera_matrix(slab, camera, rows);
  fputs("matrix <", out);
  for (int n = 0; n < 12; ++n) fprintf(out, "%s%.17g", n ? "," : "", rows[n / 3][n % 3]);
  fputs("> }\n", out);
}

/* One mesh_camera; boxes of the same size share a mesh of directions. */
static void print_mesh_camera(FILE *out, const struct bake_look *look, const struct slab *slabs,
                              const struct bake_round *round, const struct bake_batch *batch) {
  int width = 0, height = 0;
  for (size_t n = 0; n < batch->count; ++n) {
    const int *size = unit_box(round, batch->first + n)->size;
    if (size[SLAB_S] == width && size[SLAB_T] == height) continue;
    width = size[SLAB_S], height = size[SLAB_T];
    fprintf(out, "#ifndef (D%dx%d) #declare D%dx%d = Canned_Directions(%d, %d, %.17g) #end\n",
            width, height, width, height, width, height, bake_mesh_epsilon(width, height));
  }
  fputs("camera { mesh_camera { 1 1\n", out);
  for (size_t n = 0; n < batch->count; ++n) {
    struct bake_camera camera;
    unit_camera(look, slabs, round, batch->first + n, &camera);
    fprintf(out, "mesh { D%dx%d ", camera.width, camera.height);
    print_matrix(out, &slabs[unit_box(round, batch->first + n)->page], &camera);
  }
  fputs("} location 0 direction z }\n", out);
}

/* An animation: frame n looks through camera n. The image's top is the small end of
 * the rows' axis; POV-Ray's sheared cameras are exact (it warns). */
static void print_animation(FILE *out, const struct bake_look *look, const struct slab *slabs,
                            const struct bake_round *round, const struct bake_batch *batch) {
  fputs("#switch (max(1, frame_number))\n", out);
  for (size_t n = 0; n < batch->count; ++n) {
    struct bake_camera camera;
    unit_camera(look, slabs, round, batch->first + n, &camera);
    /* Directions are -(toward + across + down); positions are origin + across + down. */
    double sign = camera.orthographic ? 1 : -1;
    fprintf(out, "#case (%zu) camera { %s location ", n + 1,
            camera.orthographic ? "orthographic" : "perspective");
    print_vector(out, camera.origin, 1);
    fputs(" direction ", out);
    print_vector(out, camera.toward, -1);
    fputs(" right ", out);
    print_vector(out, camera.across, sign);
    fputs(" up ", out);
    print_vector(out, camera.down, -sign);
    fputs(" } #break\n", out);
  }
  fputs("#end\n", out);
}

void bake_scene_size(const struct bake_look *look, const struct bake_round *round,
                     const struct bake_batch *batch, struct povray_job *job) {
  if (look->form == BAKE_MESH) {
    job->frames = 1;
    job->width = IMAGE_WIDTH;
    job->height = (int)((batch->rays + IMAGE_WIDTH - 1) / IMAGE_WIDTH) + look->defect_rows;
    return;
  }
  const int *size = unit_box(round, batch->first)->size;
  bool transposed = look->form == BAKE_TRANSPOSED;
  job->frames = (int)batch->count;
  job->width = transposed ? size[SLAB_U] : size[SLAB_S];
  job->height = transposed ? size[SLAB_V] : size[SLAB_T];
}

char *bake_scene_text(const struct bake_look *look, const struct slab *slabs, int pages,
                      const struct bake_round *round, const struct bake_batch *batch) {
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  struct povray_job job;
  bake_scene_size(look, round, batch, &job);
  print_head(out, look, slabs, pages, slabs[unit_box(round, batch->first)->page].channel, &job);
  if (look->form == BAKE_MESH)
    print_mesh_camera(out, look, slabs, round, batch);
  else
    print_animation(out, look, slabs, round, batch);
  if (fclose(out) != 0) {
    free(text);
    return NULL;
  }
  return text;
}

/* ---- Reading ---- */

/* Names the sample of a ray that is not finite. */
static enum result refuse_ray(const struct bake_round *round, const struct bake_batch *batch,
                              size_t ray, float value, struct error *error) {
  size_t unit = batch->first;
  for (; ray >= (size_t)bake_box_rays(unit_box(round, unit)); ++unit)
    ray -= (size_t)bake_box_rays(unit_box(round, unit));
  const struct bake_box *box = unit_box(round, unit);
  static const int fastest_first[SLAB_AXES] = {SLAB_S, SLAB_U, SLAB_T, SLAB_V};
  int at[SLAB_AXES];
  for (int n = 0; n < SLAB_AXES; ++n) {
    int axis = fastest_first[n];
    at[axis] = box->first[axis] + (int)(ray % (size_t)box->size[axis]);
    ray /= (size_t)box->size[axis];
  }
  return result_fail(error, RESULT_BAD,
                     "page %d, sample (%d,%d,%d,%d): POV-Ray rendered %s; a lamp brighter than "
                     "half-float pictures can hold needs a smaller --gain",
                     box->page + 1, at[0], at[1], at[2], at[3],
                     isnan(value) ? "something that is not a number" : "an infinite radiance");
}

enum result bake_scene_read(const struct bake_look *look, const struct bake_round *round,
                            const struct bake_batch *batch, const struct povray_job *job,
                            float *rgb, struct error *error) {
  bool mesh = look->form == BAKE_MESH;
  size_t skip = mesh ? (size_t)look->defect_rows * (size_t)job->width * 3 : 0;
  size_t rays = mesh ? batch->rays : (size_t)job->width * (size_t)job->height;
  for (int frame = 0; frame < job->frames; ++frame) {
    struct picture picture = {0};
    enum result result = povray_read_frame(job, frame, &picture, error);
    if (result != RESULT_OK) return result;
    memcpy(rgb + 3 * rays * (size_t)frame, picture.rgb + skip, 3 * rays * sizeof *rgb);
    picture_free(&picture);
  }
  for (size_t n = 0; n < 3 * batch->rays; ++n)
    if (!isfinite(rgb[n])) return refuse_ray(round, batch, n / 3, rgb[n], error);
  return RESULT_OK;
}
