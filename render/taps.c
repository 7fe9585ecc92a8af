/* taps.c - see taps.h. */
#include "taps.h"

#include <string.h>

#include "simd.h"

void taps_set_column(struct taps_column *column, const int offset[2], const double weight[4]) {
  for (int side = 0; side < 2; ++side) {
    column->offset[side] = offset[side];
    for (int k = 0; k < 8; ++k)
      column->weight[side][k] = k < 6 ? (float)weight[2 * side + (k >= 3)] : 0;
  }
}

SIMD_CLONES
void taps_sum_row(const float *const rows[4], const double row_weight[4],
                  const struct taps_column *columns, const float *factor, int count,
                  double rgb[3]) {
  const float *const row0 = rows[0], *const row1 = rows[1];
  const float *const row2 = rows[2], *const row3 = rows[3];
  const float w0 = (float)row_weight[0], w1 = (float)row_weight[1];
  const float w2 = (float)row_weight[2], w3 = (float)row_weight[3];
  simd_float8 sum = {0};
  for (int c = 0; c < count; ++c) {
    const struct taps_column *column = &columns[c];
    const int a = column->offset[0], b = column->offset[1];
    simd_float8 near =
        SIMD_LOAD(simd_floats8, row0 + a) * w0 + SIMD_LOAD(simd_floats8, row1 + a) * w1 +
        (SIMD_LOAD(simd_floats8, row2 + a) * w2 + SIMD_LOAD(simd_floats8, row3 + a) * w3);
    simd_float8 far =
        SIMD_LOAD(simd_floats8, row0 + b) * w0 + SIMD_LOAD(simd_floats8, row1 + b) * w1 +
        (SIMD_LOAD(simd_floats8, row2 + b) * w2 + SIMD_LOAD(simd_floats8, row3 + b) * w3);
    sum += (near * SIMD_LOAD(simd_floats8, column->weight[0]) +
            far * SIMD_LOAD(simd_floats8, column->weight[1])) *
           factor[c];
  }
  for (int c = 0; c < 3; ++c) rgb[c] += (double)(sum[c] + sum[c + 3]);
}

/* Adds up 16 samples; lane 3 is nobody's. */
SIMD_INLINE void add_cell(const float *const rows[4], const int offset[2],
                          const double weight[4][4], simd_double4 *sum) {
  for (int row = 0; row < 4; ++row)
    for (int tap = 0; tap < 4; ++tap) {
      simd_float4 sample =
          SIMD_LOAD(simd_floats4, rows[row] + offset[tap >> 1] + (size_t)3 * (tap & 1));
      *sum += __builtin_convertvector(sample, simd_double4) * weight[row][tap];
    }
}

void taps_sum_cell(const float *const rows[4], const int offset[2], const double weight[4][4],
                   double rgb[3]) {
  simd_double4 sum = {0};
  add_cell(rows, offset, weight, &sum);
  for (int c = 0; c < 3; ++c) rgb[c] += sum[c];
}

SIMD_CLONES
void taps_sum_cells(const struct taps_cells *cells, int first, int last, double rgb[3]) {
  simd_double4 sum = {0};
  for (int c = first; c < last; ++c) {
    simd_double4 weight[4] = {{0}, {0}, {0}, {0}};
    for (int h = 0; h < cells->row_nodes; ++h) {
      const double *kernel = cells->kernel[h];
      simd_double4 along = {0};
      for (int g = cells->first[c]; g < cells->first[c + 1]; ++g)
        along += SIMD_LOAD(simd_doubles4, cells->column_weight[g]) * kernel[g - cells->base];
      for (int row = 0; row < 4; ++row) weight[row] += along * cells->row_weight[h][row];
    }
    double spread[4][4];
    memcpy(spread, weight, sizeof spread); /* scalars again, to be broadcast */
    add_cell(cells->rows, cells->offset[c], spread, &sum);
  }
  for (int c = 0; c < 3; ++c) rgb[c] += sum[c];
}
