/* helpers.c - see helpers.h. */
#include "helpers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double random_number(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (*seed >> 8) / 16777216.0;
}

struct slab awkward_slab(const int samples[SLAB_AXES], double distance) {
  struct slab slab = slab_default();
  memcpy(slab.samples, samples, sizeof slab.samples);
  snprintf(slab.name, sizeof slab.name, "awkward");
  /* u = 0.4 (.6,0,.8), v = 0.7 (0,1,0), n = (.8,0,-.6): u x v = 0.28 (-.8,0,.6) */
  const double u[3] = {0.24, 0, 0.32}, v[3] = {0, 0.7, 0}, n[3] = {0.8, 0, -0.6};
  const double center[3] = {1, -2, 0.5}, window[4] = {-0.3, 1.1, 0.2, 0.9};
  memcpy(slab.u, u, sizeof u);
  memcpy(slab.v, v, sizeof v);
  memcpy(slab.normal, n, sizeof n);
  memcpy(slab.center, center, sizeof center);
  memcpy(slab.st_window, window, sizeof window);
  slab.st_distance = distance;
  struct error error = {{0}};
  assert_ok(slab_alloc(&slab, &error), &error);
  return slab;
}

void fill_colours(struct slab *slab, uint32_t seed) {
  size_t count = slab_sample_count(slab);
  for (size_t k = 0; k < count; ++k)
    for (size_t c = 0; c < 3; ++c)
      slab->rgb[3 * k + c] =
          k % 7 == 0 && c > 0 ? slab->rgb[3 * k] : (float)(0.05 + random_number(&seed));
}

/* Weight of sample `index` of n at x on [low, high]. */
static double hat(int n, int index, double low, double high, double x) {
  if (x < low || x > high) return 0;
  double h = (high - low) / n, first = low + h / 2, last = high - h / 2;
  double clamped = x < first ? first : x > last ? last : x;
  double distance = fabs(clamped - (low + (index + 0.5) * h)) / h;
  return n == 1 ? 1 : distance < 1 ? 1 - distance : 0;
}

void oracle_lookup(const struct slab *slab, double a, double b, double s, double t, double rgb[3]) {
  double u = sqrt(slab->u[0] * slab->u[0] + slab->u[1] * slab->u[1] + slab->u[2] * slab->u[2]);
  double v = sqrt(slab->v[0] * slab->v[0] + slab->v[1] * slab->v[1] + slab->v[2] * slab->v[2]);
  const int *n = slab->samples;
  const double *w = slab->st_window;
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        for (int l = 0; l < n[3]; ++l) {
          double weight = hat(n[0], i, -u / 2, u / 2, a) * hat(n[1], j, -v / 2, v / 2, b) *
                          hat(n[2], k, w[0], w[1], s) * hat(n[3], l, w[2], w[3], t);
          /* pixel (i*Ns + k, j*Nt + l) of an image Nu*Ns wide */
          size_t pixel = (size_t)(j * n[3] + l) * (size_t)(n[0] * n[2]) + (size_t)(i * n[2] + k);
          for (size_t c = 0; c < 3; ++c) rgb[c] += weight * (double)slab->rgb[3 * pixel + c];
        }
}

void assert_ok(enum result result, const struct error *error) {
  if (result != RESULT_OK) fail_msg("result %d: %s", (int)result, error->text);
}

void assert_refused(enum result result, const struct error *error, ...) {
  if (result == RESULT_OK) fail_msg("was not refused");
  if (strchr(error->text, '\n') || !*error->text) fail_msg("not one line: '%s'", error->text);
  va_list pieces;
  va_start(pieces, error);
  const char *piece;
  while ((piece = va_arg(pieces, const char *)) != NULL)
    if (!strstr(error->text, piece)) fail_msg("'%s' does not say '%s'", error->text, piece);
  va_end(pieces);
}

void assert_file_refused(const char *path, const char *piece1, const char *piece2) {
  struct error error = {{0}};
  struct slab *slabs = NULL;
  int count = 0;
  enum result result = slab_file_load_all(path, &slabs, &count, &error);
  assert_null(slabs);
  assert_refused(result, &error, path, piece1, piece2, NULL);
}

void write_bytes(const char *path, const void *bytes, size_t count) {
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(bytes, 1, count, file), count);
  assert_int_equal(fclose(file), 0);
}

struct slab_sampling sampling_of(const struct slab *slab) {
  struct slab_sampling sampling;
  struct error error;
  assert_ok(slab_json_sampling(slab, &sampling, &error), &error);
  return sampling;
}

char *json_of(const struct slab *slab, const char *key, const char *inner) {
  json_t *root;
  struct error error;
  assert_ok(slab_json_root(slab, &root, &error), &error);
  const json_t *value = json_object_get(root, key);
  char *text = json_dumps(inner ? json_object_get(value, inner) : value, JSON_ENCODE_ANY);
  json_decref(root);
  return text;
}
