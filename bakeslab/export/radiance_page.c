#include "export/radiance_page.h"

#include <math.h>

#include "export/export_folder.h"
#include "export/export_frame.h"
#include "include/text/include_fill.h"
#include "slab/plane.h"

extern const char export_radiance_cal[];

bool radiance_page_grey(const struct slab *slab) {
  size_t count = slab_sample_count(slab);
  for (const float *rgb = slab->rgb; rgb < slab->rgb + 3 * count; rgb += 3)
    if (rgb[0] != rgb[1] || rgb[0] != rgb[2]) return false;
  return true;
}

/* First and last position of the data along an axis. A 1-wide axis is given twice, at its ends. */
static void axis_ends(const struct slab *slab, int axis, double ends[2]) {
  int last = slab->samples[axis] - 1;
  double half = last > 0 ? 0 : slab_spacing(slab, axis) / 2;
  ends[0] = slab_position(slab, axis, 0) - half;
  ends[1] = slab_position(slab, axis, last) + half;
}

/* Order: u, v, s, and t fastest. */
static enum result write_data(const struct slab *slab, int channel, const char *folder,
                              const char *stem, struct error *error) {
  static const char *const endings[3] = {"_r.dat", "_g.dat", "_b.dat"};
  FILE *out = export_folder_open(folder, stem, endings[channel], error);
  if (!out) return RESULT_IO;
  int count[SLAB_AXES], last[SLAB_AXES];
  fprintf(out, "4\n");
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    double ends[2];
    axis_ends(slab, axis, ends);
    last[axis] = slab->samples[axis] - 1;
    count[axis] = last[axis] > 0 ? last[axis] + 1 : 2;
    fprintf(out, "%.9g %.9g %d\n", ends[0], ends[1], count[axis]);
  }
  for (int i = 0; i < count[SLAB_U]; ++i)
    for (int j = 0; j < count[SLAB_V]; ++j)
      for (int k = 0; k < count[SLAB_S]; ++k)
        for (int l = 0; l < count[SLAB_T]; ++l) {
          const float *rgb = slab_at(
              slab, i < last[SLAB_U] ? i : last[SLAB_U], j < last[SLAB_V] ? j : last[SLAB_V],
              k < last[SLAB_S] ? k : last[SLAB_S], l < last[SLAB_T] ? l : last[SLAB_T]);
          fprintf(out, "%.9g%c", (double)rgb[channel], l + 1 < count[SLAB_T] ? ' ' : '\n');
        }
  return export_folder_close(out, stem, endings[channel], RESULT_OK, error);
}

static enum result write_functions(const struct slab *slab, const struct radiance_source *source,
                                   const struct export_wish *wish, const char *folder,
                                   const char *stem, struct error *error) {
  double center[3], normal[3], unit[2][3], ends[SLAB_AXES][2], kappa = slab_kappa(slab);
  export_z_up(slab->center, center);
  export_z_up(slab->normal, normal);
  export_z_up(slab->u, unit[0]);
  export_z_up(slab->v, unit[1]);
  double edge[2], halvings[2];
  for (int k = 0; k < 2; ++k) {
    for (int c = 0; c < 3; ++c) unit[k][c] /= plane_edge(slab, k);
    edge[k] = plane_edge(slab, k) / source->polygons[k];
    halvings[k] = source->halvings[k];
  }
  for (int axis = 0; axis < SLAB_AXES; ++axis) axis_ends(slab, axis, ends[axis]);
  const struct include_value values[] = {{"stem", .text = stem},
                                         {"c", .numbers = center},
                                         {"n", .numbers = normal},
                                         {"u", .numbers = unit[0]},
                                         {"v", .numbers = unit[1]},
                                         {"kappa", .numbers = &kappa},
                                         {"ends", .numbers = ends[0]},
                                         {"window", .numbers = slab->st_window},
                                         {"edge", .numbers = edge},
                                         {"halvings", .numbers = halvings},
                                         {"ds", .number = radiance_source_ds},
                                         {0}};
  FILE *out = export_folder_open(folder, stem, ".cal", error);
  if (!out) return RESULT_IO;
  include_fill(export_radiance_cal, wish->name, values, out);
  putc('\n', out);
  return export_folder_close(out, stem, ".cal", RESULT_OK, error);
}

enum result radiance_page_write(const struct slab *slab, const struct radiance_source *source,
                                const struct export_wish *wish, const char *folder,
                                const char *stem, struct error *error) {
  enum result result = write_functions(slab, source, wish, folder, stem, error);
  int channels = radiance_page_grey(slab) ? 1 : 3;
  for (int c = 0; c < channels && result == RESULT_OK; ++c)
    result = write_data(slab, c, folder, stem, error);
  return result;
}
