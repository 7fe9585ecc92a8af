/* helpers.c - see helpers.h. */
#include "helpers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void scale(double a[3], double length) {
  double by = length / sqrt(dot(a, a));
  for (int k = 0; k < 3; ++k) a[k] *= by;
}

/* a - (a . b) b, with b a unit vector. */
static void reject(double a[3], const double b[3]) {
  double along = dot(a, b);
  for (int k = 0; k < 3; ++k) a[k] -= along * b[k];
}

static void turn_frame(struct slab *slab, bool mirrored, uint64_t *seed) {
  double frame[3][3], *const axes[3] = {slab->u, slab->v, slab->normal};
  random_frame(seed, mirrored ? -1 : 1, frame);
  for (int k = 0; k < 3; ++k) {
    memcpy(axes[k], frame[k], sizeof frame[k]);
    if (k < 2) scale(axes[k], random_between(seed, 0.3, 1.3));
    slab->center[k] = random_between(seed, -4, 4);
  }
}

void fill_slab(struct slab *slab, enum fill fill, uint64_t seed) {
  size_t count = 3 * slab_sample_count(slab);
  for (size_t k = 0; k < count; ++k) {
    double x = random_number(&seed);
    slab->rgb[k] = fill == FILL_CONSTANT  ? 1
                   : fill == FILL_UNIFORM ? (float)x
                   : fill == FILL_EXTREME ? (x < 0.5 ? 0 : 2)
                                          : (float)(2 * x - 1);
  }
}

struct slab rough_slab(const int samples[SLAB_AXES], double distance, const double window[4],
                       enum frame frame, enum fill fill, uint64_t seed) {
  struct slab slab = slab_default();
  struct error error = {{0}};
  memcpy(slab.samples, samples, sizeof slab.samples);
  snprintf(slab.name, sizeof slab.name, "rough");
  for (int k = 0; k < 3; ++k) {
    slab.center[k] = 0;
    slab.u[k] = k == 0, slab.v[k] = k == 1, slab.normal[k] = k == 2;
  }
  if (frame != FRAME_PLAIN) turn_frame(&slab, frame == FRAME_MIRRORED, &seed);
  memcpy(slab.st_window, window, sizeof slab.st_window);
  slab.st_distance = distance;
  if (slab_check(&slab, &error) != RESULT_OK || slab_alloc(&slab, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  fill_slab(&slab, fill, seed);
  return slab;
}

void slab_point(const struct slab *slab, double a, double b, double z, double p[3]) {
  double u = sqrt(dot(slab->u, slab->u)), v = sqrt(dot(slab->v, slab->v));
  for (int k = 0; k < 3; ++k)
    p[k] = slab->center[k] + a / u * slab->u[k] + b / v * slab->v[k] + z * slab->normal[k];
}

struct surfel aimed_receiver(const struct slab *slab, double z, enum receiver_kind kind,
                             uint64_t *seed) {
  struct surfel receiver = {{0}, {0}};
  const double *w = slab->st_window;
  double kappa = isinf(slab->st_distance) ? 0 : 1 / slab->st_distance, from[3], to_light[3];
  double a = random_between(seed, -0.5, 0.5) * sqrt(dot(slab->u, slab->u));
  double b = random_between(seed, -0.5, 0.5) * sqrt(dot(slab->v, slab->v));
  double s = w[0] + (w[1] - w[0]) * random_between(seed, -0.1, 1.1);
  double t = w[2] + (w[3] - w[2]) * random_between(seed, -0.1, 1.1);
  slab_point(slab, a, b, 0, from);
  slab_point(slab, a + z * (s - kappa * a), b + z * (t - kappa * b), z, receiver.p);
  for (int k = 0; k < 3; ++k) to_light[k] = from[k] - receiver.p[k];
  scale(to_light, 1);
  random_direction(seed, receiver.n);
  for (int k = 0; k < 3 && kind == RECEIVER_FACING; ++k) receiver.n[k] = -slab->normal[k];
  if (kind == RECEIVER_CUT) {
    reject(receiver.n, to_light);
    scale(receiver.n, 1);
  } else if (dot(receiver.n, to_light) < 0) {
    for (int k = 0; k < 3; ++k) receiver.n[k] = -receiver.n[k];
  }
  return receiver;
}

void aim(const struct slab *slab, const double z[2], enum receiver_kind kind, uint64_t *seed,
         struct surfel *receivers, int count) {
  for (int k = 0; k < count; ++k) {
    enum receiver_kind one =
        kind == RECEIVER_KINDS ? (enum receiver_kind)(k % RECEIVER_KINDS) : kind;
    receivers[k] = aimed_receiver(slab, random_log(seed, z[0], z[1]), one, seed);
  }
}

const char *write_light(const char *name, const struct slab *slabs, int count) {
  struct error error = {{0}};
  const char *path = scratch(name);
  if (slab_file_write(path, slabs, count, SLAB_PRECISION_FLOAT, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return path;
}

static void write_receivers(const char *path, const struct surfel *receivers, int count) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  for (int k = 0; k < count; ++k) {
    const double *p = receivers[k].p, *n = receivers[k].n;
    fprintf(file, "%.17g %.17g %.17g %.17g %.17g %.17g\n", p[0], p[1], p[2], n[0], n[1], n[2]);
  }
  assert_int_equal(fclose(file), 0);
}

void irradiance(const struct surfel *receivers, int count, double rgb[][3], const char *arguments,
                ...) {
  char words[3000], command[sizeof words + 1300], line[256];
  static char input[600], output[600]; /* not among the caller's 8 */
  va_list list;
  if (!*input) {
    snprintf(input, sizeof input, "%s", scratch("receivers"));
    snprintf(output, sizeof output, "%s", scratch("irradiance"));
  }
  va_start(list, arguments);
  vsnprintf(words, sizeof words, arguments, list);
  va_end(list);
  assert_true(count <= COUNT_MAX);
  write_receivers(input, receivers, count);
  snprintf(command, sizeof command, "\"$RENDERSLAB\" irradiance %s <%s >%s", words, input, output);
  int status = system(command);
  if (status != 0) fail_msg("status %d: %s", status, command);
  FILE *file = fopen(output, "r");
  assert_non_null(file);
  for (int k = 0; k < count; ++k) {
    int end = 0;
    if (!fgets(line, sizeof line, file)) fail_msg("%d lines for %d receivers: %s", k, count, words);
    if (sscanf(line, "%lf %lf %lf %n", &rgb[k][0], &rgb[k][1], &rgb[k][2], &end) != 3 || line[end])
      fail_msg("not three numbers: %s", line);
    for (int c = 0; c < 3; ++c)
      if (!isfinite(rgb[k][c])) fail_msg("not finite: %s", line);
  }
  if (fgets(line, sizeof line, file)) fail_msg("a line too many: %s", line);
  fclose(file);
}

double relative_rms(double (*a)[3], double (*b)[3], int count) {
  double off = 0, all = 0;
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < 3; ++c) {
      off += (a[k][c] - b[k][c]) * (a[k][c] - b[k][c]);
      all += b[k][c] * b[k][c];
    }
  return sqrt(off / all);
}

struct light load_light(const struct slab *slabs, int count) {
  struct light light;
  struct error error = {{0}};
  if (light_load(write_light("light.tif", slabs, count), &light, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return light;
}

struct receiver receiver_at(const struct surfel *at) {
  struct receiver receiver = {.index = 0};
  memcpy(receiver.position, at->p, sizeof receiver.position);
  memcpy(receiver.normal, at->n, sizeof receiver.normal);
  memcpy(receiver.lift, at->n, sizeof receiver.lift);
  return receiver;
}

struct gather_counts sum_light(const struct gather_settings *settings,
                               const struct receiver *receivers, int count,
                               struct gathered *gathered) {
  struct error error = {{0}};
  struct gather *gather;
  if (gather_create(settings, &gather, &error) != RESULT_OK ||
      gather_light(gather, receivers, count, gathered, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  const struct gather_counts counts = *gather_counts(gather);
  gather_free(gather);
  return counts;
}
