/* fuzz_words.c - LIGHT, CAMERA, keys of the viewer and the numbers of options. */
#include <math.h>
#include <stdlib.h>

#include "base/numbers.h"
#include "fuzz.h"
#include "light/light_text.h"
#include "scene/camera.h"
#include "viewer/viewer_state.h"

static void read_camera(const char *text) {
  struct camera camera;
  struct error error;
  double forward[3], right[3], up[3], length = 0;
  if (camera_parse(text, &camera, &error) != RESULT_OK) return;
  fuzz_check(camera.fov > 0 && camera.fov < 180);
  camera_axes(&camera, forward, right, up);
  for (int c = 0; c < 3; ++c) length += right[c] * right[c];
  fuzz_check(fabs(length - 1) < 1e-9);
}

static void read_numbers(const char *text) {
  double numbers[3];
  uint64_t count = 0;
  int size[2];
  if (numbers_real(text, 1, numbers)) fuzz_check(isfinite(numbers[0]));
  if (numbers_real(text, 3, numbers)) fuzz_check(isfinite(numbers[2]));
  if (numbers_whole(text, 1, 1024, &count)) fuzz_check(count >= 1 && count <= 1024);
  if (numbers_size(text, size)) fuzz_check(size[0] >= 1 && size[1] >= 1);
}

static void read_keys(const char *text) {
  const char *at = text, *before;
  int key;
  bool shift;
  do {
    before = at;
    if (!viewer_key_read(&at, &key, &shift)) return;
    fuzz_check(key >= 0 && key <= VIEWER_KEY_ESCAPE && (!key || at > before));
  } while (key);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct light_text light;
  struct error error;
  char *text = fuzz_text(data, size);
  if (light_text_parse(text, &light, &error) == RESULT_OK) {
    fuzz_check(light.path && *light.path && light.scale > 0);
    for (int c = 0; c < 3; ++c) fuzz_check(isfinite(light.gain[c]));
    light_text_free(&light);
  }
  read_camera(text);
  read_numbers(text);
  read_keys(text);
  free(text);
  return 0;
}
