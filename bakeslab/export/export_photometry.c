#include "export/export_photometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "base/sdl.h"
#include "base/version.h"
#include "export/far_field.h"

typedef void put_field(const struct far_field *field, const struct export_wish *wish, FILE *out);

/* Numbers in lines of at most ten, as the standards' lines are short. */
static void put_numbers(int count, const double *numbers, const char *after, FILE *out) {
  for (int k = 0; k < count; ++k)
    fprintf(out, "%.10g%s", numbers[k], k + 1 == count ? after : k % 10 == 9 ? "\r\n" : " ");
}

/* A plane of the grid. */
static void put_candela(const struct far_grid *grid, int plane, double scale, FILE *out) {
  int angles = grid->count[FAR_GAMMA];
  const double *row = grid->candela + (size_t)plane * (size_t)angles;
  for (int k = 0; k < angles; ++k)
    fprintf(out, "%.6g%s", scale * row[k], k % 10 == 9 || k + 1 == angles ? "\r\n" : " ");
}

/* A line of text, in parts of the standard's 80 characters: the first after `first`. */
static void put_words(const char *first, const char *text, FILE *out) {
  char line[64];
  do {
    snprintf(line, sizeof line, "%s", text);
    fprintf(out, "%s ", first);
    sdl_comment(line, out);
    fputs("\r\n", out);
    text += strlen(line);
    first = "[MORE]";
  } while (*text);
}

static void put_ies(const struct far_field *field, const struct export_wish *wish, FILE *out) {
  const struct far_grid *grid = &field->grid;
  const int *count = grid->count;
  fputs("IESNA:LM-63-2002\r\n[TEST] none: the far field of a simulated lamp\r\n", out);
  fputs("[TESTLAB] bakeslab " CANNED_VERSION "\r\n[ISSUEDATE] not dated\r\n", out);
  fputs("[MANUFAC] not stated\r\n", out);
  put_words("[LUMCAT]", wish->name, out);
  put_words("[OTHER]", wish->command, out);
  fprintf(out, "TILT=NONE\r\n1 -1 1 %d %d 1 2 %.6g %.6g %.6g\r\n1 1 0\r\n", count[FAR_GAMMA],
          count[FAR_C], field->size[2], field->size[0], field->size[1]);
  put_numbers(count[FAR_GAMMA], grid->at[FAR_GAMMA], "\r\n", out);
  put_numbers(count[FAR_C], grid->at[FAR_C], "\r\n", out);
  for (int plane = 0; plane < count[FAR_C]; ++plane) put_candela(grid, plane, 1, out);
}

/* The share of flux that goes down, in %: the trapezoid rule. */
static double downward(const struct far_grid *grid) {
  double down = 0, all = 0, radian = M_PI / 180;
  int planes = grid->count[FAR_C] - 1, angles = grid->count[FAR_GAMMA];
  const double *c = grid->at[FAR_C], *gamma = grid->at[FAR_GAMMA];
  for (int plane = 0; plane < planes; ++plane) {
    double wide = c[plane + 1] - (plane > 0 ? c[plane - 1] : c[planes - 1] - 360);
    for (int k = 0; k + 1 < angles; ++k) {
      const double *a = grid->candela + (size_t)plane * (size_t)angles + k;
      double part = wide * (gamma[k + 1] - gamma[k]) *
                    (a[0] * sin(gamma[k] * radian) + a[1] * sin(gamma[k + 1] * radian));
      all += part;
      if (gamma[k + 1] <= 90) down += part;
    }
  }
  return all > 0 ? 100 * down / all : 0;
}

/* The distance between values; 0 where it is not the same everywhere. */
static double even_step(const double *values, int count) {
  double step = values[1] - values[0];
  for (int k = 1; k < count; ++k)
    if (values[k] - values[k - 1] != step) return 0; /* sums of powers of two: exact */
  return step;
}

static void put_ldt(const struct far_field *field, const struct export_wish *wish, FILE *out) {
  const struct far_grid *grid = &field->grid;
  const double *c = grid->at[FAR_C], *gamma = grid->at[FAR_GAMMA], mm = 1000;
  int planes = grid->count[FAR_C] - 1, angles = grid->count[FAR_GAMMA];
  char line[79];
  fprintf(out, "bakeslab " CANNED_VERSION "\r\n3\r\n0\r\n%d\r\n%.10g\r\n%d\r\n%.10g\r\n", planes,
          even_step(c, planes + 1), angles, even_step(gamma, angles));
  snprintf(line, sizeof line, "%s", wish->name);
  fprintf(out, "simulated\r\n%s\r\n\r\n%.8s.ldt\r\n", line, wish->name);
  snprintf(line, sizeof line, "%s", wish->command);
  sdl_comment(line, out);
  fprintf(out, "\r\n%.6g\r\n%.6g\r\n%.6g\r\n%.6g\r\n%.6g\r\n", mm * field->size[2],
          mm * field->size[0], mm * field->size[1], mm * field->size[2], mm * field->size[0]);
  for (int k = 0; k < 4; ++k) fprintf(out, "%.6g\r\n", mm * field->size[1]);
  fprintf(out, "%.4g\r\n100\r\n1\r\n0\r\n1\r\n1\r\nLED\r\n%.9g\r\n0\r\n0\r\n0\r\n", downward(grid),
          field->lumens);
  for (int k = 0; k < 10; ++k) fputs("0\r\n", out); /* utilances for ten rooms: not computed */
  for (int k = 0; k < planes; ++k) fprintf(out, "%.10g\r\n", c[k]);
  for (int k = 0; k < angles; ++k) fprintf(out, "%.10g\r\n", gamma[k]);
  for (int k = 0; k < planes * angles; ++k)
    fprintf(out, "%.6g\r\n", grid->candela[k] * 1000 / field->lumens);
}

static void tell(const struct far_field *field, const struct slab *slab,
                 const struct export_wish *wish) {
  const struct far_grid *grid = &field->grid;
  warnings_add(wish->notes,
               "%d planes of %d angles: 95 %% of the directions are within %.2g %% of the peak of "
               "%.4g cd, all within %.2g %%; flux %.5g lm, %.2g %% off the slab's",
               grid->count[FAR_C] - 1, grid->count[FAR_GAMMA], 100 * grid->most95, grid->peak,
               100 * grid->most, field->lumens, 100 * fabs(field->lumens / field->flux - 1));
  if (grid->beyond > 0)
    warnings_add(wish->notes, "%.2g %% of the lit directions are off by more than %g %%",
                 100 * grid->beyond, 100 * wish->tolerance);
  warnings_add(wish->notes,
               "the far field is what is kept: irradiance four aperture widths away is %.3g %% off "
               "if all light comes from one point; colours are lost",
               100 * field->loss);
  if (!strcmp(slab->radiance_unit, "relative"))
    warnings_add(wish->notes, "its radiance is relative: 1 counts as 1 cd/m2");
  if (!strcmp(slab->radiance_unit, "W/(sr m2)"))
    warnings_add(wish->notes, "its radiance is in watts: 1 W counts as 179 lm, as in Radiance");
}

static enum result refuse_negative(const struct far_grid *grid, struct error *error) {
  for (int k = 0; k < grid->count[FAR_C] * grid->count[FAR_GAMMA]; ++k)
    if (grid->candela[k] < 0)
      return result_fail(error, RESULT_BAD,
                         "it gives negative light (%g cd), which photometric files cannot hold",
                         grid->candela[k]);
  return RESULT_OK;
}

static enum result write_field(const struct slab *slabs, int count, const struct export_wish *wish,
                               const char *path, put_field *put, struct error *error) {
  struct far_field field = {0};
  char *text = NULL;
  size_t size = 0;
  enum result result = far_field_make(slabs, count, wish->tolerance, &field, error);
  if (result == RESULT_OK && !(field.lumens > 0 && field.grid.peak > 0))
    result = result_fail(error, RESULT_BAD, "its flux is not positive: %g lm", field.lumens);
  if (result == RESULT_OK) result = refuse_negative(&field.grid, error);
  FILE *out = result == RESULT_OK ? open_memstream(&text, &size) : NULL;
  if (result == RESULT_OK && !out) result = result_no_memory(error);
  if (out) put(&field, wish, out);
  if (out && (fclose(out) != 0 || !text)) result = result_no_memory(error);
  if (result == RESULT_OK) result = output_text(path, text, size, error);
  if (result == RESULT_OK) tell(&field, &slabs[0], wish);
  free(text);
  far_field_free(&field);
  return result;
}

enum result export_ies(const struct slab *slabs, int count, const struct export_wish *wish,
                       const char *path, struct error *error) {
  return write_field(slabs, count, wish, path, put_ies, error);
}

enum result export_ldt(const struct slab *slabs, int count, const struct export_wish *wish,
                       const char *path, struct error *error) {
  return write_field(slabs, count, wish, path, put_ldt, error);
}
