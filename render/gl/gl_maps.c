#include "gl/gl_maps.h"

#include <epoxy/gl.h>
#include <stdlib.h>

#include "gl/gl_program.h"

/* Bytes of all maps at a time. */
static const double most_memory = 0x1p28;

static enum result upload(const struct scene *scene, const double origin[3], struct gl_maps *maps,
                          struct error *error) {
  if (scene->triangles > INT32_MAX / 3)
    return gl_fail(error, RESULT_BAD, "%zu triangles are more than it can draw", scene->triangles);
  float *corners = calloc(scene->vertices + 1, 3 * sizeof *corners);
  if (!corners) return result_no_memory(error);
  for (size_t k = 0; k < 3 * scene->vertices; ++k)
    corners[k] = (float)(scene->position[k / 3][k % 3] - origin[k % 3]);
  maps->indices = 3 * (int)scene->triangles;
  glGenVertexArrays(1, &maps->mesh);
  glBindVertexArray(maps->mesh);
  glGenBuffers(1, &maps->corners);
  glBindBuffer(GL_ARRAY_BUFFER, maps->corners);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(scene->vertices * 3 * sizeof *corners), corners,
               GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
  glEnableVertexAttribArray(0);
  glGenBuffers(1, &maps->triangles);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, maps->triangles);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(scene->triangles * sizeof *scene->corners),
               scene->corners, GL_STATIC_DRAW);
  free(corners);
  return gl_check("the mesh", error);
}

int gl_maps_most(int size, const struct gl_limits *limits) {
  int most = (int)(most_memory / (4.0 * size * size));
  if (most < 1) return 1;
  return most < limits->layers ? most : limits->layers;
}

static enum result make_layers(struct gl_maps *maps, struct error *error) {
  maps->texture = gl_texture(GL_TEXTURE_2D_ARRAY, GL_NEAREST);
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_DEPTH_COMPONENT32F, maps->size, maps->size, maps->room);
  glGenFramebuffers(1, &maps->target);
  return gl_check("the shadow maps", error);
}

enum result gl_maps_create(const struct scene *scene, const double origin[3], int size, int room,
                           const struct gl_limits *limits, struct gl_maps *maps,
                           struct error *error) {
  *maps = (struct gl_maps){.size = size, .room = room};
  if (size > limits->texture)
    return gl_fail(error, RESULT_BAD,
                   "--shadow-map %d: this driver's textures have %d texels a side", size,
                   limits->texture);
  enum result result = gl_program_make(gl_map_vert, gl_map_frag, "", &maps->program, error);
  if (result == RESULT_OK) result = upload(scene, origin, maps, error);
  if (result == RESULT_OK) result = make_layers(maps, error);
  if (result != RESULT_OK) gl_maps_free(maps);
  return result;
}

void gl_maps_free(struct gl_maps *maps) {
  glDeleteTextures(1, &maps->texture);
  glDeleteFramebuffers(1, &maps->target);
  glDeleteVertexArrays(1, &maps->mesh);
  glDeleteBuffers(1, &maps->corners);
  glDeleteBuffers(1, &maps->triangles);
  glDeleteProgram(maps->program);
  *maps = (struct gl_maps){0};
}

/* The part of the st plane that the map covers, wider than the page's window by what the
 * group's outer views see beside its middle one, down to an aperture's distance. */
static void set_window(const struct gl_slides *slides, unsigned program) {
  const struct light_axis *axes = slides->page->axes;
  double window[4], kappa[2], near = 1e-6 * (axes[0].half + axes[1].half);
  for (int axis = 0; axis < 2; ++axis) {
    const struct light_axis *a = &axes[axis];
    double inner = a->half / a->near_count;
    double margin = (slides->group_half[axis] - inner) / (a->half + inner);
    kappa[axis] = a->kappa;
    window[axis] = a->far_low - margin;
    window[2 + axis] = 1 / (a->far_high - a->far_low + 2 * margin);
  }
  gl_set_floats(program, "map_window", 4, window);
  gl_set_floats(program, "kappa", 2, kappa);
  gl_set_floats(program, "near", 1, &near);
}

void gl_maps_draw(struct gl_maps *maps, const struct gl_slides *slides, int first, int count,
                  int layer) {
  static const float nothing = 0;
  glBindFramebuffer(GL_FRAMEBUFFER, maps->target);
  glBindVertexArray(maps->mesh);
  glUseProgram(maps->program);
  glViewport(0, 0, maps->size, maps->size);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  set_window(slides, maps->program);
  gl_set_floats(maps->program, "center", 3, slides->center);
  gl_set_frame(maps->program, slides->page->frame);
  for (int k = 0; k < count; ++k) {
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, maps->texture, 0, layer + k);
    glClearBufferfv(GL_DEPTH, 0, &nothing);
    gl_set_floats(maps->program, "at", 2, slides->middle[first + k]);
    glDrawElements(GL_TRIANGLES, maps->indices, GL_UNSIGNED_INT, NULL);
  }
  glDisable(GL_DEPTH_TEST);
  maps->drawn += (uint64_t)count;
}

void gl_maps_set(const struct gl_maps *maps, const struct gl_slides *slides, int first,
                 unsigned program, int unit) {
  set_window(slides, program);
  gl_set_int(program, "first_map", first);
  gl_set_texture(program, "maps", unit, GL_TEXTURE_2D_ARRAY, maps->texture);
  gl_set_texture(program, "map_centers", unit + 1, GL_TEXTURE_BUFFER, slides->middles);
}
