/* scene.c - what is asked of a scene that was loaded. */
#include "scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"

void scene_free(struct scene *scene) {
  free(scene->position);
  free(scene->normal);
  free(scene->uv);
  free(scene->corners);
  free(scene->material);
  free(scene->materials);
  for (int k = 0; k < scene->texture_count; ++k) {
    free(scene->textures[k].path);
    picture_free(&scene->textures[k].picture);
  }
  free(scene->textures);
  free(scene->cameras);
  for (int k = 0; k < SCENE_IGNORED; ++k) free(scene->ignored[k]);
  *scene = (struct scene){0};
}

bool scene_glossy(const struct scene_material *material) {
  return material->shininess > 0 && !vector_is_zero(material->specular);
}

void scene_box(const struct scene *scene, double low[3], double high[3]) {
  vector_box(low, high);
  for (size_t k = 0; k < scene->vertices; ++k) vector_widen(low, high, scene->position[k]);
}

static void share_weights(const double share[2], double weights[3]) {
  weights[0] = 1 - share[0] - share[1];
  weights[1] = share[0];
  weights[2] = share[1];
}

/* Bilinear between the middles of pixels; the picture is repeated. */
static void texture_look_up(const struct picture *picture, double u, double v, double rgb[3]) {
  int size[2] = {picture->width, picture->height}, near[2], far[2];
  double place[2] = {u, 1 - v}, part[2];
  for (int k = 0; k < 2; ++k) {
    double x = (place[k] - floor(place[k])) * size[k] - 0.5;
    double low = floor(x);
    part[k] = x - low;
    near[k] = low < 0 ? size[k] - 1 : (int)low % size[k];
    far[k] = (near[k] + 1) % size[k];
  }
  const float *corner[4];
  for (int k = 0; k < 4; ++k) {
    size_t column = (size_t)(k & 1 ? far[0] : near[0]), row = (size_t)(k & 2 ? far[1] : near[1]);
    corner[k] = picture->rgb + 3 * (row * (size_t)picture->width + column);
  }
  for (int c = 0; c < 3; ++c) {
    double top = (double)corner[0][c] * (1 - part[0]) + (double)corner[1][c] * part[0];
    double bottom = (double)corner[2][c] * (1 - part[0]) + (double)corner[3][c] * part[0];
    rgb[c] = top * (1 - part[1]) + bottom * part[1];
  }
}

void scene_diffuse(const struct scene *scene, size_t triangle, const double share[2],
                   double rgb[3]) {
  const struct scene_material *material = &scene->materials[scene->material[triangle]];
  memcpy(rgb, material->diffuse, 3 * sizeof *rgb);
  if (material->texture < 0) return;
  double weights[3], uv[2] = {0, 0}, texel[3];
  share_weights(share, weights);
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 2; ++c) uv[c] += weights[k] * scene->uv[scene->corners[triangle][k]][c];
  texture_look_up(&scene->textures[material->texture].picture, uv[0], uv[1], texel);
  for (int c = 0; c < 3; ++c) rgb[c] *= texel[c];
}

void scene_geometric(const struct scene *scene, size_t triangle, double normal[3]) {
  const int *corners = scene->corners[triangle];
  double edge[2][3];
  for (int k = 0; k < 2; ++k)
    vector_subtract(scene->position[corners[k + 1]], scene->position[corners[0]], edge[k]);
  vector_cross(edge[0], edge[1], normal);
  vector_normalise(normal);
}

void scene_point(const struct scene *scene, size_t triangle, const double share[2],
                 double position[3], double normal[3], double geometric[3]) {
  const int *corners = scene->corners[triangle];
  double weights[3];
  share_weights(share, weights);
  for (int c = 0; c < 3; ++c) {
    position[c] = normal[c] = 0;
    for (int k = 0; k < 3; ++k) {
      position[c] += weights[k] * scene->position[corners[k]][c];
      normal[c] += weights[k] * scene->normal[corners[k]][c];
    }
  }
  scene_geometric(scene, triangle, geometric);
  /* opposite normals may cancel out */
  if (!vector_normalise(normal)) memcpy(normal, geometric, 3 * sizeof *normal);
  if (vector_dot(normal, geometric) < 0)
    for (int c = 0; c < 3; ++c) geometric[c] = -geometric[c];
}
