#include "include/text/include_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/sdl.h"
#include "slab/plane.h"

extern const char include_head_inc[], include_usage_inc[], include_units_inc[], include_scene_inc[],
    include_begin_inc[], include_image_inc[], include_checks_inc[], include_canned_inc[],
    include_channels_inc[], include_end_inc[];

/* POV-Ray's objects end 1e10 units from the origin. */
static const double most_width = 1e9;

/* ---- Channels ---- */

static const char
    gain_row[] = "#ifndef(@_Gain_@{variable}) #declare @_Gain_@{variable} = 1; #end",
    case_row[] = "    #case (@{number}) #local Gain_ = @_Gain_@{variable}; #break",
    set_row[] = "  #if (strcmp(Name, \"@{channel}\") = 0) #declare @_Gain_@{variable} = Gain; "
                "#local Known_ = 1; #end",
    name_word[] = "@{channel}", variable_word[] = "@_Gain_@{variable}";

/* What is printed of each channel, with what stands between two of them. */
struct channel_rows {
  const struct include_lamp *lamp;
  const char *between, *format; /* of the lamp's name, the variable's end, the number, the name */
  const char *name;
};

static void print_channels(const void *of, FILE *out) {
  const struct channel_rows *rows = of;
  const struct include_lamp *lamp = rows->lamp;
  for (int n = 0; n < lamp->channel_count; ++n) {
    char variable[SDL_IDENTIFIER_SIZE] = "", number[16];
    struct error ignored;
    sdl_capitalise(lamp->channels[n], variable, &ignored); /* include_lit_pages has tried it */
    snprintf(number, sizeof number, "%d", n + 1);
    if (n) fputs(rows->between, out);
    const struct include_value values[] = {{"variable", .text = variable},
                                           {"channel", .text = lamp->channels[n]},
                                           {"number", .text = number},
                                           {0}};
    include_fill(rows->format, rows->name, values, out);
  }
}

/* Where things are for which the header tells an exposure, in aperture widths. */
static const double exposed_at = 4;

/* What the header says of the lamp's brightness. */
struct brightness {
  double lumens;   /* 0: its unit is relative */
  double away;     /* lamp units */
  double start;    /* Gain */
  double exposure; /* EV at ISO 100, by which 1.2 * 2^EV cd/m2 is white */
  const char *counted;
};

/* A matt surface shows E/pi, straight before a matt lamp twice the mean over the half sphere. */
static struct brightness find_brightness(const struct include_lamp *lamp) {
  const struct slab *frame = &lamp->frame;
  bool watts = !strcmp(frame->radiance_unit, "W/(sr m2)");
  bool relative = !watts && strcmp(frame->radiance_unit, "cd/m2") != 0;
  double away = exposed_at * plane_width(frame), unit = watts ? SLAB_WATT_LUMENS : 1;
  double shows = 2 * lamp->flux / (2 * M_PI * away * away) / M_PI;
  double area = frame->metres_per_unit * frame->metres_per_unit;
  return (struct brightness){relative ? 0 : lamp->flux * area * unit, away, 1 / shows,
                             log2(shows * unit / 1.2),
                             watts ? ", if a watt of its light is 179 lm" : ""};
}

static const char *const channels[3] = {"red", "green", "blue"};

/* A lamp that is written in metres comes out too small in most scenes. */
static const char *tell_centimetres(const struct slab *frame, char text[96]) {
  double metres = frame->metres_per_unit;
  *text = '\0';
  if (metres > 0.01)
    snprintf(text, 96, "its unit is %.4g m: in a scene in centimetres Scale is %.4g", metres,
             100 * metres);
  return text;
}

static void put_stamp(const struct include_lamp *lamp, const char *housing, char stamp[17]) {
  uint64_t hash = housing ? include_hash(lamp->stamp, housing, strlen(housing)) : lamp->stamp;
  snprintf(stamp, 17, "%016" PRIx64, hash);
}

void include_print(const char *template, const struct include_text *text,
                   const struct include_lamp *lamp, const struct include_value *values, FILE *out) {
  const char *housing = text->housing;
  char stamp[17], centimetres[96];
  put_stamp(lamp, housing, stamp);
  const struct channel_rows gains = {lamp, "\n", gain_row, text->name},
                            cases = {lamp, "\n", case_row, text->name},
                            sets = {lamp, "\n", set_row, text->name},
                            names = {lamp, ", ", name_word, text->name},
                            variables = {lamp, ", ", variable_word, text->name};
  const struct brightness bright = find_brightness(lamp);
  const struct include_value shared[] = {
      {"channels", .part = include_channels_inc},
      {"channel_count", .number = lamp->channel_count},
      {"gain_rows", .print = print_channels, .of = &gains},
      {"case_rows", .print = print_channels, .of = &cases},
      {"name_rows", .print = print_channels, .of = &sets},
      {"channel_names", .print = print_channels, .of = &names},
      {"channel_variables", .print = print_channels, .of = &variables},
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
      {"in_centimetres", .text = tell_centimetres(&lamp->frame, centimetres)},
      {"radiance_unit", .text = lamp->frame.radiance_unit},
      {"flux_of_one", .number = lamp->flux},
      {"lumens", .number = bright.lumens},
      {"counted", .text = bright.counted},
      {"start", .number = bright.start},
      {"away", .number = bright.away},
      {"exposure", .number = bright.exposure},
      {"black_pages", .number = lamp->black_pages},
      {"stamp", .text = stamp},
      {"check", .numbers = lamp->check.at},
      {"rgb", .numbers = lamp->check.rgb},
      {"channel", .text = channels[lamp->check.channel]},
      {"value", .number = lamp->check.rgb[lamp->check.channel]},
      {"most_width", .number = most_width},
      {.more = values}};
  include_fill(template, text->name, shared, out);
  putc('\n', out);
}

double include_reach(double intensity, double width) {
  static const double dropped = 1e-10; /* below this in every channel */
  double reach = sqrt(intensity / (M_PI * dropped));
  return reach < 1e3 * width ? reach : 0;
}

void include_put_frame(const struct slab *slab, const double center[3], const char *between,
                       FILE *out) {
  const double *vectors[4] = {slab->u, slab->v, slab->normal, center};
  const double sizes[4] = {plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V), 1, 1};
  for (int k = 0; k < 4; ++k)
    fprintf(out, "%s<%.15g, %.15g, %.15g>", k ? between : "", vectors[k][0] / sizes[k],
            vectors[k][1] / sizes[k], vectors[k][2] / sizes[k]);
}
