#include "unit/photometric.h"

#include <math.h>
#include <stdio.h>

#include "oracle/oracle.h"
#include "testing.h"

const char *photometric_ies(const char *name, photometric_candela *candela, const void *about,
                            double step, const double size[3]) {
  int rows = (int)round(180 / step) + 1, planes = (int)round(180 / step) + 1;
  const char *path = scratch(name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "IESNA:LM-63-2002\n[TEST] made\n[MANUFAC] tests\nTILT=NONE\n");
  fprintf(file, "1 -1 1 %d %d 1 2 %.9g %.9g %.9g 1 1 0\n", rows, planes, size[0], size[1], size[2]);
  for (int j = 0; j < rows; ++j) fprintf(file, "%.9g\n", j * step);
  for (int i = 0; i < planes; ++i) fprintf(file, "%.9g\n", 2 * i * step);
  for (int i = 0; i < planes; ++i)
    for (int j = 0; j < rows; ++j) {
      double gamma = j * step * M_PI / 180, c = 2 * i * step * M_PI / 180;
      double d[3] = {sin(gamma) * cos(c), -cos(gamma), sin(gamma) * sin(c)};
      fprintf(file, "%.9g%s", candela(d, about), j % 9 == 8 ? "\r\n" : " ");
    }
  assert_int_equal(fclose(file), 0);
  return path;
}

struct import_light photometric_import(const char *path, const struct import_wish *wish) {
  struct warnings notes = {0};
  struct import_wish all = wish ? *wish : (struct import_wish){0};
  struct import_light light;
  struct error error = {{0}};
  all.files = &path;
  all.file_count = 1;
  all.notes = &notes;
  if (import_files(&all, "test", &light, &error) != RESULT_OK) fail_msg("%s", error.text);
  return light;
}

double photometric_irradiance(const struct import_light *light, const double point[3],
                              const double normal[3], int count) {
  double sum = 0;
  for (int n = 0; n < light->count; ++n) {
    double rgb[3], z = 0;
    for (int k = 0; k < 3; ++k)
      z += (point[k] - light->slabs[n].center[k]) * light->slabs[n].normal[k];
    if (!(z > 0)) continue;
    oracle_brute(&light->slabs[n], point, normal, NULL, 0, count, rgb);
    sum += 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  }
  return sum;
}

double photometric_far(const struct import_light *light, const double direction[3],
                       double distance) {
  double point[3], normal[3];
  for (int k = 0; k < 3; ++k) {
    point[k] = distance * direction[k];
    normal[k] = -direction[k];
  }
  return photometric_irradiance(light, point, normal, 24) * distance * distance;
}

void photometric_direction(int n, int count, double direction[3]) {
  double y = 1 - (2 * n + 1.0) / count, turn = n * 2.39996322972865332, r = sqrt(1 - y * y);
  direction[0] = r * sin(turn + 1);
  direction[1] = y;
  direction[2] = r * cos(turn + 1);
}
