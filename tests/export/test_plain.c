/* test_plain.c - lamps for Mitsuba without a plugin: the irradiance of their projectors against
 * renderslab's reference, by a reader of NAME.xml and its pictures that knows Mitsuba's formulas
 * alone (projector.cpp, bitmap.cpp); and by Mitsuba itself where it is installed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "file/slab_exr.h"
#include "lamps.h"
#include "testing.h"

enum { SIDE = 8, RECEIVERS = SIDE * SIDE, MOST = 2048 };

struct projector {
  double matrix[3][4];
  struct picture picture;
};

static struct projector projectors[MOST];
static double receivers[RECEIVERS][6], there[RECEIVERS][6], wanted[RECEIVERS][3], got[RECEIVERS][3];

static int read_projectors(const char *folder, const char *name) {
  static const char matrix[] = "<matrix value=\"", file_name[] = "name=\"filename\" value=\"";
  char path[512], line[1024];
  int count = 0;
  snprintf(path, sizeof path, "%s/%s.xml", folder, name);
  FILE *file = fopen(path, "r");
  assert_non_null(file);
  while (fgets(line, sizeof line, file)) {
    char *at = strstr(line, matrix);
    if (at && !strchr(at, '$')) {
      at += strlen(matrix);
      assert_true(count < MOST);
      for (int k = 0; k < 12; ++k) projectors[count].matrix[k / 4][k % 4] = strtod(at, &at);
    }
    at = strstr(line, file_name);
    if (!at) continue;
    at += strlen(file_name);
    snprintf(path, sizeof path, "%s/%.*s", folder, (int)strcspn(at, "\""), at);
    assert_int_equal(slab_exr_read(path, &projectors[count++].picture, NULL), RESULT_OK);
  }
  fclose(file);
  assert_true(count > 0);
  return count;
}

static void free_projectors(int count) {
  for (int k = 0; k < count; ++k) picture_free(&projectors[k].picture);
}

static double determinant(const double *a, const double *b, const double *c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* In the projector's own space, by Cramer's rule. */
static void to_local(double m[3][4], const double p[3], double local[3]) {
  double column[4][3];
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c) column[k][c] = k < 3 ? m[c][k] : p[c] - m[c][3];
  double all = determinant(column[0], column[1], column[2]);
  for (int k = 0; k < 3; ++k) {
    const double *of[3] = {column[0], column[1], column[2]};
    of[k] = column[3];
    local[k] = determinant(of[0], of[1], of[2]) / all;
  }
}

/* A bilinear texture; beyond its outer texels it goes on as they are. x, y from 0 to 1. */
static void texture(const struct picture *picture, double x, double y, double rgb[3]) {
  double at[2] = {x * picture->width - 0.5, y * picture->height - 0.5};
  int low[2] = {(int)floor(at[0]), (int)floor(at[1])};
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int k = 0; k < 4; ++k) {
    int i = low[0] + k % 2, j = low[1] + k / 2;
    double weight = (1 - fabs(at[0] - i)) * (1 - fabs(at[1] - j));
    i = i < 0 ? 0 : i < picture->width ? i : picture->width - 1;
    j = j < 0 ? 0 : j < picture->height ? j : picture->height - 1;
    for (int c = 0; c < 3; ++c)
      rgb[c] += weight * (double)picture->rgb[3 * (j * picture->width + i) + c];
  }
}

/* Projector::sample_direction; with fov 90 along x, and the receiver's cosine. */
static void add_light(struct projector *projector, const double receiver[6], double rgb[3]) {
  double local[3], texel[3], d[3], along = 0, facing = 0;
  to_local(projector->matrix, receiver, local);
  const struct picture *picture = &projector->picture;
  double x = 0.5 - 0.5 * local[0] / local[2];
  double y = 0.5 - 0.5 * local[1] / local[2] * picture->width / picture->height;
  if (!(local[2] > 0 && x >= 0 && x <= 1 && y >= 0 && y <= 1)) return;
  for (int c = 0; c < 3; ++c) {
    d[c] = projector->matrix[c][3] - receiver[c];
    along -= d[c] * projector->matrix[c][2];
    facing += d[c] * receiver[3 + c];
  }
  texture(picture, x, y, texel);
  double weight = acos(-1) * facing / (local[2] * local[2] * along);
  for (int c = 0; c < 3; ++c) rgb[c] += weight * texel[c];
}

static void sum(int count) {
  for (int k = 0; k < RECEIVERS; ++k) {
    memset(got[k], 0, sizeof got[k]);
    for (int n = 0; n < count; ++n) add_light(&projectors[n], there[k], got[k]);
  }
}

/* The receivers four aperture widths away, in lamp space and in Mitsuba's, and what they are to
 * have. */
static const char *prepare(const struct lamp *lamp) {
  struct slab pages[LAMP_PAGES];
  char command[512];
  const char *path = lamp_write(lamp, pages);
  lamp_receivers(&pages[0], 4 * 1.3, SIDE, receivers);
  lamp_free(pages);
  for (int k = 0; k < RECEIVERS; ++k)
    for (int c = 0; c < 6; c += 3) lamp_y_up(receivers[k] + c, there[k] + c);
  snprintf(command, sizeof command, "'%s' irradiance --light '%s' --method reference",
           getenv("RENDERSLAB"), path);
  lamp_run(command, receivers[0], 6, RECEIVERS, wanted);
  return path;
}

TEST(irradiance_by_the_text) {
  for (int n = 0; n < lamp_count; ++n) {
    if (!strcmp(lamps[n].name, "narrow") || !strcmp(lamps[n].name, "mirrored")) continue;
    const char *path = prepare(&lamps[n]);
    const char *folder = lamp_export(path, "plain", "--as mitsuba --plain --tolerance 0.03");
    int count = read_projectors(folder, lamps[n].name);
    sum(count);
    print_message("# %s: %d projectors, irradiance %.2f %% off\n", lamps[n].name, count,
                  100 * lamp_rms(got, wanted, RECEIVERS));
    if (!(lamp_rms(got, wanted, RECEIVERS) < 0.04))
      fail_msg("%s: irradiance %g off", lamps[n].name, lamp_rms(got, wanted, RECEIVERS));
    free_projectors(count);
  }
}

/* Plainly, and turned, mirrored, and scaled by 2.5, which the gain makes up for. */
TEST(irradiance_by_mitsuba) {
  static const double place[3][4] = {{-1.5, 2, 0, 1}, {2, 1.5, 0, -2}, {0, 0, 2.5, 0.5}};
  if (!engine_there(MITSUBA)) skip();
  const char *path = prepare(&lamps[1]);
  const char *folder = lamp_export(path, "plain", "--as mitsuba --plain --tolerance 0.05");
  int count = read_projectors(folder, lamps[1].name);
  sum(count);
  memcpy(wanted, got, sizeof wanted);
  engine_mitsuba(folder, lamps[1].name, "sum", there, RECEIVERS, got);
  if (!(lamp_rms(got, wanted, RECEIVERS) < 1e-4))
    fail_msg("%g off", lamp_rms(got, wanted, RECEIVERS));
  for (int k = 0; k < RECEIVERS; ++k) {
    double at[6];
    memcpy(at, there[k], sizeof at);
    for (int c = 0; c < 6; ++c)
      there[k][c] = place[c % 3][0] * at[c / 3 * 3] + place[c % 3][1] * at[c / 3 * 3 + 1] +
                    place[c % 3][2] * at[c / 3 * 3 + 2] + (c < 3 ? place[c][3] : 0);
    for (int c = 3; c < 6; ++c) there[k][c] /= 2.5;
  }
  engine_mitsuba(folder, lamps[1].name, "sum 'place=-1.5 2 0 1 2 1.5 0 -2 0 0 2.5 .5 0 0 0 1'",
                 there, RECEIVERS, got);
  for (int k = 0; k < 3 * RECEIVERS; ++k) got[k / 3][k % 3] *= 2.5;
  if (!(lamp_rms(got, wanted, RECEIVERS) < 1e-4))
    fail_msg("placed: %g off", lamp_rms(got, wanted, RECEIVERS));
}

int main(void) {
  return testing_run(NULL, NULL);
}
