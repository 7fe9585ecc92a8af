/* cmd_convert.c - bakeslab convert: other container, precision, resolution; sharpening. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/version.h"
#include "cmd/slab_options.h"
#include "file/slab_file.h"
#include "file/slab_json.h"
#include "slab/slab_resample.h"
#include "slab/slab_sharpen_gain.h"

struct options {
  const char *input, *output;
  enum slab_precision precision;
  int samples[SLAB_AXES];               /* 0: as it is */
  int first[SLAB_AXES], end[SLAB_AXES]; /* end 0: all */
  bool sharpen, positive;
};

#define OPTION(member) offsetof(struct options, member)
#define KEY(member) VALUE_KEY(struct options, member)

static const struct argp_option options_list[] = {
    {"output", 'o', "OUT", 0,
     "The file to write: .tif, .tiff or .exr; - writes a TIFF to standard output", 0},
    {"precision", KEY(precision), CLI_PRECISIONS, 0,
     "Number format of the samples: logluv (4 bytes) is the default for TIFF, float for EXR", 0},
    {"uv", KEY(samples[SLAB_U]), "NxM", 0, "Samples along u and v", 0},
    {"st", KEY(samples[SLAB_S]), "NxM", 0, "Samples along s and t", 0},
    {"crop", KEY(first), "RANGE", 0,
     "Keep a part, before anything else: uv=I0:I1,J0:J1 or st=K0:K1,L0:L1, sample numbers from "
     "0, the end not included. May be given for both.",
     0},
    {"sharpen", KEY(sharpen), "st", 0,
     "The only value is st: after all else, sharpen along s and t, so that the interpolated "
     "radiance keeps the means over cells that the samples are; but no page that would become "
     "worse",
     0},
    {"positive", KEY(positive), NULL, 0,
     "With --sharpen, no sample becomes negative, as always in LogLuv; include needs it", 0},
    {0}};

static const struct value values[] = {
    {'o', VALUE_TEXT, OPTION(output), 0, 0},
    {KEY(precision), VALUE_WORD, OPTION(precision), SLAB_PRECISION_LOGLUV, 0},
    {KEY(samples[SLAB_U]), VALUE_SIZE, OPTION(samples[SLAB_U]), 0, 0},
    {KEY(samples[SLAB_S]), VALUE_SIZE, OPTION(samples[SLAB_S]), 0, 0},
    {KEY(positive), VALUE_FLAG, OPTION(positive), 0, 0},
    {0}};

/* uv=I0:I1,J0:J1 or st=K0:K1,L0:L1 */
static void parse_crop(const char *text, struct options *options, struct argp_state *state) {
  int axis = !strncmp(text, "uv=", 3) ? SLAB_U : !strncmp(text, "st=", 3) ? SLAB_S : -1;
  int *first = options->first, *end = options->end, used = 0;
  if (axis >= 0 &&
      sscanf(text + 3, "%9d:%9d,%9d:%9d%n", &first[axis], &end[axis], &first[axis + 1],
             &end[axis + 1], &used) == 4 &&
      !text[3 + used] && first[axis] >= 0 && first[axis] < end[axis] && first[axis + 1] >= 0 &&
      first[axis + 1] < end[axis + 1])
    return;
  argp_error(state, "--crop %s: must be uv=I0:I1,J0:J1 or st=K0:K1,L0:L1 with first < end", text);
}

static error_t parse(int key, char *argument, struct argp_state *state) {
  struct options *options = state->input;
  switch (key) {
  case KEY(first):
    parse_crop(argument, options, state);
    return 0;
  case KEY(sharpen):
    if (strcmp(argument, "st") != 0) argp_error(state, "--sharpen %s: must be st", argument);
    options->sharpen = true;
    return 0;
  case ARGP_KEY_SUCCESS:
    if (!options->output) argp_error(state, "no output given: -o OUT");
    if (options->positive && !options->sharpen) argp_error(state, "--positive needs --sharpen");
    return 0;
  default:
    if (values_take(values, options_list, key, argument, options, state) == 0) return 0;
    return cli_parse_file(key, argument, state, "slab", &options->input);
  }
}

static void replace(struct slab *slab, const struct slab *with) {
  slab_free(slab);
  *slab = *with;
}

/* Cell means alone can be sharpened, and once. Resampled, a sharpened slab would be neither cell
 * means nor sharpened. */
static enum result check_sharpening(const struct options *options, const struct slab *slab,
                                    bool resample_st, struct error *error) {
  struct slab_sampling sampling = {0};
  enum result result = slab_json_sampling(slab, &sampling, error);
  if (result != RESULT_OK) return result;
  if (sampling.sharpened && options->sharpen)
    return result_fail(error, RESULT_BAD, "is sharpened already, as its provenance says");
  if (sampling.sharpened && resample_st)
    return result_fail(error, RESULT_BAD,
                       "is sharpened: give --st to the convert that sharpens the slab it is from");
  if (sampling.points && options->sharpen)
    return result_fail(
        error, RESULT_BAD,
        "its samples are points: only means over cells can be sharpened (bake without "
        "--centre)");
  return RESULT_OK;
}

static enum slab_sharpening how_to_sharpen(const struct options *options) {
  enum slab_precision precision = slab_file_precision_of(options->output, options->precision);
  return options->positive || precision == SLAB_PRECISION_LOGLUV ? SLAB_SHARPEN_POSITIVE
                                                                 : SLAB_SHARPEN_EXACT;
}

/* Whether sharpening pays, which is told. The bake's noise is not that of other samples. */
static enum result judge_sharpening(const struct options *options, int page,
                                    const struct slab *slab, bool changed, bool *pays,
                                    struct error *error) {
  struct slab_sampling sampling = {0};
  double gain = NAN;
  enum result result = slab_json_sampling(slab, &sampling, error);
  if (changed) sampling.sample_noise = sampling.flux_noise = NAN;
  if (result == RESULT_OK)
    result = slab_sharpen_gain(slab, &sampling, how_to_sharpen(options), &gain, error);
  *pays = gain <= slab_sharpen_pays;
  if (result != RESULT_OK) return result;
  if (isnan(gain))
    cli_note("%s: page %d: note: not sharpened: too few samples, or no blur, to judge it by",
             options->input, page + 1);
  else
    cli_note("%s: page %d: note: %s: its error %s some %.2g times what it %s", options->input,
             page + 1, *pays ? "sharpened" : "not sharpened", *pays ? "is" : "would be", gain,
             *pays ? "was" : "is");
  return RESULT_OK;
}

static enum result sharpen_page(const struct options *options, struct slab *slab,
                                struct error *error) {
  enum slab_sharpening how = how_to_sharpen(options);
  enum result result = slab_sharpen(slab, how, error);
  return result == RESULT_OK ? slab_json_record_sharpening(slab, how, error) : result;
}

static enum result convert_page(const struct options *options, int page, struct slab *slab,
                                struct error *error) {
  int first[SLAB_AXES], end[SLAB_AXES], samples[SLAB_AXES];
  bool crop = false, resample = false, resample_st = false, sharpen = options->sharpen;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    first[axis] = options->end[axis] ? options->first[axis] : 0;
    end[axis] = options->end[axis] ? options->end[axis] : slab->samples[axis];
    crop |= first[axis] != 0 || end[axis] != slab->samples[axis];
    samples[axis] = options->samples[axis] ? options->samples[axis] : end[axis] - first[axis];
    resample |= samples[axis] != end[axis] - first[axis];
    resample_st |= axis >= SLAB_S && samples[axis] != end[axis] - first[axis];
  }
  enum result result = check_sharpening(options, slab, resample_st, error);
  struct slab other = {0};
  if (crop && result == RESULT_OK) {
    result = slab_crop(slab, first, end, &other, error);
    if (result == RESULT_OK) replace(slab, &other);
  }
  if (resample && result == RESULT_OK) {
    result = slab_resample(slab, samples, &other, error);
    if (result == RESULT_OK) replace(slab, &other);
  }
  if (result == RESULT_OK && sharpen)
    result = judge_sharpening(options, page, slab, crop || resample, &sharpen, error);
  if (result == RESULT_OK)
    result = slab_json_record(slab, cli_command_line(), "bakeslab " CANNED_VERSION,
                              crop || resample || sharpen, error);
  if (result == RESULT_OK && sharpen) result = sharpen_page(options, slab, error);
  return result;
}

static enum result run(void *input, struct error *error) {
  const struct options *options = input;
  struct slab *slabs = NULL;
  int count = 0;
  enum result result = slab_file_load_all(options->input, &slabs, &count, error);
  for (int page = 0; page < count && result == RESULT_OK; ++page) {
    result = convert_page(options, page, &slabs[page], error);
    result_at(result, error, "%s: page %d", options->input, page + 1);
  }
  if (result == RESULT_OK)
    result = slab_file_write(options->output, slabs, count, options->precision, error);
  slab_file_free_all(slabs, count);
  return result;
}

static const char doc[] =
    "Writes a light slab into another container, or with another precision or resolution. "
    "Fewer samples are means over the new cells, more are interpolated. The command is "
    "recorded in the provenance.\n\n"
    "--sharpen st removes the blur that interpolation adds to cell means along s and t. "
    "The sum of each view's samples stays. Samples beside edges may become negative; in "
    "LogLuv, and with --positive, light moves between neighbouring cells only as far as "
    "no sample becomes negative, and means beside edges are kept less exactly. "
    "Sharpening helps where light is smooth from sample to sample (a fourth of the error "
    "of irradiance, or much less) or has peaks a few cells wide (a fifth to two thirds). "
    "It does not where edges move by cells from view to view, as behind fine bars, and it "
    "amplifies noise. So each page is judged by what sharpening does to a coarser copy of it, and "
    "stays as it is where the error would not become smaller; both are told. Compare bakeslab "
    "check --error of both slabs."
    "\vExamples:\n"
    "  bakeslab convert lamp.tif -o lamp.exr\n"
    "  bakeslab convert lamp.tif -o small.tif --uv 8x8 --st 32x32\n"
    "  bakeslab convert lamp.exr -o exact.tif --precision float\n"
    "  bakeslab convert lamp.exr -o sharp.exr --sharpen st\n"
    "  bakeslab convert lamp.tif -o middle.tif --crop st=16:48,16:48\n"
    "  bakeslab convert lamp.tif -o - --uv 4x4 | bakeslab info -";
static const struct argp argp = {options_list, parse, "SLAB -o OUT", doc, cli_options, NULL, NULL};

int cmd_convert(int argc, char **argv) {
  struct options options = {0};
  return cli_run(&argp, argc, argv, run, &options);
}
