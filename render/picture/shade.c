#include "picture/shade.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "scene/scene.h"
#include "shadow/occlusion.h"

static void turn_towards(const double eye[3], double normal[3]) {
  if (vector_dot(eye, normal) >= 0) return;
  for (int c = 0; c < 3; ++c) normal[c] = -normal[c];
}

static void shade_surface(const struct shade *shade, const struct occlusion_hit *met,
                          const double direction[3], uint64_t index, struct shade_hit *hit) {
  const struct scene *scene = shade->scene;
  const struct scene_material *material = &scene->materials[scene->material[met->triangle]];
  struct receiver *receiver = &hit->receiver;
  memcpy(hit->shows, material->emission, sizeof hit->shows);
  scene_diffuse(scene, met->triangle, met->share, hit->diffuse);
  bool gloss = scene_glossy(material);
  if (gloss) memcpy(hit->specular, material->specular, sizeof hit->specular);
  hit->lit = gloss || !vector_is_zero(hit->diffuse);
  if (!hit->lit) return;
  scene_point(scene, met->triangle, met->share, receiver->position, receiver->normal,
              receiver->lift);
  for (int c = 0; c < 3; ++c) receiver->eye[c] = -direction[c];
  turn_towards(receiver->eye, receiver->normal);
  turn_towards(receiver->eye, receiver->lift);
  receiver->shininess = gloss ? material->shininess : 0;
  receiver->index = index;
}

void shade_ray(const struct shade *shade, double x, double y, uint64_t index,
               struct shade_hit *hit) {
  const double *origin = shade->camera.from;
  double direction[3], lamp[3];
  struct occlusion_hit met;
  memset(hit, 0, sizeof *hit);
  camera_ray(&shade->camera, shade->width, shade->height, x, y, direction);
  bool surface = occlusion_nearest(shade->occlusion, origin, direction, &met);
  double limit = surface ? met.distance : INFINITY;
  double distance = light_seen(shade->lights, shade->light_count, origin, direction, limit, lamp);
  if (distance < limit)
    memcpy(hit->shows, lamp, sizeof lamp);
  else if (surface)
    shade_surface(shade, &met, direction, index, hit);
  else
    memcpy(hit->shows, shade->background, sizeof hit->shows);
}

void shade_radiance(const struct shade_hit *hit, const struct gathered *gathered, double rgb[3],
                    double error[3]) {
  for (int c = 0; c < 3; ++c) {
    rgb[c] = hit->shows[c];
    error[c] = 0;
    if (!hit->lit) continue;
    double lit =
        (hit->diffuse[c] * gathered->irradiance[c] + hit->specular[c] * gathered->gloss[c]) / M_PI;
    rgb[c] += lit;
    if (lit != 0) error[c] = fabs(lit) * gathered->error;
  }
}
