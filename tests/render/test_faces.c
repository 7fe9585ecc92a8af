/* test_faces.c - faces of any shape, begun at any corner and in both directions, of OBJ and PLY
 * files: their triangles cover what the outline encloses, and nothing twice. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "meshes.h"
#include "oracle/random.h"
#include "testing.h"

enum { MOST = 40 };

/* An outline on a grid; its area is positive where it runs against the clock. */
struct outline {
  int count;
  int at[MOST][2];
};

static const struct outline shapes[] = {
    {6, {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}},                 /* L */
    {8, {{0, 0}, {6, 0}, {6, 4}, {4, 4}, {3, 1}, {2, 4}, {1, 5}, {0, 4}}}, /* a notch */
    {5, {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}},                         /* M */
    {4, {{0, 0}, {4, 1}, {0, 4}, {1, 1}}},                                 /* an arrow */
    {4, {{0, 0}, {3, 0}, {3, 3}, {0, 3}}},
    {7, {{0, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {0, 4}, {0, 2}}}, /* corners within edges */
    {6, {{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 4}}},         /* corners twice */
    {6, {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 6}, {2, 4}}},         /* and an edge */
    /* Windows, that an edge joins there and back: one, and two. */
    {10, {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {2, 2}, {2, 5}, {5, 5}, {5, 2}, {2, 2}}},
    {16,
     {{0, 0},
      {20, 0},
      {20, 9},
      {0, 9},
      {0, 0},
      {2, 2},
      {2, 5},
      {5, 5},
      {8, 5},
      {8, 8},
      {11, 8},
      {11, 5},
      {8, 5},
      {5, 5},
      {5, 2},
      {2, 2}}},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

/* The plane, far from the origin; all its numbers are exact. */
static void place(const int at[2], double far, double out[3]) {
  out[0] = 2 * at[0] + far;
  out[1] = at[0] + at[1];
  out[2] = 3 * at[1] - far;
}

static int twice_area(const struct outline *outline) {
  int sum = 0;
  for (int k = 0; k < outline->count; ++k) {
    const int *a = outline->at[k], *b = outline->at[(k + 1) % outline->count];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

/* By crossings of a ray to the right, an odd number of which is inside. */
static bool inside(const struct outline *outline, const double at[2]) {
  bool odd = false;
  for (int k = 0; k < outline->count; ++k) {
    const int *a = outline->at[k], *b = outline->at[(k + 1) % outline->count];
    if ((a[1] > at[1]) == (b[1] > at[1])) continue;
    odd ^= at[0] < a[0] + (at[1] - a[1]) * (b[0] - a[0]) / (double)(b[1] - a[1]);
  }
  return odd;
}

/* The outline begun at another corner, or backwards. */
static struct outline turned(const struct outline *outline, int first, bool back) {
  struct outline out = {.count = outline->count};
  for (int k = 0; k < out.count; ++k) {
    int from = (first + (back ? out.count - k : k)) % out.count;
    memcpy(out.at[k], outline->at[from], sizeof out.at[k]);
  }
  return out;
}

static const char *write_obj(const struct outline *outline, double far) {
  char text[4096];
  size_t at = 0;
  double x[3];
  for (int k = 0; k < outline->count; ++k) {
    place(outline->at[k], far, x);
    at += (size_t)snprintf(text + at, sizeof text - at, "v %.17g %.17g %.17g\n", x[0], x[1], x[2]);
  }
  at += (size_t)snprintf(text + at, sizeof text - at, "f");
  for (int k = 0; k < outline->count; ++k)
    at += (size_t)snprintf(text + at, sizeof text - at, " %d", k - outline->count);
  return meshes_write("faces.obj", text);
}

/* Little endian, as this machine's numbers are; big endian: each reversed. */
static void put(FILE *file, const void *number, size_t size, bool big) {
  for (size_t k = 0; k < size; ++k)
    putc(((const unsigned char *)number)[big ? size - 1 - k : k], file);
}

static const char *write_ply(const struct outline *outline, double far, bool big) {
  const char *path = scratch("faces.ply");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file,
          "ply\r\nformat binary_%s_endian 1.0\r\ncomment none\r\nelement other 1\r\nproperty list "
          "char short some\r\nelement vertex %d\r\nproperty double z\r\nproperty uchar red\r\n"
          "property double x\r\nproperty double y\r\nelement face 1\r\nproperty float weight\r\n"
          "property list ushort uint vertex_index\r\nend_header\r\n",
          big ? "big" : "little", outline->count);
  unsigned char some[] = {10}; /* a line feed; ten numbers that are skipped */
  short number = 7;
  put(file, some, 1, big);
  for (int k = 0; k < 10; ++k) put(file, &number, sizeof number, big);
  for (unsigned k = 0; k < (unsigned)outline->count; ++k) {
    double x[3];
    place(outline->at[k], far, x);
    put(file, &x[2], sizeof *x, big);
    put(file, some, 1, big);
    put(file, &x[0], sizeof *x, big);
    put(file, &x[1], sizeof *x, big);
  }
  float weight = 1.5f;
  unsigned short count = (unsigned short)outline->count;
  put(file, &weight, sizeof weight, big);
  put(file, &count, sizeof count, big);
  for (unsigned k = 0; k < count; ++k) put(file, &k, sizeof k, big);
  assert_int_equal(fclose(file), 0);
  return path;
}

/* All triangles show the side of the outline, lie in it, and are as large as it is together. */
static void covers(const char *path, const struct outline *outline, double far) {
  char note[256];
  struct scene scene = meshes_load(path, SCENE_SHAPE, false, note);
  double sum = 0;
  for (size_t t = 0; t < scene.triangles; ++t) {
    double on[3][2], middle[2] = {0, 0};
    for (int k = 0; k < 3; ++k) {
      /* z is mirrored, so the outline runs the other way; so does the triangle */
      const double *x = scene.position[scene.corners[t][k]];
      on[k][0] = (x[0] - far) / 2;
      on[k][1] = (-x[2] + far) / 3;
      assert_near(x[1], on[k][0] + on[k][1], 1e-9);
      for (int c = 0; c < 2; ++c) middle[c] += on[k][c] / 3;
    }
    /* mirrored: wound the other way */
    double area = (on[2][0] - on[0][0]) * (on[1][1] - on[0][1]) -
                  (on[2][1] - on[0][1]) * (on[1][0] - on[0][0]);
    assert_true(area * twice_area(outline) > 0);
    assert_true(inside(outline, middle));
    sum += area;
  }
  assert_near(sum, twice_area(outline), 1e-9 * fabs(sum));
  assert_true((strstr(note, "single precision") != NULL) == (far > 1e5));
  scene_free(&scene);
}

TEST(every_shape_from_every_corner) {
  for (int s = 0; s < SHAPES; ++s)
    for (int first = 0; first < shapes[s].count; ++first)
      for (int back = 0; back < 2; ++back) {
        struct outline outline = turned(&shapes[s], first, back);
        double far = first % 2 ? 5334567 : 0;
        covers(write_obj(&outline, far), &outline, far);
        covers(write_ply(&outline, far, back), &outline, far);
      }
}

static long turn(const int a[2], const int b[2], const int c[2]) {
  return (long)(b[0] - a[0]) * (c[1] - a[1]) - (long)(b[1] - a[1]) * (c[0] - a[0]);
}

/* Do the edges a b and c d have a point in common? */
static bool meet(const int a[2], const int b[2], const int c[2], const int d[2]) {
  long side[4] = {turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)};
  return (side[0] >= 0) != (side[1] > 0) || side[0] == 0 || side[1] == 0
             ? ((side[2] >= 0) != (side[3] > 0) || side[2] == 0 || side[3] == 0)
             : false;
}

/* Takes crossings out of a random outline, each of which shortens it; false where corners lie on
 * edges. */
static bool untangle(struct outline *outline) {
  for (int round = 0; round < 1000; ++round) {
    bool good = true;
    for (int i = 0; i < outline->count && good; ++i)
      for (int j = i + 2; j < outline->count && good; ++j) {
        if (i == 0 && j == outline->count - 1) continue;
        int *a = outline->at[i], *b = outline->at[i + 1], *c = outline->at[j];
        int *d = outline->at[(j + 1) % outline->count];
        if (!meet(a, b, c, d)) continue;
        good = false;
        for (int l = i + 1, r = j; l < r; ++l, --r)
          for (int x = 0; x < 2; ++x) {
            int swap = outline->at[l][x];
            outline->at[l][x] = outline->at[r][x];
            outline->at[r][x] = swap;
          }
      }
    if (good) return twice_area(outline) != 0;
  }
  return false;
}

TEST(random_outlines) {
  uint64_t state = 7;
  int tried = 0;
  for (int k = 0; k < 300; ++k) {
    struct outline outline = {.count = 5 + k % 30};
    for (int c = 0; c < outline.count; ++c)
      for (int x = 0; x < 2; ++x) outline.at[c][x] = (int)(100 * random_number(&state));
    if (!untangle(&outline)) continue;
    ++tried;
    covers(k % 2 ? write_obj(&outline, 0) : write_ply(&outline, 0, false), &outline, 0);
  }
  assert_true(tried > 200);
}

/* Refused by name, and dropped where they may be: an hourglass whose halves differ, one that runs
 * around something twice, one with a corner of another edge inside, and one that turns more than
 * once around its first corner. */
TEST(crossing_outlines) {
  static const struct outline crossing[] = {
      {4, {{0, 0}, {4, 4}, {4, 0}, {0, 2}}},
      {8, {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}}},
      {6, {{0, 0}, {2, 2}, {4, 6}, {4, 0}, {2, 2}, {0, 4}}},
      {7, {{0, 0}, {4, 0}, {4, 4}, {-4, 4}, {-4, -4}, {5, -4}, {5, 1}}},
  };
  for (size_t k = 0; k < sizeof crossing / sizeof *crossing; ++k) {
    const char *path = write_obj(&crossing[k], 0);
    meshes_refused(path, SCENE_SHAPE, false, "faces.obj:");
    meshes_refused(path, SCENE_SHAPE, false, "crosses itself; --repair drops it");
    meshes_refused(path, SCENE_SHAPE, true, "has no triangles with an area");
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
