#include "gl/gl_raster.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "gl/gl_program.h"

/* A corner of a triangle, as raster.vert.glsl takes it. */
struct corner {
  float position[3], normal[3], geometric[3], uv[2];
};

static void set_corner(const struct gl_raster *raster, size_t triangle, int k,
                       struct corner *corner) {
  const struct scene *scene = raster->scene;
  const int *corners = scene->corners[triangle];
  double geometric[3];
  scene_geometric(scene, triangle, geometric);
  for (int c = 0; c < 3; ++c) {
    corner->position[c] = (float)(scene->position[corners[k]][c] - raster->origin[c]);
    corner->normal[c] = (float)scene->normal[corners[k]][c];
    corner->geometric[c] = (float)geometric[c];
  }
  for (int c = 0; c < 2; ++c) corner->uv[c] = (float)scene->uv[corners[k]][c];
}

/* Groups the corners by material: each is drawn at once. */
static void set_corners(struct gl_raster *raster, struct corner *corners) {
  const struct scene *scene = raster->scene;
  int first = 0;
  for (size_t k = 0; k < scene->triangles; ++k) raster->parts[scene->material[k]].count += 3;
  for (int k = 0; k < scene->material_count; ++k) {
    const struct scene_material *material = &scene->materials[k];
    struct gl_raster_part *part = &raster->parts[k];
    part->first = first;
    part->texture = material->texture < 0 ? 0 : raster->textures[material->texture];
    first += part->count;
    raster->glossy = raster->glossy || (part->count > 0 && scene_glossy(material));
    part->count = 0;
  }
  for (size_t k = 0; k < 3 * scene->triangles; ++k) {
    struct gl_raster_part *part = &raster->parts[scene->material[k / 3]];
    set_corner(raster, k / 3, (int)(k % 3), &corners[part->first + part->count++]);
  }
}

static void set_attribute(unsigned place, int count, size_t offset) {
  glVertexAttribPointer(place, count, GL_FLOAT, GL_FALSE, sizeof(struct corner),
                        (const void *)offset);
  glEnableVertexAttribArray(place);
}

static enum result upload_mesh(struct gl_raster *raster, struct error *error) {
  const struct scene *scene = raster->scene;
  size_t count = 3 * scene->triangles;
  if (count > INT32_MAX)
    return gl_fail(error, RESULT_BAD, "%zu triangles are more than it can draw", scene->triangles);
  struct corner *corners = calloc(count + 1, sizeof *corners);
  if (!corners) return result_no_memory(error);
  set_corners(raster, corners);
  glGenVertexArrays(1, &raster->mesh);
  glBindVertexArray(raster->mesh);
  glGenBuffers(1, &raster->corners);
  glBindBuffer(GL_ARRAY_BUFFER, raster->corners);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *corners), corners, GL_STATIC_DRAW);
  set_attribute(0, 3, offsetof(struct corner, position));
  set_attribute(1, 3, offsetof(struct corner, normal));
  set_attribute(2, 3, offsetof(struct corner, geometric));
  set_attribute(3, 2, offsetof(struct corner, uv));
  free(corners);
  return gl_check("the mesh", error);
}

static enum result upload_texture(const struct scene_texture *texture,
                                  const struct gl_limits *limits, unsigned *name,
                                  struct error *error) {
  const struct picture *picture = &texture->picture;
  if (picture->width > limits->texture || picture->height > limits->texture)
    return gl_fail(error, RESULT_BAD, "%s: %d x %d pixels; this driver's textures have %d",
                   texture->path, picture->width, picture->height, limits->texture);
  *name = gl_texture(GL_TEXTURE_2D, GL_LINEAR);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGB32F, picture->width, picture->height);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture->width, picture->height, GL_RGB, GL_FLOAT,
                  picture->rgb);
  return gl_check(texture->path, error);
}

enum result gl_raster_create(const struct scene *scene, const struct gl_limits *limits,
                             struct gl_raster *raster, struct error *error) {
  enum result result = RESULT_OK;
  *raster = (struct gl_raster){.scene = scene};
  for (size_t k = 0; k < scene->vertices; ++k)
    for (int c = 0; c < 3; ++c)
      raster->origin[c] += (scene->position[k][c] - raster->origin[c]) / (double)(k + 1);
  raster->parts = calloc((size_t)scene->material_count + 1, sizeof *raster->parts);
  raster->textures = calloc((size_t)scene->texture_count + 1, sizeof *raster->textures);
  if (!raster->parts || !raster->textures) result = result_no_memory(error);
  for (int k = 0; k < scene->texture_count && result == RESULT_OK; ++k)
    result = upload_texture(&scene->textures[k], limits, &raster->textures[k], error);
  if (result == RESULT_OK) result = upload_mesh(raster, error);
  if (result == RESULT_OK)
    result = gl_program_make(gl_raster_vert, gl_raster_frag, "", &raster->program, error);
  if (result != RESULT_OK) gl_raster_free(raster);
  return result;
}

void gl_raster_free(struct gl_raster *raster) {
  if (!raster->scene) return; /* nothing was made; perhaps there is no context */
  if (raster->textures) glDeleteTextures(raster->scene->texture_count, raster->textures);
  glDeleteVertexArrays(1, &raster->mesh);
  glDeleteBuffers(1, &raster->corners);
  glDeleteProgram(raster->program);
  free(raster->parts);
  free(raster->textures);
  *raster = (struct gl_raster){0};
}

enum result gl_surfaces_create(const struct gl_receivers *receivers, struct gl_surfaces *surfaces,
                               struct error *error) {
  int width = receivers->width, height = receivers->height;
  *surfaces = (struct gl_surfaces){.diffuse = gl_receivers_texture(width, height),
                                   .specular = gl_receivers_texture(width, height),
                                   .shows = gl_receivers_texture(width, height)};
  const unsigned targets[] = {receivers->position, receivers->normal, receivers->lift,
                              receivers->eye,      surfaces->diffuse, surfaces->specular,
                              surfaces->shows};
  GLenum buffers[sizeof targets / sizeof *targets];
  int count = sizeof targets / sizeof *targets;
  glGenRenderbuffers(1, &surfaces->depth);
  glBindRenderbuffer(GL_RENDERBUFFER, surfaces->depth);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glGenFramebuffers(1, &surfaces->target);
  glBindFramebuffer(GL_FRAMEBUFFER, surfaces->target);
  for (int k = 0; k < count; ++k) {
    buffers[k] = GL_COLOR_ATTACHMENT0 + (GLenum)k;
    glFramebufferTexture(GL_FRAMEBUFFER, buffers[k], targets[k], 0);
  }
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, surfaces->depth);
  glDrawBuffers(count, buffers);
  enum result result = gl_check("the picture", error);
  if (result == RESULT_OK && glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    result =
        gl_fail(error, RESULT_IO, "the driver cannot draw %d pictures of %d x %d floats at once",
                count, width, height);
  if (result != RESULT_OK) gl_surfaces_free(surfaces);
  return result;
}

void gl_surfaces_free(struct gl_surfaces *surfaces) {
  const unsigned textures[] = {surfaces->diffuse, surfaces->specular, surfaces->shows};
  glDeleteFramebuffers(1, &surfaces->target);
  glDeleteRenderbuffers(1, &surfaces->depth);
  glDeleteTextures(3, textures);
  *surfaces = (struct gl_surfaces){0};
}

static void set_camera(const struct gl_raster *raster, const struct camera *camera, int width,
                       int height) {
  double from[3], frame[3][3], view[3], half = tan(camera->fov * (M_PI / 360));
  double zoom[2] = {1 / half, width / (half * height)};
  vector_subtract(camera->from, raster->origin, from);
  vector_subtract(camera->at, camera->from, view);
  double near = 1e-6 * vector_length(view);
  camera_axes(camera, frame[2], frame[0], frame[1]);
  gl_set_floats(raster->program, "from", 3, from);
  gl_set_frame(raster->program, frame);
  gl_set_floats(raster->program, "zoom", 2, zoom);
  gl_set_floats(raster->program, "near", 1, &near);
}

static void set_material(const struct scene_material *material, unsigned texture,
                         unsigned program) {
  static const double none[3] = {0};
  bool gloss = scene_glossy(material);
  gl_set_floats(program, "diffuse", 3, material->diffuse);
  gl_set_floats(program, "specular", 3, gloss ? material->specular : none);
  gl_set_floats(program, "emission", 3, material->emission);
  gl_set_floats(program, "shininess", 1, gloss ? &material->shininess : none);
  gl_set_int(program, "textured", texture != 0);
  gl_set_texture(program, "picture", 0, GL_TEXTURE_2D, texture);
}

static void clear(const struct gl_surfaces *surfaces, const double background[3]) {
  static const float nothing[4] = {0}, no_receiver[4] = {0, 0, 0, -1};
  const float behind[4] = {(float)background[0], (float)background[1], (float)background[2], 0};
  glBindFramebuffer(GL_FRAMEBUFFER, surfaces->target);
  glClearBufferfv(GL_COLOR, 0, no_receiver);
  for (int k = 1; k < 6; ++k) glClearBufferfv(GL_COLOR, k, nothing);
  glClearBufferfv(GL_COLOR, 6, behind);
  glClearBufferfv(GL_DEPTH, 0, nothing);
}

void gl_raster_draw(const struct gl_raster *raster, const struct camera *camera,
                    const double origin[3], const double background[3],
                    const struct gl_receivers *receivers, const struct gl_surfaces *surfaces) {
  double shift[3];
  clear(surfaces, background);
  glViewport(0, 0, receivers->width, receivers->height);
  glUseProgram(raster->program);
  glBindVertexArray(raster->mesh);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  set_camera(raster, camera, receivers->width, receivers->height);
  vector_subtract(raster->origin, origin, shift);
  gl_set_floats(raster->program, "shift", 3, shift);
  for (int k = 0; k < raster->scene->material_count; ++k) {
    const struct gl_raster_part *part = &raster->parts[k];
    set_material(&raster->scene->materials[k], part->texture, raster->program);
    if (part->count > 0) glDrawArrays(GL_TRIANGLES, part->first, part->count);
  }
  glDisable(GL_DEPTH_TEST);
}
