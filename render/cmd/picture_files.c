#include "cmd/picture_files.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/numbers.h"
#include "base/progress.h"
#include "cli/cli.h"
#include "file/slab_exr.h"
#include "picture/preview.h"

bool picture_files_end(const char *path, const char *ending) {
  size_t length = strlen(path), end = strlen(ending);
  return length > end && !strcmp(path + length - end, ending);
}

/* cd/m2 that are white at EV 0. */
static const double white_at_zero = 78 / (0.65 * 100);

void picture_files_check(const char *path, struct argp_state *state) {
  if (!path)
    argp_error(state, "no output given; add -o OUT.exr");
  else if (strcmp(path, "-") && !picture_files_end(path, ".exr") &&
           !picture_files_end(path, ".png"))
    argp_error(state, "-o %s: must end in .exr or .png", path);
}

void picture_files_expose(const char *value, struct picture_files *files,
                          struct argp_state *state) {
  static const double most = 100; /* floats end not far beyond */
  files->exposed = strcmp(value, "auto") != 0;
  if (files->exposed && (!numbers_real(value, 1, &files->exposure) || files->exposure < -most ||
                         files->exposure > most))
    argp_error(state, "--exposure %s: must be auto or a number from %g to %g", value, -most, most);
}

/* So many EV from its own exposure nothing much is seen of a picture. */
static const double far_off = 6;

static enum result write_png(const char *path, const struct picture_files *files,
                             const struct picture *picture, struct error *error) {
  double own, white = white_at_zero / files->luminance * exp2(files->exposure);
  enum result result = preview_exposure(picture, &own, error);
  if (result != RESULT_OK) return result;
  double exposure = log2(own * files->luminance / white_at_zero);
  if (!files->exposed) {
    white = own;
    cli_note("%s: note: radiance %.4g is white; --exposure %.4f keeps it", path, white, exposure);
  } else if (fabs(exposure - files->exposure) > far_off) {
    cli_note("%s: note: --exposure %g leaves it nearly %s; auto would take %.1f", path,
             files->exposure, exposure < files->exposure ? "black" : "white", exposure);
  }
  return preview_write(path, picture, white, cli_command_line(), error);
}

/* Fills a picture with smooth values and random digits behind them: at the 17th bit, where floats
 * of pictures have them; for PNGs at the 10th, so that some of the 8 bits change. Blocks of
 * step x step pixels are the same, and their errors not known. */
static void fill(struct picture *small, bool png, int step) {
  const float weight = png ? 0x1p-33F : 0x1p-40F;
  size_t row = 3 * (size_t)small->width;
  uint32_t random = 1;
  for (int y = 0; y < small->height; ++y)
    for (size_t k = 0; k < row; ++k) {
      float *value = small->rgb + (size_t)y * row + k, ramp = 1 + (float)(k / 3) / (float)row;
      bool left = k / 3 % (size_t)step > 0, above = y % step > 0;
      random = random * 1664525 + 1013904223;
      *value = above  ? value[-(ptrdiff_t)row]
               : left ? value[-3]
                      : ramp * (1 + (float)(random >> 8) * weight);
      small->error[(size_t)y * row + k] = step > 1 ? INFINITY : *value / 100;
    }
}

/* How long a file takes: what goes with its pixels, and what does not. */
static double try_file(const char *path, struct picture *small, double pixels, int step) {
  struct output output = {0};
  bool png = picture_files_end(path, ".png");
  double white = 1, start, put;
  fill(small, png, step);
  enum result result = output_begin(&output, path, NULL);
  start = progress_now();
  if (result == RESULT_OK && png) result = preview_exposure(small, &white, NULL);
  if (result == RESULT_OK)
    result = png ? preview_put(&output, small, white, "", NULL)
                 : slab_exr_put(&output, small, 0, "", NULL);
  put = progress_now();
  if (result == RESULT_OK) output_flush(&output, NULL);
  double flushed = progress_now();
  output_abandon(&output);
  return (put - start) * pixels / (small->width * small->height) + flushed - put;
}

double picture_files_seconds(const struct picture_files *files, int width, int height, int step) {
  enum { WIDTH = 256, HEIGHT = 32, VALUES = 3 * WIDTH * HEIGHT };
  float *values = malloc(2 * VALUES * sizeof *values);
  struct picture small = {WIDTH, HEIGHT, values, values ? values + VALUES : NULL, NULL};
  double pixels = (double)width * height, seconds = 0;
  if (values) seconds = try_file(files->output, &small, pixels, step);
  if (values && files->preview) seconds += try_file(files->preview, &small, pixels, step);
  free(values);
  return seconds;
}

enum result picture_files_write(const struct picture_files *files, const struct picture *picture,
                                struct error *error) {
  enum result result = picture_files_end(files->output, ".png")
                           ? write_png(files->output, files, picture, error)
                           : slab_exr_write(files->output, picture, 0, cli_command_line(), error);
  if (result == RESULT_OK && files->preview)
    result = write_png(files->preview, files, picture, error);
  return result;
}
