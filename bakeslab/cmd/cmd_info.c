/* cmd_info.c - bakeslab info: what a slab is, for people or as JSON. The JSON has an object a page:
 *   page, name, channel (where it has one), precision, lossy (a compression, or null), samples,
 * center, u, v, normal, st_window, st_distance, metres_per_unit, radiance_unit, samples_are, flux
 * [r, g, b], flux_unit, peak [r, g, b], peak_sample [i, j, k, l], lowest (the smallest channel
 * value), error, provenance. error is an array of {apertures, noise, resolution, logluv, all}: the
 * slab's own error so many apertures away (slab_accuracy.h); null where it is not known, `all` is
 * that of what is known. Flux is in W or lm where the radiance has such a unit, always with lengths
 * in metres (slab_flux_metric). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cmd/slab_options.h"
#include "file/json_text.h"
#include "file/slab_file.h"
#include "file/slab_json.h"
#include "file/slab_source.h"
#include "slab/slab_accuracy.h"

struct options {
  const char *path;
  bool json;
};

static const struct argp_option options_list[] = {{"json", 'j', NULL, 0, "Print JSON", 0}, {0}};
static const struct value values[] = {{'j', VALUE_FLAG, offsetof(struct options, json), 0, 0}, {0}};

static error_t parse(int key, char *argument, struct argp_state *state) {
  struct options *options = state->input;
  if (values_take(values, options_list, key, argument, options, state) == 0) return 0;
  return cli_parse_file(key, argument, state, "slab", &options->path);
}

struct page {
  struct slab slab; /* its samples are freed once they are looked at */
  enum slab_precision precision;
  const char *lossy; /* of slab_file_lossy; the file's */
  double flux[3], peak[3], lowest;
  int peak_sample[SLAB_AXES];
  struct slab_accuracy accuracy[SLAB_ACCURACY_DISTANCES];
  json_t *root; /* the page's own JSON */
};

/* Flux, peak, lowest value and error. */
static enum result find_figures(struct page *page, struct error *error) {
  const struct slab *slab = &page->slab;
  const float *rgb = slab->rgb;
  size_t count = 3 * slab_sample_count(slab), highest = 0, lowest = 0;
  for (size_t n = 0; n < count; ++n) {
    if (rgb[n] > rgb[highest]) highest = n;
    if (rgb[n] < rgb[lowest]) lowest = n;
  }
  slab_locate(slab, highest / 3, page->peak_sample);
  for (size_t c = 0; c < 3; ++c) page->peak[c] = (double)rgb[highest / 3 * 3 + c];
  page->lowest = (double)rgb[lowest];
  struct slab_sampling sampling;
  enum result result = slab_json_sampling(slab, &sampling, error);
  if (result == RESULT_OK) result = slab_accuracy_table(slab, &sampling, page->accuracy, error);
  return result == RESULT_OK ? slab_flux_metric(slab, page->flux, error) : result;
}

static enum result read_page(struct slab_file *file, int number, struct page *page,
                             struct error *error) {
  page->precision = slab_file_precision(file, number);
  page->lossy = slab_file_lossy(file, number);
  enum result result = slab_file_load(file, number, &page->slab, error);
  if (result == RESULT_OK) result = slab_json_root(&page->slab, &page->root, error);
  if (result == RESULT_OK) result = find_figures(page, error);
  free(page->slab.rgb);
  page->slab.rgb = NULL;
  return result;
}

/* ---- JSON ---- */

static json_t *numbers(const double *list, size_t count) {
  json_t *array = json_array();
  for (size_t k = 0; k < count; ++k) json_array_append_new(array, json_real(list[k]));
  return array;
}

static json_t *number_or_null(double x) {
  return isfinite(x) ? json_real(x) : json_null();
}

static json_t *errors(const struct page *page) {
  json_t *array = json_array();
  for (int d = 0; d < SLAB_ACCURACY_DISTANCES; ++d) {
    const struct slab_accuracy *told = &page->accuracy[d];
    json_array_append_new(
        array,
        json_pack("{s:f, s:o, s:o, s:o, s:o}", "apertures", slab_accuracy_apertures[d], "noise",
                  number_or_null(told->noise), "resolution", number_or_null(told->resolution),
                  "logluv", json_real(told->logluv), "all", number_or_null(told->all)));
  }
  return array;
}

static json_t *describe(const struct page *page, int number) {
  const struct slab *slab = &page->slab;
  const int *n = slab->samples, *at = page->peak_sample;
  bool infinite = isinf(slab->st_distance);
  return json_pack("{s:i, s:s, s:s*, s:s, s:s?, s:[iiii], s:o, s:o, s:o, s:o, s:o, s:o, s:f, s:s, "
                   "s:O*, s:o, s:s, "
                   "s:o, "
                   "s:[iiii], s:f, s:o, s:O*}",
                   "page", number, "name", slab->name, "channel",
                   slab->channel[0] ? slab->channel : NULL, "precision",
                   cli_precision_name(page->precision), "lossy", page->lossy, "samples", n[0], n[1],
                   n[2], n[3], "center", numbers(slab->center, 3), "u", numbers(slab->u, 3), "v",
                   numbers(slab->v, 3), "normal", numbers(slab->normal, 3), "st_window",
                   numbers(slab->st_window, 4), "st_distance",
                   infinite ? json_null() : json_real(slab->st_distance), "metres_per_unit",
                   slab->metres_per_unit, "radiance_unit", slab->radiance_unit, "samples_are",
                   json_object_get(page->root, "samples_are"), "flux", numbers(page->flux, 3),
                   "flux_unit", slab_flux_unit(slab), "peak", numbers(page->peak, 3), "peak_sample",
                   at[0], at[1], at[2], at[3], "lowest", page->lowest, "error", errors(page),
                   "provenance", json_object_get(page->root, "provenance"));
}

static enum result print_json(const char *path, const struct page *pages, int count,
                              struct error *error) {
  char *text;
  unsigned long mark = json_mark();
  json_t *list = json_array();
  for (int n = 0; n < count; ++n) json_array_append_new(list, describe(&pages[n], n + 1));
  json_t *root = json_pack("{s:o, s:o}", "file", json_any_string(path), "pages", list);
  enum result result =
      json_text(root, mark, JSON_INDENT(2) | JSON_REAL_PRECISION(17), &text, error);
  if (result == RESULT_OK) puts(text);
  free(text);
  json_decref(root);
  return result;
}

/* ---- Text ---- */

static void print_vector(const char *label, const double v[3]) {
  printf("  %-14s%g %g %g\n", label, v[0], v[1], v[2]);
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

static void print_error(const struct slab_accuracy *told, double apertures) {
  const struct {
    const char *name;
    double part;
  } parts[] = {{"noise", told->noise}, {"resolution", told->resolution}, {"LogLuv", told->logluv}};
  bool lacks = isnan(told->st) || isnan(told->uv) || isnan(told->noise);
  printf("  %-14s", "error");
  for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k)
    if (isnan(parts[k].part))
      printf("%s unknown, ", parts[k].name);
    else
      printf("%s %.2g %%, ", parts[k].name, 100 * parts[k].part);
  if (isnan(told->all))
    printf("all unknown");
  else
    printf("all %s%.2g %%", lacks ? "at least " : "", 100 * told->all);
  printf(" at %g aperture%s (%.6g)\n", apertures, apertures > 1 ? "s" : "", told->distance);
}

static void print_page(const char *path, const struct page *page, int number, int count) {
  const struct slab *slab = &page->slab;
  const int *n = slab->samples, *at = page->peak_sample;
  const double *w = slab->st_window, *flux = page->flux, *peak = page->peak;
  printf("%s: page %d of %d: %s\n", path, number, count, slab->name);
  if (slab->channel[0]) printf("  %-14s%s\n", "channel", slab->channel);
  printf("  %-14s%d x %d x %d x %d, %s%s%s\n", "samples", n[0], n[1], n[2], n[3],
         cli_precision_name(page->precision),
         page->lossy ? ", changed by the lossy compression " : "", page->lossy ? page->lossy : "");
  print_vector("center", slab->center);
  print_vector("u", slab->u);
  print_vector("v", slab->v);
  print_vector("normal", slab->normal);
  printf("  %-14s%g %g x %g %g\n", "st window", w[0], w[1], w[2], w[3]);
  if (isinf(slab->st_distance))
    printf("  %-14sinfinite\n", "st distance");
  else
    printf("  %-14s%g\n", "st distance", slab->st_distance);
  printf("  %-14s%g\n", "metres/unit", slab->metres_per_unit);
  printf("  %-14s%.6g %.6g %.6g (%s)\n", "flux", flux[0], flux[1], flux[2], slab_flux_unit(slab));
  printf("  %-14s%.6g %.6g %.6g (%s) at sample (%d, %d, %d, %d)\n", "peak", peak[0], peak[1],
         peak[2], slab->radiance_unit, at[0], at[1], at[2], at[3]);
  printf("  %-14s%.6g\n", "lowest", page->lowest);
  for (int d = 0; d < SLAB_ACCURACY_DISTANCES; ++d)
    print_error(&page->accuracy[d], slab_accuracy_apertures[d]);
  const char *how = json_string_value(json_object_get(page->root, "samples_are"));
  if (how) printf("  %-14s%s\n", "samples are", how);
}

static enum result print_source(const struct slab *slab, struct error *error) {
  char *line;
  enum result result = slab_source_line(slab, &line, error);
  if (line) printf("  %-14s%s\n", "imported from", line);
  free(line);
  return result;
}

static enum result print_provenance(const struct page *page, struct error *error) {
  json_t *provenance = json_object_get(page->root, "provenance"), *value;
  const char *key;
  enum result result = RESULT_OK;
  if (provenance) printf("  provenance\n");
  if (provenance && !json_is_object(provenance)) return print_value("", provenance, error);
  json_object_foreach(provenance, key, value) {
    if (result == RESULT_OK) result = print_value(key, value, error);
  }
  return result;
}

/* The flux of each channel, all of its pages together: in order of their first pages. */
static void print_channels(const char *path, const struct page *pages, int count) {
  for (int n = 0; n < count; ++n) {
    const struct slab *slab = &pages[n].slab;
    double flux[3] = {0};
    bool first = slab->channel[0] != 0;
    for (int k = 0; k < n; ++k) first &= !slab_same_channel(&pages[k].slab, slab);
    if (!first) continue;
    for (int k = n; k < count; ++k)
      for (int c = 0; c < 3 && slab_same_channel(&pages[k].slab, slab); ++c)
        flux[c] += pages[k].flux[c];
    printf("%s: channel %s: flux %.6g %.6g %.6g (%s)\n", path, slab->channel, flux[0], flux[1],
           flux[2], slab_flux_unit(slab));
  }
}

static enum result run(void *input, struct error *error) {
  const struct options *options = input;
  struct slab_file *file = NULL;
  struct page *pages = NULL;
  enum result result = slab_file_open(options->path, &file, error);
  int count = result == RESULT_OK ? slab_file_pages(file) : 0;
  if (result == RESULT_OK && !(pages = calloc((size_t)count, sizeof *pages)))
    result = result_no_memory(error);
  for (int n = 0; n < count && result == RESULT_OK; ++n)
    result = read_page(file, n, &pages[n], error);
  if (result == RESULT_OK && options->json) result = print_json(options->path, pages, count, error);
  for (int n = 0; n < count && result == RESULT_OK && !options->json; ++n) {
    print_page(options->path, &pages[n], n + 1, count);
    result = print_source(&pages[n].slab, error);
    if (result == RESULT_OK) result = print_provenance(&pages[n], error);
  }
  if (result == RESULT_OK && !options->json) print_channels(options->path, pages, count);
  for (int n = 0; pages && n < count; ++n) {
    json_decref(pages[n].root);
    slab_free(&pages[n].slab);
  }
  free(pages);
  slab_file_close(file);
  return result;
}

static const char doc[] =
    "Prints what a light slab is: geometry, samples, flux and peak of each page, and how "
    "it was made: the effects, the estimated noise and the rest of its provenance; and its own "
    "error of irradiance on a surface that faces it, estimated as by check --error, by noise, "
    "resolution and rounding to LogLuv, which scenes lit by it inherit. Of a lamp whose bulbs are "
    "in channels, also the flux of each. Flux "
    "is the integral of the interpolated radiance times the cosine, with lengths in "
    "metres: in W or lm where the radiance has a unit."
    "\vExamples:\n"
    "  bakeslab info lamp.tif\n"
    "  bakeslab info --json lamp.tif | jq '.pages[0].flux'";

static const struct argp argp = {options_list, parse, "SLAB", doc, cli_options, NULL, NULL};

int cmd_info(int argc, char **argv) {
  struct options options = {0};
  return cli_run(&argp, argc, argv, run, &options);
}
