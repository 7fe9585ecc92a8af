/* cmd_image.c - renderslab image: a picture of a mesh scene that light slabs light. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "cmd/commands.h"
#include "cmd/options.h"
#include "cmd/outputs.h"
#include "cmd/picture_options.h"
#include "cmd/stats.h"
#include "file/slab_exr.h"
#include "picture/image.h"
#include "picture/preview.h"
#include "scene/scene.h"
#include "shadow/occlusion.h"

struct arguments {
  struct options options;
  struct picture_options view;
  const char *output, *preview;
  int samples;
  double exposure;   /* 0: by the picture */
  double time_limit; /* seconds; 0: none */
  double start;      /* of the command, on progress_now's clock */
  bool no_shadows;
};

/* What is loaded. */
struct world {
  struct light *lights;
  struct gather_prepared aids;
  struct scene scene;
  struct occlusion *occlusion;
};

enum {
  OPTION_SAMPLES = 256,
  OPTION_PREVIEW,
  OPTION_EXPOSURE,
  OPTION_NO_SHADOWS,
  OPTION_TIME_LIMIT
};

static void check_output(const char *path, struct argp_state *state) {
  size_t length = path ? strlen(path) : 0;
  if (!path)
    argp_error(state, "no output given; add -o OUT.exr");
  else if (strcmp(path, "-") && (length < 5 || strcmp(path + length - 4, ".exr")))
    argp_error(state, "-o %s: must end in .exr; --preview writes a PNG", path);
}

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  uint64_t count = 1;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &arguments->options;
    state->child_inputs[1] = &arguments->view;
    return 0;
  case 'o':
    arguments->output = value;
    return 0;
  case OPTION_SAMPLES:
    if (!options_count(value, 1, IMAGE_MOST_SAMPLES, &count))
      argp_error(state, "--samples %s: must be a whole number from 1 to %d", value,
                 IMAGE_MOST_SAMPLES);
    arguments->samples = (int)count;
    return 0;
  case OPTION_PREVIEW:
    arguments->preview = value;
    return 0;
  case OPTION_EXPOSURE:
    if (!options_number(value, &arguments->exposure) || !(arguments->exposure > 0))
      argp_error(state, "--exposure %s: must be a number above 0", value);
    return 0;
  case OPTION_TIME_LIMIT:
    if (!options_number(value, &arguments->time_limit) || !(arguments->time_limit > 0))
      argp_error(state, "--time-limit %s: must be a number of seconds above 0", value);
    return 0;
  case OPTION_NO_SHADOWS:
    arguments->no_shadows = true;
    return 0;
  case ARGP_KEY_SUCCESS:
    if (arguments->time_limit > 0 && arguments->options.method == GATHER_GL)
      argp_error(state, "--time-limit: not with --method gl, which has one pass; use --level");
    check_output(arguments->output, state);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

/* What a method cannot do is not left out silently. */
static enum result check_method(const struct arguments *arguments, const struct scene *scene,
                                struct error *error) {
  if (arguments->options.method != GATHER_CLOSED) return RESULT_OK;
  for (int k = 0; k < scene->material_count; ++k)
    if (scene_glossy(&scene->materials[k]))
      return result_fail(error, RESULT_BAD,
                         "%s: material %s has a highlight, which --method closed cannot do; take "
                         "another, such as reference",
                         arguments->view.mesh, scene->materials[k].name);
  return RESULT_OK;
}

static enum result load(const struct arguments *arguments, struct world *world,
                        struct error *error) {
  const struct options *options = &arguments->options;
  int count = options->light_count;
  uint64_t receivers = (uint64_t)arguments->view.size[0] * (uint64_t)arguments->view.size[1] *
                       (uint64_t)(arguments->samples * arguments->samples);
  const char *outputs[] = {arguments->output, arguments->preview, options->stats};
  char note[256] = "";
  enum result result = options_load_lights(options, &world->lights, error);
  const char **inputs = calloc((size_t)count + 1, sizeof *inputs);
  if (result == RESULT_OK && !inputs) result = result_fail(error, RESULT_MEMORY, "out of memory");
  if (result == RESULT_OK) {
    for (int k = 0; k < count; ++k) inputs[k] = world->lights[k].path;
    inputs[count] = arguments->view.mesh;
    result = outputs_check(outputs, 3, inputs, count + 1, error);
  }
  free(inputs);
  if (result == RESULT_OK)
    result = gather_prepare(world->lights, count, options->method, receivers, options->threads,
                            &world->aids, error);
  if (result == RESULT_OK)
    result = scene_load(arguments->view.mesh, SCENE_SURFACES, options->repair, &world->scene, note,
                        error);
  if (result == RESULT_OK && *note) cli_note("%s: note: %s", arguments->view.mesh, note);
  if (result == RESULT_OK) result = check_method(arguments, &world->scene, error);
  if (result == RESULT_OK) result = occlusion_create(&world->scene, &world->occlusion, error);
  return result;
}

static void unload(const struct arguments *arguments, struct world *world) {
  occlusion_free(world->occlusion);
  scene_free(&world->scene);
  gather_prepared_free(&world->aids);
  options_free_lights(world->lights, arguments->options.light_count);
}

static void tell_effects(const struct arguments *arguments, const struct scene *scene,
                         struct stats *stats) {
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

/* What the time allowed. */
static void tell_report(const struct arguments *arguments, const struct image_report *report) {
  if (!(arguments->time_limit > 0)) return;
  if (report->late)
    cli_note("%s: note: %g s do not suffice for one pass; this is the coarsest picture",
             arguments->output, arguments->time_limit);
  cli_note("%s: note: gathered with tolerances from %.2g to %.2g in %d pass%s; relative error at "
           "most %.2g",
           arguments->output, report->best_tolerance, report->worst_tolerance, report->passes,
           report->passes > 1 ? "es" : "", report->error);
}

static enum result render(const struct arguments *arguments, const struct world *world,
                          struct picture *picture, struct stats *stats, struct error *error) {
  const struct options *options = &arguments->options;
  const struct picture_options *view = &arguments->view;
  const struct occlusion *shadows = arguments->no_shadows ? NULL : world->occlusion;
  struct progress progress;
  struct gl_sum_settings gl = options_gl_settings(options, world->lights, &world->aids,
                                                  arguments->no_shadows ? NULL : &world->scene);
  struct image_settings settings = {
      .shade = {.scene = &world->scene,
                .occlusion = world->occlusion,
                .lights = world->lights,
                .light_count = options->light_count},
      .camera = view->camera,
      .gather = options_settings(options, world->lights, &world->aids, shadows),
      .gl = options->method == GATHER_GL ? &gl : NULL,
      .width = view->size[0],
      .height = view->size[1],
      .samples = arguments->samples,
      .threads = options->threads,
      .progress = show_progress,
      .progress_context = &progress,
      .until = arguments->time_limit > 0 ? arguments->start + arguments->time_limit : 0};
  struct image_report report;
  memcpy(settings.shade.background, view->background, sizeof view->background);
  progress_start(&progress, cli_quiet(), 0);
  enum result result = image_render(&settings, picture, &report, error);
  progress_end(&progress);
  if (result == RESULT_OK) tell_report(arguments, &report);
  stats->counts = report.counts;
  return result;
}

static enum result write_files(const struct arguments *arguments, const struct picture *picture,
                               struct error *error) {
  const char *command = cli_command_line();
  double white = arguments->exposure;
  enum result result = slab_exr_write(arguments->output, picture, 0, command, error);
  if (result != RESULT_OK || !arguments->preview) return result;
  if (!(white > 0)) {
    result = preview_exposure(picture, &white, error);
    if (result == RESULT_OK)
      cli_note("%s: note: radiance %.4g is white; --exposure %.4g keeps it", arguments->preview,
               white, white);
  }
  if (result == RESULT_OK)
    result = preview_write(arguments->preview, picture, white, command, error);
  return result;
}

static enum result run(const struct arguments *arguments, struct error *error) {
  const struct options *options = &arguments->options;
  struct world world = {0};
  struct picture picture = {0};
  struct stats stats = {.command = cli_command_line(),
                        .method = gather_method_name(options->method),
                        .tolerance = options->tolerance,
                        .threads = options->threads};
  stats_phase(&stats, "load");
  enum result result = load(arguments, &world, error);
  if (result == RESULT_OK) {
    tell_effects(arguments, &world.scene, &stats);
    stats_phase(&stats, "render");
    result = render(arguments, &world, &picture, &stats, error);
  }
  if (result == RESULT_OK) {
    stats_phase(&stats, "write");
    result = write_files(arguments, &picture, error);
  }
  if (result == RESULT_OK && options->stats)
    result = stats_write(&stats, world.lights, options->light_count, options->stats, error);
  picture_free(&picture);
  unload(arguments, &world);
  return result;
}

static const struct argp_option options_list[] = {
    {"output", 'o', "OUT.exr", 0, "The picture: radiance in float RGB; - is standard output", 0},
    {"samples", OPTION_SAMPLES, "N", 0,
     "N x N rays a pixel, on a regular grid (default 1, through its middle)", 0},
    {"preview", OPTION_PREVIEW, "FILE.png", 0, "Write an 8-bit sRGB picture too", 0},
    {"exposure", OPTION_EXPOSURE, "X", 0,
     "Radiance that is white in the preview (default: 99 % of its pixels are at most 0.9 of it)",
     0},
    {"time-limit", OPTION_TIME_LIMIT, "S", 0,
     "The best picture that S seconds allow, down to --tolerance; says how good it got", 0},
    {"no-shadows", OPTION_NO_SHADOWS, NULL, 0, "Light passes through the mesh", 0},
    {0}};

static const char help_text[] =
    "Renders an OBJ, glTF or PLY scene lit by light slabs. Meshes are mirrored in z into POV-Ray's "
    "coordinates. A surface shows emission + diffuse E/pi and a highlight, as in POV-Ray; where "
    "the camera looks into a lamp it sees the slab."
    "\vExamples:\n"
    "  renderslab image room.obj --light 'lamp.tif at=0,2,0 toward=0,0,0' --camera 'from=0,1,-3 "
    "at=0,1,0' -o room.exr\n"
    "  renderslab image room.obj --light lamp.tif --camera 'from=0,1,-3 at=0,1,0 fov=50' -o "
    "room.exr --samples 3 --preview room.png --stats room.json";

int cmd_image(int argc, char **argv) {
  const struct argp_child children[] = {
      {&options_argp, 0, NULL, 0}, {&picture_options_argp, 0, NULL, 0}, cli_options[0], {0}};
  const struct argp argp = {.options = options_list,
                            .parser = parse,
                            .children = children,
                            .args_doc = "MESH",
                            .doc = help_text};
  struct arguments arguments = {.samples = 1, .start = progress_now()};
  struct error error = {{0}};
  cli_parse(&argp, argc, argv, &arguments);
  int status = run(&arguments, &error) == RESULT_OK ? CLI_OK : cli_fail(&error);
  options_free(&arguments.options);
  return cli_close_stdout() == CLI_OK ? status : CLI_FAILED;
}
