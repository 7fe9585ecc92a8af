/* slab_file_write.c - writes slabs into containers, after making sure that the
 * samples survive it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/output.h"
#include "file/slab_exr.h"
#include "file/slab_file.h"
#include "file/slab_half.h"
#include "file/slab_json.h"
#include "file/slab_raster.h"
#include "file/slab_tiff.h"

enum {
  PLAIN_TILE = 64,               /* where a view is no tile */
  LARGEST_EXR_VIEW = 1024 * 1024 /* pixels; EXR keeps a tile's bytes in 31 bits */
};

static bool has_suffix(const char *path, const char *suffix) {
  size_t length = strlen(path), tail = strlen(suffix);
  return length > tail && !strcasecmp(path + length - tail, suffix);
}

/* Container by name, and the precision that DEFAULT means there. */
static enum result choose(const char *path, enum slab_precision *precision, bool *exr,
                          struct error *error) {
  *exr = has_suffix(path, ".exr");
  if (!*exr && !has_suffix(path, ".tif") && !has_suffix(path, ".tiff"))
    return result_fail(error, RESULT_BAD, "%s: the name must end in .tif, .tiff or .exr", path);
  if (*precision == SLAB_PRECISION_DEFAULT)
    *precision = *exr ? SLAB_PRECISION_FLOAT : SLAB_PRECISION_LOGLUV;
  if (*exr && *precision == SLAB_PRECISION_LOGLUV)
    return result_fail(error, RESULT_BAD,
                       "%s: EXR cannot hold LogLuv: name it .tif, or use --precision float or half",
                       path);
  return RESULT_OK;
}

enum result slab_file_check_target(const char *path, enum slab_precision precision,
                                   struct error *error) {
  bool exr;
  struct stat status;
  enum result result = choose(path, &precision, &exr, error);
  if (result == RESULT_OK && stat(path, &status) == 0 && !S_ISREG(status.st_mode))
    result = result_fail(error, RESULT_IO, "%s: exists and is not a regular file", path);
  return result;
}

enum slab_precision slab_file_precision_of(const char *path, enum slab_precision precision) {
  bool exr;
  if (choose(strcmp(path, "-") ? path : "stdout.tif", &precision, &exr, NULL) != RESULT_OK)
    return SLAB_PRECISION_DEFAULT;
  return precision;
}

/* Why a sample cannot be written, or NULL. */
static const char *objection(enum slab_precision precision, const float rgb[3]) {
  if (!isfinite(rgb[0]) || !isfinite(rgb[1]) || !isfinite(rgb[2])) return "is not finite";
  if (precision == SLAB_PRECISION_HALF)
    for (int c = 0; c < 3; ++c)
      if (!slab_half_holds(rgb[c])) return "is beyond half's 65504: use --precision float";
  if (precision == SLAB_PRECISION_LOGLUV && !slab_tiff_logluv_holds(rgb))
    return "has a negative channel, or a colour or luminance that LogLuv cannot hold: use "
           "--precision float";
  return NULL;
}

static enum result check_samples(const char *path, int page, const struct slab *slab,
                                 enum slab_precision precision, struct error *error) {
  size_t count = slab_sample_count(slab);
  for (size_t k = 0; k < count; ++k) {
    const float *rgb = slab->rgb + 3 * k;
    const char *why = objection(precision, rgb);
    if (!why) continue;
    int at[SLAB_AXES];
    slab_locate(slab, k, at);
    return result_fail(error, RESULT_BAD, "%s: page %d: sample (%d, %d, %d, %d) = (%g, %g, %g) %s",
                       path, page + 1, at[SLAB_U], at[SLAB_V], at[SLAB_S], at[SLAB_T],
                       (double)rgb[0], (double)rgb[1], (double)rgb[2], why);
  }
  return RESULT_OK;
}

static enum result describe(const char *path, int page, const struct slab *slab,
                            enum slab_precision precision, bool exr, struct slab_raster *raster,
                            struct error *error) {
  enum result result = slab_check(slab, error);
  if (result == RESULT_OK && !slab->rgb) result = result_fail(error, RESULT_BAD, "has no samples");
  bool logluv = precision == SLAB_PRECISION_LOGLUV;
  if (result == RESULT_OK && logluv)
    slab_tiff_choose_white(slab->rgb, slab_sample_count(slab), raster->white);
  if (result == RESULT_OK)
    result = slab_json_text(slab, logluv ? raster->white : NULL, &raster->text, error);
  if (result != RESULT_OK) return result_at(result, error, "%s: page %d", path, page + 1);
  int ns = slab->samples[SLAB_S], nt = slab->samples[SLAB_T];
  bool view_is_tile = ns % 16 == 0 && nt % 16 == 0 && !(exr && ns > LARGEST_EXR_VIEW / nt);
  raster->width = slab_width(slab);
  raster->height = slab_height(slab);
  raster->block_width = view_is_tile ? ns : PLAIN_TILE;
  raster->block_height = view_is_tile ? nt : PLAIN_TILE;
  raster->precision = precision;
  raster->rgb = slab->rgb;
  return check_samples(path, page, slab, precision, error);
}

enum result slab_file_write(const char *path, const struct slab *slabs, int count,
                            enum slab_precision precision, struct error *error) {
  bool exr;
  struct output output = {0};
  /* Standard output has no name to choose by: a TIFF. */
  bool piped = !strcmp(path, "-");
  const char *name = piped ? "stdout" : path;
  enum result result = choose(piped ? "stdout.tif" : path, &precision, &exr, error);
  if (result != RESULT_OK) return result;
  if (count < 1) return result_fail(error, RESULT_BAD, "%s: there are no slabs to write", name);
  struct slab_raster *rasters = calloc((size_t)count, sizeof *rasters);
  if (!rasters) return result_fail(error, RESULT_MEMORY, "%s: out of memory", name);
  for (int page = 0; page < count && result == RESULT_OK; ++page)
    result = describe(name, page, &slabs[page], precision, exr, &rasters[page], error);
  if (result == RESULT_OK) result = output_begin(&output, path, error);
  if (result == RESULT_OK)
    result = exr ? slab_exr_write_parts(&output, rasters, count, "lightslab", error)
                 : slab_tiff_write(&output, rasters, count, error);
  if (result == RESULT_OK) result = output_commit(&output, error);
  output_abandon(&output);
  for (int page = 0; page < count; ++page) free(rasters[page].text);
  free(rasters);
  return result;
}
