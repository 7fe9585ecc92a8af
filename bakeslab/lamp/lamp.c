/* lamp.c - the trial run of a lamp script. */
#include "lamp/lamp.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/files.h"
#include "povray/povray_log.h"

/* As include-pov/canned_bake.inc lays the trial's image out. */
enum { TRIAL_SIDE = 16, TRIAL_VIEWS = 256, TRIAL_MARKER = 5, TRIAL_HAZE = 2 };

/* Canned_Bake_Probe keeps the effects' cost out; what depends on them is parsed. */
static const char trial_scene[] = "#declare Canned_Bake_Describe = \"declared.txt\";\n"
                                  "#declare Canned_Bake_Probe = 1;\n"
                                  "#include \"canned_bake.inc\"\n"
                                  "#include \"" LAMP_SCRIPT "\"\n"
                                  "Canned_Neutral()\n"
                                  "Canned_Probe()\n";

static enum result read_declarations(const struct lamp_source *source, const char *directory,
                                     struct lamp *lamp, struct error *error) {
  char *text = files_read(directory, "declared.txt"); /* none where no macro was called */
  if (!text && errno != ENOENT)
    return result_fail(error, RESULT_IO, "%s/declared.txt: %s", directory, strerror(errno));
  enum result result = lamp_declarations(text, source->script, lamp, error);
  free(text);
  return result;
}

static const float *row_of(const struct picture *picture, int row) {
  return picture->rgb + (size_t)row * TRIAL_SIDE * 3;
}

static bool is_marker_row(const struct picture *picture, int row) {
  const float *pixel = row_of(picture, row);
  for (int n = 0; n < TRIAL_SIDE; ++n, pixel += 3)
    if (!(fabs((double)pixel[1] - TRIAL_MARKER) < 1)) return false; /* haze may dim it a little */
  return true;
}

/* The second of two rows avoids what fills all of space. Single rays may differ by an edge of the
 * lamp. */
static bool is_hazy(const struct picture *picture, int row) {
  int differ = 0;
  for (int n = 0; n < 3 * TRIAL_SIDE; ++n) {
    double open = row_of(picture, row)[n], closed = row_of(picture, row + 1)[n];
    differ += !(fabs(open - closed) <= 0.01 * fmax(fabs(open), fabs(closed)));
  }
  return differ >= TRIAL_SIDE / 2;
}

static void read_picture(const struct picture *picture, struct lamp *lamp) {
  lamp->defect_rows = is_marker_row(picture, 1) ? 1 : 0;
  lamp->mesh_camera = is_marker_row(picture, 0) && !is_marker_row(picture, 2);
  lamp->hazy = lamp->mesh_camera && is_hazy(picture, 1 + lamp->defect_rows);
  size_t count = (size_t)picture->width * (size_t)picture->height * 3;
  size_t first = (size_t)(1 + TRIAL_HAZE + lamp->defect_rows) * TRIAL_SIDE * 3;
  for (size_t n = first; n < count; ++n) {
    double value = fabs((double)picture->rgb[n]);
    if (value > lamp->peak) lamp->peak = value; /* Inf stays Inf, NaN is ignored */
    if (value > 0) lamp->mean += value / (double)(count - first);
  }
}

static enum result write_trial(const char *directory, const struct effects *effects,
                               const char *change, struct error *error) {
  char *scene = NULL;
  size_t size;
  FILE *out = open_memstream(&scene, &size);
  if (!out) return result_no_memory(error);
  fputs("#version 3.7;\n", out);
  if (effects) effects_declare(effects, out);
  if (change) fprintf(out, "#declare %s = 1;\n", change);
  fputs(trial_scene, out);
  enum result result = fclose(out) || !scene ? result_no_memory(error)
                                             : files_write(directory, "scene.pov", scene, error);
  free(scene);
  return result;
}

/* Runs POV-Ray with the list-maker, which wants the list's path in the environment. */
static enum result run_listing(const struct povray *povray, struct povray_job *job,
                               struct error *error) {
  char *folder = realpath(job->directory, NULL);
  char *list = folder ? files_join(folder, "reads.txt") : NULL;
  static const char preload[] = LAMP_PRELOAD;
  const char *const environment[] = {"LD_PRELOAD", preload, "CANNED_READS", list, "CANNED_MATT",
                                     "1",          NULL};
  job->environment = environment;
  enum result result = list ? povray_run(povray, job, error) : result_no_memory(error);
  job->environment = NULL;
  free(list);
  free(folder);
  return result;
}

enum result lamp_try(const struct povray *povray, const struct lamp_source *source,
                     const char *directory, const struct effects *effects, const char *change,
                     const volatile sig_atomic_t *stop, struct lamp *lamp, struct error *error) {
  *lamp = (struct lamp){0};
  struct lamp_library library;
  lamp_source_library(source, &library);
  struct povray_job job = {.directory = directory,
                           .width = TRIAL_SIDE,
                           .height = 2 + TRIAL_HAZE + TRIAL_SIDE * TRIAL_VIEWS,
                           .frames = 1,
                           .library = library.paths,
                           .stop = stop};
  struct picture picture = {0};
  enum result result = lamp_source_link(source, directory, error);
  if (result == RESULT_OK) result = write_trial(directory, effects, change, error);
  if (result == RESULT_OK) {
    result = run_listing(povray, &job, error);
    if (result != RESULT_OK) lamp_source_rename(source, error);
    if (result == RESULT_BAD || result == RESULT_IO)
      result_fail(error, result, "%s: %s", source->script, error->text);
    if (result == RESULT_STOPPED)
      result_fail(error, result, "interrupted while POV-Ray was trying the script");
  }
  if (result != RESULT_OK) goto out;
  lamp->own_radiosity = povray_statistic(directory, "Radiosity samples calculated:") >= 0;
  double lights = povray_statistic(directory, "Light Sources:");
  result = read_declarations(source, directory, lamp, error);
  lamp->all_lights = lights > 0 ? (int)lights : 0;
  if (result == RESULT_OK)
    result = lamp_reads_collect(directory, source->path, source->script, &lamp->reads, error);
  if (result == RESULT_OK) result = povray_read_frame(&job, 0, &picture, error);
  if (result == RESULT_OK) read_picture(&picture, lamp);
  if (lamp->hazy)
    result = result_fail(error, RESULT_BAD,
                         "%s: has fog, or media in all of space, which would be baked with the "
                         "lamp; keep it for previews: #ifndef (Canned_Baking) fog { ... } #end",
                         source->script);
out:
  picture_free(&picture);
  files_remove_tree(directory);
  return result;
}

void lamp_free(struct lamp *lamp) {
  for (int n = 0; n < lamp->slab_count; ++n) slab_free(&lamp->slabs[n]);
  free(lamp->slabs);
  lamp_reads_free(&lamp->reads);
  *lamp = (struct lamp){0};
}
