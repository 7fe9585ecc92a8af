#include "export/export_mitsuba.h"

#include "base/files.h"
#include "export/export_frame.h"
#include "export/export_mitsuba_plain.h"
#include "export/export_pages.h"
#include "export/export_provenance.h"
#include "export/export_text.h"
#include "file/json_text.h"

extern const char export_slab_emitter[], export_slab_cells[], export_mitsuba_xml[],
    export_mitsuba_example[], export_mitsuba_md[];

static const double ray_error = 1e-4; /* of single precision, by the largest radiance */

enum { example_samples = 256 };

struct lamp {
  const struct slab *slabs;
  int count;
  const char *name;
};

/* Turns the rectangle [-1, 1]^2 at z = 0 into the aperture. */
static void put_page(const struct lamp *lamp, int page, int number, FILE *out) {
  const struct slab *slab = &lamp->slabs[page];
  double u[3], v[3], n[3], center[3];
  export_y_up(slab->u, u);
  export_y_up(slab->v, v);
  export_y_up(slab->normal, n);
  export_y_up(slab->center, center);
  for (int c = 0; c < 3; ++c) {
    u[c] /= 2;
    v[c] /= 2;
  }
  fprintf(out, "%s  <shape type=\"rectangle\" id=\"%s_%d\">\n", number ? "\n" : "", lamp->name,
          page + 1);
  fputs("    <transform name=\"to_world\">\n      <matrix value=\"", out);
  export_put_matrix(u, v, n, center, out);
  fputs("\"/>\n      <matrix value=\"$place\"/>\n    </transform>\n    <bsdf type=\"null\"/>\n",
        out);
  fprintf(out,
          "    <emitter type=\"slab\">\n      <string name=\"filename\" value=\"%s.json\"/>\n"
          "      <integer name=\"page\" value=\"%d\"/>\n"
          "      <float name=\"gain\" value=\"$gain\"/>\n"
          "      <string name=\"sampling\" value=\"$sampling\"/>\n    </emitter>\n  </shape>",
          lamp->name, number);
}

static void put_pages(const void *of, FILE *out) {
  const struct lamp *lamp = of;
  for (int k = 0, number = 0; k < lamp->count; ++k)
    if (slab_is_lit(&lamp->slabs[k])) put_page(lamp, k, number++, out);
}

static enum result write_texts(const struct slab *slabs, int count, const struct export_wish *wish,
                               const char *folder, struct error *error) {
  const struct lamp lamp = {slabs, count, wish->name};
  const struct export_text texts[] = {{export_mitsuba_xml, wish->name, ".xml"},
                                      {export_mitsuba_example, "example", ".xml"},
                                      {export_mitsuba_md, "README", ".md"},
                                      {0}};
  const struct slab *first = export_pages_first(slabs, count);
  const struct export_scene scene = export_scene_of(first, export_y_up);
  const struct include_value values[] = {{"shapes", .print = put_pages, .of = &lamp},
                                         {"floor_matrix", .print = export_put_floor, .of = &scene},
                                         {"rays", .number = ray_error},
                                         {"samples", .number = example_samples},
                                         {0}};
  return export_texts(folder, wish->name, texts, first, &scene, values, error);
}

enum result export_mitsuba(const struct slab *slabs, int count, const struct export_wish *wish,
                           const char *path, struct error *error) {
  if (wish->plain) return export_mitsuba_plain(slabs, count, wish, path, error);
  enum result result = export_pages_write(slabs, count, wish, path, error);
  if (result == RESULT_OK) result = write_texts(slabs, count, wish, path, error);
  if (result == RESULT_OK)
    result = files_write(path, "slab_emitter.py", export_slab_emitter, error);
  if (result == RESULT_OK) result = files_write(path, "slab_cells.py", export_slab_cells, error);
  if (result != RESULT_OK) return result;
  unsigned long mark = json_mark();
  json_t *errors = json_pack("{s:f, s:s}", "rays_by_largest_radiance", ray_error, "why",
                             "single precision; noise goes down with the samples");
  result = export_provenance(slabs, count, wish, "mitsuba", errors, mark, path, error);
  if (result == RESULT_OK)
    warnings_add(wish->notes, "Mitsuba's default sampler, 4 independent samples a pixel, is too "
                              "coarse: use multijitter with 256 or more, as in example.xml");
  return result;
}
