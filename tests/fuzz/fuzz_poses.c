/* fuzz_poses.c - transforms.json: what is read are cameras that can look. */
#include <math.h>
#include <stdlib.h>

#include "fuzz.h"
#include "import/pictures/poses.h"

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct poses poses;
  struct error error;
  char *text = fuzz_text(data, size);
  if (poses_read(text, &poses, &error) == RESULT_OK) {
    fuzz_check(poses.count > 0);
    for (int n = 0; n < poses.count; ++n) {
      struct pose *pose = &poses.pose[n];
      double look[3];
      fuzz_check(pose->file && *pose->file);
      fuzz_check(fabs(dot(pose->right, pose->up)) < 2e-3 && fabs(dot(pose->up, pose->back)) < 2e-3);
      fuzz_check(fabs(dot(pose->back, pose->back) - 1) < 1e-9);
      poses_complete(pose, 64, 48);
      fuzz_check(pose->focal[0] > 0 && pose->focal[1] > 0);
      fuzz_check(isfinite(pose->middle[0]) && isfinite(pose->middle[1]));
      poses_look(pose, pose->middle[0], pose->middle[1], look);
      fuzz_check(dot(look, pose->back) < -0.99);
    }
  } else {
    fuzz_check(error.text[0]);
  }
  poses_free(&poses);
  free(text);
  return 0;
}
