/* ways_bakes.c - slabs, from coarse to fine, until one is fine enough to be the truth.
 *
 * 1. Bake the next of the table, or find it in the folder where bakes are kept.
 * 2. Of the first: is anything lit, and how far away is it? It is there that slabs tell errors.
 * 3. Its picture by renderslab's reference, and against it the errors of all slabs before.
 * 4. Its own error: what it tells, times what the slab before errs by over what that told, if that
 *    is more than 1. (What a slab tells knows nothing of radiosity's blotches, say.)
 * 5. Stop once that is a third of the least error of the ladder: finer slabs would cost more and
 *    gain nothing. The last one is the reference. */
#include <libgen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/files.h"
#include "base/output.h"
#include "file/slab_file.h"
#include "file/slab_json.h"
#include "slab/slab_accuracy.h"
#include "tradeoff/ways.h"

/* Samples a side of positions and directions, rays a sample; costs rise. */
static const struct {
  int uv, st, rays;
} candidates[] = {{4, 32, 4},  {8, 32, 4},   {8, 64, 4},   {8, 64, 16},  {16, 64, 4},
                  {8, 96, 16}, {16, 64, 16}, {16, 96, 16}, {24, 128, 16}};
enum { CANDIDATES = sizeof candidates / sizeof *candidates };

/* The reference tells at most this share of the least error that is asked for. */
static const double reference_share = 1.0 / 3;

/* ---- Baking ---- */

static double work(int candidate) {
  double uv = candidates[candidate].uv, st = candidates[candidate].st;
  return uv * uv * st * st * candidates[candidate].rays;
}

static void show(const struct ways_settings *settings, int candidate) {
  char label[80];
  double done = 0, all = 0;
  for (int k = 0; k < CANDIDATES; ++k) {
    if (k < candidate) done += work(k);
    all += work(k);
  }
  snprintf(label, sizeof label, "baking %dx%d positions, %dx%d directions, %d rays",
           candidates[candidate].uv, candidates[candidate].uv, candidates[candidate].st,
           candidates[candidate].st, candidates[candidate].rays);
  if (settings->progress) settings->progress(settings->progress_context, 0.8 * done / all, label);
}

/* The slab's file, and beside it that of the bake's seconds, in the folder of bakes. */
static enum result name_files(const struct ways_settings *settings, const struct ways *ways,
                              struct ways_bake *bake, char **clock, struct error *error) {
  const char *folder = settings->bakes ? settings->bakes : ways->programs.folder;
  char *lamp = strdup(settings->lamp), *stem = NULL;
  if (!lamp) return result_no_memory(error);
  char *name = basename(lamp), *dot = strrchr(name, '.');
  if (dot) *dot = 0;
  int length = asprintf(&stem, "%s/%s-%dx%d-%d", folder, name, bake->uv, bake->st, bake->rays);
  free(lamp);
  if (length < 0) return result_no_memory(error);
  if (asprintf(&bake->slab, "%s.tif", stem) < 0) bake->slab = NULL;
  if (asprintf(clock, "%s.cpu", stem) < 0) *clock = NULL;
  free(stem);
  return bake->slab && *clock ? RESULT_OK : result_no_memory(error);
}

/* Was it baked before, after the script was changed last? */
static bool is_kept(const struct ways_settings *settings, struct ways_bake *bake,
                    const char *clock) {
  struct stat script, slab;
  FILE *file = fopen(clock, "re");
  bool good = file && fscanf(file, "%lf", &bake->cpu) == 1 && stat(settings->lamp, &script) == 0 &&
              stat(bake->slab, &slab) == 0 && slab.st_mtime > script.st_mtime;
  if (file) fclose(file);
  return good;
}

static enum result bake_anew(const struct ways_settings *settings, struct ways *ways,
                             struct ways_bake *bake, const char *clock, struct error *error) {
  char uv[16], st[16], rays[16], text[32], *partial = NULL;
  snprintf(uv, sizeof uv, "%d", bake->uv);
  snprintf(st, sizeof st, "%d", bake->st);
  snprintf(rays, sizeof rays, "%d", bake->rays);
  const char *words[] = {ways->programs.bakeslab,
                         "bake",
                         settings->lamp,
                         "-o",
                         bake->slab,
                         "--uv",
                         uv,
                         "--st",
                         st,
                         "--rays",
                         rays,
                         "-q",
                         "--yes",
                         NULL};
  /* What an interrupted bake left would not be in the seconds. */
  if (asprintf(&partial, "%s.partial", bake->slab) < 0) return result_no_memory(error);
  files_remove_tree(partial);
  free(partial);
  bake->cpu = 0;
  enum result result = programs_run(&ways->programs, words, &bake->cpu, error);
  snprintf(text, sizeof text, "%.3f\n", bake->cpu);
  if (result == RESULT_OK) result = output_text(clock, text, strlen(text), error);
  return result;
}

static enum result get(const struct ways_settings *settings, struct ways *ways,
                       struct ways_bake *bake, struct error *error) {
  char *clock = NULL;
  enum result result = name_files(settings, ways, bake, &clock, error);
  if (result == RESULT_OK && !is_kept(settings, bake, clock))
    result = bake_anew(settings, ways, bake, clock, error);
  free(clock);
  return result;
}

/* ---- What the slab tells of its own error ---- */

/* Adds a page's, weighed by its flux. */
static enum result add_page(const struct slab *slab, double distance, struct ways_bake *bake,
                            double *weights, struct error *error) {
  struct slab_sampling sampling;
  struct slab_accuracy accuracy;
  double flux[3];
  enum result result = slab_json_sampling(slab, &sampling, error);
  if (result == RESULT_OK)
    result = slab_accuracy_estimate(slab, &sampling, 1, &distance, &accuracy, error);
  if (result != RESULT_OK) return result;
  result = slab_flux(slab, flux, error);
  if (result != RESULT_OK) return result;
  double weight = flux[0] + flux[1] + flux[2];
  const double values[] = {accuracy.st, accuracy.uv, accuracy.noise};
  for (int k = 0; k < 3; ++k)
    if (isfinite(values[k])) bake->parts[k] += weight * values[k];
  if (isfinite(accuracy.all)) bake->told += weight * accuracy.all;
  *weights += weight;
  return RESULT_OK;
}

static enum result tell(const struct ways *ways, struct ways_bake *bake, struct error *error) {
  struct slab *slabs = NULL;
  struct stat about;
  int count = 0;
  double weights = 0;
  enum result result = slab_file_load_all(bake->slab, &slabs, &count, error);
  bake->told = 0;
  for (int page = 0; page < count && result == RESULT_OK; ++page)
    result = add_page(&slabs[page], ways->distance, bake, &weights, error);
  if (result == RESULT_OK && weights > 0) {
    bake->told /= weights;
    for (int k = 0; k < 3; ++k) bake->parts[k] /= weights;
  }
  if (count > 0) {
    bake->uv = slabs[0].samples[SLAB_U];
    bake->st = slabs[0].samples[SLAB_S];
  }
  if (stat(bake->slab, &about) == 0) bake->bytes = (double)about.st_size;
  slab_file_free_all(slabs, count);
  return result;
}

void ways_would_reach(const struct ways *ways, double error, char text[WAYS_NAME]) {
  const struct ways_bake *bake = &ways->bakes[ways->bake_count - 1];
  double share = error / (sqrt(3) * ways->doubt); /* of three parts */
  double st = bake->parts[0] / share, uv = bake->parts[1] / share, noise = bake->parts[2] / share;
  /* Blur falls with the spacing of the samples, noise with the root of the rays. */
  int more_st = (int)ceil(bake->st * fmax(st, 1)), more_uv = (int)ceil(bake->uv * fmax(uv, 1));
  int length = snprintf(text, WAYS_NAME, "--uv %d --st %d", more_uv, more_st);
  if (bake->rays > 0 && noise > 1)
    snprintf(text + length, WAYS_NAME - (size_t)length, " --rays %.0f",
             2 * ceil(bake->rays * noise * noise / 2));
  else if (noise > 1)
    snprintf(text + length, WAYS_NAME - (size_t)length, " and %.0f times the rays",
             ceil(noise * noise));
}

/* ---- Pictures by reference ---- */

static enum result picture_of(const struct ways_settings *settings, struct ways *ways,
                              struct ways_bake *bake, struct error *error) {
  static const char *const words[] = {"--method",      "reference", "--tolerance", "1e-4",
                                      "--shadow-edge", "1024",      NULL};
  double cpu = 0;
  return ways_render(settings, ways, bake, words, &bake->picture, &cpu, error);
}

/* Of the first slab: where its light is, and whether any is seen. */
static enum result place(const struct ways_settings *settings, struct ways *ways,
                         struct error *error) {
  struct ways_bake *bake = &ways->bakes[0];
  struct shade view = settings->view;
  char *text = NULL;
  if (asprintf(&text, "%s %s", bake->slab, settings->placement) < 0) return result_no_memory(error);
  enum result result = light_load(text, &ways->light, error);
  free(text);
  view.lights = &ways->light;
  view.light_count = 1;
  if (result == RESULT_OK) result = pixels_find(&view, &ways->pixels, error);
  if (result == RESULT_OK) result = picture_of(settings, ways, bake, error);
  if (result == RESULT_OK && !(pixels_light(&ways->pixels, &bake->picture, &ways->distance) > 0))
    result = result_fail(error, RESULT_BAD,
                         "%s: no light of it reaches what the camera sees; move one of them",
                         settings->lamp);
  return result;
}

/* ---- All of them ---- */

/* The errors of all slabs, as the last one sees them. */
static void compare(struct ways *ways) {
  struct ways_bake *last = &ways->bakes[ways->bake_count - 1];
  ways->truth = &last->picture;
  for (struct ways_bake *bake = ways->bakes; bake < last; ++bake)
    bake->error = pixels_error(&ways->pixels, &bake->picture, ways->truth);
  ways->doubt = 1;
  if (last > ways->bakes && last[-1].told > 0)
    ways->doubt = fmax(last[-1].error / last[-1].told, 1);
  last->error = ways->doubt * last->told;
}

static enum result add(const struct ways_settings *settings, struct ways *ways,
                       struct error *error) {
  int number = ways->bake_count++;
  struct ways_bake *bake = &ways->bakes[number];
  enum result result = RESULT_OK;
  if (settings->script) {
    *bake = (struct ways_bake){
        .uv = candidates[number].uv, .st = candidates[number].st, .rays = candidates[number].rays};
    show(settings, number);
    result = get(settings, ways, bake, error);
  } else if (!(bake->slab = strdup(settings->lamp))) {
    result = result_no_memory(error);
  }
  if (result == RESULT_OK && number == 0) result = place(settings, ways, error);
  if (result == RESULT_OK) result = tell(ways, bake, error);
  if (result == RESULT_OK && number > 0) result = picture_of(settings, ways, bake, error);
  if (result == RESULT_OK) compare(ways);
  return result;
}

/* Is any rung above what the reference itself errs by? */
static enum result check_floor(const struct ways_settings *settings, const struct ways *ways,
                               struct error *error) {
  const struct ways_bake *reference = &ways->bakes[ways->bake_count - 1];
  char more[WAYS_NAME];
  if (settings->errors[0] >= reference->error) return RESULT_OK;
  ways_would_reach(ways, settings->errors[0], more);
  return result_fail(error, RESULT_BAD,
                     "%s: an error of %g is asked for, but %s errs by %.2g here itself (%dx%d "
                     "positions, %dx%d directions); a bake with %s would do",
                     settings->lamp, settings->errors[0],
                     settings->script ? "the finest bake" : "the slab", reference->error,
                     reference->uv, reference->uv, reference->st, reference->st, more);
}

enum result ways_bake_all(const struct ways_settings *settings, struct ways *ways,
                          struct error *error) {
  double enough = settings->errors[settings->error_count - 1] * reference_share;
  int most = settings->script ? CANDIDATES : 1;
  enum result result = RESULT_OK;
  for (int k = 0; k < most && result == RESULT_OK; ++k) {
    result = add(settings, ways, error);
    if (k > 0 && ways->bakes[k].error <= enough) break;
  }
  return result == RESULT_OK ? check_floor(settings, ways, error) : result;
}
