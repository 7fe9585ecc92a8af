#include "pov/pov.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/output.h"
#include "base/sdl.h"
#include "base/vector.h"
#include "scene/scene.h"

/* As a word of a shell. */
static void print_word(const char *text, FILE *out) {
  putc('\'', out);
  for (; *text; ++text) {
    if (*text == '\'')
      fputs("'\\''", out);
    else
      putc((unsigned char)*text < ' ' ? '?' : *text, out);
  }
  putc('\'', out);
}

static void print_vector(const char *before, const double v[3], FILE *out) {
  fprintf(out, "%s<%.15g, %.15g, %.15g>", before, v[0], v[1], v[2]);
}

static void print_header(const char *path, const struct shade *view, const char *command,
                         FILE *out) {
  fputs("// Made by: ", out);
  sdl_comment(command, out);
  fputs("\n// Render it in the folder where that ran, by\n//   povray +I", out);
  print_word(path, out);
  fprintf(out,
          " +W%d +H%d -A +FE +Oview.exr -D\n"
          "// The picture then holds radiances, as that of `renderslab image' does.\n"
          "// The lamps light the scene, but are not seen in it.\n"
          "#version 3.7;\n"
          "global_settings { assumed_gamma 1 ambient_light 0 }\n",
          view->width, view->height);
  print_vector("background { rgb ", view->background, out);
  fputs(" }\n\n", out);
}

/* Sides of the image plane at distance 1: rays pass the middles of pixels, as ours do. */
static void print_camera(const struct shade *view, FILE *out) {
  double forward[3], right[3], up[3];
  camera_axes(&view->camera, forward, right, up);
  double width = 2 * tan(view->camera.fov * M_PI / 360);
  double height = width * view->height / view->width;
  for (int c = 0; c < 3; ++c) {
    right[c] *= width;
    up[c] *= height;
  }
  fprintf(out, "camera { // %.15g degrees wide\n", view->camera.fov);
  print_vector("  location ", view->camera.from, out);
  print_vector("\n  direction ", forward, out);
  print_vector("\n  right ", right, out);
  print_vector("\n  up ", up, out);
  fputs("\n}\n\n", out);
}

static double mean(const double rgb[3]) {
  return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

static bool grey(const double rgb[3]) {
  return rgb[0] == rgb[1] && rgb[1] == rgb[2];
}

/* What POV-Ray calls a kind of image. Those of 8 bits hold sRGB values. */
struct image_kind {
  const char *suffix, *name;
  bool srgb;
};

/* Of a material's texture; NULL without one and for one that POV-Ray does not read. */
static const struct image_kind *image_kind(const struct scene *scene,
                                           const struct scene_material *material) {
  static const struct image_kind kinds[] = {
      {".png", "png", true},  {".jpg", "jpeg", true},  {".jpeg", "jpeg", true},
      {".tga", "tga", true},  {".bmp", "bmp", true},   {".gif", "gif", true},
      {".tif", "tiff", true}, {".tiff", "tiff", true}, {".ppm", "ppm", true},
      {".exr", "exr", false}, {".hdr", "hdr", false}};
  const char *path = material->texture >= 0 ? scene->textures[material->texture].path : "";
  const char *suffix = strrchr(path, '.');
  for (size_t k = 0; suffix && k < sizeof kinds / sizeof *kinds; ++k)
    if (!strcasecmp(suffix, kinds[k].suffix)) return &kinds[k];
  return NULL;
}

/* The pigment, and what diffuse must be for it; textures are multiplied by one number only. */
static double print_pigment(const struct scene *scene, const struct scene_material *material,
                            FILE *out) {
  const struct image_kind *kind = image_kind(scene, material);
  if (!kind) {
    print_vector("pigment { rgb ", material->diffuse, out);
    fputs(" }", out);
    return 1;
  }
  fprintf(out, "pigment { uv_mapping image_map { %s ", kind->name);
  sdl_string(scene->textures[material->texture].path, out);
  fprintf(out, " %sinterpolate 2 } }", kind->srgb ? "gamma srgb " : "");
  return mean(material->diffuse);
}

/* An emitting surface is the average of a reflecting and an emitting texture, each twice as
 * strong. */
static void print_texture(const struct scene *scene, const struct scene_material *material,
                          FILE *out) {
  bool gloss = scene_glossy(material);
  const double *glow = material->emission;
  bool shines = !vector_is_zero(glow);
  double twice = shines ? 2 : 1;
  fputs("    texture { ", out);
  if (shines) fputs("average texture_map {\n      [1 ", out);
  double diffuse = print_pigment(scene, material, out);
  fprintf(out, " finish { ambient 0 diffuse %.15g", twice * diffuse);
  if (gloss)
    fprintf(out, " specular %.15g roughness %.15g", twice * mean(material->specular),
            1 / material->shininess);
  fputs(" }", out);
  if (shines) {
    const double doubled[3] = {twice * glow[0], twice * glow[1], twice * glow[2]};
    print_vector("]\n      [1 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission rgb ",
                 doubled, out);
    fputs(" }] }", out);
  }
  fputs(" }", out);
}

/* What is lost of a material; NULL for nothing. */
static const char *loss(const struct scene *scene, const struct scene_material *material) {
  bool textured = material->texture >= 0;
  if (textured && !image_kind(scene, material))
    return "POV-Ray does not read its texture: left out";
  if (textured && !grey(material->diffuse))
    return "POV-Ray multiplies a texture by one number: the mean of the diffuse colour";
  if (material->shininess > 0 && !grey(material->specular))
    return "POV-Ray's highlights have one amount: the mean of the specular colour";
  return NULL;
}

static void print_textures(const struct scene *scene, char note[256], FILE *out) {
  fprintf(out, "  texture_list { %d,\n", scene->material_count);
  for (int k = 0; k < scene->material_count; ++k) {
    const struct scene_material *material = &scene->materials[k];
    const char *lost = loss(scene, material);
    fputs("    // ", out);
    sdl_comment(material->name, out);
    if (lost) {
      fprintf(out, "\n    // %s", lost);
      if (!*note) snprintf(note, 256, "material %s: %s", material->name, lost);
    }
    putc('\n', out);
    print_texture(scene, material, out);
    fputs(k + 1 < scene->material_count ? ",\n" : "\n", out);
  }
  fputs("  }\n", out);
}

/* Vectors of so many numbers each, one after the other. */
static void print_list(const char *name, size_t count, int size, const double *numbers, FILE *out) {
  fprintf(out, "  %s { %zu,\n", name, count);
  for (size_t k = 0; k < count; ++k) {
    for (int c = 0; c < size; ++c) fprintf(out, "%s%.9g", c ? ", " : "    <", *numbers++);
    fputs(k + 1 < count ? ">,\n" : ">\n", out);
  }
  fputs("  }\n", out);
}

static void print_mesh(const struct scene *scene, char note[256], FILE *out) {
  bool textured = false;
  for (int k = 0; k < scene->material_count; ++k) textured |= scene->materials[k].texture >= 0;
  fputs("mesh2 {\n", out);
  print_list("vertex_vectors", scene->vertices, 3, scene->position[0], out);
  print_list("normal_vectors", scene->vertices, 3, scene->normal[0], out);
  if (textured) print_list("uv_vectors", scene->vertices, 2, scene->uv[0], out);
  print_textures(scene, note, out);
  fprintf(out, "  face_indices { %zu,\n", scene->triangles);
  for (size_t k = 0; k < scene->triangles; ++k) {
    const int *corner = scene->corners[k];
    fprintf(out, "    <%d, %d, %d>, %d%s\n", corner[0], corner[1], corner[2], scene->material[k],
            k + 1 < scene->triangles ? "," : "");
  }
  fputs("  }\n}\n\n", out);
}

static void print_includes(const struct pov_includes *includes, FILE *out) {
  for (int k = 0; k < includes->count; ++k) {
    const struct pov_include *include = &includes->list[k];
    fprintf(out, "#declare %s_Sheet_File = ", include->name);
    sdl_string(include->image, out);
    fputs(";\n#include ", out);
    sdl_string(include->path, out);
    putc('\n', out);
  }
  putc('\n', out);
}

/* The scale is the macro's argument: POV-Ray's `scale` leaves a light's brightness alone. */
static void print_light(const struct light *light, const char *name, FILE *out) {
  double scale = vector_length(light->matrix[0]);
  const double *gain = light->gain;
  fprintf(out, "object { %s_Canned(%.15g, ", name, scale);
  if (gain[0] == gain[1] && gain[0] == gain[2])
    fprintf(out, "%.15g", gain[0]);
  else
    fprintf(out, "rgb <%.15g, %.15g, %.15g>", gain[0], gain[1], gain[2]);
  fputs(")\n  matrix <", out);
  for (int row = 0; row < 4; ++row)
    for (int c = 0; c < 3; ++c)
      fprintf(out, "%.15g%s", light->matrix[row][c] / (row < 3 ? scale : 1),
              row == 3 && c == 2 ? "> }\n" : ", ");
}

static void print_scene(const char *path, const struct shade *view,
                        const struct pov_includes *includes, const char *command, char note[256],
                        FILE *out) {
  print_header(path, view, command, out);
  print_includes(includes, out);
  print_camera(view, out);
  for (int k = 0; k < view->light_count; ++k)
    print_light(&view->lights[k], includes->list[includes->of_light[k]].name, out);
  putc('\n', out);
  print_mesh(view->scene, note, out);
}

enum result pov_write(const char *path, const struct shade *view,
                      const struct pov_includes *includes, const char *command, char note[256],
                      struct error *error) {
  char *text = NULL;
  size_t length = 0;
  FILE *out = open_memstream(&text, &length);
  note[0] = 0;
  if (out) print_scene(path, view, includes, command, note, out);
  enum result result =
      !out || fclose(out) != 0 || !text /* glibc's fclose may lose the text without a word */
          ? result_no_memory(error)
          : output_text(path, text, length, error);
  free(text);
  return result;
}
