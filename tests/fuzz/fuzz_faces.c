/* fuzz_faces.c - outlines of faces: two bytes are a corner on a grid. Triangles of an outline that
 * does not cross itself are together as large as it is: all numbers are whole. */
#include <stdlib.h>

#include "fuzz.h"
#include "scene/scene_faces.h"

enum { MOST = 500 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  double corner[MOST][3];
  int triangle[2 * MOST][3], made;
  int count = size / 2 > MOST ? MOST : (int)(size / 2);
  double area = 0, sum = 0;
  bool crosses;
  if (count < 3) return 0;
  for (int k = 0; k < count; ++k) {
    corner[k][2] = data[2 * k] % 32;
    corner[k][0] = data[2 * k + 1] % 32;
    corner[k][1] = corner[k][0] / 2; /* a plane that leans */
  }
  for (int k = 0; k < count; ++k) {
    const double *a = corner[k], *b = corner[(k + 1) % count];
    area += a[2] * b[0] - b[2] * a[0];
  }
  const double normal[3] = {-area / 2, area, 0};
  if (area == 0) return 0;
  fuzz_check(scene_triangulate((const double(*)[3])corner, count, normal, triangle, &made, &crosses,
                               NULL) == RESULT_OK);
  fuzz_check(made >= 0 && made <= 2 * count && !(crosses && made));
  for (int k = 0; k < made; ++k) {
    const double *at[3];
    for (int c = 0; c < 3; ++c) {
      fuzz_check((unsigned)triangle[k][c] < (unsigned)count);
      at[c] = corner[triangle[k][c]];
    }
    double own = (at[1][2] - at[0][2]) * (at[2][0] - at[0][0]) -
                 (at[1][0] - at[0][0]) * (at[2][2] - at[0][2]);
    fuzz_check(own * area > 0);
    sum += own;
  }
  fuzz_check(crosses || sum == area);
  return 0;
}
