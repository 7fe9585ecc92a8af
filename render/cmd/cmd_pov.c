/* cmd_pov.c - renderslab pov: the same view as a POV-Ray scene. */
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "cmd/commands.h"
#include "cmd/options.h"
#include "cmd/outputs.h"
#include "cmd/picture_options.h"
#include "pov/pov.h"

struct arguments {
  struct options options;
  struct picture_options view;
  const char *output;
};

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &arguments->options;
    state->child_inputs[1] = &arguments->view;
    return 0;
  case 'o':
    arguments->output = value;
    return 0;
  case ARGP_KEY_SUCCESS:
    if (!arguments->output) argp_error(state, "no output given; add -o SCENE.pov");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

/* The scene must not take the place of what it reads. */
static enum result check(const struct arguments *arguments, const struct light *lights,
                         const struct pov_includes *includes, struct error *error) {
  enum result result = outputs_check(&arguments->output, 1, &arguments->view.mesh, 1, error);
  for (int k = 0; k < includes->count && result == RESULT_OK; ++k) {
    const struct pov_include *include = &includes->list[k];
    const char *inputs[] = {lights[include->light].path, include->path, include->image};
    result = outputs_check(&arguments->output, 1, inputs, 3, error);
  }
  return result;
}

static enum result run(const struct arguments *arguments, struct error *error) {
  const struct options *options = &arguments->options;
  const struct picture_options *view = &arguments->view;
  struct light *lights = NULL;
  struct scene scene = {0};
  struct pov_includes includes = {0};
  char note[256] = "";
  enum result result = options_load_lights(options, &lights, error);
  if (result == RESULT_OK)
    result = pov_includes_find(lights, options->light_count, &includes, error);
  if (result == RESULT_OK) result = check(arguments, lights, &includes, error);
  if (result == RESULT_OK)
    result = scene_load(view->mesh, SCENE_SURFACES, options->repair, &scene, note, error);
  if (result == RESULT_OK && *note) cli_note("%s: note: %s", view->mesh, note);
  if (result == RESULT_OK) {
    struct pov_view scene_view = {.scene = &scene,
                                  .lights = lights,
                                  .light_count = options->light_count,
                                  .includes = &includes,
                                  .camera = view->camera,
                                  .width = view->size[0],
                                  .height = view->size[1],
                                  .command = cli_command_line()};
    memcpy(scene_view.background, view->background, sizeof view->background);
    result = pov_write(arguments->output, &scene_view, note, error);
    if (result == RESULT_OK && *note) cli_note("%s: note: %s", arguments->output, note);
  }
  pov_includes_free(&includes);
  scene_free(&scene);
  options_free_lights(lights, options->light_count);
  return result;
}

static const struct argp_option options_list[] = {
    {"output", 'o', "SCENE.pov", 0, "The scene to write; - is standard output", 0}, {0}};

static const char help_text[] =
    "Writes the view that `renderslab image' renders as a POV-Ray 3.7 scene, which lights it by "
    "the include files of the same slabs: NAME.inc beside NAME.tif, made by `bakeslab include'. "
    "The scene's first lines say how to render it."
    "\vExample:\n"
    "  bakeslab include lamp.tif -o lamp.inc\n"
    "  renderslab pov room.obj --light 'lamp.tif at=0,2,0 toward=0,0,0' --camera 'from=0,1,-3 "
    "at=0,1,0' -o room.pov";

int cmd_pov(int argc, char **argv) {
  const struct argp_child children[] = {
      {&options_lights_argp, 0, NULL, 0}, {&picture_options_argp, 0, NULL, 0}, cli_options[0], {0}};
  const struct argp argp = {.options = options_list,
                            .parser = parse,
                            .children = children,
                            .args_doc = "MESH",
                            .doc = help_text};
  struct arguments arguments = {0};
  struct error error = {{0}};
  cli_parse(&argp, argc, argv, &arguments);
  int status = run(&arguments, &error) == RESULT_OK ? CLI_OK : cli_fail(&error);
  options_free(&arguments.options);
  return cli_close_stdout() == CLI_OK ? status : CLI_FAILED;
}
