#include "microlight/taps.h"

#include "base/simd.h"

void taps_set_column(struct taps_column *column, const int offset[2], const double weight[4]) {
  for (int side = 0; side < 2; ++side) {
    column->offset[side] = offset[side];
    for (int k = 0; k < 8; ++k)
      column->weight[side][k] = k < 6 ? (float)weight[2 * side + (k >= 3)] : 0;
  }
}

SIMD_INLINE void taps_sum_row_body(const float *const rows[4], const double row_weight[4],
                                   const struct taps_column *columns, const float *factor,
                                   int count, double rgb[3]) {
  const float *const row0 = rows[0], *const row1 = rows[1];
  const float *const row2 = rows[2], *const row3 = rows[3];
  const float w0 = (float)row_weight[0], w1 = (float)row_weight[1];
  const float w2 = (float)row_weight[2], w3 = (float)row_weight[3];
  simd_float8 sum = {0}, far = {0};
  int seen = -1; /* offset of the pair in `far`: often the next column's near one */
  for (int c = 0; c < count; ++c) {
    const struct taps_column *column = &columns[c];
    const int a = column->offset[0], b = column->offset[1];
    simd_float8 near = far;
    if (a != seen)
      near = SIMD_LOAD(simd_floats8, row0 + a) * w0 + SIMD_LOAD(simd_floats8, row1 + a) * w1 +
             (SIMD_LOAD(simd_floats8, row2 + a) * w2 + SIMD_LOAD(simd_floats8, row3 + a) * w3);
    far = SIMD_LOAD(simd_floats8, row0 + b) * w0 + SIMD_LOAD(simd_floats8, row1 + b) * w1 +
          (SIMD_LOAD(simd_floats8, row2 + b) * w2 + SIMD_LOAD(simd_floats8, row3 + b) * w3);
    seen = b;
    sum += (near * SIMD_LOAD(simd_floats8, column->weight[0]) +
            far * SIMD_LOAD(simd_floats8, column->weight[1])) *
           factor[c];
  }
  for (int c = 0; c < 3; ++c) rgb[c] += (double)(sum[c] + sum[c + 3]);
}

SIMD_DISPATCH(taps_sum_row,
              (const float *const rows[4], const double row_weight[4],
               const struct taps_column *columns, const float *factor, int count, double rgb[3]),
              (rows, row_weight, columns, factor, count, rgb))

/* Four floats as doubles, in a form that gcc makes one instruction of. */
#define AS_DOUBLES(from) ((simd_double4){(from)[0], (from)[1], (from)[2], (from)[3]})

/* The part of a cell that lies in one row: two pairs of pixels. */
SIMD_INLINE void add_row(const float *row, const int offset[2], const double weight[4],
                         simd_double4 *sum) {
  const float *near = row + offset[0], *far = row + offset[1];
  *sum += (AS_DOUBLES(near) * weight[0] + AS_DOUBLES(near + 3) * weight[1]) +
          (AS_DOUBLES(far) * weight[2] + AS_DOUBLES(far + 3) * weight[3]);
}

/* Adds up 16 samples; lane 3 is unused. */
SIMD_INLINE void add_cell(const float *const rows[4], const int offset[2],
                          const double weight[4][4], simd_double4 *sum) {
  add_row(rows[0], offset, weight[0], sum);
  add_row(rows[1], offset, weight[1], sum);
  add_row(rows[2], offset, weight[2], sum);
  add_row(rows[3], offset, weight[3], sum);
}

void taps_sum_cell(const float *const rows[4], const int offset[2], const double weight[4][4],
                   double rgb[3]) {
  simd_double4 sum = {0};
  add_cell(rows, offset, weight, &sum);
  for (int c = 0; c < 3; ++c) rgb[c] += sum[c];
}

SIMD_INLINE void taps_sum_cells_body(const struct taps_cells *cells, int first, int last,
                                     double rgb[3]) {
  simd_double4 sum = {0};
  for (int c = first; c < last; ++c) {
    const int from = cells->first[c], nodes = cells->first[c + 1] - from;
    const double(*column)[4] = cells->column_weight + from;
    simd_double4 weight0 = {0}, weight1 = {0}, weight2 = {0}, weight3 = {0};
    for (int h = 0; h < cells->row_nodes; ++h) {
      const double *kernel = cells->kernel[h] + (from - cells->base), *row = cells->row_weight[h];
      simd_double4 along = {0};
      for (int g = 0; g < nodes; ++g) along += SIMD_LOAD(simd_doubles4, column[g]) * kernel[g];
      weight0 += along * row[0];
      weight1 += along * row[1];
      weight2 += along * row[2];
      weight3 += along * row[3];
    }
    const union {
      simd_double4 rows[4];
      double each[4][4]; /* as scalars, to be broadcast */
    } weight = {{weight0, weight1, weight2, weight3}};
    add_cell(cells->rows, cells->offset[c], weight.each, &sum);
  }
  for (int c = 0; c < 3; ++c) rgb[c] += sum[c];
}

SIMD_DISPATCH(taps_sum_cells, (const struct taps_cells *cells, int first, int last, double rgb[3]),
              (cells, first, last, rgb))
