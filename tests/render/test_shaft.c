/* test_shaft.c - where it says that nothing stands between receivers and an aperture, no
 * segment meets a triangle (brute force); and it says so where users would expect it. */
#include "base/vector.h"
#include "oracle/random.h"
#include "scene/scene.h"
#include "shadow/shaft.h"
#include "testing.h"

enum { TRIANGLES = 40, RECEIVERS = 5, RAYS = 200, CASES = 400 };

struct case_ {
  double position[3 * TRIANGLES][3], receivers[RECEIVERS][3], corners[4][3];
  int triangle[TRIANGLES][3];
  struct scene scene;
};

static double triple(const double a[3], const double b[3], const double c[3]) {
  double across[3];
  vector_cross(b, c, across);
  return vector_dot(a, across);
}

/* Signs of the volumes that the segment makes with the triangle's edges and plane. */
static bool meets(const double from[3], const double to[3], const double corner[3][3]) {
  double a[3], b[3], d[3], start[3], end[3];
  vector_subtract(corner[1], corner[0], a);
  vector_subtract(corner[2], corner[0], b);
  vector_subtract(from, corner[0], start);
  vector_subtract(to, corner[0], end);
  vector_subtract(to, from, d);
  if ((triple(a, b, start) > 0) == (triple(a, b, end) > 0)) return false;
  bool side[3];
  for (int k = 0; k < 3; ++k) {
    double x[3], y[3];
    vector_subtract(corner[k], from, x);
    vector_subtract(corner[(k + 1) % 3], from, y);
    side[k] = triple(d, x, y) > 0;
  }
  return side[0] == side[1] && side[1] == side[2];
}

/* Small triangles here and there; receivers close together; a rectangle. */
static void fill(struct case_ *now, uint64_t *seed) {
  double size = random_log(seed, 0.01, 1), spread = random_log(seed, 0.01, 1);
  for (int k = 0; k < TRIANGLES; ++k)
    for (int c = 0; c < 3; ++c) {
      double middle = random_between(seed, -2, 2);
      for (int corner = 0; corner < 3; ++corner)
        now->position[3 * k + corner][c] = middle + size * random_between(seed, -0.5, 0.5);
      now->triangle[k][c] = 3 * k + c;
    }
  double place[3], along[2][3];
  for (int c = 0; c < 3; ++c) {
    place[c] = random_between(seed, -2, 2);
    for (int k = 0; k < RECEIVERS; ++k)
      now->receivers[k][c] = place[c] + spread * random_between(seed, -0.5, 0.5);
    place[c] = random_between(seed, -2, 2);
    along[0][c] = random_between(seed, -0.5, 0.5);
    along[1][c] = random_between(seed, -0.5, 0.5);
    for (int k = 0; k < 4; ++k)
      now->corners[k][c] = place[c] + (k & 1) * along[0][c] + (k >> 1) * along[1][c];
  }
  now->scene = (struct scene){.vertices = (size_t)3 * TRIANGLES,
                              .triangles = TRIANGLES,
                              .position = now->position,
                              .corners = now->triangle};
}

static bool any_segment_meets(const struct case_ *now, uint64_t *seed) {
  for (int ray = 0; ray < RAYS; ++ray) {
    const double *from = now->receivers[ray % RECEIVERS];
    double u = random_number(seed), v = random_number(seed), to[3];
    for (int c = 0; c < 3; ++c)
      to[c] = now->corners[0][c] + u * (now->corners[1][c] - now->corners[0][c]) +
              v * (now->corners[2][c] - now->corners[0][c]);
    for (int k = 0; k < TRIANGLES; ++k)
      if (meets(from, to, (const double(*)[3]) & now->position[3 * k])) return true;
  }
  return false;
}

static bool ask(const struct scene *scene, const double (*receivers)[3], int count,
                const double corners[4][3]) {
  struct shaft_tree *tree = NULL;
  struct error error;
  assert_int_equal(shaft_tree_create(scene, &tree, &error), RESULT_OK);
  bool answer = shaft_may_block(tree, receivers, count, corners);
  shaft_tree_free(tree);
  return answer;
}

TEST(test_certain) {
  static struct case_ now;
  uint64_t seed = 7;
  int open = 0, needless = 0;
  for (int k = 0; k < CASES; ++k) {
    fill(&now, &seed);
    bool says = ask(&now.scene, (const double(*)[3])now.receivers, RECEIVERS,
                    (const double(*)[3])now.corners);
    bool is = any_segment_meets(&now, &seed);
    assert_true(says || !is);
    open += !says;
    needless += says && !is;
  }
  print_message("%d of %d open, %d asked for needlessly\n", open, CASES, needless);
  assert_true(open > CASES / 4);
}

/* A floor and a wall: receivers just above them, a lamp above. */
TEST(test_floor) {
  double position[8][3] = {{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9},
                           {-9, 0, 9},  {9, 0, 9},  {9, 9, 9}, {-9, 9, 9}};
  int corners[4][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  const struct scene scene = {
      .vertices = 8, .triangles = 4, .position = position, .corners = corners};
  const double lamp[4][3] = {{-1, 5, -1}, {1, 5, -1}, {-1, 5, 1}, {1, 5, 1}};
  const double above[2][3] = {{-8, 1e-5, -8}, {8, 1e-5, 8.9}};
  const double before[2][3] = {{-8, 1, 9 - 1e-5}, {8, 8, 9 - 1e-5}};
  const double below[1][3] = {{0, -1e-5, 0}};
  assert_false(ask(&scene, above, 2, lamp));
  assert_false(ask(&scene, before, 2, lamp));
  assert_true(ask(&scene, below, 1, lamp));
  assert_false(ask(&(struct scene){0}, above, 2, lamp));
}

int main(void) {
  return testing_run(NULL, NULL);
}
