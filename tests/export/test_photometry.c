/* test_photometry.c - IES and EULUMDAT files of a slab: their intensities, by a reader of their
 * text alone, against sums over the aperture; their flux and opening; and back into a slab. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lamps.h"
#include "oracle/lookup.h"
#include "oracle/random.h"
#include "testing.h"

enum { MOST = 1024, DIRECTIONS = 500, POINTS = 48 };
static const double degree = M_PI / 180;

/* A file's grid. Planes from 0 to 360, both there. */
struct table {
  int planes, angles;
  double c[MOST], gamma[MOST], *candela, length, width, height; /* along x, z, y */
};

static double next(FILE *in) {
  double value;
  if (fscanf(in, "%lf", &value) != 1) fail_msg("a number is missing");
  return value;
}

static void read_line(FILE *in, char line[512]) {
  if (!fgets(line, 512, in)) fail_msg("a line is missing");
  line[strcspn(line, "\r\n")] = 0;
}

static double number(FILE *in) {
  char line[512], *end;
  read_line(in, line);
  double value = strtod(line, &end);
  if (end == line || *end) fail_msg("\"%s\" is no number", line);
  return value;
}

static void read_candela(struct table *table, int planes, double scale, FILE *in) {
  size_t row = (size_t)table->angles;
  table->candela = calloc((size_t)table->planes * row, sizeof *table->candela);
  assert_non_null(table->candela);
  for (size_t k = 0; k < (size_t)planes * row; ++k) table->candela[k] = scale * next(in);
  for (int p = planes; p < table->planes; ++p) /* C360 is C0; or all planes are */
    memcpy(table->candela + (size_t)p * row, table->candela, row * sizeof *table->candela);
}

/* LM-63-2002: keywords, TILT, thirteen numbers, gamma, C, candela. */
static void read_ies(FILE *in, struct table *table) {
  char line[512];
  read_line(in, line);
  assert_string_equal(line, "IESNA:LM-63-2002");
  do {
    read_line(in, line);
    assert_true(strlen(line) <= 80);
  } while (line[0] == '[');
  assert_string_equal(line, "TILT=NONE");
  assert_near(next(in), 1, 0);
  assert_near(next(in), -1, 0); /* absolute */
  assert_near(next(in), 1, 0);
  table->angles = (int)next(in);
  int planes = (int)next(in);
  table->planes = planes == 1 ? 2 : planes;
  assert_true(table->angles < MOST && table->planes < MOST);
  assert_near(next(in), 1, 0); /* type C */
  assert_near(next(in), 2, 0); /* metres */
  table->width = next(in);
  table->length = next(in);
  table->height = next(in);
  assert_near(next(in), 1, 0);
  next(in);
  next(in);
  for (int k = 0; k < table->angles; ++k) table->gamma[k] = next(in);
  for (int k = 0; k < planes; ++k) table->c[k] = next(in);
  if (planes == 1) table->c[1] = 360;
  read_candela(table, planes, 1, in);
}

/* EULUMDAT's lines, by number. */
static void read_ldt(FILE *in, struct table *table) {
  char line[512];
  double at[43] = {0}; /* 26 + the set of lamps + utilances */
  for (int k = 1; k <= 42; ++k) {
    bool text = k == 1 || (k >= 8 && k <= 12) || k == 28 || k == 30 || k == 31;
    if (text)
      read_line(in, line);
    else
      at[k] = number(in);
  }
  table->planes = (int)at[4] + 1;
  table->angles = (int)at[6];
  assert_true(table->angles < MOST && table->planes < MOST);
  table->length = at[17] / 1000; /* along C0 is the width */
  table->width = at[16] / 1000;
  table->height = at[18] / 1000;
  assert_near(at[23], 100, 0);
  assert_near(at[24], 1, 0);
  for (int k = 0; k + 1 < table->planes; ++k) table->c[k] = number(in);
  table->c[table->planes - 1] = 360;
  for (int k = 0; k < table->angles; ++k) table->gamma[k] = number(in);
  read_candela(table, table->planes - 1, at[29] / 1000, in);
}

static int cell(const double *angles, int count, double at) {
  int k = 0;
  while (k + 2 < count && angles[k + 1] <= at) ++k;
  return k;
}

/* Bilinear; none beyond the last angle. */
static double candela(const struct table *table, double c, double gamma) {
  if (gamma < table->gamma[0] || gamma > table->gamma[table->angles - 1]) return 0;
  int p = cell(table->c, table->planes, c), k = cell(table->gamma, table->angles, gamma);
  double x = (c - table->c[p]) / (table->c[p + 1] - table->c[p]);
  double y = (gamma - table->gamma[k]) / (table->gamma[k + 1] - table->gamma[k]);
  const double *a = table->candela + p * table->angles + k, *b = a + table->angles;
  return (1 - x) * ((1 - y) * a[0] + y * a[1]) + x * ((1 - y) * b[0] + y * b[1]);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Luminance times projected area, summed over the aperture. */
static double truth(const struct slab *slab, const double d[3]) {
  double u = sqrt(dot(slab->u, slab->u)), v = sqrt(dot(slab->v, slab->v)), sum = 0;
  double cosine = dot(d, slab->normal),
         kappa = isinf(slab->st_distance) ? 0 : 1 / slab->st_distance;
  if (cosine <= 0) return 0;
  for (int k = 0; k < POINTS * POINTS; ++k) {
    double a = ((k % POINTS + 0.5) / POINTS - 0.5) * u, b = ((k / POINTS + 0.5) / POINTS - 0.5) * v;
    double rgb[3], abst[4] = {a, b, dot(d, slab->u) / u / cosine + kappa * a,
                              dot(d, slab->v) / v / cosine + kappa * b};
    oracle_lookup(slab, abst, rgb);
    sum += 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  }
  return sum * cosine * u * v / POINTS / POINTS;
}

/* Light that falls off to nothing at the window, as files of angles can hold it. */
static void smooth(struct slab *slab) {
  const int *n = slab->samples;
  for (size_t pixel = 0; pixel < slab_sample_count(slab); ++pixel) {
    int at[SLAB_AXES];
    slab_locate(slab, pixel, at);
    double x = 2 * (at[2] + 0.5) / n[2] - 1, y = 2 * (at[3] + 0.5) / n[3] - 1;
    double light = (1 - x * x) * (1 - y * y) * (1 - x * x) * (1 - y * y);
    for (int c = 0; c < 3; ++c)
      slab->rgb[3 * pixel + (size_t)c] *= (float)(light * (1 + 0.5 * x)); /* chiral */
  }
}

static struct table export_and_read(const char *path, const char *ending) {
  struct table table = {0};
  char name[64];
  snprintf(name, sizeof name, "field%s", ending);
  const char *file = lamp_export(path, name, "");
  FILE *in = fopen(file, "r");
  assert_non_null(in);
  if (!strcmp(ending, ".ies"))
    read_ies(in, &table);
  else
    read_ldt(in, &table);
  assert_int_equal(fscanf(in, " %*c"), EOF);
  fclose(in);
  return table;
}

/* In 500 directions of rays of the lamp: RMS error, as a part of the largest. */
static double error_of(const struct table *table, const struct lamp *lamp,
                       const struct slab *pages) {
  double off = 0, most = 0;
  uint64_t seed = 5;
  for (int n = 0; n < DIRECTIONS; ++n) {
    double ray[6], d[3], wanted = 0;
    lamp_ray(lamp, pages, &seed, ray);
    double length = sqrt(dot(ray + 3, ray + 3));
    for (int c = 0; c < 3; ++c) d[c] = ray[3 + c] / length;
    for (int k = 0; k < lamp->pages; ++k) wanted += truth(&pages[k], d);
    double c = atan2(d[2], d[0]) / degree;
    double got = candela(table, c < 0 ? c + 360 : c, acos(-d[1]) / degree);
    off += (got - wanted) * (got - wanted);
  }
  for (int k = 0; k < table->planes * table->angles; ++k) most = fmax(most, table->candela[k]);
  return sqrt(off / DIRECTIONS) / most;
}

/* The trapezoid rule in both angles. */
static double flux_of(const struct table *table) {
  double sum = 0;
  for (int p = 0; p + 1 < table->planes; ++p)
    for (int k = 0; k + 1 < table->angles; ++k) {
      double g0 = table->gamma[k] * degree, g1 = table->gamma[k + 1] * degree;
      const double *row = table->candela + p * table->angles + k, *next = row + table->angles;
      sum += (table->c[p + 1] - table->c[p]) * degree * (g1 - g0) / 4 *
             ((row[0] + next[0]) * sin(g0) + (row[1] + next[1]) * sin(g1));
    }
  return sum;
}

TEST(intensities_and_flux) {
  static const char *const endings[2] = {".ies", ".ldt"};
  for (int n = 0; n < 2 * lamp_count; ++n) {
    const struct lamp *lamp = &lamps[n / 2];
    struct slab pages[LAMP_PAGES];
    if (lamp->samples[SLAB_S] < 4) continue; /* nothing smooth fits into its window */
    lamp_make(lamp, pages);
    double flux = 0, unit = strcmp(lamp->unit, "W/(sr m2)") ? 1 : 179;
    for (int k = 0; k < lamp->pages; ++k) {
      double rgb[3];
      smooth(&pages[k]);
      assert_int_equal(slab_flux(&pages[k], rgb, NULL), RESULT_OK);
      flux += unit * (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
    }
    struct table table = export_and_read(lamp_save(lamp, pages), endings[n % 2]);
    size_t count = (size_t)table.planes * (size_t)table.angles;
    assert_near(flux_of(&table) / flux, 1, 0.002);
    for (size_t k = 0; k < count; ++k) table.candela[k] /= unit;
    double error = error_of(&table, lamp, pages);
    print_message("# %s%s: %.2g %% of the peak, flux %.2g %%, %d planes of %d\n", lamp->name,
                  endings[n % 2], 100 * error, 100 * fabs(flux_of(&table) * unit / flux - 1),
                  table.planes, table.angles);
    if (!(error < 0.007)) fail_msg("%s%s: %g off", lamp->name, endings[n % 2], error);
    double box[3] = {table.length, table.height, table.width};
    for (int c = 0; c < 3 && lamp->pages == 1; ++c)
      assert_near(box[c], fabs(pages[0].u[c]) + fabs(pages[0].v[c]), 1e-5);
    free(table.candela);
    lamp_free(pages);
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
