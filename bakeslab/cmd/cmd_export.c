/* cmd_export.c - bakeslab export: a slab's light for other programs. */
#include <string.h>

#include "cmd/slab_options.h"
#include "export/export.h"
#include "file/slab_file.h"

static const char doc[] =
    "Writes the light of a slab for other programs, which light their scenes with it."
    "\v"
    "The kind follows from the ending of the output, or from --as. These make a folder, with a "
    "README.md that says how it is used, an example, and provenance.json, which holds the error "
    "against the slab:\n"
    "  radiance  NAME.rad and its files for Radiance: exact\n"
    "  mitsuba   NAME.xml and an emitter for Mitsuba 3: exact\n"
    "  cycles    NAME.json and an add-on for Blender's Cycles: exact\n"
    "These make a file, which holds the far field alone; what that loses is told:\n"
    "  ies       IES LM-63-2002 (.ies): absolute, type C, with the size of the opening\n"
    "  ldt       EULUMDAT (.ldt)\n"
    "And these a file of rays, drawn by their luminance:\n"
    "  tm25ray   IES TM-25 (.tm25ray)\n"
    "  rays      text (.txt): `x y z dx dy dz flux' a line, in metres\n"
    "\n"
    "A folder appears whole or not at all. One that is there is refused; --force replaces it as a "
    "whole, if bakeslab export made it. What one leaves that is killed by signal 9, "
    "OUT.unfinished-export.XXXXXX, the next export to OUT removes.\n"
    "\n"
    "Lamp space is left-handed with y up. A lamp point (x, y, z) is (x, z, y) in Radiance "
    "and Blender, whose space is right-handed with z up, and (x, y, -z) in Mitsuba, whose space is "
    "right-handed with y up. In photometric files gamma 0 is -y, C0 is +x, C90 is +z.\n"
    "\n"
    "Examples:\n"
    "  bakeslab export lamp.tif -o lamp_radiance --as radiance\n"
    "  bakeslab export lamp.tif -o fine_radiance --as radiance --polygons 4x4\n"
    "  bakeslab export lamp.tif -o lamp_radiance --as radiance --tolerance 0.05 \\\n"
    "    --force\n"
    "  bakeslab export lamp.tif -o lamp_mitsuba --as mitsuba\n"
    "  bakeslab export lamp.tif -o plain_mitsuba --as mitsuba --plain\n"
    "  bakeslab export lamp.tif -o lamp.ies\n"
    "  bakeslab export lamp.tif -o lamp.ldt --tolerance 0.02\n"
    "  bakeslab export lamp.tif -o lamp.tm25ray --rays 50000";

struct arguments {
  const char *slab, *output, *as;
  bool force;
  struct export_wish wish;
  const struct export_kind *kind;
};

#define ARGUMENT(member) offsetof(struct arguments, member)
#define KEY(member) VALUE_KEY(struct arguments, member)

static const struct argp_option options[] = {
    {"output", 'o', "OUT", 0, "The file or folder to write", 1},
    {"as", KEY(as), EXPORT_KINDS, 0, "The kind, where the ending of OUT does not say it", 1},
    {"force", KEY(force), NULL, 0, "Replace a folder that an export made", 1},
    {"name", 'n', "NAME", 0, "Call the lamp NAME rather than what the slab says", 1},
    {"tolerance", KEY(wish.tolerance), "T", 0,
     "Relative error of what a kind approximates (default 0.01; ies, ldt: 0.005). radiance: of "
     "irradiance one aperture width away, without --polygons; mitsuba --plain: of irradiance four "
     "widths away; ies, ldt: of intensities between the angles, as a part of the largest",
     2},
    {"polygons", KEY(wish.polygons), "NxM", 0,
     "radiance: cut each aperture into so many sources along u and v; the default follows from "
     "the tolerance",
     2},
    {"plain", KEY(wish.plain), NULL, 0,
     "mitsuba: use Mitsuba's own projectors, no plugin: not exact, and the lamp's face is not seen",
     2},
    {"blend", KEY(wish.blend), NULL, 0,
     "cycles: make NAME.blend, too, with the Blender that BLENDER in the environment names, or is "
     "installed, or with python3 and its module bpy",
     2},
    {"rays", KEY(wish.rays), "N", 0, "tm25ray, rays: how many (default 100000)", 2},
    {"seed", KEY(wish.seed), "N", 0, "tm25ray, rays: other rays for another number (default 1)", 2},
    {0}};

static const struct value values[] = {
    {'o', VALUE_TEXT, ARGUMENT(output), 0, 0},
    {KEY(as), VALUE_TEXT, ARGUMENT(as), 0, 0},
    {KEY(force), VALUE_FLAG, ARGUMENT(force), 0, 0},
    {'n', VALUE_TEXT, ARGUMENT(wish.name), 0, 0},
    {KEY(wish.tolerance), VALUE_POSITIVE, ARGUMENT(wish.tolerance), 0, 0},
    {KEY(wish.plain), VALUE_FLAG, ARGUMENT(wish.plain), 0, 0},
    {KEY(wish.blend), VALUE_FLAG, ARGUMENT(wish.blend), 0, 0},
    {KEY(wish.rays), VALUE_WHOLE, ARGUMENT(wish.rays), 1, 1e9},
    {KEY(wish.seed), VALUE_WHOLE, ARGUMENT(wish.seed), 0, 1e9},
    {KEY(wish.polygons), VALUE_SIZE, ARGUMENT(wish.polygons), 0, 0},
    {0}};

/* Options of other kinds are refused. */
static void check_kind(const struct arguments *arguments, struct argp_state *state) {
  const char *kind = arguments->kind->name;
  const struct export_wish *wish = &arguments->wish;
  bool rays = !strcmp(kind, "tm25ray") || !strcmp(kind, "rays"), cycles = !strcmp(kind, "cycles"),
       mitsuba = !strcmp(kind, "mitsuba");
  if (wish->polygons[0] && strcmp(kind, "radiance") != 0)
    argp_error(state, "--polygons: is for --as radiance only");
  if (wish->plain && !mitsuba) argp_error(state, "--plain: is for --as mitsuba only");
  if (wish->blend && !cycles) argp_error(state, "--blend: is for --as cycles only");
  if (!rays && (wish->rays || wish->seed >= 0))
    argp_error(state, "--rays, --seed: are for ray files only");
  if (wish->tolerance > 0 && (rays || cycles || (mitsuba && !wish->plain)))
    argp_error(state, "--tolerance: --as %s approximates nothing that it could bound", kind);
}

static void check_arguments(struct arguments *arguments, struct argp_state *state) {
  if (!arguments->output) argp_error(state, "no output given: -o OUT");
  arguments->kind = export_kind_of(arguments->as, arguments->output);
  if (!arguments->kind && arguments->as)
    argp_error(state, "--as %s: must be one of %s", arguments->as, EXPORT_KINDS);
  if (!arguments->kind)
    argp_error(state, "%s: its ending names no kind; give one of %s with --as", arguments->output,
               EXPORT_KINDS);
  if (!arguments->kind) return;
  check_kind(arguments, state);
  if (!arguments->wish.rays) arguments->wish.rays = 100000;
  if (arguments->wish.seed < 0) arguments->wish.seed = 1;
  bool far = !strcmp(arguments->kind->name, "ies") || !strcmp(arguments->kind->name, "ldt");
  if (arguments->wish.tolerance == 0) arguments->wish.tolerance = far ? 0.005 : 0.01;
}

static error_t parse_option(int key, char *text, struct argp_state *state) {
  struct arguments *arguments = state->input;
  if (key == ARGP_KEY_SUCCESS) {
    check_arguments(arguments, state);
    return 0;
  }
  if (values_take(values, options, key, text, arguments, state) == 0) return 0;
  return cli_parse_file(key, text, state, "slab", &arguments->slab);
}

static const char *noted; /* the slab's file, before each note */

static void tell(const char *line) {
  cli_note("%s: note: %s", noted, line);
}

static enum result check_name(const struct export_kind *kind, struct export_wish *wish,
                              const struct slab *slabs, struct error *error) {
  if (!wish->name) wish->name = slabs[0].name;
  if (kind->ending) return RESULT_OK; /* a text that need be no identifier */
  if (export_check_name(wish->name, error) == RESULT_OK) return RESULT_OK;
  struct error reason = *error;
  return result_fail(error, RESULT_BAD, "%s: %s; give one with --name", wish->slab, reason.text);
}

static enum result run(void *input, struct error *error) {
  struct arguments *arguments = input;
  struct warnings notes = {.tell = tell};
  struct export_wish *wish = &arguments->wish;
  struct slab *slabs = NULL;
  int count = 0;
  wish->slab = noted = arguments->slab;
  wish->command = cli_command_line();
  wish->notes = &notes;
  enum result result = export_check_output(arguments->kind, arguments->output, arguments->slab,
                                           arguments->force, error);
  if (result == RESULT_OK) result = slab_file_load_all(arguments->slab, &slabs, &count, error);
  if (result == RESULT_OK) result = check_name(arguments->kind, wish, slabs, error);
  struct error why = {{0}};
  if (result == RESULT_OK) {
    result =
        export_make(arguments->kind, slabs, count, wish, arguments->output, arguments->force, &why);
    if (result != RESULT_OK) result_fail(error, result, "%s: %s", arguments->slab, why.text);
  }
  slab_file_free_all(slabs, count);
  return result;
}

int cmd_export(int argc, char **argv) {
  static const struct argp argp = {
      options, parse_option, "SLAB -o OUT [--as KIND]", doc, cli_options, NULL, NULL};
  struct arguments arguments = {.wish = {.seed = -1}};
  return cli_run(&argp, argc, argv, run, &arguments);
}
