#include "slab/slab_profile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add_samples(const struct slab *slab, struct slab_profile *profile) {
  const float *sample = slab->rgb;
  int ns = slab->samples[SLAB_S], nt = slab->samples[SLAB_T];
  for (int y = 0; y < slab_height(slab); ++y)
    for (int x = 0; x < slab_width(slab); ++x, sample += 3) {
      double size = 0;
      for (int c = 0; c < 3; ++c) size += fabs((double)sample[c]);
      profile->axis[SLAB_U][x / ns] += size;
      profile->axis[SLAB_S][x % ns] += size;
      profile->axis[SLAB_V][y / nt] += size;
      profile->axis[SLAB_T][y % nt] += size;
    }
}

enum result slab_profile(const struct slab *slab, struct slab_profile *profile,
                         struct error *error) {
  *profile = (struct slab_profile){0};
  memcpy(profile->samples, slab->samples, sizeof profile->samples);
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    profile->axis[axis] = calloc((size_t)slab->samples[axis], sizeof(double));
    if (!profile->axis[axis]) return result_no_memory(error);
  }
  add_samples(slab, profile);
  double all = (double)slab_sample_count(slab);
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    for (int k = 0; k < slab->samples[axis]; ++k)
      profile->axis[axis][k] *= slab->samples[axis] / all;
  return RESULT_OK;
}

void slab_profile_free(struct slab_profile *profile) {
  for (int axis = 0; axis < SLAB_AXES; ++axis) free(profile->axis[axis]);
  *profile = (struct slab_profile){0};
}

double slab_profile_limit(int axis) {
  return axis == SLAB_S || axis == SLAB_T ? 0.02 : 0.5;
}

double slab_profile_cut_off(const struct slab_profile *profile, int axis, int end) {
  int count = profile->samples[axis];
  double peak = 0;
  for (int k = 0; k < count; ++k) peak = fmax(peak, profile->axis[axis][k]);
  double share = profile->axis[axis][end ? count - 1 : 0] / peak;
  return count > 1 && share > slab_profile_limit(axis) ? share : 0;
}
