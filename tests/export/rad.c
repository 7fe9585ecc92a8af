#include "rad.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cal.h"
#include "testing.h"

enum { AXES = 4, SOURCES = 8, POLYGONS = 4096, WORD = 96 };

struct data {
  double first[AXES], last[AXES];
  int count[AXES];
  float *values;
};

/* A `colordata` pattern and the `glow` or `illum` that it colours. */
struct source {
  char pattern[WORD], material[WORD], functions[3][WORD], coordinates[AXES][WORD];
  char shows[WORD]; /* the material that an illum shows to rays other than those to sources */
  struct data data[3];
  struct cal *cal;
  double colour[3];
};

struct polygon {
  struct source *source;
  double corners[4][3];
};

struct rad {
  struct source sources[SOURCES];
  int source_count;
  struct polygon polygons[POLYGONS];
  int polygon_count;
};

static void word(FILE *in, char text[WORD]) {
  do {
    if (fscanf(in, " %95s", text) != 1) text[0] = 0;
    if (text[0] == '#') (void)!fscanf(in, "%*[^\n]");
  } while (text[0] == '#');
}

static double number(FILE *in) {
  char text[WORD], *end;
  word(in, text);
  double value = strtod(text, &end);
  if (end == text || *end) fail_msg("\"%s\" is no number", text);
  return value;
}

static void expect_number(FILE *in, double wanted) {
  assert_near(number(in), wanted, 0);
}

static void path_of(const char *folder, const char *name, const char *ending, char path[512]) {
  snprintf(path, 512, "%s/%s%s", folder, name, ending);
}

/* A data file: 4, then first, last and count of each axis, then the values, the last axis fastest.
 */
static struct data read_data(const char *folder, const char *name) {
  struct data data;
  char path[512];
  path_of(folder, name, "", path);
  FILE *in = fopen(path, "r");
  if (!in) fail_msg("%s is not there", path);
  expect_number(in, AXES);
  size_t count = 1;
  for (int axis = 0; axis < AXES; ++axis) {
    data.first[axis] = number(in);
    data.last[axis] = number(in);
    data.count[axis] = (int)number(in);
    assert_true(data.count[axis] >= 2);
    count *= (size_t)data.count[axis];
  }
  data.values = calloc(count, sizeof *data.values);
  assert_non_null(data.values);
  for (size_t k = 0; k < count; ++k) data.values[k] = (float)number(in);
  char rest[WORD];
  word(in, rest);
  assert_string_equal(rest, "");
  fclose(in);
  return data;
}

/* Linear along each axis, and extrapolated beyond its ends, as Radiance's data.c does. */
static double interpolate(const struct data *data, const double at[AXES]) {
  int cell[AXES];
  double part[AXES], sum = 0;
  for (int axis = 0; axis < AXES; ++axis) {
    double x = (at[axis] - data->first[axis]) / (data->last[axis] - data->first[axis]) *
               (data->count[axis] - 1);
    cell[axis] = (int)fmin(fmax(x, 0), data->count[axis] - 2);
    part[axis] = x - cell[axis];
  }
  for (int corner = 0; corner < 16; ++corner) {
    size_t index = 0;
    double weight = 1;
    for (int axis = 0; axis < AXES; ++axis) {
      int up = corner >> axis & 1;
      index = index * (size_t)data->count[axis] + (size_t)(cell[axis] + up);
      weight *= up ? part[axis] : 1 - part[axis];
    }
    sum += weight * (double)data->values[index];
  }
  return sum;
}

static void read_source(struct rad *rad, FILE *in, const char *folder) {
  char text[WORD];
  assert_true(rad->source_count < SOURCES);
  struct source *source = &rad->sources[rad->source_count++];
  word(in, source->pattern);
  expect_number(in, 11);
  for (int c = 0; c < 3; ++c) word(in, source->functions[c]);
  for (int c = 0; c < 3; ++c) {
    word(in, text);
    source->data[c] = read_data(folder, text);
  }
  word(in, text);
  char path[512];
  path_of(folder, text, "", path);
  source->cal = cal_read(path);
  for (int axis = 0; axis < AXES; ++axis) word(in, source->coordinates[axis]);
  expect_number(in, 0);
  expect_number(in, 0);
}

/* A glow, whose last number 0 says that it is no source, or an illum. */
static void read_material(struct rad *rad, FILE *in, const char *modifier, bool illum) {
  struct source *source = rad->sources;
  while (source < rad->sources + rad->source_count && strcmp(source->pattern, modifier)) ++source;
  assert_true(source < rad->sources + rad->source_count);
  word(in, source->material);
  expect_number(in, illum);
  if (illum) word(in, source->shows);
  expect_number(in, 0);
  expect_number(in, illum ? 3 : 4);
  for (int c = 0; c < 3; ++c) source->colour[c] = number(in);
  if (!illum) expect_number(in, 0);
}

static struct source *find_material(struct rad *rad, const char *material) {
  struct source *source = rad->sources;
  while (source < rad->sources + rad->source_count && strcmp(source->material, material)) ++source;
  if (source == rad->sources + rad->source_count) fail_msg("no material %s", material);
  return source;
}

static void read_polygon(struct rad *rad, FILE *in, const char *modifier) {
  char name[WORD];
  assert_true(rad->polygon_count < POLYGONS);
  struct polygon *polygon = &rad->polygons[rad->polygon_count++];
  polygon->source = find_material(rad, modifier);
  word(in, name);
  expect_number(in, 0);
  expect_number(in, 0);
  expect_number(in, 12);
  for (int k = 0; k < 12; ++k) polygon->corners[k / 3][k % 3] = number(in);
}

struct rad *rad_read(const char *folder, const char *name) {
  struct rad *rad = calloc(1, sizeof *rad);
  char path[512], modifier[WORD], type[WORD];
  path_of(folder, name, ".rad", path);
  FILE *in = fopen(path, "r");
  if (!rad || !in) fail_msg("%s is not there", path);
  while (word(in, modifier), modifier[0]) {
    word(in, type);
    if (!strcmp(type, "colordata"))
      read_source(rad, in, folder);
    else if (!strcmp(type, "glow") || !strcmp(type, "illum"))
      read_material(rad, in, modifier, type[0] == 'i');
    else if (!strcmp(type, "polygon"))
      read_polygon(rad, in, modifier);
    else
      fail_msg("%s: type %s", path, type);
  }
  fclose(in);
  if (!rad || rad->polygon_count == 0) fail_msg("%s: no polygons", path);
  return rad;
}

void rad_free(struct rad *rad) {
  for (int k = 0; k < rad->source_count; ++k) {
    for (int c = 0; c < 3; ++c) free(rad->sources[k].data[c].values);
    cal_free(rad->sources[k].cal);
  }
  free(rad);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* (b - a) x (c - a) */
static void cross(const double a[3], const double b[3], const double c[3], double product[3]) {
  for (int k = 0; k < 3; ++k) {
    int y = (k + 1) % 3, z = (k + 2) % 3;
    product[k] = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
  }
}

/* How far the ray goes to the polygon; INFINITY where it misses. `rod` is the cosine, positive
 * where the ray comes from the side from which the corners go round counter-clockwise. */
static double distance(const struct polygon *polygon, const double origin[3],
                       const double direction[3], double *rod) {
  const double(*corner)[3] = polygon->corners;
  double normal[3], to[3], point[3], side[3];
  cross(corner[0], corner[1], corner[2], normal);
  *rod = -dot(normal, direction);
  if (*rod == 0) return INFINITY;
  for (int c = 0; c < 3; ++c) to[c] = corner[0][c] - origin[c];
  double far = dot(normal, to) / dot(normal, direction);
  if (!(far > 0)) return INFINITY;
  for (int c = 0; c < 3; ++c) point[c] = origin[c] + far * direction[c];
  for (int k = 0; k < 4; ++k) {
    cross(corner[k], corner[(k + 1) % 4], point, side);
    if (dot(side, normal) < 0) return INFINITY;
  }
  return far;
}

/* What a material gives to a ray. */
static void shade(struct source *source, const struct cal_ray *ray, double rgb[3]) {
  double at[AXES], values[3];
  for (int axis = 0; axis < AXES; ++axis)
    at[axis] = cal_variable(source->cal, source->coordinates[axis], ray);
  for (int c = 0; c < 3; ++c) values[c] = interpolate(&source->data[c], at);
  for (int c = 0; c < 3; ++c)
    rgb[c] = source->colour[c] * cal_function(source->cal, source->functions[c], values, ray);
}

void rad_ray(struct rad *rad, const double origin[3], const double direction[3], double rgb[3]) {
  const struct polygon *met = NULL;
  double nearest = INFINITY, faces = 0, length = sqrt(dot(direction, direction));
  for (const struct polygon *p = rad->polygons; p < rad->polygons + rad->polygon_count; ++p) {
    double rod, far = distance(p, origin, direction, &rod);
    if (!(far < nearest)) continue;
    nearest = far;
    faces = rod;
    met = p;
  }
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!met || !(faces > 0)) return;
  struct cal_ray ray = {.length = nearest * length};
  for (int c = 0; c < 3; ++c) {
    ray.point[c] = origin[c] + nearest * direction[c];
    ray.direction[c] = direction[c] / length;
  }
  shade(find_material(rad, met->source->shows), &ray, rgb);
}
