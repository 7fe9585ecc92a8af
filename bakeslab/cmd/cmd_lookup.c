/* cmd_lookup.c - bakeslab lookup: radiance of rays. A view is read when the first ray needs it. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/numbers.h"
#include "cmd/slab_options.h"
#include "file/slab_file.h"

struct options {
  const char *path;
  int page; /* 1-based; 0 for all */
};

static const struct argp_option options_list[] = {
    {"page", 'p', "N", 0, "Only this page, from 1 (all pages are added up)", 0}, {0}};
static const struct value values[] = {
    {'p', VALUE_WHOLE, offsetof(struct options, page), 1, 1000000}, {0}};

static error_t parse(int key, char *argument, struct argp_state *state) {
  struct options *options = state->input;
  if (values_take(values, options_list, key, argument, options, state) == 0) return 0;
  return cli_parse_file(key, argument, state, "slab", &options->path);
}

/* A page of which some views are loaded. Memory that no ray touches is never
 * committed by the system. */
struct lazy_page {
  struct slab slab;
  bool *loaded; /* [Nv][Nu] */
  float *view;  /* one view, as it is read */
};

static enum result open_page(struct slab_file *file, int page, struct lazy_page *lazy,
                             struct error *error) {
  enum result result = slab_copy_geometry(slab_file_page(file, page), &lazy->slab, error);
  if (result == RESULT_OK) result = slab_alloc(&lazy->slab, error);
  if (result != RESULT_OK) return result;
  const int *n = lazy->slab.samples;
  lazy->loaded = calloc((size_t)n[SLAB_U] * (size_t)n[SLAB_V], sizeof *lazy->loaded);
  lazy->view = calloc((size_t)n[SLAB_S] * (size_t)n[SLAB_T], 3 * sizeof *lazy->view);
  return lazy->loaded && lazy->view ? RESULT_OK : result_no_memory(error);
}

static void close_page(struct lazy_page *lazy) {
  slab_free(&lazy->slab);
  free(lazy->loaded);
  free(lazy->view);
}

static enum result need_view(struct slab_file *file, int page, struct lazy_page *lazy, int i, int j,
                             struct error *error) {
  const int *n = lazy->slab.samples;
  bool *loaded = &lazy->loaded[(size_t)j * (size_t)n[SLAB_U] + (size_t)i];
  if (*loaded) return RESULT_OK;
  enum result result = slab_file_read_view(file, page, i, j, lazy->view, error);
  if (result != RESULT_OK) return result;
  size_t row = 3 * (size_t)n[SLAB_S];
  for (int l = 0; l < n[SLAB_T]; ++l)
    memcpy(slab_at(&lazy->slab, i, j, 0, l), lazy->view + (size_t)l * row, row * sizeof(float));
  *loaded = true;
  return RESULT_OK;
}

/* The samples on both sides of a position along u or v, and one more on each side, so that
 * rounding does not matter. */
static void neighbours(const struct slab *slab, int axis, double position, int index[2]) {
  int last = slab->samples[axis] - 1;
  double cell = floor((position - slab_position(slab, axis, 0)) / slab_spacing(slab, axis));
  index[0] = cell < 0 ? 0 : cell > last ? last : (int)cell;
  index[1] = index[0] < last ? index[0] + 1 : last;
  if (index[0] > 0) --index[0];
  if (index[1] < last) ++index[1];
}

static enum result add_radiance(struct slab_file *file, int page, struct lazy_page *lazy,
                                const double ray[6], double sum[3], struct error *error) {
  double abst[4], rgb[3];
  int u[2], v[2];
  if (!slab_ray(&lazy->slab, ray, ray + 3, abst)) return RESULT_OK;
  double half_u = slab_spacing(&lazy->slab, SLAB_U) * lazy->slab.samples[SLAB_U] / 2;
  double half_v = slab_spacing(&lazy->slab, SLAB_V) * lazy->slab.samples[SLAB_V] / 2;
  if (!(fabs(abst[0]) <= 1.01 * half_u && fabs(abst[1]) <= 1.01 * half_v)) return RESULT_OK;
  neighbours(&lazy->slab, SLAB_U, abst[0], u);
  neighbours(&lazy->slab, SLAB_V, abst[1], v);
  for (int j = v[0]; j <= v[1]; ++j)
    for (int i = u[0]; i <= u[1]; ++i) {
      enum result result = need_view(file, page, lazy, i, j, error);
      if (result != RESULT_OK) return result;
    }
  slab_lookup(&lazy->slab, abst[0], abst[1], abst[2], abst[3], rgb);
  for (int c = 0; c < 3; ++c) sum[c] += rgb[c];
  return RESULT_OK;
}

/* 1 for a ray, 0 for a line without one, -1 for a line that is neither. */
static int parse_ray(const char *line, double ray[6]) {
  line += strspn(line, NUMBERS_BLANKS);
  if (!*line || *line == '#') return 0;
  const char *end = numbers_read(line, ' ', 6, ray);
  if (!end || end[strspn(end, NUMBERS_BLANKS)]) return -1;
  return ray[3] == 0 && ray[4] == 0 && ray[5] == 0 ? -1 : 1;
}

static enum result look_up(struct slab_file *file, struct lazy_page *pages, int first, int end,
                           struct error *error) {
  enum result result = RESULT_OK;
  char *line = NULL;
  size_t room = 0;
  for (long number = 1; result == RESULT_OK && !ferror(stdout) && getline(&line, &room, stdin) >= 0;
       ++number) {
    double ray[6], sum[3] = {0};
    int kind = parse_ray(line, ray);
    if (kind < 0)
      result =
          result_fail(error, RESULT_BAD,
                      "stdin: line %ld: is not a ray `ox oy oz dx dy dz` of finite numbers with "
                      "a direction",
                      number);
    if (kind <= 0) continue;
    for (int page = first; page < end && result == RESULT_OK; ++page)
      result = add_radiance(file, page, &pages[page], ray, sum, error);
    if (result == RESULT_OK) printf("%.9g %.9g %.9g\n", sum[0], sum[1], sum[2]);
  }
  if (result == RESULT_OK && !ferror(stdout) && !feof(stdin))
    result = result_fail(error, RESULT_IO, "stdin: %s", strerror(errno));
  free(line);
  return result;
}

static enum result run(const struct options *options, struct error *error) {
  struct slab_file *file = NULL;
  struct lazy_page *pages = NULL;
  enum result result = slab_file_open(options->path, &file, error);
  int count = result == RESULT_OK ? slab_file_pages(file) : 0;
  if (result == RESULT_OK && options->page > count)
    result = result_fail(error, RESULT_BAD, "%s: has no page %d, only %d", options->path,
                         options->page, count);
  if (result == RESULT_OK && !(pages = calloc((size_t)count, sizeof *pages)))
    result = result_at(result_no_memory(error), error, "%s", options->path);
  int first = options->page ? options->page - 1 : 0, end = options->page ? options->page : count;
  for (int page = first; page < end && result == RESULT_OK; ++page)
    result = open_page(file, page, &pages[page], error);
  if (result == RESULT_OK) result = look_up(file, pages, first, end, error);
  for (int page = 0; pages && page < count; ++page) close_page(&pages[page]);
  free(pages);
  slab_file_close(file);
  return result;
}

static const char doc[] =
    "Reads rays `ox oy oz dx dy dz` in lamp space from standard input, one a line, and "
    "prints the radiance `r g b` that leaves the lamp along each. The origin may be any "
    "point of the ray, before or behind the aperture. Empty lines and lines that start "
    "with # are skipped."
    "\vExamples:\n"
    "  echo 0 -1 0  0 -1 0 | bakeslab lookup lamp.tif\n"
    "  bakeslab lookup --page 1 lamp.tif < rays.txt";
static const struct argp argp = {options_list, parse, "SLAB", doc, cli_options, NULL, NULL};

int cmd_lookup(int argc, char **argv) {
  struct options options = {0};
  struct error error = {{0}};
  cli_parse(&argp, argc, argv, &options);
  if (!strcmp(options.path, "-")) {
    cli_complain("-: the rays come from stdin, so the slab must be a file");
    return CLI_USAGE;
  }
  return cli_end(run(&options, &error), &error);
}
