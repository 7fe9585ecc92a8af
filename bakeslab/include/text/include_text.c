#include "include/text/include_text.h"

#include <inttypes.h>
#include <string.h>

#include "base/sdl.h"
#include "slab/plane.h"

extern const char include_head_inc[], include_usage_inc[], include_units_inc[], include_scene_inc[],
    include_begin_inc[], include_image_inc[], include_checks_inc[], include_canned_inc[],
    include_end_inc[];

/* POV-Ray's objects end 1e10 units from the origin. */
static const double most_width = 1e9;

void include_print(const char *template, const struct include_text *text,
                   const struct include_lamp *lamp, const struct include_value *values, FILE *out) {
  static const char *const channels[3] = {"red", "green", "blue"};
  const struct include_check *check = &lamp->check;
  const char *housing = text->housing;
  uint64_t hash = housing ? include_hash(lamp->stamp, housing, strlen(housing)) : lamp->stamp;
  char stamp[17];
  snprintf(stamp, sizeof stamp, "%016" PRIx64, hash);
  const struct include_value shared[] = {
      {"head", .part = include_head_inc},
      {"usage", .part = include_usage_inc},
      {"units", .part = include_units_inc},
      {"scene", .part = include_scene_inc},
      {"begin", .part = include_begin_inc},
      {"image", .part = include_image_inc},
      {"checks", .part = include_checks_inc},
      {"canned", .part = include_canned_inc},
      {"end", .part = include_end_inc},
      {"file", .text = text->file, .write = sdl_comment},
      {"image_file", .text = text->image, .write = sdl_comment},
      {"image_string", .text = text->image, .write = sdl_string},
      {"image_path", .text = text->image_path, .write = sdl_string},
      {"command", .text = text->command, .write = sdl_comment},
      {"source", .text = text->source, .write = sdl_comment},
      {"chosen", .text = text->chosen, .write = sdl_comment},
      {"own_error", .text = text->own_error},
      {"housing", .text = housing},
      {"no_housing", .text = housing                  ? NULL
                             : text->housing_left_out ? " that could be used."
                                                      : "."},
      {"metres", .number = lamp->frame.metres_per_unit},
      {"radiance_unit", .text = lamp->frame.radiance_unit},
      {"black_pages", .number = lamp->black_pages},
      {"stamp", .text = stamp},
      {"check", .numbers = check->at},
      {"rgb", .numbers = check->rgb},
      {"channel", .text = channels[check->channel]},
      {"value", .number = check->rgb[check->channel]},
      {"most_width", .number = most_width},
      {.more = values}};
  include_fill(template, text->name, shared, out);
  putc('\n', out);
}

void include_put_frame(const struct slab *slab, const double center[3], const char *between,
                       FILE *out) {
  const double *vectors[4] = {slab->u, slab->v, slab->normal, center};
  const double sizes[4] = {plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V), 1, 1};
  for (int k = 0; k < 4; ++k)
    fprintf(out, "%s<%.15g, %.15g, %.15g>", k ? between : "", vectors[k][0] / sizes[k],
            vectors[k][1] / sizes[k], vectors[k][2] / sizes[k]);
}
