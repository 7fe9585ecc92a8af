/* lamp.c - the probe of a lamp script; see lamp.h. */
#include "lamp.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files.h"

/* As include-pov/canned_bake.inc lays the probe's image out. */
enum { PROBE_SIDE = 16, PROBE_VIEWS = 256, PROBE_MARKER = 5 };

/* Canned_Bake_Probe keeps the effects' cost out; what depends on them is parsed. */
static const char probe_scene[] = "#declare Canned_Bake_Describe = \"declared.txt\";\n"
                                  "#declare Canned_Bake_Probe = 1;\n"
                                  "#include \"canned_bake.inc\"\n"
                                  "#include \"" LAMP_SCRIPT "\"\n"
                                  "Canned_Probe()\n";

/* ---- What the script declares ---- */

/* Numbers as canned.inc writes them: mantissa and binary exponent. */
static bool read_numbers(const char *text, int count, double *numbers) {
  for (int n = 0; n < count; ++n) {
    char *end;
    double mantissa = strtod(text, &end);
    if (end == text) return false;
    text = end;
    long exponent = strtol(text, &end, 10);
    if (end == text) return false;
    text = end;
    numbers[n] = ldexp(mantissa, (int)exponent);
  }
  return true;
}

static bool add_slab(struct lamp *lamp) {
  struct slab *grown = realloc(lamp->slabs, (size_t)(lamp->slab_count + 1) * sizeof *grown);
  if (!grown) return false;
  lamp->slabs = grown;
  grown[lamp->slab_count] = slab_default();
  for (int axis = 0; axis < SLAB_AXES; ++axis) grown[lamp->slab_count].samples[axis] = 1;
  ++lamp->slab_count;
  return true;
}

/* A bulb may be too small for the probe to see. */
static bool read_bulb(const char *value, struct lamp *lamp) {
  double rgb[3];
  if (!read_numbers(value, 3, rgb)) return false;
  lamp->bulbs = true;
  for (int c = 0; c < 3; ++c) lamp->peak = fmax(lamp->peak, fabs(rgb[c]));
  return true;
}

/* One line of what canned.inc tells: a key and its value. Keys up to the first
 * "slab" speak of the lamp, those after one of that slab. */
static bool read_declaration(char *line, struct lamp *lamp, struct slab *common) {
  char *value = strchr(line, ' ');
  if (value) *value++ = 0;
  if (!strcmp(line, "slab")) return add_slab(lamp);
  if (!value) return false;
  struct slab *slab = lamp->slab_count ? &lamp->slabs[lamp->slab_count - 1] : NULL;
  if (!strcmp(line, "lamp")) {
    snprintf(common->name, sizeof common->name, "%s", value);
    return true;
  }
  if (!strcmp(line, "radiance_unit")) {
    snprintf(common->radiance_unit, sizeof common->radiance_unit, "%s", value);
    return true;
  }
  if (!strcmp(line, "needs")) {
    lamp->needs_declared = true;
    snprintf(lamp->needs, sizeof lamp->needs, "%s", value);
    return true;
  }
  if (!strcmp(line, "bulb")) return read_bulb(value, lamp);
  if (!strcmp(line, "metres_per_unit")) return read_numbers(value, 1, &common->metres_per_unit);
  if (!slab) return false;
  if (!strcmp(line, "center")) return read_numbers(value, 3, slab->center);
  if (!strcmp(line, "u")) return read_numbers(value, 3, slab->u);
  if (!strcmp(line, "v")) return read_numbers(value, 3, slab->v);
  if (!strcmp(line, "normal")) return read_numbers(value, 3, slab->normal);
  if (!strcmp(line, "s")) return read_numbers(value, 2, slab->st_window);
  if (!strcmp(line, "t")) return read_numbers(value, 2, slab->st_window + 2);
  return !strcmp(line, "distance") && read_numbers(value, 1, &slab->st_distance);
}

static enum slab_result read_declarations(const struct lamp_source *source, const char *directory,
                                          struct lamp *lamp, struct slab_error *error) {
  struct slab common = slab_default();
  char *text = files_read(directory, "declared.txt");
  enum slab_result result = SLAB_OK;
  char *rest = text;
  for (char *line; rest && *rest && (line = strsep(&rest, "\n")) && !result;)
    if (*line && !read_declaration(line, lamp, &common))
      result = slab_fail(error, SLAB_BAD,
                         "%s: canned.inc said \"%s\", which this bakeslab does not know; use the "
                         "canned.inc that came with it",
                         source->script, line);
  free(text);
  if (!result && !lamp->slab_count)
    result = slab_fail(error, SLAB_BAD,
                       "%s: declares no slab; it must #include \"canned.inc\" and call Canned_Slab",
                       source->script);
  if (!result && !common.name[0])
    result =
        slab_fail(error, SLAB_BAD, "%s: has no name; call Canned_Lamp(\"name\")", source->script);
  for (int n = 0; n < lamp->slab_count && !result; ++n) {
    struct slab *slab = &lamp->slabs[n];
    memcpy(slab->name, common.name, sizeof slab->name);
    memcpy(slab->radiance_unit, common.radiance_unit, sizeof slab->radiance_unit);
    slab->metres_per_unit = common.metres_per_unit;
    if (slab->st_distance == 0) slab->st_distance = INFINITY;
    double length = sqrt(slab->normal[0] * slab->normal[0] + slab->normal[1] * slab->normal[1] +
                         slab->normal[2] * slab->normal[2]);
    for (int axis = 0; axis < 3; ++axis) slab->normal[axis] /= length;
    struct slab_error reason;
    if (slab_check(slab, &reason))
      result =
          slab_fail(error, SLAB_BAD, "%s: Canned_Slab %d: %s", source->script, n + 1, reason.text);
  }
  return result;
}

/* ---- What it looks like ---- */

static bool is_marker_row(const struct slab_picture *picture, int row) {
  const float *pixel = picture->rgb + (size_t)row * PROBE_SIDE * 3;
  for (int n = 0; n < PROBE_SIDE; ++n, pixel += 3)
    if (pixel[1] != PROBE_MARKER) return false;
  return true;
}

static void read_picture(const struct slab_picture *picture, struct lamp *lamp) {
  lamp->defect_rows = is_marker_row(picture, 1) ? 1 : 0;
  lamp->mesh_camera = is_marker_row(picture, 0) && !is_marker_row(picture, 2);
  size_t count = (size_t)picture->width * (size_t)picture->height * 3;
  for (size_t n = (size_t)(1 + lamp->defect_rows) * PROBE_SIDE * 3; n < count; ++n) {
    double value = fabs((double)picture->rgb[n]);
    if (value > lamp->peak) lamp->peak = value; /* Inf stays Inf, NaN is ignored */
  }
}

static enum slab_result write_probe(const char *directory, const struct effects *effects,
                                    struct slab_error *error) {
  char *scene = NULL;
  size_t size;
  FILE *out = open_memstream(&scene, &size);
  if (!out) return slab_fail(error, SLAB_MEMORY, "out of memory");
  fputs("#version 3.7;\n", out);
  if (effects) effects_declare(effects, out);
  fputs(probe_scene, out);
  enum slab_result result = fclose(out) ? slab_fail(error, SLAB_MEMORY, "out of memory")
                                        : files_write(directory, "scene.pov", scene, error);
  free(scene);
  return result;
}

/* Runs POV-Ray with the list-maker, which wants the list's path in the environment. */
static enum slab_result run_listing(const struct povray *povray, const struct povray_job *job,
                                    struct slab_error *error) {
  char *folder = realpath(job->directory, NULL);
  char *list = folder ? files_join(folder, "reads.txt") : NULL;
  enum slab_result result = SLAB_OK;
  if (!list || setenv("CANNED_READS", list, 1) != 0)
    result = slab_fail(error, SLAB_MEMORY, "out of memory");
  if (!result) result = povray_run(povray, job, error);
  unsetenv("CANNED_READS");
  free(list);
  free(folder);
  return result;
}

enum slab_result lamp_probe(const struct povray *povray, const struct lamp_source *source,
                            const char *directory, const struct effects *effects,
                            const volatile sig_atomic_t *stop, struct lamp *lamp,
                            struct slab_error *error) {
  *lamp = (struct lamp){0};
  struct lamp_library library;
  lamp_source_library(source, &library);
  struct povray_job job = {.directory = directory,
                           .width = PROBE_SIDE,
                           .height = 2 + PROBE_SIDE * PROBE_VIEWS,
                           .frames = 1,
                           .library = library.paths,
                           .preload = "./" LAMP_READS,
                           .stop = stop};
  struct slab_picture picture = {0};
  enum slab_result result = lamp_source_link(source, directory, error);
  if (!result) result = write_probe(directory, effects, error);
  if (!result) {
    result = run_listing(povray, &job, error);
    if (result) lamp_source_rename(source, error);
    if (result == SLAB_BAD) slab_fail(error, result, "%s: %s", source->script, error->text);
  }
  lamp->own_radiosity = povray_statistic(directory, "Radiosity samples calculated:") >= 0;
  if (!result) result = read_declarations(source, directory, lamp, error);
  if (!result)
    result = lamp_reads_collect(directory, source->path, source->script, &lamp->reads, error);
  if (!result) result = povray_read_frame(&job, 0, &picture, error);
  if (!result) read_picture(&picture, lamp);
  slab_picture_free(&picture);
  files_remove_tree(directory);
  return result;
}

void lamp_free(struct lamp *lamp) {
  for (int n = 0; n < lamp->slab_count; ++n) slab_free(&lamp->slabs[n]);
  free(lamp->slabs);
  lamp_reads_free(&lamp->reads);
  *lamp = (struct lamp){0};
}
