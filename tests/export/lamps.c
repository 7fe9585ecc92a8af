#include "lamps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "file/slab_file.h"
#include "oracle/random.h"
#include "testing.h"

const struct lamp lamps[] = {
    {"infinite", {5, 4, 7, 6}, INFINITY, {-0.3, 1.1, -0.7, 0.5}, 1, 1, "relative"},
    {"finite", {4, 5, 6, 7}, 1.5, {-0.8, 0.6, -0.4, 0.9}, 1, 1, "relative"},
    {"mirrored", {4, 4, 6, 6}, 0.8, {-0.5, 0.9, -0.6, 0.7}, -1, 1, "W/(sr m2)"},
    {"upright", {3, 4, 6, 5}, INFINITY, {-0.5, 0.9, -0.6, 0.7}, 0, 1, "W/(sr m2)"},
    {"two_pages", {4, 3, 5, 6}, 2, {-0.8, 0.6, -0.4, 0.9}, 1, 2, "relative"},
    {"one_wide", {1, 3, 1, 5}, INFINITY, {-0.8, 0.6, -0.4, 0.9}, -1, 1, "relative"},
    {"one_sample", {1, 1, 1, 1}, 1.2, {-0.8, 0.6, -0.4, 0.9}, 1, 1, "relative"},
    {"narrow", {4, 4, 8, 8}, INFINITY, {0.1, 0.16, -0.05, 0.03}, 1, 1, "relative"},
    {"photometric", {3, 3, 4, 5}, INFINITY, {-0.8, 0.6, -0.4, 0.9}, 1, 1, "cd/m2"}};
const int lamp_count = sizeof lamps / sizeof *lamps;

static struct slab make_page(const struct lamp *lamp, int page, uint64_t *seed) {
  static const double plain[3][3] = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  struct slab slab = slab_default();
  double frame[3][3];
  memcpy(frame, plain, sizeof frame);
  if (lamp->hand) random_frame(seed, page ? -lamp->hand : lamp->hand, frame);
  snprintf(slab.name, sizeof slab.name, "%s", lamp->name);
  snprintf(slab.radiance_unit, sizeof slab.radiance_unit, "%s", lamp->unit);
  memcpy(slab.samples, lamp->samples, sizeof slab.samples);
  memcpy(slab.st_window, lamp->window, sizeof slab.st_window);
  slab.st_distance = lamp->distance;
  for (int c = 0; c < 3; ++c) {
    slab.u[c] = 1.3 * frame[0][c];
    slab.v[c] = 0.8 * frame[1][c];
    slab.normal[c] = frame[2][c];
    slab.center[c] = 0.1 * (c + 1);
  }
  if (slab_alloc(&slab, NULL) != RESULT_OK) fail();
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k)
    slab.rgb[k] = (float)random_between(seed, 0.05, 1);
  return slab;
}

/* The second page looks the other way, from behind the first, so that neither hides the other. */
static void turn_away(struct slab *second, const struct slab *first) {
  for (int c = 0; c < 3; ++c) {
    second->u[c] = first->u[c];
    second->v[c] = first->v[c];
    second->normal[c] = -first->normal[c];
    second->center[c] = first->center[c] - 0.2 * first->normal[c];
  }
}

void lamp_make(const struct lamp *lamp, struct slab pages[LAMP_PAGES]) {
  uint64_t seed = 19 + (uint64_t)(lamp - lamps);
  for (int page = 0; page < LAMP_PAGES; ++page) pages[page] = (struct slab){0};
  for (int page = 0; page < lamp->pages; ++page) pages[page] = make_page(lamp, page, &seed);
  if (lamp->pages > 1) turn_away(&pages[1], &pages[0]);
}

const char *lamp_save(const struct lamp *lamp, const struct slab pages[LAMP_PAGES]) {
  char name[64];
  struct error error = {{0}};
  snprintf(name, sizeof name, "%s.exr", lamp->name);
  const char *path = scratch(name);
  if (slab_file_write(path, pages, lamp->pages, SLAB_PRECISION_FLOAT, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return path;
}

const char *lamp_write(const struct lamp *lamp, struct slab pages[LAMP_PAGES]) {
  lamp_make(lamp, pages);
  return lamp_save(lamp, pages);
}

void lamp_free(struct slab pages[LAMP_PAGES]) {
  for (int page = 0; page < LAMP_PAGES; ++page) slab_free(&pages[page]);
}

bool lamp_letter_is_lit(int field) {
  static const char letter[LETTER_FIELDS + 1] = "####."
                                                "#...."
                                                "###.."
                                                "#...."
                                                "#....";
  return letter[field] == '#';
}

/* Lamp space is left-handed: who looks along z, with y up, has x on the right. */
void lamp_letter_place(int field, double lamp[3]) {
  lamp[0] = (field % LETTER_SIDE - 2) * 0.4;
  lamp[1] = (2 - field / LETTER_SIDE) * 0.4;
  lamp[2] = 3;
}

const char *lamp_letter(void) {
  char command[1024];
  const char *image = scratch("letter.ppm"), *slab = scratch("letter.exr");
  FILE *file = fopen(image, "w");
  assert_non_null(file);
  fprintf(file, "P3\n5 5\n255\n");
  for (int k = 0; k < LETTER_FIELDS; ++k)
    fputs(lamp_letter_is_lit(k) ? "255 255 255\n" : "0 0 0\n", file);
  assert_int_equal(fclose(file), 0);
  snprintf(command, sizeof command,
           "'%s' projector '%s' -o '%s' --uv 2 --aperture 0.1 --focus 3 --width 2",
           getenv("BAKESLAB"), image, slab);
  assert_int_equal(system(command), 0);
  return slab;
}

void lamp_ray(const struct lamp *lamp, const struct slab *pages, uint64_t *seed, double ray[6]) {
  const struct slab *slab = &pages[random_choose(seed, lamp->pages)];
  const double *window = slab->st_window;
  double kappa = slab_kappa(slab), far = random_between(seed, -0.1, 3), along[2], slope[2];
  for (int k = 0; k < 2; ++k) {
    double half = 0.55 * slab_spacing(slab, k) * slab->samples[k];
    double margin = 0.05 * (window[2 * k + 1] - window[2 * k]);
    along[k] = random_between(seed, -half, half);
    slope[k] =
        random_between(seed, window[2 * k] - margin, window[2 * k + 1] + margin) - kappa * along[k];
  }
  double u = slab_spacing(slab, SLAB_U) * slab->samples[SLAB_U];
  double v = slab_spacing(slab, SLAB_V) * slab->samples[SLAB_V];
  for (int c = 0; c < 3; ++c) {
    ray[3 + c] = slab->normal[c] + slope[0] * slab->u[c] / u + slope[1] * slab->v[c] / v;
    ray[c] =
        slab->center[c] + along[0] * slab->u[c] / u + along[1] * slab->v[c] / v + far * ray[3 + c];
  }
}

void lamp_receivers(const struct slab *page, double distance, int side, double (*receivers)[6]) {
  double kappa = slab_kappa(page);
  for (int k = 0; k < side * side; ++k) {
    double at[2], cell[2] = {(k % side + 0.5) / side, (k / side + 0.5) / side};
    for (int axis = 0; axis < 2; ++axis) {
      const double *window = page->st_window + 2 * axis;
      double edge = slab_spacing(page, axis) * page->samples[axis];
      double half = (1 + distance * kappa) * edge / 2;
      double reach = distance * (window[1] - window[0]) + 2 * half;
      at[axis] = (distance * window[0] - half + cell[axis] * reach) / edge;
    }
    for (int c = 0; c < 3; ++c) {
      receivers[k][c] =
          page->center[c] + distance * page->normal[c] + at[0] * page->u[c] + at[1] * page->v[c];
      receivers[k][3 + c] = -page->normal[c];
    }
  }
}

/* Of all children that have ended. */
static double cpu_seconds(void) {
  struct rusage used;
  getrusage(RUSAGE_CHILDREN, &used);
  return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

double lamp_run(const char *command, const double *rows, int columns, int count, double (*rgb)[3]) {
  const char *in = scratch("rows"), *out = scratch("rgb");
  char whole[2048];
  FILE *file = fopen(in, "w");
  assert_non_null(file);
  for (int k = 0; k < count * columns; ++k)
    fprintf(file, "%.17g%c", rows[k], (k + 1) % columns ? ' ' : '\n');
  assert_int_equal(fclose(file), 0);
  snprintf(whole, sizeof whole, "%s <'%s' >'%s'", command, in, out);
  double seconds = cpu_seconds();
  if (system(whole) != 0) fail_msg("failed: %s", whole);
  seconds = cpu_seconds() - seconds;
  file = fopen(out, "r");
  assert_non_null(file);
  for (int k = 0; k < count; ++k)
    if (fscanf(file, "%lf %lf %lf", &rgb[k][0], &rgb[k][1], &rgb[k][2]) != 3)
      fail_msg("%s: row %d is not there", whole, k + 1);
  fclose(file);
  return seconds;
}

void lamp_lookup(const char *path, double (*rays)[6], int count, double (*rgb)[3]) {
  char command[512];
  snprintf(command, sizeof command, "'%s' lookup '%s'", getenv("BAKESLAB"), path);
  lamp_run(command, rays[0], 6, count, rgb);
}

const char *lamp_export(const char *path, const char *folder, const char *arguments) {
  char command[1024];
  const char *out = scratch(folder);
  snprintf(command, sizeof command, "'%s' export '%s' -o '%s' -q --force %s", getenv("BAKESLAB"),
           path, out, arguments);
  if (system(command) != 0) fail_msg("failed: %s", command);
  return out;
}

double lamp_worst(double (*a)[3], double (*b)[3], int count) {
  double worst = 0;
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < 3; ++c) worst = larger(worst, fabs(a[k][c] - b[k][c]));
  return worst;
}

double lamp_rms(double (*got)[3], double (*wanted)[3], int count) {
  double off = 0, all = 0;
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < 3; ++c) {
      off += (got[k][c] - wanted[k][c]) * (got[k][c] - wanted[k][c]);
      all += wanted[k][c] * wanted[k][c];
    }
  assert_true(all > 0);
  return sqrt(off / all);
}

void lamp_z_up(const double lamp[3], double there[3]) {
  there[0] = lamp[0];
  there[1] = lamp[2];
  there[2] = lamp[1];
}

void lamp_y_up(const double lamp[3], double there[3]) {
  there[0] = lamp[0];
  there[1] = lamp[1];
  there[2] = -lamp[2];
}
