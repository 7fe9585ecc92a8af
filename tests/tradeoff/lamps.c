/* lamps.c - the lamps and scenes of `make tradeoff`, and comparisons of pictures.
 *
 *   lamps smooth FILE.tif UV ST      a lobe that changes slowly over an aperture of 20 x 20
 *   lamps peaks FILE.tif UV ST       beams about as thin as a cell of 64 x 64 directions
 *   lamps near|office|far FILE.obj   a scene 0.3-2, 4-30 or 50-300 apertures away from a lamp
 *                                    that hangs at 0,30,0 or 0,240,0 or 0,2000,0; it names room.mtl
 *   lamps floor FILE.obj SIZE        a square of SIZE x SIZE in y = 0
 *   lamps compare A.exr B.exr        relative RMS of the difference, and the largest relative
 *                                    error, as `renderslab tradeoff` defines them */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_exr.h"
#include "file/slab_file.h"

static const double aperture = 20, slope = 1.5;

static void die(const char *text) {
  fprintf(stderr, "lamps: %s\n", text);
  exit(1);
}

/* ---- Lamps: radiance at a, b in apertures from the centre, towards the slopes s, t ---- */

static double smooth(double a, double b, double s, double t) {
  double x = s - 0.3 * a, y = t - 0.3 * b;
  return (1 + a * b) * exp(-2 * (x * x + y * y));
}

/* Seven beams, each from all of the aperture, turning a little across it. */
static double peaks(double a, double b, double s, double t) {
  double sum = 0.02;
  for (int k = 0; k < 7; ++k) {
    double angle = 2.4 * k, away = 0.15 * k;
    double x = s - away * cos(angle) - 0.4 * a, y = t - away * sin(angle) - 0.2 * b;
    sum += (1 + 0.5 * sin(5 * a + k)) * exp(-(x * x + y * y) / (2 * 0.05 * 0.05));
  }
  return sum;
}

typedef double radiance(double a, double b, double s, double t);

static void write_lamp(const char *name, radiance *lamp, const char *path, int uv, int st) {
  struct error error;
  struct slab slab = slab_default();
  if (uv < 1 || st < 1 || uv > 256 || st > 256) die("1 to 256 samples");
  snprintf(slab.name, sizeof slab.name, "%s", name);
  const struct slab form = {.samples = {uv, uv, st, st},
                            .u = {aperture, 0, 0},
                            .v = {0, 0, aperture},
                            .normal = {0, -1, 0},
                            .st_window = {-slope, slope, -slope, slope}};
  memcpy(slab.samples, form.samples, sizeof slab.samples);
  memcpy(slab.u, form.u, sizeof slab.u);
  memcpy(slab.v, form.v, sizeof slab.v);
  memcpy(slab.normal, form.normal, sizeof slab.normal);
  memcpy(slab.st_window, form.st_window, sizeof slab.st_window);
  slab.st_distance = INFINITY;
  slab.metres_per_unit = 0.01;
  if (slab_alloc(&slab, &error) != RESULT_OK) die(error.text);
  for (size_t pixel = 0; pixel < slab_sample_count(&slab); ++pixel) {
    int at[SLAB_AXES];
    double x[SLAB_AXES];
    slab_locate(&slab, pixel, at);
    for (int axis = 0; axis < SLAB_AXES; ++axis) x[axis] = slab_position(&slab, axis, at[axis]);
    double light = lamp(x[SLAB_U] / aperture, x[SLAB_V] / aperture, x[SLAB_S], x[SLAB_T]);
    static const double colour[3] = {1, 0.9, 0.7};
    for (size_t c = 0; c < 3; ++c) slab.rgb[3 * pixel + c] = (float)(light * colour[c]);
  }
  if (slab_file_write(path, &slab, 1, SLAB_PRECISION_FLOAT, &error) != RESULT_OK) die(error.text);
  slab_free(&slab);
}

/* ---- Scenes ---- */

struct box {
  double low[3], high[3];
  const char *material;
};

/* The six sides, each with its normal. */
static void write_box(FILE *file, const struct box *box, int *vertices, int *normals) {
  fprintf(file, "usemtl %s\n", box->material);
  for (int side = 0; side < 6; ++side) {
    int axis = side / 2, up = side % 2, p = (axis + 1) % 3, q = (axis + 2) % 3;
    double normal[3] = {0, 0, 0};
    normal[axis] = up ? 1 : -1;
    for (int k = 0; k < 4; ++k) {
      int corner = up ? k : 3 - k;
      double x[3];
      x[axis] = up ? box->high[axis] : box->low[axis];
      x[p] = corner == 1 || corner == 2 ? box->high[p] : box->low[p];
      x[q] = corner >= 2 ? box->high[q] : box->low[q];
      fprintf(file, "v %g %g %g\n", x[0], x[1], x[2]);
    }
    fprintf(file, "vn %g %g %g\n", normal[0], normal[1], normal[2]);
    int v = *vertices, n = ++*normals;
    fprintf(file, "f %d//%d %d//%d %d//%d %d//%d\n", v + 1, n, v + 2, n, v + 3, n, v + 4, n);
    *vertices += 4;
  }
}

static void write_floor(FILE *file, double half, int *vertices, int *normals) {
  fprintf(file, "usemtl floor\nv %g 0 %g\nv %g 0 %g\nv %g 0 %g\nv %g 0 %g\nvn 0 1 0\n", -half, half,
          half, half, half, -half, -half, -half);
  fputs("f 1//1 2//1 3//1 4//1\n", file);
  *vertices += 4;
  ++*normals;
}

static void write_scene(const char *path, double half, const struct box *boxes, int count) {
  FILE *file = fopen(path, "w");
  int vertices = 0, normals = 0;
  if (!file) die("cannot write the scene");
  fputs("mtllib room.mtl\n", file);
  write_floor(file, half, &vertices, &normals);
  for (int k = 0; k < count; ++k) write_box(file, &boxes[k], &vertices, &normals);
  if (fclose(file)) die("cannot write the scene");
}

/* A plinth right below the lamp, and a post. */
static const struct box near_boxes[] = {{{-5, 0, -5}, {5, 24, 5}, "red"},
                                        {{12, 0, 8}, {14, 20, 10}, "white"}};
/* A cupboard as high as 4 apertures below the lamp, a table with its legs, a shelf. */
static const struct box office_boxes[] = {
    {{90, 0, -60}, {150, 160, 40}, "red"},      {{-120, 70, -40}, {0, 75, 40}, "white"},
    {{-116, 0, -36}, {-110, 70, -30}, "white"}, {{-10, 0, -36}, {-4, 70, -30}, "white"},
    {{-116, 0, 30}, {-110, 70, 36}, "white"},   {{-10, 0, 30}, {-4, 70, 36}, "white"},
    {{-60, 0, -180}, {60, 40, -120}, "red"}};
/* Houses around a square. */
static const struct box far_boxes[] = {{{-1200, 0, -900}, {-500, 1000, -200}, "red"},
                                       {{500, 0, -800}, {1100, 600, 100}, "white"},
                                       {{-900, 0, 500}, {200, 300, 900}, "white"},
                                       {{600, 0, 600}, {900, 800, 900}, "red"}};

static bool write_named_scene(const char *name, const char *path) {
  if (!strcmp(name, "near"))
    write_scene(path, 60, near_boxes, sizeof near_boxes / sizeof *near_boxes);
  else if (!strcmp(name, "office"))
    write_scene(path, 500, office_boxes, sizeof office_boxes / sizeof *office_boxes);
  else if (!strcmp(name, "far"))
    write_scene(path, 4000, far_boxes, sizeof far_boxes / sizeof *far_boxes);
  else
    return false;
  return true;
}

/* ---- Pictures ---- */

static double length_of(const float *rgb) {
  double square = 0;
  for (int c = 0; c < 3; ++c) square += (double)rgb[c] * (double)rgb[c];
  return sqrt(square);
}

static void compare(const char *name, const char *other) {
  struct picture a, b;
  struct error error;
  if (slab_exr_read(name, &a, &error) || slab_exr_read(other, &b, &error)) die(error.text);
  if (a.width != b.width || a.height != b.height) die("pictures of two sizes");
  size_t count = (size_t)a.width * (size_t)a.height;
  double wrong = 0, all = 0, mean = 0, most = 0;
  for (size_t k = 0; k < count; ++k) mean += length_of(b.rgb + 3 * k) / (double)count;
  for (size_t k = 0; k < count; ++k) {
    float off[3];
    for (size_t c = 0; c < 3; ++c) off[c] = a.rgb[3 * k + c] - b.rgb[3 * k + c];
    double difference = length_of(off), light = length_of(b.rgb + 3 * k);
    wrong += difference * difference;
    all += light * light;
    most = fmax(most, difference / fmax(light, 0.01 * mean));
  }
  printf("%.4g %.4g\n", sqrt(wrong / all), most);
  picture_free(&a);
  picture_free(&b);
}

int main(int argc, char **argv) {
  const char *what = argc > 2 ? argv[1] : "";
  if (!strcmp(what, "smooth") && argc == 5)
    write_lamp("smooth", smooth, argv[2], atoi(argv[3]), atoi(argv[4]));
  else if (!strcmp(what, "peaks") && argc == 5)
    write_lamp("peaks", peaks, argv[2], atoi(argv[3]), atoi(argv[4]));
  else if (!strcmp(what, "floor") && argc == 4)
    write_scene(argv[2], atof(argv[3]) / 2, NULL, 0);
  else if (!strcmp(what, "compare") && argc == 4)
    compare(argv[2], argv[3]);
  else if (argc != 3 || !write_named_scene(what, argv[2]))
    die("see lamps.c for its arguments");
  return 0;
}
