/* test_poses.c - transforms.json: where its cameras stand and look, in lamp space; what is refused
 * by name; their pixels as rays, and the fall-off of lenses. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "helpers.h"
#include "import/pictures/posed_rays.h"

#define MATRIX "[[1, 0, 0, 0.5], [0, 0, -1, -3], [0, 1, 0, 0.25], [0, 0, 0, 1]]"

/* A file of one frame, with more keys of the file and of the frame. */
static const char *one_frame(const char *file, const char *frame) {
  static char text[2048];
  snprintf(text, sizeof text, "{%s \"frames\": [{%s}]}", file, frame);
  return text;
}

static struct poses read_text(const char *text) {
  struct poses poses;
  struct error error = {{0}};
  assert_ok(poses_read(text, &poses, &error), &error);
  return poses;
}

static void assert_looks(const struct pose *pose, double column, double row, double x, double y,
                         double z) {
  double direction[3];
  poses_look(pose, column, row, direction);
  assert_near(direction[0], x, 1e-12);
  assert_near(direction[1], y, 1e-12);
  assert_near(direction[2], z, 1e-12);
}

/* The file's z is up; this camera stands at its (0.5, -3, 0.25), upright, and looks along +y: in
 * lamp space at (0.5, 0.25, -3), along +z, with x to the right. */
TEST(test_a_camera_by_hand) {
  struct poses poses = read_text(one_frame(
      "\"fl_x\": 100, ", "\"file_path\": \"./train/r_0\", \"transform_matrix\": " MATRIX));
  struct pose *pose = poses.pose;
  assert_int_equal(poses.count, 1);
  assert_string_equal(pose->file, "./train/r_0.exr");
  poses_complete(pose, 200, 100);
  assert_near(pose->origin[0], 0.5, 0);
  assert_near(pose->origin[1], 0.25, 0);
  assert_near(pose->origin[2], -3, 0);
  assert_looks(pose, 100, 50, 0, 0, 1);
  assert_looks(pose, 200, 50, 1, 0, 1);  /* the right edge */
  assert_looks(pose, 100, 0, 0, 0.5, 1); /* the top */
  poses_free(&poses);
}

TEST(test_angles_and_middles) {
  static const char frame[] = "\"file_path\": \"a.hdr\", \"w\": 60, \"cy\": 10, "
                              "\"transform_matrix\": " MATRIX;
  struct poses poses =
      read_text(one_frame("\"camera_angle_x\": 1.5707963267948966, \"w\": 30, \"h\": 50, ", frame));
  struct pose *pose = poses.pose;
  assert_string_equal(pose->file, "a.hdr");
  assert_near(pose->width, 60, 0); /* the frame's own */
  assert_near(pose->height, 50, 0);
  poses_complete(pose, 60, 50);
  assert_looks(pose, 60, 10, 1, 0, 1); /* 45 degrees */
  assert_looks(pose, 30, 40, 0, -1, 1);
  poses_free(&poses);
}

static void refuse(const char *text, const char *piece) {
  struct poses poses;
  struct error error = {{0}};
  assert_refused(poses_read(text, &poses, &error), &error, piece, NULL);
  poses_free(&poses);
}

TEST(test_refusals) {
  static const char frame[] = "\"file_path\": \"a.exr\", \"transform_matrix\": " MATRIX;
  static const struct {
    const char *file, *frame, *says;
  } rows[] = {
      {"\"fl_x\": 9, \"k1\": -0.25,", frame, "frame 1: k1 is -0.25: lens distortion"},
      {"\"fl_x\": 9, \"p2\": 1e-3,", frame, "p2 is 0.001"},
      {"\"fl_x\": 9, \"k1\": \"much\",", frame, "k1 is no number"},
      {"\"fl_x\": 9, \"is_fisheye\": true,", frame, "is_fisheye"},
      {"\"fl_x\": 9, \"camera_model\": \"OPENCV_FISHEYE\",", frame, "OPENCV_FISHEYE"},
      {"\"fl_x\": 9, \"rolling_shutter\": [0, 0, 0.1],", frame, "rolling_shutter"},
      {"\"fl_x\": 0,", frame, "fl_x is no number above 0"},
      {"\"fl_x\": 9, \"w\": -3,", frame, "w is no number above 0"},
      {"\"camera_angle_x\": 3.2,", frame, "camera_angle_x is not below pi"},
      {"", frame, "neither camera_angle_x nor fl_x"},
      {"\"fl_x\": 9,", "\"file_path\": \"a.exr\"", "frame 1: has no transform_matrix"},
      {"\"fl_x\": 9,", "\"transform_matrix\": " MATRIX, "frame 1: has no file_path"},
      {"\"fl_x\": 9,", "\"file_path\": \"a.exr\", \"transform_matrix\": [[1, 0, 0, 0]]",
       "4 rows of 4 numbers"},
      {"\"fl_x\": 9,",
       "\"file_path\": \"a.exr\", \"transform_matrix\": "
       "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]",
       "the last 0 0 0 1"},
      {"\"fl_x\": 9,",
       "\"file_path\": \"a.exr\", \"transform_matrix\": "
       "[[1, 0, 1, 0], [0, 1, 0, 0], [1, 0, 1, 0], [0, 0, 0, 1]]",
       "transform_matrix is singular"},
      {"\"fl_x\": 9,",
       "\"file_path\": \"a.exr\", \"transform_matrix\": "
       "[[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
       "transform_matrix is singular"},
      {"\"fl_x\": 9,",
       "\"file_path\": \"a.exr\", \"transform_matrix\": "
       "[[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
       "mirrors"},
      {"\"fl_x\": 9,",
       "\"file_path\": \"a.exr\", \"transform_matrix\": "
       "[[1, 0.2, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
       "shears"},
  };
  for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k)
    refuse(one_frame(rows[k].file, rows[k].frame), rows[k].says);
  refuse("{\"frames\": []}", "there are no frames");
  refuse("{\"frames\": 3}", "there are no frames");
  refuse("[]", "there are no frames");
  refuse("{\"frames\": [7]}", "frame 1: is no object");
  refuse("{\"frames\": [}", "malformed JSON: line 1");
}

/* ---- Their pixels as rays ---- */

/* The radiance that a pixel sees on the aperture below: linear in its place, and in the corners
 * 1 - 0.3 + 0.1 of it is left by the lens. */
static void paint(struct picture *picture, const double place[2]) {
  for (int row = 0; row < picture->height; ++row)
    for (int column = 0; column < picture->width; ++column) {
      double x = (column + 0.5) / picture->width - 0.5, y = 0.5 - (row + 0.5) / picture->height;
      double square = 2 * (x * x + y * y);
      float *rgb = picture->rgb + 3 * (row * picture->width + column);
      rgb[0] =
          (float)((5 + place[0] * x + place[1] * y) * (1 - 0.3 * square + 0.1 * square * square));
      rgb[1] = rgb[2] = rgb[0];
    }
}

/* A camera 2 before an aperture of 1 x 1 that shines along lamp z, and sees 1.6 x 1.6 of it. */
TEST(test_pixels_are_rays) {
  static const double center[3], u[3] = {1, 0, 0}, v[3] = {0, 1, 0}, normal[3] = {0, 0, 1};
  static const double lens[3] = {-0.3, 0.1, 0}, place[2] = {0.25, -0.5};
  struct poses poses = read_text(
      one_frame("\"fl_x\": 80, ", "\"file_path\": \"a.exr\", \"transform_matrix\": "
                                  "[[-1, 0, 0, 0], [0, 0, 1, 2], [0, 1, 0, 0], [0, 0, 0, 1]]"));
  static float values[3 * 64 * 64];
  struct picture picture = {.width = 64, .height = 64, .rgb = values};
  static struct ray_pages pages;
  static struct posed_rays rays;
  struct error error = {{0}};
  paint(&picture, place);
  assert_ok(ray_pages_add(&pages, center, u, v, normal, &error), &error);
  struct slab *slab = &pages.page[0].geometry;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    slab->samples[axis] = axis < SLAB_S ? 4 : 2;
    slab->st_window[axis] = axis % 2 ? 1 : -1;
  }
  rays.pages = &pages;
  assert_ok(posed_rays_add(&rays, poses.pose, &picture, lens, 9, &error), &error);
  double weight = 0;
  for (size_t n = 0; n < rays.page[0].count; ++n) {
    const struct rebin_ray *ray = &rays.page[0].ray[n];
    double a = ((double)ray->at[0] + 0.5) / 4 - 0.5, b = ((double)ray->at[1] + 0.5) / 4 - 0.5;
    /* It looks back along -z, so that its right is -x. */
    assert_near((double)ray->rgb[1], 5 - place[0] * a / 1.6 + place[1] * b / 1.6, 1e-5);
    assert_near((double)ray->at[2], -a / 2 + 0.5, 1e-5);
    assert_near((double)ray->at[3], -b / 2 + 0.5, 1e-5);
    assert_int_equal(ray->source, 9);
    weight += (double)ray->weight;
  }
  /* The integral of the cosine's fourth power over the aperture, by midpoints. */
  double sum = 0;
  for (int k = 0; k < 10000; ++k) {
    double a = (k % 100 + 0.5) / 100 - 0.5, b = (k / 100 + 0.5) / 100 - 0.5;
    sum += pow(1 + (a * a + b * b) / 4, -2) / 10000;
  }
  assert_near(weight, sum, 0.002);
  /* 1 of 1.6^2; the rest is beside, a little less of it by the angle. */
  assert_near(rays.missed / rays.seen, 1 - 1 / 2.56, 0.04);
  assert_near(rays.beyond, 0, 0);
  posed_rays_free(&rays);
  poses_free(&poses);
}

int main(void) {
  return testing_run(NULL, NULL);
}
