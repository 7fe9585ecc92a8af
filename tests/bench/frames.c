/* frames.c - how long a picture of receivers takes by OpenGL: `frames SLAB MESH WIDTH HEIGHT
 * [GROUPS]` prints milliseconds a frame, one pass and a pass a view, with shadows if GROUPS is
 * there (0: a map a view), and the renderer's name. The receivers are what figure 3's camera
 * sees; tracing them is not counted. Each is the median of some frames, interleaved. */
#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "gl/gl_sum.h"
#include "scene/camera.h"
#include "scene/scene.h"
#include "shadow/occlusion.h"

enum { FRAMES = 3 };

static struct error error;

static void must(enum result result) {
  if (result == RESULT_OK) return;
  fprintf(stderr, "frames: %s\n", error.text);
  exit(1);
}

static void fill(unsigned texture, int width, int height, const float *pixels) {
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, pixels);
}

/* What the camera sees, matte. */
static void see(const struct scene *scene, const double origin[3],
                const struct gl_receivers *receivers) {
  struct camera camera;
  struct occlusion *occlusion;
  size_t count = (size_t)receivers->width * (size_t)receivers->height;
  float *position = calloc(count, 4 * sizeof *position),
        *normal = calloc(count, 4 * sizeof *normal);
  must(camera_parse("from=-12,34,-100 at=-2,13,0 fov=52", &camera, &error));
  must(occlusion_create(scene, &occlusion, &error));
  if (!position || !normal) exit(1);
  for (size_t k = 0; k < count; ++k) {
    double direction[3], point[3], n[3], flat[3];
    struct occlusion_hit hit;
    camera_ray(&camera, receivers->width, receivers->height,
               (double)(k % (size_t)receivers->width) + 0.5,
               (double)(k / (size_t)receivers->width) + 0.5, direction);
    position[4 * k + 3] = -1;
    if (!occlusion_nearest(occlusion, camera.from, direction, &hit)) continue;
    scene_point(scene, hit.triangle, hit.share, point, n, flat);
    double side = flat[0] * direction[0] + flat[1] * direction[1] + flat[2] * direction[2];
    for (int c = 0; c < 3; ++c) {
      position[4 * k + (size_t)c] = (float)(point[c] - origin[c]);
      normal[4 * k + (size_t)c] = (float)(side > 0 ? -flat[c] : flat[c]);
    }
    position[4 * k + 3] = 0;
  }
  fill(receivers->position, receivers->width, receivers->height, position);
  fill(receivers->normal, receivers->width, receivers->height, normal);
  fill(receivers->lift, receivers->width, receivers->height, normal);
  free(position);
  free(normal);
  occlusion_free(occlusion);
}

static int by_size(const void *left, const void *right) {
  const double *a = left, *b = right;
  return (*a > *b) - (*a < *b);
}

static double frame(struct gl_sum *sum, const struct gl_receivers *receivers) {
  double start = progress_now();
  gl_sum_clear(receivers);
  must(gl_sum_add(sum, receivers, 0, 1, false, &error));
  glFinish();
  return 1e3 * (progress_now() - start);
}

int main(int argc, char **argv) {
  struct light light;
  struct scene scene;
  struct gl_context *context;
  struct gl_sum sum;
  struct gl_receivers receivers;
  char text[1000], note[256];
  double ms[2][FRAMES];
  if (argc < 5) return 2;
  snprintf(text, sizeof text, "%s at=0,36,0", argv[1]);
  must(light_load(text, &light, &error));
  must(scene_load(argv[2], SCENE_SURFACES, true, &scene, note, &error));
  must(gl_context_create(&context, &error));
  struct gl_sum_settings settings = {.lights = &light,
                                     .light_count = 1,
                                     .map_size = 2048,
                                     .occluders = argc > 5 ? &scene : NULL,
                                     .groups = argc > 5 ? atoi(argv[5]) : 0};
  must(gl_sum_create(&settings, &sum, &error));
  must(gl_receivers_create(atoi(argv[3]), atoi(argv[4]), &sum.limits, &receivers, &error));
  see(&scene, sum.origin, &receivers);
  for (int k = -1; k < FRAMES; ++k) /* the first compiles shaders and is left out */
    for (int separate = 0; separate < 2; ++separate) {
      sum.settings.separate = separate;
      ms[separate][k < 0 ? 0 : k] = frame(&sum, &receivers);
    }
  for (int separate = 0; separate < 2; ++separate)
    qsort(ms[separate], FRAMES, sizeof **ms, by_size);
  printf("%.4g %.4g %s\n", ms[0][FRAMES / 2], ms[1][FRAMES / 2], sum.limits.name);
  gl_receivers_free(&receivers);
  gl_sum_free(&sum);
  gl_context_free(context);
  scene_free(&scene);
  light_free(&light);
  return 0;
}
