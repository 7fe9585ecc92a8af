/* cmd_image.c - renderslab image: a picture of a mesh scene that light slabs light. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "cli/values.h"
#include "cmd/commands.h"
#include "cmd/picture_files.h"
#include "cmd/stats.h"
#include "cmd/world.h"
#include "picture/image.h"
#include "picture/image_error.h"
#include "picture/picture_tile.h"
#include "shadow/occlusion.h"

struct arguments {
  struct world world;
  struct picture_files files;
  int samples;
  double time_limit; /* seconds; 0: none */
  double start;      /* of the process, on progress_now's clock */
  bool no_shadows;
  int tile, tiles; /* from 1; 0: the whole picture */
};

/* Seconds that it takes to free all and to end. */
static const double leaving = 0.005;

enum {
  OPTION_SAMPLES = 256,
  OPTION_PREVIEW,
  OPTION_EXPOSURE,
  OPTION_NO_SHADOWS,
  OPTION_TIME_LIMIT,
  OPTION_TILE
};

static const struct argp_option options_list[] = {
    {"output", 'o', "OUT.exr|png", 0,
     "The picture: radiance in float RGB, or 8-bit sRGB as a PNG; - is EXR on standard output", 0},
    {"samples", OPTION_SAMPLES, "N", 0,
     "N x N rays a pixel, on a regular grid, where neighbouring pixels differ by more than "
     "--tolerance allows; one, through its middle, elsewhere (default 1). There edges of shadows "
     "are "
     "looked at N times as coarsely, and light that rays share errs by up to three times the "
     "tolerance more, as the part \"error\" tells. Method gl: everywhere",
     0},
    {"preview", OPTION_PREVIEW, "FILE.png", 0, "Write an 8-bit sRGB picture too", 0},
    {"exposure", OPTION_EXPOSURE, "auto|EV", 0,
     "What is white in a PNG: by the picture (99 % of the pixels are at most 0.9 of it; the "
     "default), or 1.2 * 2^EV cd/m2, which is what a camera of ISO 100 takes so; radiance in watts "
     "counts 179 lm/W, and relative radiance as cd/m2",
     0},
    {"time-limit", OPTION_TIME_LIMIT, "S", 0,
     "The best picture that S seconds allow from the command's start to its end, down to "
     "--tolerance; says how good it got",
     0},
    {"tile", OPTION_TILE, "K/N", 0,
     "Render part K of N only (from 1), whole rows of 8 pixels; renderslab join makes one picture "
     "of "
     "all parts, the same to the last bit",
     0},
    {"no-shadows", OPTION_NO_SHADOWS, NULL, 0, "Light passes through the mesh", 0},
    {0}};

#define ARGUMENT(member) offsetof(struct arguments, member)
static const struct value values[] = {
    {'o', VALUE_TEXT, ARGUMENT(files.output), 0, 0},
    {OPTION_SAMPLES, VALUE_WHOLE, ARGUMENT(samples), 1, IMAGE_MOST_SAMPLES},
    {OPTION_PREVIEW, VALUE_TEXT, ARGUMENT(files.preview), 0, 0},
    {OPTION_TIME_LIMIT, VALUE_POSITIVE, ARGUMENT(time_limit), 0, 0},
    {OPTION_NO_SHADOWS, VALUE_FLAG, ARGUMENT(no_shadows), 0, 0},
    {0}};

/* What a part of a picture cannot be or have. */
static void check_tile(const struct arguments *arguments, struct argp_state *state) {
  int first, end;
  if (arguments->tiles == 0) return;
  if (arguments->time_limit > 0 ||
      gather_methods[arguments->world.options.method].sum == METHOD_OPENGL)
    argp_error(state, "--tile: not with --time-limit or --method gl");
  if (arguments->files.preview || !picture_files_end(arguments->files.output, ".exr"))
    argp_error(state, "--tile: writes an .exr; preview the whole picture by renderslab join");
  if (!picture_tile_rows(arguments->world.view.size[1], arguments->tile, arguments->tiles, &first,
                         &end))
    argp_error(state, "--tile %d/%d: the picture has fewer rows of %d pixels", arguments->tile,
               arguments->tiles, IMAGE_TILE);
}

static void parse_tile(struct argp_state *state, const char *text, struct arguments *arguments) {
  int used = 0;
  if (sscanf(text, "%d/%d%n", &arguments->tile, &arguments->tiles, &used) != 2 || text[used] ||
      arguments->tile < 1 || arguments->tile > arguments->tiles)
    argp_error(state, "--tile %s: not a part such as 1/4", text);
}

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &arguments->world.options;
    state->child_inputs[1] = &arguments->world.view;
    return 0;
  case OPTION_EXPOSURE:
    picture_files_expose(value, &arguments->files, state);
    return 0;
  case ARGP_KEY_SUCCESS:
    if (arguments->time_limit > 0 &&
        gather_methods[arguments->world.options.method].sum == METHOD_OPENGL)
      argp_error(state, "--time-limit: not with --method gl, which has one pass; use --level");
    picture_files_check(arguments->files.output, state);
    check_tile(arguments, state);
    return 0;
  case OPTION_TILE:
    parse_tile(state, value, arguments);
    return 0;
  default:
    return values_take(values, options_list, key, value, arguments, state);
  }
}

/* What a method cannot do is not left out silently. */
static enum result check_method(const struct world *world, struct error *error) {
  const struct method *method = &gather_methods[world->options.method];
  const struct scene_material *glossy = world_glossy(world);
  if (!method->matte_only || !glossy) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "%s: material %s has a highlight, which --method %s cannot do; take another, "
                     "such as reference",
                     world->view.mesh, glossy->name, method->name);
}

/* Receivers for which it may pay to build trees, at some 0.2 us a sample: where time is limited,
 * only if that is less than half of it. Where pixels may want more rays, about as many again. */
static uint64_t count_receivers(const struct arguments *arguments) {
  const struct world *world = &arguments->world;
  const int *size = world->view.size, samples = arguments->samples;
  double seconds = 0;
  for (int l = 0; l < world->light_count; ++l)
    for (int page = 0; page < world->lights[l].count; ++page)
      seconds += 2e-7 * (double)slab_sample_count(&world->lights[l].pages[page].slab);
  if (arguments->time_limit > 0 && seconds > arguments->time_limit / 2) return 0;
  return (uint64_t)size[0] * (uint64_t)size[1] * (samples > 1 ? 2 : 1);
}

static enum result load(struct arguments *arguments, struct error *error) {
  struct world *world = &arguments->world;
  const char *outputs[] = {arguments->files.output, arguments->files.preview, world->options.stats};
  enum result result = world_load_lights(world, outputs, 3, error);
  if (result == RESULT_OK) arguments->files.luminance = world_luminance(world);
  if (result == RESULT_OK) result = world_prepare(world, count_receivers(arguments), error);
  if (result == RESULT_OK) result = world_load_scene(world, SCENE_SURFACES, error);
  if (result == RESULT_OK) result = check_method(world, error);
  if (result == RESULT_OK) result = occlusion_create(&world->scene, &world->occlusion, error);
  return result;
}

static void tell_effects(const struct arguments *arguments, struct stats *stats) {
  const struct scene *scene = &arguments->world.scene;
  int glossy = 0, textured = 0;
  for (int k = 0; k < scene->material_count; ++k) {
    glossy += scene_glossy(&scene->materials[k]);
    textured += scene->materials[k].texture >= 0;
  }
  if (arguments->no_shadows)
    stats_effect(stats, "shadows", false, "--no-shadows");
  else
    stats_effect(stats, "shadows", true, "%zu triangles", scene->triangles);
  stats_effect(stats, "gloss", glossy > 0, "%d of %d materials have a highlight", glossy,
               scene->material_count);
  stats_effect(stats, "textures", textured > 0, "%d of %d materials have one", textured,
               scene->material_count);
  stats_effect(stats, "interreflection", false,
               "light from lamps only, not from surface to surface");
}

static void show_progress(void *context, double done) {
  progress_show(context, done, "image");
}

/* When the picture must be there, so that its files are written in time. */
static double find_end(void *context, int step) {
  const struct arguments *arguments = context;
  const int *size = arguments->world.view.size;
  return arguments->start + arguments->time_limit - leaving -
         picture_files_seconds(&arguments->files, size[0], size[1], step);
}

/* Says at once where there is not the time. */
static void tell_least(struct arguments *arguments) {
  const int *size = arguments->world.view.size;
  double left = find_end(arguments, image_first_step(size[0], size[1])) - progress_now() - leaving;
  if (left < 0)
    cli_note("%s: note: %g s do not suffice; the least here is about %.2g s, for the coarsest "
             "picture",
             arguments->files.output, arguments->time_limit, arguments->time_limit - left);
}

/* What the time allowed. */
static void tell_report(const struct arguments *arguments, const struct image_report *report) {
  char error[64] = "errors are not predicted", shared[64] = "";
  if (!(arguments->time_limit > 0)) return;
  if (isfinite(report->error))
    snprintf(error, sizeof error, "relative error at most %.2g", report->error);
  if (report->worst_step > 1)
    snprintf(shared, sizeof shared, ", but where up to %d x %d pixels share a ray",
             report->worst_step, report->worst_step);
  cli_note("%s: note: gathered with tolerances from %.2g to %.2g in %d pass%s; %s%s",
           arguments->files.output, report->best_tolerance, report->worst_tolerance, report->passes,
           report->passes > 1 ? "es" : "", error, shared);
}

static enum result render(struct arguments *arguments, const struct image_settings *settings,
                          struct picture *picture, struct stats *stats, struct error *error) {
  struct progress progress;
  struct image_report report;
  struct image_settings shown = *settings;
  shown.progress = show_progress;
  shown.progress_context = &progress;
  if (settings->until) tell_least(arguments);
  progress_start(&progress, cli_quiet(), 0);
  enum result result = image_render(&shown, picture, &report, error);
  progress_end(&progress);
  if (result == RESULT_OK) tell_report(arguments, &report);
  stats->counts = report.counts;
  return result;
}

/* For --stats, and for the picture's file. */
static enum result estimate_error(const struct arguments *arguments,
                                  const struct image_settings *settings, struct picture *picture,
                                  struct stats *stats, struct error *error) {
  struct image_error told;
  char text[IMAGE_ERROR_TEXT];
  stats_phase(stats, "error");
  enum result result = image_error_estimate(settings, picture, &told, error);
  if (result != RESULT_OK) return result;
  stats_error(stats, &told);
  image_error_text(&told, text);
  cli_note("%s: note: error %s", arguments->files.output, text);
  free(picture->about);
  picture->about = strdup(text);
  return picture->about ? RESULT_OK : result_no_memory(error);
}

/* A part of the picture, in a file of its own. */
static enum result make_tile(struct arguments *arguments, struct image_settings *settings,
                             struct picture *picture, struct stats *stats, struct error *error) {
  struct picture_tile tile = {.number = arguments->tile,
                              .count = arguments->tiles,
                              .width = settings->shade.width,
                              .height = settings->shade.height,
                              .luminance = arguments->files.luminance};
  double start = progress_now();
  picture_tile_key(settings, tile.key);
  picture_tile_rows(tile.height, tile.number, tile.count, &settings->first_row, &settings->end_row);
  tile.top = settings->first_row * IMAGE_TILE;
  tile.end =
      settings->end_row * IMAGE_TILE < tile.height ? settings->end_row * IMAGE_TILE : tile.height;
  enum result result = render(arguments, settings, picture, stats, error);
  if (result != RESULT_OK) return result;
  tile.counts = stats->counts;
  tile.seconds = progress_now() - start;
  stats_phase(stats, "write");
  return picture_tile_write(arguments->files.output, &tile, picture, error);
}

/* The error is estimated before the picture is written, which tells it; but where time is limited,
 * after that. */
static enum result make(struct arguments *arguments, struct picture *picture, struct stats *stats,
                        struct error *error) {
  const struct world *world = &arguments->world;
  const bool shadows = !arguments->no_shadows, limited = arguments->time_limit > 0;
  const struct gl_sum_settings gl = world_gl(world, shadows);
  struct image_settings settings = {
      .shade = world_shade(world),
      .gather = world_gather(world, shadows),
      .gl = gather_methods[world->options.method].sum == METHOD_OPENGL ? &gl : NULL,
      .samples = arguments->samples,
      .threads = world->options.threads,
      .until = limited ? find_end : NULL,
      .until_context = arguments};
  if (arguments->tiles > 0) return make_tile(arguments, &settings, picture, stats, error);
  enum result result = render(arguments, &settings, picture, stats, error);
  if (result == RESULT_OK && world->options.stats && !limited)
    result = estimate_error(arguments, &settings, picture, stats, error);
  if (result != RESULT_OK) return result;
  stats_phase(stats, "write");
  result = picture_files_write(&arguments->files, picture, error);
  if (result == RESULT_OK && world->options.stats && limited)
    result = estimate_error(arguments, &settings, picture, stats, error);
  return result;
}

static enum result run(void *input, struct error *error) {
  struct arguments *arguments = input;
  struct picture picture = {0};
  struct stats stats = stats_start();
  enum result result = load(arguments, error);
  if (result == RESULT_OK) {
    tell_effects(arguments, &stats);
    stats_phase(&stats, "render");
    result = make(arguments, &picture, &stats, error);
  }
  result = stats_end(&stats, &arguments->world, result, error);
  picture_free(&picture);
  world_free(&arguments->world);
  return result;
}

static const char help_text[] =
    "Renders an OBJ, glTF or PLY scene lit by light slabs. Meshes are mirrored in z into POV-Ray's "
    "coordinates. A surface shows emission + diffuse E/pi and a highlight, as in POV-Ray; where "
    "the camera looks into a lamp it sees the slab. The air is clear: there is no fog and there "
    "are "
    "no other media. `renderslab pov' writes the view for POV-Ray, which has them.\n\n"
    "With --tile a picture is shared out to several processes or machines: each renders some rows, "
    "and renderslab join puts them together.\n\n"
    "--stats tells the picture's error against the lamps themselves, too: RMS over mean of the "
    "lamps' light, by the noise, resolution and LogLuv rounding of the slabs, by the sum, by the "
    "edges of shadows, and of all together. An EXR then has it in its attribute \"error\". It is "
    "estimated from a few hundred pixels, after the picture and outside of --time-limit.\n"
    "\vExamples, for room.obj of share/canned/include-pov:\n"
    "  renderslab image room.obj --light 'lamp.tif at=0,190,20' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o room.png\n"
    "  renderslab image room.obj --light 'lamp.tif at=0,190,20 gain=1,0.8,0.6' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o room.exr \\\n"
    "    --samples 3 --preview room.png --stats room.json\n"
    "  renderslab image room.obj \\\n"
    "    --light 'lamp.tif at=0,190,20 lumens=800 kelvin=2700' --exposure 5 \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o bright.png\n"
    "  renderslab image room.obj --light 'lamp.tif at=0,190,20' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o quick.png \\\n"
    "    --time-limit 0.5";

int cmd_image(int argc, char **argv) {
  static const struct argp_child children[] = {{&options_argp, 0, NULL, 0},
                                               {&picture_options_argp, 0, NULL, 0},
                                               {&cli_argp, 0, NULL, 0},
                                               {0}};
  static const struct argp argp = {options_list, parse, "MESH", help_text, children, NULL, NULL};
  struct arguments arguments = {.samples = 1, .start = progress_process_start()};
  return cli_run(&argp, argc, argv, run, &arguments);
}
