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
          "// The camera sees into lamps whose includes are sheets, and what is behind them.\n"
          "#version 3.7;\n"
          "global_settings { assumed_gamma 1 ambient_light 0 }\n",
          view->width, view->height);
  print_vector("background { rgb ", view->background, out);
  fputs(" }\n\n", out);
}

/* POV-Ray's matrix: the images of x, y and z, and the translation. */
static void print_matrix(const double matrix[4][3], FILE *out) {
  fputs("matrix <", out);
  for (int row = 0; row < 4; ++row)
    for (int c = 0; c < 3; ++c)
      fprintf(out, "%.15g%s", matrix[row][c], row == 3 && c == 2 ? ">" : ", ");
}

/* Sides of the image plane at distance 1: rays pass the middles of pixels, as ours do. Where the
 * scene is moved (NULL: it is not), the camera is too. */
static void print_camera(const struct shade *view, const double move[4][3], FILE *out) {
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
  if (move) {
    fputs("\n  ", out);
    print_matrix(move, out);
  }
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

/* `textures` NULL: as the scene says; otherwise all of the mesh has this one. */
static void print_mesh(const struct scene *scene, const char *textures, const char *modifiers,
                       char note[256], FILE *out) {
  bool textured = false;
  for (int k = 0; k < scene->material_count; ++k) textured |= scene->materials[k].texture >= 0;
  fputs("mesh2 {\n", out);
  print_list("vertex_vectors", scene->vertices, 3, scene->position[0], out);
  print_list("normal_vectors", scene->vertices, 3, scene->normal[0], out);
  if (textured && !textures) print_list("uv_vectors", scene->vertices, 2, scene->uv[0], out);
  if (!textures) print_textures(scene, note, out);
  fprintf(out, "  face_indices { %zu,\n", scene->triangles);
  for (size_t k = 0; k < scene->triangles; ++k) {
    const int *corner = scene->corners[k];
    fprintf(out, "    <%d, %d, %d>", corner[0], corner[1], corner[2]);
    if (!textures) fprintf(out, ", %d", scene->material[k]);
    fputs(k + 1 < scene->triangles ? ",\n" : "\n", out);
  }
  fputs("  }\n", out);
  if (textures) fprintf(out, "  %s\n", textures);
  fprintf(out, "%s}\n\n", modifiers);
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

/* From the scene's space to the lamp's: matrix is a similarity. */
static void invert(const double matrix[4][3], double inverse[4][3]) {
  double square = vector_dot(matrix[0], matrix[0]);
  for (int row = 0; row < 3; ++row)
    for (int c = 0; c < 3; ++c) inverse[row][c] = matrix[c][row] / square;
  for (int c = 0; c < 3; ++c) inverse[3][c] = -vector_dot(matrix[3], matrix[c]) / square;
}

/* Whether the macro draws a face of the light: a page is in front of the camera. It refuses a
 * camera in an opening. */
static bool has_face(const struct light *light, const double from[3]) {
  bool front = false;
  for (int page = 0; page < light->count; ++page) {
    const struct light_page *seen = &light->pages[page];
    double to_eye[3], least = 4e-6 * fmax(seen->axes[0].half, seen->axes[1].half);
    vector_subtract(from, seen->center, to_eye);
    double before = vector_dot(to_eye, seen->frame[2]);
    front |= before > least;
    if (fabs(before) <= least && fabs(vector_dot(to_eye, seen->frame[0])) <= seen->axes[0].half &&
        fabs(vector_dot(to_eye, seen->frame[1])) <= seen->axes[1].half)
      return false;
  }
  return front;
}

/* The scale is the macro's argument: POV-Ray's `scale` leaves a light's brightness alone. */
static void print_object(const char *name, const char *macro, const struct light *light,
                         const double eye[3], FILE *out) {
  double scale = vector_length(light->matrix[0]);
  const double *gain = light->gain;
  fprintf(out, "object { %s_%s(%.15g, ", name, macro, scale);
  if (gain[0] == gain[1] && gain[0] == gain[2])
    fprintf(out, "%.15g", gain[0]);
  else
    fprintf(out, "rgb <%.15g, %.15g, %.15g>", gain[0], gain[1], gain[2]);
  if (eye) print_vector(", ", eye, out);
  double unscaled[4][3];
  for (int row = 0; row < 4; ++row)
    for (int c = 0; c < 3; ++c) unscaled[row][c] = light->matrix[row][c] / (row < 3 ? scale : 1);
  fputs(")\n  ", out);
  print_matrix(unscaled, out);
  fputs(" }\n", out);
}

/* The lamp's light and, where the camera may look into it, its face: the camera is seen from the
 * object before that is turned and moved. */
static void print_light(const struct light *light, const struct pov_include *include,
                        const double from[3], FILE *out) {
  double inverse[4][3], eye[3], scale = light->scale;
  for (int n = 0; n < light->channel_count; ++n)
    fprintf(out, "%s_Canned_Channel(\"%s\", %.15g)\n", include->name, light->channels[n].name,
            light->channels[n].gain);
  print_object(include->name, "Canned", light, NULL, out);
  if (!include->face || !has_face(light, from)) return;
  invert(light->matrix, inverse);
  for (int c = 0; c < 3; ++c)
    eye[c] = scale * (from[0] * inverse[0][c] + from[1] * inverse[1][c] + from[2] * inverse[2][c] +
                      inverse[3][c]);
  print_object(include->name, "Canned_Face", light, eye, out);
}

static void print_scene(const char *path, const struct shade *view,
                        const struct pov_includes *includes, const char *command, char note[256],
                        FILE *out) {
  print_header(path, view, command, out);
  print_includes(includes, out);
  print_camera(view, NULL, out);
  for (int k = 0; k < view->light_count; ++k)
    print_light(&view->lights[k], &includes->list[includes->of_light[k]], view->camera.from, out);
  putc('\n', out);
  print_mesh(view->scene, NULL, "", note, out);
}

/* ---- The lamp itself ---- */

/* The mesh, moved to the lamp. Rays that gather light for radiosity must meet it, since it throws
 * shadows, but must bring no light from it: they see a black copy, which pictures do not show. */
static void print_moved_mesh(const struct shade *view, const struct pov_lamp *lamp, FILE *out) {
  double move[4][3];
  char note[256] = "";
  invert(lamp->light->matrix, move);
  fputs("union {\n", out);
  if (lamp->mark)
    print_mesh(view->scene, "pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 1e4 }", "",
               note, out);
  else
    print_mesh(view->scene, NULL, lamp->gather ? "  no_radiosity\n" : "", note, out);
  if (lamp->gather && !lamp->mark)
    print_mesh(view->scene, "pigment { rgb 0 } finish { ambient 0 diffuse 0 }", "  no_image\n",
               note, out);
  fputs("  ", out);
  print_matrix(move, out);
  fputs("\n}\n\n", out);
  print_camera(view, move, out);
}

static void print_lamp(const struct shade *view, const struct pov_lamp *lamp, FILE *out) {
  fputs("#version 3.7;\n#declare Canned_Baking = 1;\n", out);
  fprintf(out, "#declare Canned_Bake_Effects = \"%s\";\n",
          lamp->photons ? "caustics extended_source" : "extended_source");
  if (lamp->photons) fprintf(out, "#declare Canned_Bake_Photons = %d;\n", lamp->photons);
  fputs("#include ", out);
  sdl_string(lamp->script, out);
  fputs("\n", out);
  if (lamp->gather && !lamp->mark)
    fprintf(out,
            "global_settings {\n"
            "  radiosity { pretrace_start 0.08 pretrace_end 0.01 count %d, %d error_bound 0.2\n"
            "    nearest_count 10 recursion_limit 3 low_error_factor 0.7 minimum_reuse 0.01\n"
            "    gray_threshold 0 brightness 1 }\n}\n",
            lamp->gather, 10 * lamp->gather);
  print_vector("background { rgb ", view->background, out);
  fputs(" }\n\n", out);
  print_moved_mesh(view, lamp, out);
}

/* ---- Files ---- */

static enum result finish(const char *path, FILE *out, char **text, size_t *length,
                          struct error *error) {
  enum result result =
      !out || fclose(out) != 0 || !*text /* glibc's fclose may lose the text without a word */
          ? result_no_memory(error)
          : output_text(path, *text, *length, error);
  free(*text);
  return result;
}

enum result pov_write_lamp(const char *path, const struct shade *view, const struct pov_lamp *lamp,
                           struct error *error) {
  char *text = NULL;
  size_t length = 0;
  FILE *out = open_memstream(&text, &length);
  if (out) print_lamp(view, lamp, out);
  return finish(path, out, &text, &length, error);
}

enum result pov_write(const char *path, const struct shade *view,
                      const struct pov_includes *includes, const char *command, char note[256],
                      struct error *error) {
  char *text = NULL;
  size_t length = 0;
  FILE *out = open_memstream(&text, &length);
  note[0] = 0;
  if (out) print_scene(path, view, includes, command, note, out);
  return finish(path, out, &text, &length, error);
}
