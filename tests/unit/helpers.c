/* helpers.c - see helpers.h. */
#include "helpers.h"

#include <stdio.h>
#include <string.h>

#include "oracle/random.h"

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

void fill_colours(struct slab *slab, uint64_t seed) {
  size_t count = slab_sample_count(slab);
  for (size_t k = 0; k < count; ++k)
    for (size_t c = 0; c < 3; ++c)
      slab->rgb[3 * k + c] =
          k % 7 == 0 && c > 0 ? slab->rgb[3 * k] : (float)random_between(&seed, 0.05, 1.05);
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

struct slab *write_and_load(const char *path, const struct slab *pages, int count,
                            enum slab_precision precision) {
  struct error error = {{0}};
  struct slab *got = NULL;
  int found = 0;
  assert_ok(slab_file_write(path, pages, count, precision, &error), &error);
  assert_ok(slab_file_load_all(path, &got, &found, &error), &error);
  assert_int_equal(found, count);
  return got;
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
