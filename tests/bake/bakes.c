/* bakes.c - see bakes.h. */
#include "bakes.h"

#include <jansson.h>
#include <libgen.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/files.h"

/* Bakes at a time: a small one mostly waits for POV-Ray's front end. */
enum { AT_ONCE = 6, MOST = 64 };

static char directory[256], *fixtures;
static struct {
  pid_t pid;
  char output[64];
} running[MOST];
static int running_count;

/* ---- The scratch folder ---- */

int bakes_setup(void **state) {
  (void)state;
  const char *parent = getenv("TMPDIR"), *include_pov = getenv("CANNED_INCLUDE");
  if (!include_pov || !getenv("BAKESLAB")) {
    print_error("run by `make test`, which sets BAKESLAB and CANNED_INCLUDE\n");
    return -1;
  }
  char *copy = strdup(include_pov);
  fixtures = files_join(dirname(copy), "tests/bake/lamps");
  free(copy);
  snprintf(directory, sizeof directory, "%s/bake-test-XXXXXX", parent ? parent : "/tmp");
  setenv("FIXTURES", fixtures, 1);
  return mkdtemp(directory) ? 0 : -1;
}

int bakes_teardown(void **state) {
  (void)state;
  for (int n = 0; n < running_count; ++n) waitpid(running[n].pid, NULL, 0);
  running_count = 0;
  files_remove_tree(directory);
  free(fixtures);
  fixtures = NULL;
  return 0;
}

const char *bakes_path(const char *name) {
  static char paths[8][512];
  static int next;
  char *path = paths[next++ % 8];
  snprintf(path, sizeof paths[0], "%s/%s", directory, name);
  return path;
}

int bakes_run(const char *format, ...) {
  char command[2048], *all = NULL;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(command, sizeof command, format, arguments);
  va_end(arguments);
  assert_true(asprintf(&all, "cd '%s' && %s", directory, command) > 0);
  int status = system(all);
  free(all);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* ---- Lamps ---- */

static FILE *open_lamp(const char *name, const char *mode) {
  char file[128];
  snprintf(file, sizeof file, "%s.pov", name);
  FILE *out = fopen(bakes_path(file), mode);
  assert_non_null(out);
  return out;
}

void bakes_lamp_add(const char *name, const char *format, ...) {
  FILE *out = open_lamp(name, "a");
  va_list arguments;
  va_start(arguments, format);
  vfprintf(out, format, arguments);
  va_end(arguments);
  assert_int_equal(fclose(out), 0);
}

void bakes_lamp(const char *name) {
  fclose(open_lamp(name, "w"));
  bakes_lamp_add(name, "#version 3.7;\n#include \"canned.inc\"\n#include \"known.inc\"\n"
                       "Canned_Lamp(\"lamp\")\nCanned_Needs(\"\")\n");
}

static void print_frame(FILE *out, const struct bakes_frame *frame) {
  const double *vectors[4] = {frame->center, frame->u, frame->v, frame->normal};
  for (int n = 0; n < 4; ++n)
    fprintf(out, "%s<%.17g, %.17g, %.17g>", n ? ", " : "", vectors[n][0], vectors[n][1],
            vectors[n][2]);
}

void bakes_lamp_slab(const char *name, const struct bakes_frame *frame) {
  FILE *out = open_lamp(name, "a");
  const double *w = frame->window;
  fputs("Canned_Slab(", out);
  print_frame(out, frame);
  fprintf(out, ", <%.17g, %.17g, %.17g, %.17g>, %.17g)\n", w[0], w[1], w[2], w[3], frame->distance);
  assert_int_equal(fclose(out), 0);
}

void bakes_lamp_macro(const char *name, const char *macro, const struct bakes_frame *frame,
                      const char *rest) {
  FILE *out = open_lamp(name, "a");
  fprintf(out, "%s(", macro);
  print_frame(out, frame);
  fprintf(out, ", %s)\n", rest);
  assert_int_equal(fclose(out), 0);
}

static double length(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void bakes_point(const struct bakes_frame *frame, const double abst[4], double depth, double *x,
                 double *y) {
  double kappa = frame->distance > 0 ? 1 / frame->distance : 0;
  *x = abst[0] - depth * (abst[2] - kappa * abst[0]);
  *y = abst[1] - depth * (abst[3] - kappa * abst[1]);
}

static void mix(const double from[3], const double to[3], double part, double rgb[3]) {
  for (int c = 0; c < 3; ++c) rgb[c] = from[c] + part * (to[c] - from[c]);
}

void bakes_waves(const struct bakes_frame *frame, double radiance, const double abst[4],
                 double rgb[3]) {
  static const double glow[2][3] = {{1, 0.2, 0.4}, {0.3, 1, 0.6}};
  static const double filter[2][3] = {{0.4, 0.7, 1}, {1, 0.9, 0.3}};
  double lu = length(frame->u), lv = length(frame->v), x, y, passed[3];
  bakes_point(frame, abst, 0.8 * lu, &x, &y);
  mix(glow[0], glow[1], 0.5 + 0.4 * sin(0.5 * x / lu + 0.3 * y / lv + 0.7), rgb);
  bakes_point(frame, abst, 0.3 * lu, &x, &y);
  mix(filter[0], filter[1], 0.5 + 0.4 * sin(0.6 * y / lv - 0.4 * x / lu + 2), passed);
  for (int c = 0; c < 3; ++c) rgb[c] *= radiance * passed[c];
}

void bakes_slope(const struct bakes_frame *frame, double depth, const double abst[4],
                 double rgb[3]) {
  static const double ends[2][3] = {{0, 1, 2}, {1, 0, 5}};
  double x, y;
  bakes_point(frame, abst, depth, &x, &y);
  mix(ends[0], ends[1], 0.5 + 0.1 * x + 0.05 * y, rgb);
}

/* Mean of the step from 0 to 1 at `edge` over p + q with p and q uniform in
 * [-wide/2, wide/2] around `at` and [-narrow/2, narrow/2]: the integral of a trapezoid. */
static double passed(double edge, double at, double wide, double narrow) {
  if (wide < narrow) return passed(edge, at, narrow, wide);
  double x = at - edge, half = 0.5 * (wide + narrow), flat = 0.5 * (wide - narrow);
  if (x <= -half) return 0;
  if (x >= half) return 1;
  if (narrow <= 0 || fabs(x) <= flat) return 0.5 + x / wide;
  double rest = half - fabs(x), tail = 0.5 * rest * rest / (wide * narrow);
  return x < 0 ? tail : 1 - tail;
}

static double passed_pane(const struct slab *slab, double depth, int axis, int i, int k,
                          const double limits[2]) {
  double widen = 1 + depth * slab_kappa(slab);
  double at = widen * slab_position(slab, axis, i) - depth * slab_position(slab, axis + 2, k);
  double wide = widen * slab_spacing(slab, axis), narrow = depth * slab_spacing(slab, axis + 2);
  return passed(limits[0], at, wide, narrow) - passed(limits[1], at, wide, narrow);
}

void bakes_sample(const struct slab *slab, size_t pixel, int at[SLAB_AXES], double abst[4]) {
  slab_locate(slab, pixel, at);
  for (int axis = 0; axis < SLAB_AXES; ++axis) abst[axis] = slab_position(slab, axis, at[axis]);
}

double bakes_pane(const struct slab *slab, double depth, const double rectangle[4],
                  const int at[SLAB_AXES]) {
  return passed_pane(slab, depth, SLAB_U, at[SLAB_U], at[SLAB_S], rectangle) *
         passed_pane(slab, depth, SLAB_V, at[SLAB_V], at[SLAB_T], rectangle + 2);
}

/* ---- Bakes ---- */

static void show_log(const char *output) {
  char name[96];
  snprintf(name, sizeof name, "%s.log", output);
  char *text = files_read(directory, name);
  print_error("%s: %s\n", output, text ? text : "(no log)");
  free(text);
}

static void wait_for(int most) {
  while (running_count > most) {
    int status, n = 0;
    pid_t pid = waitpid(-1, &status, 0);
    while (n < running_count && running[n].pid != pid) ++n;
    if (n == running_count) fail_msg("a process that nobody started, or none");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
      show_log(running[n].output);
      fail_msg("the bake of %s failed", running[n].output);
    }
    running[n] = running[--running_count];
  }
}

void bakes_start(const char *lamp, const char *output, const char *options) {
  wait_for(AT_ONCE - 1);
  char *command = NULL;
  assert_true(
      asprintf(&command,
               "cd '%s' && exec \"$BAKESLAB\" bake %s.pov -o %s -L \"$FIXTURES\" --jobs 1 %s "
               ">%s.log 2>&1",
               directory, lamp, output, options, output) > 0);
  pid_t pid = fork();
  assert_true(pid >= 0);
  if (pid == 0) {
    execl("/bin/sh", "sh", "-c", command, (char *)NULL);
    _exit(127);
  }
  free(command);
  running[running_count].pid = pid;
  snprintf(running[running_count++].output, sizeof running[0].output, "%s", output);
}

void bakes_wait(void) {
  wait_for(0);
}

struct slab bakes_load(const char *output, int page) {
  struct error error = {""};
  struct slab_file *file = NULL;
  struct slab slab = {0};
  enum result result = slab_file_open(bakes_path(output), &file, &error);
  if (!result) result = slab_file_load(file, page, &slab, &error);
  slab_file_close(file);
  if (result) fail_msg("%s", error.text);
  return slab;
}

double bakes_provenance(const struct slab *slab, const char *key, const char *inner) {
  json_t *page = json_loads(slab->json, 0, NULL);
  json_t *value = json_object_get(json_object_get(page, "provenance"), key);
  if (inner) value = json_object_get(value, inner);
  if (!json_is_number(value)) fail_msg("no provenance of %s %s", key, inner ? inner : "");
  double number = json_number_value(value);
  json_decref(page);
  return number;
}
