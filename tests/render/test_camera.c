/* test_camera.c - the camera's frame and rays against POV-Ray's documentation. */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "helpers.h"
#include "scene/camera.h"

static struct camera parse(const char *text) {
  struct camera camera;
  struct error error = {""};
  if (camera_parse(text, &camera, &error)) fail_msg("%s", error.text);
  return camera;
}

static void expect_vector(const double x[3], double a, double b, double c) {
  assert_near(x[0], a, 1e-14);
  assert_near(x[1], b, 1e-14);
  assert_near(x[2], c, 1e-14);
}

/* Left-handed: who looks along z with y up has x to the right. */
TEST(test_axes) {
  double forward[3], right[3], up[3];
  struct camera camera = parse("from=0,0,-5 at=0,0,3");
  camera_axes(&camera, forward, right, up);
  expect_vector(forward, 0, 0, 1);
  expect_vector(right, 1, 0, 0);
  expect_vector(up, 0, 1, 0);
  camera = parse("from=0,7,0 at=0,0,0 up=0,0,1e-200");
  camera_axes(&camera, forward, right, up);
  expect_vector(forward, 0, -1, 0);
  expect_vector(right, 1, 0, 0);
  expect_vector(up, 0, 0, 1);
  camera = parse(" at=4,2,-1\tfrom=1,2,3  up=1,5,2 fov=40 ");
  camera_axes(&camera, forward, right, up);
  assert_near(vector_dot(forward, right), 0, 1e-15);
  assert_near(vector_dot(forward, up), 0, 1e-15);
  assert_near(vector_dot(right, up), 0, 1e-15);
  double across[3];
  vector_cross(right, up, across);
  expect_vector(across, forward[0], forward[1], forward[2]);
  assert_true(up[1] > 0);
}

TEST(test_rays) {
  double ray[3];
  struct camera camera = parse("from=1,2,3 at=1,2,13 fov=90");
  camera_ray(&camera, 400, 300, 200, 150, ray);
  expect_vector(ray, 0, 0, 1);
  camera_ray(&camera, 400, 300, 400, 150, ray); /* the right edge: half of fov */
  expect_vector(ray, sqrt(0.5), 0, sqrt(0.5));
  camera_ray(&camera, 400, 300, 0, 150, ray);
  expect_vector(ray, -sqrt(0.5), 0, sqrt(0.5));
  camera_ray(&camera, 400, 300, 200, 0, ray); /* the top: pixels are square */
  expect_vector(ray, 0, 0.6, 0.8);
  camera_ray(&camera, 400, 300, 399.5, 299.5, ray);
  double x = 199.5 / 200, y = -149.5 / 200, length = sqrt(1 + x * x + y * y);
  expect_vector(ray, x / length, y / length, 1 / length);
}

TEST(test_defaults) {
  struct camera camera = parse("from=1,2,3 at=-4e2,5,.5");
  expect_vector(camera.up, 0, 1, 0);
  assert_near(camera.fov, 60, 0);
  expect_vector(camera.at, -400, 5, 0.5);
}

TEST(test_refused) {
  static const char *const cases[][2] = {
      {"", "from=X,Y,Z is missing"},
      {"from=0,0,0", "at=X,Y,Z is missing"},
      {"from=0,0,0 at=0,0,0", "the same"},
      {"from=0,0,0 at=0,3,0", "up is along the view"},
      {"from=0,0,0 at=0,-3,0 up=0,2,0", "up is along the view"},
      {"from=0,0,0 at=0,0,1 up=0,0,0", "up has no length"},
      {"from=0,0,0 at=0,0,1 fov=0", "between 0 and 180"},
      {"from=0,0,0 at=0,0,1 fov=180", "between 0 and 180"},
      {"from=0,0,0 at=0,0,1 fov=nan", "fov=DEG"},
      {"from=0,0,inf at=0,0,1", "finite"},
      {"from=0,0 at=0,0,1", "from=X,Y,Z"},
      {"from=0,0,0,0 at=0,0,1", "from=X,Y,Z"},
      {"from=0, 0,0 at=0,0,1", "from=X,Y,Z"},
      {"from=0,0,0 at=0,0,1 at=0,0,2", "twice"},
      {"from=0,0,0 at=0,0,1 zoom=3", "'zoom=3'"},
      {"from=-1.7e308,0,0 at=1.7e308,0,0", "too far apart"},
  };
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    struct camera camera;
    struct error error = {""};
    assert_int_equal(camera_parse(cases[k][0], &camera, &error), RESULT_BAD);
    if (!strstr(error.text, cases[k][1])) fail_msg("'%s': %s", cases[k][0], error.text);
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
