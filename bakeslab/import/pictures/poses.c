#include "import/pictures/poses.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file/json_text.h"

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- Numbers ---- */

/* A number of the frame, or else of the file; `otherwise` where neither has it. */
struct source {
  const json_t *file, *frame;
};

static enum result find_number(const struct source *source, const char *key, double low,
                               double otherwise, double *number, struct error *error) {
  const json_t *value = json_object_get(source->frame, key);
  if (!value) value = json_object_get(source->file, key);
  *number = otherwise;
  if (!value) return RESULT_OK;
  *number = json_number_value(value);
  if (json_is_number(value) && isfinite(*number) && *number > low) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s is no number%s", key,
                     low == 0 ? " above 0" : " that can be used");
}

static enum result find_camera(const struct source *source, struct pose *pose,
                               struct error *error) {
  const struct {
    const char *key;
    double low, otherwise;
    double *into;
  } numbers[] = {
      {"w", 0, 0, &pose->width},
      {"h", 0, 0, &pose->height},
      {"camera_angle_x", 0, 0, &pose->angle[0]},
      {"camera_angle_y", 0, 0, &pose->angle[1]},
      {"fl_x", 0, 0, &pose->focal[0]},
      {"fl_y", 0, 0, &pose->focal[1]},
      {"cx", -INFINITY, NAN, &pose->middle[0]},
      {"cy", -INFINITY, NAN, &pose->middle[1]},
  };
  enum result result = RESULT_OK;
  for (size_t k = 0; k < sizeof numbers / sizeof *numbers && result == RESULT_OK; ++k)
    result = find_number(source, numbers[k].key, numbers[k].low, numbers[k].otherwise,
                         numbers[k].into, error);
  if (result != RESULT_OK) return result;
  for (int k = 0; k < 2; ++k)
    if (pose->angle[k] >= M_PI)
      return result_fail(error, RESULT_BAD, "camera_angle_%c is not below pi, in radians", "xy"[k]);
  if (pose->angle[0] > 0 || pose->focal[0] > 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "there is neither camera_angle_x nor fl_x");
}

/* ---- What is refused by name ---- */

static enum result check_undistorted(const struct source *source, struct error *error) {
  static const char *const lens[] = {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"};
  for (size_t k = 0; k < sizeof lens / sizeof *lens; ++k) {
    double number;
    enum result result = find_number(source, lens[k], -INFINITY, 0, &number, error);
    if (result != RESULT_OK) return result;
    if (number != 0)
      return result_fail(error, RESULT_BAD,
                         "%s is %g: lens distortion is not read; undistort the pictures first",
                         lens[k], number);
  }
  return RESULT_OK;
}

static bool is_set(const json_t *value) {
  if (json_is_array(value)) {
    for (size_t k = 0; k < json_array_size(value); ++k)
      if (is_set(json_array_get(value, k))) return true;
    return false;
  }
  return value && !json_is_null(value) && !json_is_false(value) &&
         !(json_is_number(value) && json_number_value(value) == 0);
}

static enum result check_understood(const struct source *source, struct error *error) {
  static const char *const foreign[] = {"is_fisheye",      "ftheta_p0",       "latlong",
                                        "equirectangular", "rolling_shutter", "mask_path"};
  static const char *const models[] = {"PINHOLE", "SIMPLE_PINHOLE", "OPENCV", "SIMPLE_RADIAL",
                                       "RADIAL"};
  for (size_t k = 0; k < sizeof foreign / sizeof *foreign; ++k)
    if (is_set(json_object_get(source->frame, foreign[k])) ||
        is_set(json_object_get(source->file, foreign[k])))
      return result_fail(error, RESULT_BAD, "%s is not read; make plain perspective pictures first",
                         foreign[k]);
  const json_t *value = json_object_get(source->frame, "camera_model");
  if (!value) value = json_object_get(source->file, "camera_model");
  const char *model = value ? json_string_value(value) : models[0];
  for (size_t k = 0; model && k < sizeof models / sizeof *models; ++k)
    if (!strcmp(model, models[k])) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "camera_model %.60s is not read; PINHOLE and OPENCV are",
                     model ? model : "is no name and");
}

/* ---- A frame ---- */

static enum result find_matrix(const json_t *frame, double matrix[4][4], struct error *error) {
  const json_t *rows = json_object_get(frame, "transform_matrix");
  static const double last[4] = {0, 0, 0, 1};
  size_t count = json_array_size(rows);
  memcpy(matrix[3], last, sizeof last);
  bool good = count == 3 || count == 4;
  for (size_t n = 0; n < count && good; ++n) {
    const json_t *row = json_array_get(rows, n);
    good = json_array_size(row) == 4;
    for (size_t k = 0; k < 4 && good; ++k) {
      const json_t *value = json_array_get(row, k);
      matrix[n][k] = json_number_value(value);
      good = json_is_number(value) && isfinite(matrix[n][k]);
    }
  }
  for (int k = 0; k < 4; ++k) good = good && matrix[3][k] == last[k];
  if (good) return RESULT_OK;
  if (!rows) return result_fail(error, RESULT_BAD, "has no transform_matrix");
  return result_fail(error, RESULT_BAD,
                     "transform_matrix must be 4 rows of 4 numbers, the last 0 0 0 1");
}

/* The columns of the matrix in lamp space, as unit vectors. */
static enum result find_place(const double matrix[4][4], struct pose *pose, struct error *error) {
  static const int row_of[3] = {0, 2, 1}; /* z up to y up */
  double *axes[3] = {pose->right, pose->up, pose->back}, length[3], cross[3];
  for (int n = 0; n < 3; ++n) {
    for (int k = 0; k < 3; ++k) axes[k][n] = matrix[row_of[n]][k];
    pose->origin[n] = matrix[row_of[n]][3];
  }
  for (int k = 0; k < 3; ++k) {
    length[k] = sqrt(dot(axes[k], axes[k]));
    if (!(length[k] > 0) || !isfinite(length[k]))
      return result_fail(error, RESULT_BAD, "transform_matrix is singular");
    for (int n = 0; n < 3; ++n) axes[k][n] /= length[k];
  }
  for (int n = 0; n < 3; ++n) {
    int m = (n + 1) % 3, o = (n + 2) % 3;
    cross[n] = pose->right[m] * pose->up[o] - pose->right[o] * pose->up[m];
  }
  double handed = -dot(cross, pose->back); /* the swap of axes mirrors */
  if (!(fabs(handed) > 1e-6)) return result_fail(error, RESULT_BAD, "transform_matrix is singular");
  for (int k = 0; k < 3; ++k)
    if (fabs(dot(axes[k], axes[(k + 1) % 3])) > 1e-3 || fabs(length[k] / length[0] - 1) > 1e-3 ||
        handed < 0)
      return result_fail(error, RESULT_BAD, "transform_matrix is no rotation: it %s",
                         handed < 0 ? "mirrors" : "shears or stretches");
  return RESULT_OK;
}

static enum result find_file(const json_t *frame, struct pose *pose, struct error *error) {
  const char *file = json_string_value(json_object_get(frame, "file_path"));
  if (!file || !*file) return result_fail(error, RESULT_BAD, "has no file_path");
  const char *slash = strrchr(file, '/');
  const char *ending = strchr(slash ? slash + 1 : file, '.') ? "" : ".exr";
  if (asprintf(&pose->file, "%s%s", file, ending) >= 0) return RESULT_OK;
  pose->file = NULL;
  return result_no_memory(error);
}

static enum result read_frame(const struct source *source, struct pose *pose, struct error *error) {
  double matrix[4][4];
  if (!json_is_object(source->frame)) return result_fail(error, RESULT_BAD, "is no object");
  enum result result = find_file(source->frame, pose, error);
  if (result == RESULT_OK) result = find_matrix(source->frame, matrix, error);
  if (result == RESULT_OK) result = find_place(matrix, pose, error);
  if (result == RESULT_OK) result = check_understood(source, error);
  if (result == RESULT_OK) result = check_undistorted(source, error);
  return result == RESULT_OK ? find_camera(source, pose, error) : result;
}

enum result poses_read(const char *text, struct poses *poses, struct error *error) {
  json_t *root = NULL;
  *poses = (struct poses){0};
  enum result result = json_read(text, 0, &root, error);
  if (result != RESULT_OK) return result;
  const json_t *frames = json_object_get(root, "frames");
  size_t count = json_array_size(frames);
  if (count == 0)
    result = result_fail(error, RESULT_BAD, "there are no frames, which hold pictures and poses");
  else
    poses->pose = calloc(count, sizeof *poses->pose);
  if (count > 0 && !poses->pose) result = result_no_memory(error);
  for (size_t n = 0; n < count && result == RESULT_OK; ++n) {
    struct source source = {root, json_array_get(frames, n)};
    result = read_frame(&source, &poses->pose[n], error);
    poses->count = (int)n + 1;
    result_at(result, error, "frame %zu", n + 1);
  }
  json_decref(root);
  return result;
}

void poses_free(struct poses *poses) {
  for (int n = 0; n < poses->count; ++n) free(poses->pose[n].file);
  free(poses->pose);
  *poses = (struct poses){0};
}

/* ---- The camera ---- */

void poses_complete(struct pose *pose, int width, int height) {
  const int size[2] = {width, height};
  for (int k = 0; k < 2; ++k) {
    if (pose->focal[k] == 0 && pose->angle[k] > 0)
      pose->focal[k] = 0.5 * size[k] / tan(0.5 * pose->angle[k]);
    if (isnan(pose->middle[k])) pose->middle[k] = 0.5 * size[k];
  }
  if (pose->focal[1] == 0) pose->focal[1] = pose->focal[0];
}

void poses_look(const struct pose *pose, double column, double row, double direction[3]) {
  double x = (column - pose->middle[0]) / pose->focal[0];
  double y = (pose->middle[1] - row) / pose->focal[1];
  for (int n = 0; n < 3; ++n) direction[n] = x * pose->right[n] + y * pose->up[n] - pose->back[n];
}
