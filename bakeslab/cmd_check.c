/* cmd_check.c - bakeslab check: reads all of a slab, and looks whether its
 * light goes on beyond what was sampled (slab_profile.h). --error tells the slab's own error
 * (slab_floor.h). */
#include <math.h>
#include <stdio.h>

#include "cli.h"
#include "slab_file.h"
#include "slab_floor.h"
#include "slab_profile.h"

struct options {
  bool strict, error;
  char **paths;
  int count;
};

enum { OPTION_STRICT = 256, OPTION_ERROR };

static error_t parse(int key, char *argument, struct argp_state *state) {
  struct options *options = state->input;
  (void)argument;
  switch (key) {
  case OPTION_STRICT:
    options->strict = true;
    return 0;
  case OPTION_ERROR:
    options->error = true;
    return 0;
  case ARGP_KEY_ARGS:
    options->paths = state->argv + state->next;
    options->count = state->argc - state->next;
    return 0;
  case ARGP_KEY_NO_ARGS:
    argp_error(state, "no slab given");
    return EINVAL;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static enum slab_result judge_page(const char *path, int page, const struct slab *slab,
                                   int *warnings, struct slab_error *error) {
  struct slab_profile profile;
  enum slab_result result = slab_profile(slab, &profile, error);
  for (int k = 0; k < 2 * SLAB_AXES && !result; ++k) {
    int axis = k / 2, end = k % 2;
    double share = slab_profile_cut_off(&profile, axis, end);
    if (share == 0) continue;
    ++*warnings;
    printf("%s: page %d: warning: light is cut off at the %s end of %c (%s): the last samples "
           "have %.3g %% of the brightest, more than %g %%\n",
           path, page + 1, end ? "high" : "low", "uvst"[axis],
           axis < SLAB_S ? "uv rectangle" : "st window", 100 * share,
           100 * slab_profile_limit(axis));
  }
  slab_profile_free(&profile);
  return result;
}

/* " NAME 1.2 %", or that it is unknown. */
static void print_part(const char *before, const char *name, double part) {
  if (isnan(part))
    printf("%s%s unknown", before, name);
  else
    printf("%s%s %.2g %%", before, name, 100 * part);
}

static enum slab_result print_floor(const char *path, int page, const struct slab *slab,
                                    struct slab_error *error) {
  double distances[SLAB_FLOOR_DISTANCES];
  struct slab_floor floors[SLAB_FLOOR_DISTANCES], *floor = floors;
  for (int n = 0; n < SLAB_FLOOR_DISTANCES; ++n)
    distances[n] = slab_floor_apertures[n] * slab_aperture(slab);
  enum slab_result result =
      slab_floor_estimate(slab, SLAB_FLOOR_DISTANCES, distances, floors, error);
  for (; result == SLAB_OK && floor < floors + SLAB_FLOOR_DISTANCES; ++floor) {
    double apertures = floor->distance / slab_aperture(slab);
    printf("%s: page %d: error of irradiance at %g aperture%s (%.6g): ", path, page + 1, apertures,
           apertures > 1 ? "s" : "", floor->distance);
    if (isnan(floor->all))
      printf("unknown");
    else
      printf("%s%.2g %%", isnan(floor->st) || isnan(floor->uv) ? "at least " : "about ",
             100 * floor->all);
    print_part(" (", "st", floor->st);
    print_part(", ", "uv", floor->uv);
    print_part(", ", "noise", floor->noise);
    printf(")\n");
  }
  return result;
}

static enum slab_result check_file(const char *path, bool errors, int *warnings,
                                   struct slab_error *error) {
  struct slab_file *file = NULL;
  enum slab_result result = slab_file_open(path, &file, error);
  for (int page = 0; result == SLAB_OK && page < slab_file_pages(file); ++page) {
    struct slab slab = {0};
    result = slab_file_load(file, page, &slab, error);
    if (result == SLAB_OK) result = judge_page(path, page, &slab, warnings, error);
    if (result == SLAB_OK)
      printf("%s: page %d: valid, %d x %d x %d x %d samples\n", path, page + 1, slab.samples[0],
             slab.samples[1], slab.samples[2], slab.samples[3]);
    if (result == SLAB_OK && errors) result = print_floor(path, page, &slab, error);
    slab_free(&slab);
  }
  slab_file_close(file);
  return result;
}

int cmd_check(int argc, char **argv) {
  static const struct argp_option option[] = {
      {"strict", OPTION_STRICT, NULL, 0, "Exit with 1 after a warning too", 0},
      {"error", OPTION_ERROR, NULL, 0,
       "Estimate the slab's own error, below which no method's digits mean anything", 0},
      {0}};
  static const struct argp argp = {
      .options = option,
      .parser = parse,
      .children = cli_options,
      .args_doc = "SLAB...",
      .doc =
          "Validates light slabs: reads every sample and refuses what is malformed. Warns, on "
          "standard output, where light is cut off: where the mean radiance of the last samples "
          "of s or t is more than 2 % of that axis's brightest (enlarge the st window), and of "
          "u or v more than 50 % (the lamp's opening fills the rectangle and may go on beyond "
          "it). A warning is not an error.\n\n"
          "With --error, it tells how far the irradiance of a surface that faces the slab is "
          "off the lamp's, at 1, 4 and 16 apertures (longer edges of the rectangle; lamp units "
          "in brackets): the RMS of the error over the RMS of the irradiance. It is told from "
          "the slab alone: by what halving its resolution changes, for st and for uv, and by "
          "the noise that the bake recorded, which sharpening and resampling forget. Take it for "
          "the size of the error: of 54 test lamps that had no part in its making, it was "
          "within a factor of 2 for 45, and from 0.4 to 8 times the truth for all; for 38 of "
          "54, and up to 12 times, once sharpened. It is too small for hard edges seen from "
          "afar, and where a few rays a sample are all wrong alike."
          "\vExamples:\n"
          "  bakeslab check lamp.tif\n"
          "  bakeslab check --error lamp.tif\n"
          "  bakeslab check --strict lamps/*.tif"};
  struct options options = {0};
  argp_parse(&argp, argc, argv, 0, NULL, &options);
  int status = CLI_OK, warnings = 0;
  for (int k = 0; k < options.count; ++k) {
    struct slab_error error = {{0}};
    if (check_file(options.paths[k], options.error, &warnings, &error) != SLAB_OK)
      status = cli_fail(&error);
  }
  if (options.strict && warnings > 0) status = CLI_FAILED;
  return cli_close_stdout() == CLI_OK ? status : CLI_FAILED;
}
