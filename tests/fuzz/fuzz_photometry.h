/* fuzz_photometry.h - what was read of a photometric file is what photometry.h promises. */
#ifndef FUZZ_PHOTOMETRY_H
#define FUZZ_PHOTOMETRY_H

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "fuzz.h"
#include "import/photometric/photometry.h"

static void fuzz_angles(const double *angles, int count, double low, double high) {
  fuzz_check(count >= 1 && count <= 2 * PHOTOMETRY_MOST_ANGLES + 1);
  for (int k = 0; k < count; ++k) {
    fuzz_check(angles[k] >= low && angles[k] <= high);
    fuzz_check(k == 0 || angles[k] > angles[k - 1]);
  }
}

/* No direction is brighter than the table, within rounding. */
static void fuzz_directions(const struct photometry *lamp) {
  double most = 0;
  for (size_t k = 0; k < (size_t)lamp->planes * (size_t)lamp->rows; ++k) {
    fuzz_check(isfinite(lamp->candela[k]));
    most = fmax(most, fabs(lamp->candela[k]));
  }
  for (int k = 0; k < 27; ++k) {
    const double direction[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
    if (k == 13) continue;
    fuzz_check(fabs(photometry_candela(lamp, direction)) <= most * (1 + 1e-12));
  }
  fuzz_check(!(fabs(photometry_flux(lamp)) > 4 * M_PI * most * (1 + 1e-9)));
}

static inline void fuzz_photometry(const struct photometry *lamp) {
  bool c = lamp->type == PHOTOMETRY_C;
  fuzz_check(c || lamp->type == PHOTOMETRY_A || lamp->type == PHOTOMETRY_B);
  fuzz_angles(lamp->plane, lamp->planes, c ? 0 : -90, c ? 360 : 90);
  fuzz_angles(lamp->row, lamp->rows, c ? 0 : -90, c ? 180 : 90);
  if (c && lamp->planes > 1)
    fuzz_check(lamp->plane[0] == 0 && lamp->plane[lamp->planes - 1] == 360);
  for (int k = 0; k < 3; ++k) fuzz_check(lamp->size[k] >= 0 && lamp->size[k] <= 1e5);
  for (int k = 0; k < 4 && lamp->shape == PHOTOMETRY_BOX; ++k)
    fuzz_check(lamp->side[k] >= 0 && lamp->side[k] <= lamp->size[1] * (1 + 1e-12));
  fuzz_check(lamp->axis >= 0 && lamp->axis < 3);
  fuzz_check(memchr(lamp->label, 0, sizeof lamp->label));
  for (const char *at = lamp->label; *at; ++at) fuzz_check(!iscntrl((unsigned char)*at));
  fuzz_directions(lamp);
}

#endif
