#include "export/export_cycles.h"

#include "base/files.h"
#include "export/cycles_blend.h"
#include "export/export_frame.h"
#include "export/export_pages.h"
#include "export/export_provenance.h"
#include "export/export_text.h"
#include "file/json_text.h"

extern const char export_canned_lights[], export_cycles_example[], export_cycles_md[];

static const double ray_error = 1e-4; /* of single precision, by the largest radiance */
enum { LIMIT_OF_TEXTURE = 16384 };    /* above, graphics cards shrink pictures, or refuse them */

static enum result write_texts(const struct slab *slabs, int count, const struct export_wish *wish,
                               const char *folder, struct error *error) {
  const struct slab *first = export_pages_first(slabs, count);
  const struct export_scene scene = export_scene_of(first, export_z_up);
  const struct export_text texts[] = {
      {export_cycles_example, "example", ".py"}, {export_cycles_md, "README", ".md"}, {0}};
  const struct include_value values[] = {
      {"rays", .number = ray_error}, {"blend", .number = wish->blend}, {0}};
  return export_texts(folder, wish->name, texts, first, &scene, values, error);
}

static void tell(const struct slab *slabs, int count, const struct export_wish *wish) {
  for (int k = 0; k < count; ++k)
    if (slab_width(&slabs[k]) > LIMIT_OF_TEXTURE || slab_height(&slabs[k]) > LIMIT_OF_TEXTURE)
      warnings_add(wish->notes,
                   "page %d: its picture is %dx%d, more than %d, which graphics cards may shrink: "
                   "render on the CPU",
                   k + 1, slab_width(&slabs[k]), slab_height(&slabs[k]), LIMIT_OF_TEXTURE);
  warnings_add(wish->notes, "in Blender, switch off Cycles' adaptive sampling and denoising, and "
                            "clamping, where light is to be measured, as example.py does");
}

enum result export_cycles(const struct slab *slabs, int count, const struct export_wish *wish,
                          const char *path, struct error *error) {
  enum result result = export_pages_write(slabs, count, wish, path, error);
  if (result == RESULT_OK) result = write_texts(slabs, count, wish, path, error);
  if (result == RESULT_OK)
    result = files_write(path, "canned_lights.py", export_canned_lights, error);
  if (result == RESULT_OK && wish->blend) result = cycles_blend(path, wish->name, error);
  if (result != RESULT_OK) return result;
  unsigned long mark = json_mark();
  json_t *errors = json_pack("{s:f, s:s}", "rays_by_largest_radiance", ray_error, "why",
                             "single precision; noise goes down with the samples");
  result = export_provenance(slabs, count, wish, "cycles", errors, mark, path, error);
  if (result == RESULT_OK) tell(slabs, count, wish);
  return result;
}
