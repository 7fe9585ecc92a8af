#include "light/lit_rows.h"

#include <limits.h>
#include <stdlib.h>

static const struct lit_row black = {{INT_MAX, -1}, {INT_MAX, -1}};

static void widen(int range[2], int low, int high) {
  if (low < range[0]) range[0] = low;
  if (high > range[1]) range[1] = high;
}

struct lit_row lit_rows_join(const struct lit_row *a, const struct lit_row *b) {
  struct lit_row both = *a;
  widen(both.near, b->near[0], b->near[1]);
  widen(both.far, b->far[0], b->far[1]);
  return both;
}

static struct lit_row look(const struct slab *slab, const float *rgb) {
  struct lit_row row = black;
  for (int i = 0; i < slab->samples[SLAB_U]; ++i)
    for (int k = 0; k < slab->samples[SLAB_S]; ++k, rgb += 3) {
      if (rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0) continue;
      widen(row.near, i, i);
      widen(row.far, k, k);
    }
  return row;
}

struct lit_row *lit_rows(const struct slab *slab) {
  size_t count = (size_t)slab_height(slab);
  struct lit_row *rows = calloc(count, sizeof *rows);
  for (size_t r = 0; rows && r < count; ++r)
    rows[r] = look(slab, slab->rgb + r * 3 * (size_t)slab_width(slab));
  return rows;
}
