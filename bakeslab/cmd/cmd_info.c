/* cmd_info.c - bakeslab info: what a slab is, for people or as JSON. Both are
 * printed from one JSON object a page:
 *   page, name, precision, samples, center, u, v, normal, st_window,
 *   st_distance, metres_per_unit, radiance_unit, samples_are, provenance,
 *   flux [r, g, b], flux_unit, peak [r, g, b], peak_sample [i, j, k, l],
 *   lowest (the smallest channel value).
 * Flux is in W or lm where the radiance has such a unit, always with lengths in
 * metres (slab_flux_metric). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cmd/slab_options.h"
#include "file/json_text.h"
#include "file/slab_file.h"
#include "file/slab_json.h"

struct options {
  const char *path;
  bool json;
};

static error_t parse(int key, char *argument, struct argp_state *state) {
  struct options *options = state->input;
  switch (key) {
  case 'j':
    options->json = true;
    return 0;
  default:
    return cli_parse_slab(key, argument, state, &options->path);
  }
}

static json_t *numbers(const double *values, size_t count) {
  json_t *array = json_array();
  for (size_t k = 0; k < count; ++k) json_array_append_new(array, json_real(values[k]));
  return array;
}

static json_t *integers(const int *values, size_t count) {
  json_t *array = json_array();
  for (size_t k = 0; k < count; ++k) json_array_append_new(array, json_integer(values[k]));
  return array;
}

/* Flux, peak and lowest value. */
static void add_figures(json_t *page, const struct slab *slab, const double flux[3]) {
  double peak[3];
  const size_t count = slab_sample_count(slab);
  size_t brightest = 0;
  float most = -INFINITY, lowest = INFINITY;
  for (size_t k = 0; k < count; ++k)
    for (size_t c = 0; c < 3; ++c) {
      float value = slab->rgb[3 * k + c];
      if (value > most) {
        most = value;
        brightest = k;
      }
      if (value < lowest) lowest = value;
    }
  for (size_t c = 0; c < 3; ++c) peak[c] = (double)slab->rgb[3 * brightest + c];
  int where[SLAB_AXES];
  slab_locate(slab, brightest, where);
  json_object_set_new(page, "flux", numbers(flux, 3));
  json_object_set_new(page, "flux_unit", json_string(slab_flux_unit(slab)));
  json_object_set_new(page, "peak", numbers(peak, 3));
  json_object_set_new(page, "peak_sample", integers(where, 4));
  json_object_set_new(page, "lowest", json_real((double)lowest));
}

static void add_kept(json_t *page, const json_t *root, const char *key) {
  json_object_set(page, key, json_object_get(root, key)); /* NULL: not set */
}

static json_t *describe(const struct slab *slab, const json_t *root, int number,
                        enum slab_precision precision, const double flux[3]) {
  json_t *page = json_object();
  json_object_set_new(page, "page", json_integer(number));
  json_object_set_new(page, "name", json_string(slab->name));
  json_object_set_new(page, "precision", json_string(cli_precision_name(precision)));
  json_object_set_new(page, "samples", integers(slab->samples, SLAB_AXES));
  json_object_set_new(page, "center", numbers(slab->center, 3));
  json_object_set_new(page, "u", numbers(slab->u, 3));
  json_object_set_new(page, "v", numbers(slab->v, 3));
  json_object_set_new(page, "normal", numbers(slab->normal, 3));
  json_object_set_new(page, "st_window", numbers(slab->st_window, 4));
  json_object_set_new(page, "st_distance",
                      isinf(slab->st_distance) ? json_null() : json_real(slab->st_distance));
  json_object_set_new(page, "metres_per_unit", json_real(slab->metres_per_unit));
  json_object_set_new(page, "radiance_unit", json_string(slab->radiance_unit));
  add_kept(page, root, "samples_are");
  add_figures(page, slab, flux);
  add_kept(page, root, "provenance");
  return page;
}

static double item(const json_t *page, const char *key, size_t k) {
  return json_number_value(json_array_get(json_object_get(page, key), k));
}

static void print_vector(const json_t *page, const char *key) {
  printf("  %-14s%g %g %g\n", key, item(page, key, 0), item(page, key, 1), item(page, key, 2));
}

static enum result print_value(const char *key, const json_t *value, struct error *error) {
  char *text = NULL;
  enum result result = RESULT_OK;
  if (!json_is_string(value))
    result = json_text(value, json_mark(), JSON_REAL_PRECISION(6), &text, error);
  if (result == RESULT_OK) printf("    %-12s%s\n", key, text ? text : json_string_value(value));
  free(text);
  return result;
}

static enum result print_page(const char *path, const json_t *page, int pages,
                              struct error *error) {
  const char *unit = json_string_value(json_object_get(page, "radiance_unit"));
  const json_t *distance = json_object_get(page, "st_distance");
  printf("%s: page %d of %d: %s\n", path, (int)json_integer_value(json_object_get(page, "page")),
         pages, json_string_value(json_object_get(page, "name")));
  printf("  %-14s%g x %g x %g x %g, %s\n", "samples", item(page, "samples", 0),
         item(page, "samples", 1), item(page, "samples", 2), item(page, "samples", 3),
         json_string_value(json_object_get(page, "precision")));
  print_vector(page, "center");
  print_vector(page, "u");
  print_vector(page, "v");
  print_vector(page, "normal");
  printf("  %-14s%g %g x %g %g\n", "st window", item(page, "st_window", 0),
         item(page, "st_window", 1), item(page, "st_window", 2), item(page, "st_window", 3));
  if (json_is_null(distance))
    printf("  %-14sinfinite\n", "st distance");
  else
    printf("  %-14s%g\n", "st distance", json_number_value(distance));
  printf("  %-14s%g\n", "metres/unit", json_number_value(json_object_get(page, "metres_per_unit")));
  printf("  %-14s%.6g %.6g %.6g (%s)\n", "flux", item(page, "flux", 0), item(page, "flux", 1),
         item(page, "flux", 2), json_string_value(json_object_get(page, "flux_unit")));
  printf("  %-14s%.6g %.6g %.6g (%s) at sample (%g, %g, %g, %g)\n", "peak", item(page, "peak", 0),
         item(page, "peak", 1), item(page, "peak", 2), unit, item(page, "peak_sample", 0),
         item(page, "peak_sample", 1), item(page, "peak_sample", 2), item(page, "peak_sample", 3));
  printf("  %-14s%.6g\n", "lowest", json_number_value(json_object_get(page, "lowest")));
  const char *how = json_string_value(json_object_get(page, "samples_are"));
  if (how) printf("  %-14s%s\n", "samples are", how);
  const char *key;
  json_t *value, *provenance = json_object_get(page, "provenance");
  if (provenance) printf("  provenance\n");
  if (provenance && !json_is_object(provenance)) return print_value("", provenance, error);
  enum result result = RESULT_OK;
  json_object_foreach(provenance, key, value) {
    if (result == RESULT_OK) result = print_value(key, value, error);
  }
  return result;
}

static enum result print_json(const char *path, json_t *pages, unsigned long mark,
                              struct error *error) {
  char *text;
  json_t *root = json_object();
  json_object_set_new(root, "file", json_any_string(path));
  json_object_set(root, "pages", pages);
  enum result result =
      json_text(root, mark, JSON_INDENT(2) | JSON_REAL_PRECISION(17), &text, error);
  if (result == RESULT_OK) puts(text);
  free(text);
  json_decref(root);
  return result;
}

static enum result collect(const char *path, json_t *pages, struct error *error) {
  struct slab_file *file = NULL;
  enum result result = slab_file_open(path, &file, error);
  for (int page = 0; result == RESULT_OK && page < slab_file_pages(file); ++page) {
    struct slab slab = {0};
    double flux[3];
    json_t *root = NULL;
    result = slab_file_load(file, page, &slab, error);
    if (result == RESULT_OK) result = slab_json_root(&slab, &root, error);
    if (result == RESULT_OK && slab_flux_metric(&slab, flux) != RESULT_OK)
      result = result_fail(error, RESULT_MEMORY, "%s: out of memory", path);
    if (result == RESULT_OK)
      json_array_append_new(pages,
                            describe(&slab, root, page + 1, slab_file_precision(file, page), flux));
    json_decref(root);
    slab_free(&slab);
  }
  slab_file_close(file);
  return result;
}

int cmd_info(int argc, char **argv) {
  static const struct argp_option option[] = {{"json", 'j', NULL, 0, "Print JSON", 0}, {0}};
  static const struct argp argp = {
      .options = option,
      .parser = parse,
      .children = cli_options,
      .args_doc = "SLAB",
      .doc =
          "Prints what a light slab is: geometry, samples, flux and peak of each page, and how it "
          "was made: effects, estimated noise and the rest of its provenance. Flux is the "
          "integral of the interpolated radiance times the cosine, with lengths in metres: in "
          "W or lm where the radiance has a unit."
          "\vExamples:\n"
          "  bakeslab info lamp.tif\n"
          "  bakeslab info --json lamp.tif | jq '.pages[0].flux'"};
  struct options options = {0};
  struct error error = {{0}};
  cli_parse(&argp, argc, argv, &options);
  unsigned long mark = json_mark();
  json_t *pages = json_array();
  enum result result = collect(options.path, pages, &error);
  if (result == RESULT_OK) result = json_whole(mark, &error);
  if (result == RESULT_OK && options.json) result = print_json(options.path, pages, mark, &error);
  for (size_t k = 0; !options.json && result == RESULT_OK && k < json_array_size(pages); ++k)
    result =
        print_page(options.path, json_array_get(pages, k), (int)json_array_size(pages), &error);
  json_decref(pages);
  return cli_end(result, &error);
}
