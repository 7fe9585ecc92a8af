/* taps.h - the innermost loops: sums over the samples of a page, weighted.
 *
 * A micro light has 16 samples: four rows of the raster (rule.h's order of samples along v)
 * by two pairs of neighbouring pixels. Rows are pointers to their first float. Samples are
 * read as vectors of 8 floats from an RGB pixel on (slab.h pads the raster for it); what lies
 * behind the pair gets the weight 0. */
#ifndef TAPS_H
#define TAPS_H

/* A strip along u with one node, single precision: its samples and their weights. */
struct taps_column {
  int offset[2]; /* of the pixels of the near and the near + up sample, in floats from the row's
                    first */
  float weight[2][8]; /* of the pair's floats there: R G B R G B 0 0 */
};

void taps_set_column(struct taps_column *column, const int offset[2], const double weight[4]);

/* rgb += sum over columns of factor[c] * column . rows . row_weight. Summed in single
 * precision along the row. */
void taps_sum_row(const float *const rows[4], const double row_weight[4],
                  const struct taps_column *columns, const float *factor, int count, double rgb[3]);

/* rgb += sum over the micro light's samples, in double precision. weight[row][column] */
void taps_sum_cell(const float *const rows[4], const int offset[2], const double weight[4][4],
                   double rgb[3]);

/* Several nodes a micro light, double precision: rgb += sum over the cells of a row. Cell c
 * has the nodes first[c] to first[c+1], with weights column_weight[node][4]; the row has
 * row_nodes with row_weight[node][4]; kernel[h][node - base] is the kernel at both. */
struct taps_cells {
  const float *const *rows;
  int row_nodes;
  const double (*row_weight)[4];
  const double *const *kernel;
  int base;
  const int (*offset)[2]; /* [cell] */
  const int *first;
  const double (*column_weight)[4];
};
void taps_sum_cells(const struct taps_cells *cells, int first, int last, double rgb[3]);

#endif
