/* point_text.c - the include file of a point light, point.inc.in. */
#include <math.h>

#include "include/point/point.h"

extern const char point_inc[];

/* POV-Ray wants its SMALL_TOLERANCE, 0.001 units, between a light and what filters it;
 * twice that is exact. */
static const double least_radius = 0.002;

/* The sphere's radius in aperture widths, as far as the tolerance allows, and at most. */
static const double radius = 0.05, most_radius = 0.5;

static void print_frame(const void *of, FILE *out) {
  const struct point *point = of;
  const double *vectors[4] = {point->axes[0], point->axes[1], point->axes[2], point->center};
  for (int k = 0; k < 4; ++k)
    fprintf(out, "%s<%.15g, %.15g, %.15g>", k ? ",\n  " : "  ", vectors[k][0], vectors[k][1],
            vectors[k][2]);
}

static void print_peaks(const void *of, FILE *out) {
  const struct point *point = of;
  for (int n = 0; n < point->count; ++n)
    fprintf(out, "%s%.10g", n ? ", " : "", point->intensity[n]);
}

static void print_channels(const void *of, FILE *out) {
  const struct point *point = of;
  for (int n = 0; n < point->count; ++n) fprintf(out, "%s%d", n ? ", " : "", point->channels[n]);
}

void point_print(const struct point *point, const struct include_text *text, FILE *out) {
  const struct slab *frame = &point->lamp.frame;
  const struct point_table *table = point->table;
  double flux[3], percent[POINT_DISTANCES], brightest = 0;
  for (int n = 0; n < point->count; ++n) brightest = fmax(brightest, point->intensity[n]);
  for (int c = 0; c < 3; ++c)
    flux[c] = point->flux[c] * (frame->metres_per_unit * frame->metres_per_unit);
  for (int d = 0; d < POINT_DISTANCES; ++d) percent[d] = 100 * point->error[d];
  const struct include_value values[] = {
      {"no_face", .number = 1},
      {"flux", .numbers = flux},
      {"flux_unit", .text = slab_flux_unit(frame)},
      {"percent", .numbers = percent},
      {"frame", .print = print_frame, .of = point},
      {"width", .number = point->width},
      {"reach", .number = include_reach(brightest, point->width)},
      {"far_count", .number = point->count},
      {"columns", .number = point->columns},
      {"rows", .number = point->rows},
      {"peak_row", .print = print_peaks, .of = point},
      {"channel_row", .print = print_channels, .of = point},
      {"radius", .number = radius},
      {"most_radius", .number = most_radius},
      {"least_radius", .number = least_radius},
      {"small_scale", .number = least_radius / (radius * point->width)},
      {"least_scale", .number = least_radius / (most_radius * point->width)},
      {"measured", .number = table != NULL},
      {"exact", .text = table && table->exact ? "on all of its angles" : NULL},
      {"fine", .text = table && !table->exact ? "closer than its angles" : NULL},
      {0}};
  include_print(point_inc, text, &point->lamp, values, out);
}
