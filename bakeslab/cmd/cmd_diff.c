/* cmd_diff.c - bakeslab diff: compares the samples and the frames of two
 * slabs. Exit status 0: same within the tolerance, 1: they differ, 2: failed. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "cmd/slab_options.h"
#include "file/slab_file.h"

enum { DIFFER = 1 };

struct options {
  const char *paths[2];
  double tolerance; /* of the largest difference, relative to the peak */
  bool differ;      /* what came out */
};

static const struct argp_option options_list[] = {
    {"tolerance", 't', "T", 0,
     "Largest difference of a sample that still counts as same, relative to the page's peak "
     "(default 0)",
     0},
    {0}};
static const struct value values[] = {
    {'t', VALUE_REAL, offsetof(struct options, tolerance), 0, INFINITY}, {0}};

static error_t parse(int key, char *argument, struct argp_state *state) {
  struct options *options = state->input;
  switch (key) {
  case ARGP_KEY_ARG:
    if (state->arg_num >= 2) argp_error(state, "%s: two slabs at a time", argument);
    options->paths[state->arg_num] = argument;
    return 0;
  case ARGP_KEY_END:
    if (state->arg_num < 2) argp_error(state, "give two slabs");
    return 0;
  default:
    return values_take(values, options_list, key, argument, options, state);
  }
}

/* What two pages differ in that makes their samples incomparable, or NULL. */
static const char *different_frame(const struct slab *a, const struct slab *b) {
  double scale =
      slab_spacing(a, SLAB_U) * a->samples[SLAB_U] + slab_spacing(a, SLAB_V) * a->samples[SLAB_V];
  double opening =
      fabs(a->st_window[1] - a->st_window[0]) + fabs(a->st_window[3] - a->st_window[2]);
  const double rounding = 1e-9; /* of positions, relative to the aperture */
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    if (a->samples[axis] != b->samples[axis]) return "samples";
  for (int c = 0; c < 3; ++c) {
    if (fabs(a->center[c] - b->center[c]) > rounding * scale) return "center";
    if (fabs(a->u[c] - b->u[c]) > rounding * scale) return "u";
    if (fabs(a->v[c] - b->v[c]) > rounding * scale) return "v";
    if (fabs(a->normal[c] - b->normal[c]) > rounding) return "normal";
  }
  for (int k = 0; k < 4; ++k)
    if (fabs(a->st_window[k] - b->st_window[k]) > rounding * opening) return "st_window";
  if (fabs(slab_kappa(a) - slab_kappa(b)) * scale > rounding * opening) return "st_distance";
  return NULL;
}

/* Prints what the samples of two pages differ by. */
static enum result compare_samples(int page, const struct slab *a, const struct slab *b,
                                   struct options *options, struct error *error) {
  size_t count = 3 * slab_sample_count(a), worst = 0;
  double peak = 0, largest = 0, squares = 0, flux_a[3], flux_b[3];
  for (size_t k = 0; k < count; ++k) {
    double x = (double)a->rgb[k], y = (double)b->rgb[k], difference = fabs(x - y);
    peak = fmax(peak, fmax(fabs(x), fabs(y)));
    squares += difference * difference;
    if (difference > largest) {
      largest = difference;
      worst = k / 3;
    }
  }
  double rmse = sqrt(squares / (double)count), scale = peak > 0 ? peak : 1;
  int at[SLAB_AXES];
  slab_locate(a, worst, at);
  enum result result = slab_flux_metric(a, flux_a, error);
  if (result == RESULT_OK) result = slab_flux_metric(b, flux_b, error);
  if (result != RESULT_OK) return result;
  printf("page %d: rmse %.6g (%.3g of the peak %.6g), largest %.6g (%.3g of the peak) at sample "
         "(%d, %d, %d, %d)\n",
         page + 1, rmse, rmse / scale, peak, largest, largest / scale, at[SLAB_U], at[SLAB_V],
         at[SLAB_S], at[SLAB_T]);
  printf("page %d: flux %.6g %.6g %.6g and %.6g %.6g %.6g\n", page + 1, flux_a[0], flux_a[1],
         flux_a[2], flux_b[0], flux_b[1], flux_b[2]);
  options->differ |= largest > options->tolerance * peak;
  return RESULT_OK;
}

static enum result compare(void *input, struct error *error) {
  struct options *options = input;
  struct slab *slabs[2] = {NULL, NULL};
  int count[2] = {0, 0};
  enum result result = RESULT_OK;
  for (int k = 0; k < 2 && result == RESULT_OK; ++k)
    result = slab_file_load_all(options->paths[k], &slabs[k], &count[k], error);
  if (result == RESULT_OK && count[0] != count[1]) {
    printf("pages: %d and %d\n", count[0], count[1]);
    options->differ = true;
  }
  for (int page = 0; page < count[0] && count[0] == count[1] && result == RESULT_OK; ++page) {
    const struct slab *a = &slabs[0][page], *b = &slabs[1][page];
    const char *what = different_frame(a, b);
    if (what) {
      printf("page %d: \"%s\" differs\n", page + 1, what);
      options->differ = true;
    } else {
      result = compare_samples(page, a, b, options, error);
    }
  }
  for (int k = 0; k < 2; ++k) slab_file_free_all(slabs[k], count[k]);
  return result;
}

static const char doc[] =
    "Compares two light slabs page by page: RMSE, largest difference, flux (as bakeslab "
    "info prints it). Slabs whose geometry or numbers of samples are not the same differ; "
    "bakeslab convert changes the numbers of samples."
    "\vExit status: 0 same, 1 they differ, 2 trouble.\n"
    "\n"
    "Examples:\n"
    "  bakeslab diff before.tif after.tif\n"
    "  bakeslab diff --tolerance 0.022 float.exr logluv.tif";
static const struct argp argp = {options_list, parse, "A B", doc, cli_options, NULL, NULL};

int cmd_diff(int argc, char **argv) {
  struct options options = {0};
  int status = cli_run(&argp, argc, argv, compare, &options);
  return status == CLI_OK && options.differ ? DIFFER : status;
}
