/* ways_pictures.c - what includes and methods cost and err by: sheets are measured on the finest
 * slab of each number of positions, which is how many lights they have, all others on the finest
 * slab. With the others of the same lamp they cost and err by nearly the same. */
#include <errno.h>
#include <libgen.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/files.h"
#include "file/slab_exr.h"
#include "tradeoff/ways.h"

/* A cluster of more lights costs more to fit than it saves here. */
const struct ways_picture ways_pictures[WAYS_PICTURES] = {
    {WAYS_SHEET, 16, 0},    {WAYS_SHEET, 8, 0},     {WAYS_SHEET, 4, 0},
    {WAYS_CLUSTER, 16, 0},  {WAYS_POINT, 1, 0},     {WAYS_METHOD, 0, 0.1},
    {WAYS_METHOD, 0, 0.03}, {WAYS_METHOD, 0, 0.01}, {WAYS_METHOD, 0, 0.001},
};

bool ways_in_povray(int picture) {
  return ways_pictures[picture].kind != WAYS_METHOD;
}

void ways_name(const struct ways_bake *bake, const struct ways_picture *picture,
               char name[WAYS_NAME]) {
  switch (picture->kind) {
  case WAYS_SHEET:
    snprintf(name, WAYS_NAME, picture->lights < bake->uv ? "include --lights %d" : "include",
             picture->lights);
    break;
  case WAYS_CLUSTER:
    snprintf(name, WAYS_NAME, "include --mode cluster --lights %d", picture->lights);
    break;
  case WAYS_POINT:
    snprintf(name, WAYS_NAME, "include --mode point");
    break;
  case WAYS_METHOD:
    snprintf(name, WAYS_NAME, "renderslab image --tolerance %g", picture->tolerance);
    break;
  }
}

/* ---- Pictures ---- */

static void print_view(const struct ways_settings *settings, char camera[512], char size[32],
                       char background[128]) {
  const struct shade *view = &settings->view;
  const struct camera *eye = &view->camera;
  const double *back = view->background;
  snprintf(camera, 512,
           "from=%.17g,%.17g,%.17g at=%.17g,%.17g,%.17g up=%.17g,%.17g,%.17g fov=%.17g",
           eye->from[0], eye->from[1], eye->from[2], eye->at[0], eye->at[1], eye->at[2], eye->up[0],
           eye->up[1], eye->up[2], eye->fov);
  snprintf(size, 32, "%dx%d", view->width, view->height);
  snprintf(background, 128, "--background=%.17g,%.17g,%.17g", back[0], back[1], back[2]);
}

/* renderslab COMMAND MESH --light SLAB ... -o OUTPUT */
static enum result run_renderslab(const struct ways_settings *settings, struct ways *ways,
                                  const char *command, const char *slab, const char *output,
                                  const char *const *more, double *cpu, struct error *error) {
  enum { MOST = 32 };
  char camera[512], size[32], background[128], *light = NULL;
  print_view(settings, camera, size, background);
  if (asprintf(&light, "%s %s", slab, settings->placement) < 0) return result_no_memory(error);
  const char *words[MOST] = {ways->programs.renderslab,
                             command,
                             settings->mesh,
                             "--light",
                             light,
                             "--camera",
                             camera,
                             "--size",
                             size,
                             background,
                             "-q",
                             "-o",
                             output};
  int count = 13;
  if (settings->repair) words[count++] = "--repair";
  while (more && *more && count + 1 < MOST) words[count++] = *more++;
  enum result result = programs_run(&ways->programs, words, cpu, error);
  free(light);
  return result;
}

enum result ways_render(const struct ways_settings *settings, struct ways *ways,
                        const struct ways_bake *bake, const char *const *words,
                        struct picture *picture, double *cpu, struct error *error) {
  char *path = programs_file(&ways->programs, "picture.exr");
  if (!path) return result_no_memory(error);
  enum result result = run_renderslab(settings, ways, "image", bake->slab, path, words, cpu, error);
  if (result == RESULT_OK) result = pixels_read(&ways->pixels, path, picture, error);
  free(path);
  return result;
}

enum result ways_povray(const struct ways_settings *settings, struct ways *ways, const char *scene,
                        int width, int height, struct picture *picture, double *cpu,
                        struct error *error) {
  char in[128], out[128], wide[16], high[16], libraries[2][PATH_MAX + 8];
  char *lamp = strdup(settings->lamp), *macros = files_beside_program("share/canned/include-pov");
  if (!lamp) return result_no_memory(error);
  snprintf(in, sizeof in, "+I%s/%s", ways->programs.folder, scene);
  snprintf(out, sizeof out, "+O%s/pov.exr", ways->programs.folder);
  snprintf(wide, sizeof wide, "+W%d", width);
  snprintf(high, sizeof high, "+H%d", height);
  snprintf(libraries[0], sizeof libraries[0], "+L%s", macros ? macros : ".");
  snprintf(libraries[1], sizeof libraries[1], "+L%s", dirname(lamp));
  const char *words[] = {ways->programs.povray, in,           out, wide, high, "+FE", "-A", "-D",
                         libraries[0],          libraries[1], NULL};
  enum result result = programs_run(&ways->programs, words, cpu, error);
  if (result == RESULT_OK && picture) {
    if (width == ways->pixels.width) /* one that is to be compared */
      result = pixels_read(&ways->pixels, out + 2, picture, error);
    else
      result = slab_exr_read(out + 2, picture, error);
  }
  free(macros);
  free(lamp);
  return result;
}

/* ---- Includes ---- */

/* The slab as light.tif in the folder, and its include as light.inc beside it, which the scene
 * names. */
static enum result write_include(const struct ways_settings *settings, struct ways *ways,
                                 const struct ways_bake *bake, const struct ways_picture *picture,
                                 double *cpu, struct error *error) {
  static const char *const modes[] = {"sheet", "cluster", "point"};
  char slab[128], include[128], scene[128], lights[16], *real = realpath(bake->slab, NULL);
  snprintf(slab, sizeof slab, "%s/light.tif", ways->programs.folder);
  snprintf(include, sizeof include, "%s/light.inc", ways->programs.folder);
  snprintf(scene, sizeof scene, "%s/scene.pov", ways->programs.folder);
  snprintf(lights, sizeof lights, "%d", picture->lights);
  remove(slab);
  bool there = real && symlink(real, slab) == 0;
  free(real);
  if (!there) return result_fail(error, RESULT_IO, "%s: %s", slab, strerror(errno));
  const char *words[] = {ways->programs.bakeslab,
                         "include",
                         slab,
                         "-o",
                         include,
                         "-q",
                         "--name=light",
                         "--mode",
                         modes[picture->kind],
                         picture->kind == WAYS_POINT ? NULL : "--lights",
                         lights,
                         NULL};
  enum result result = programs_run(&ways->programs, words, cpu, error);
  double unpaid = 0; /* the user has a scene */
  if (result == RESULT_OK)
    result = run_renderslab(settings, ways, "pov", slab, scene, NULL, &unpaid, error);
  return result;
}

/* The picture of a way, and its seconds. */
static enum result make(const struct ways_settings *settings, struct ways *ways, int bake,
                        int number, struct picture *picture, double *include_cpu, double *cpu,
                        struct error *error) {
  const struct ways_picture *way = &ways_pictures[number];
  if (way->kind == WAYS_METHOD) {
    char tolerance[32];
    snprintf(tolerance, sizeof tolerance, "%g", way->tolerance);
    const char *const words[] = {"--tolerance", tolerance, NULL};
    return ways_render(settings, ways, &ways->bakes[bake], words, picture, cpu, error);
  }
  enum result result = write_include(settings, ways, &ways->bakes[bake], way, include_cpu, error);
  if (result == RESULT_OK)
    result = ways_povray(settings, ways, "scene.pov", ways->pixels.width, ways->pixels.height,
                         picture, cpu, error);
  return result;
}

/* ---- Measuring ---- */

/* A sheet has no more lights than the slab has positions. */
static bool possible(const struct ways_bake *bake, const struct ways_picture *way) {
  return way->kind != WAYS_SHEET || way->lights <= bake->uv;
}

/* Its error against the truth; where its slab is the truth, with what that tells of itself. */
static double measured(const struct ways *ways, int bake, const struct picture *picture) {
  double error = pixels_error(&ways->pixels, picture, ways->truth);
  return bake < ways->bake_count - 1 ? error : hypot(error, ways->bakes[bake].error);
}

static enum result measure(const struct ways_settings *settings, struct ways *ways, int bake,
                           int number, bool to_compare, struct error *error) {
  struct ways_made *made = &ways->made[bake][number];
  struct picture picture = {0};
  struct error reason;
  double include_cpu = 0, cpu = 0;
  enum result result = make(settings, ways, bake, number, &picture, &include_cpu, &cpu, &reason);
  /* A lamp that has no such include is no failure. */
  if (result == RESULT_IO && ways_pictures[number].kind != WAYS_METHOD && cpu == 0) {
    made->refused = true;
    return RESULT_OK;
  }
  if (result != RESULT_OK) return result_fail(error, result, "%s", reason.text);
  made->tried = made->known = true;
  made->include_cpu = include_cpu;
  made->cpu = cpu;
  made->measured = measured(ways, bake, &picture);
  if (to_compare) made->error = pixels_error(&ways->pixels, &picture, &ways->bakes[bake].picture);
  picture_free(&picture);
  return RESULT_OK;
}

enum result ways_try(const struct ways_settings *settings, struct ways *ways, int bake, int picture,
                     struct error *error) {
  if (ways->made[bake][picture].tried) return RESULT_OK;
  return measure(settings, ways, bake, picture, false, error);
}

/* The slab on which a kind of picture is measured for this one. */
static int model_of(const struct ways *ways, int bake, int picture) {
  int model = ways->bake_count - 1;
  if (ways_pictures[picture].kind != WAYS_SHEET) return model;
  while (ways->bakes[model].uv != ways->bakes[bake].uv) --model;
  return model;
}

static void predict(struct ways *ways, int bake) {
  for (int k = 0; k < WAYS_PICTURES; ++k) {
    const struct ways_made *from = &ways->made[model_of(ways, bake, k)][k];
    struct ways_made *made = &ways->made[bake][k];
    made->refused = !from->known;
    if (!made->known) {
      made->include_cpu = from->include_cpu;
      made->cpu = from->cpu;
    }
    made->error = from->error;
    made->predicted = hypot(from->error, ways->bakes[bake].error);
  }
}

enum result ways_picture_all(const struct ways_settings *settings, struct ways *ways,
                             struct error *error) {
  enum result result = RESULT_OK;
  for (int bake = 0; bake < ways->bake_count; ++bake)
    for (int k = 0; k < WAYS_PICTURES && result == RESULT_OK; ++k) {
      char label[WAYS_NAME];
      if (!possible(&ways->bakes[bake], &ways_pictures[k]) || model_of(ways, bake, k) != bake)
        continue;
      ways_name(&ways->bakes[bake], &ways_pictures[k], label);
      if (settings->progress) settings->progress(settings->progress_context, 0.85, label);
      result = measure(settings, ways, bake, k, true, error);
    }
  for (int bake = 0; bake < ways->bake_count; ++bake) predict(ways, bake);
  return result;
}
