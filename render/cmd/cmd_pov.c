/* cmd_pov.c - renderslab pov: the same view as a POV-Ray scene. */
#include "base/output.h"
#include "cli/cli.h"
#include "cmd/commands.h"
#include "cmd/world.h"
#include "pov/pov.h"

struct arguments {
  struct world world;
  const char *output;
};

static error_t parse(int key, char *value, struct argp_state *state) {
  struct arguments *arguments = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &arguments->world.options;
    state->child_inputs[1] = &arguments->world.view;
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

/* The scene must not take the place of the includes that it reads. */
static enum result find_includes(const struct arguments *arguments, struct pov_includes *includes,
                                 struct error *error) {
  const struct world *world = &arguments->world;
  enum result result = pov_includes_find(world->lights, world->light_count, includes, error);
  for (int k = 0; k < includes->count && result == RESULT_OK; ++k) {
    const char *inputs[] = {includes->list[k].path, includes->list[k].image};
    result = output_check(&arguments->output, 1, inputs, 2, error);
  }
  return result;
}

static enum result run(void *input, struct error *error) {
  struct arguments *arguments = input;
  struct world *world = &arguments->world;
  struct pov_includes includes = {0};
  char note[256] = "";
  enum result result = world_load_lights(world, &arguments->output, 1, error);
  if (result == RESULT_OK) result = find_includes(arguments, &includes, error);
  if (result == RESULT_OK) result = world_load_scene(world, SCENE_SURFACES, error);
  if (result == RESULT_OK) {
    const struct shade shade = world_shade(world);
    result = pov_write(arguments->output, &shade, &includes, cli_command_line(), note, error);
    if (result == RESULT_OK && *note) cli_note("%s: note: %s", arguments->output, note);
  }
  pov_includes_free(&includes);
  world_free(world);
  return result;
}

static const struct argp_option options_list[] = {
    {"output", 'o', "SCENE.pov", 0, "The scene to write; - is standard output", 0}, {0}};

static const char help_text[] =
    "Writes the view that `renderslab image' renders as a POV-Ray 3.7 scene, which lights it by "
    "the include files of the same slabs: NAME.inc beside NAME.tif, made by `bakeslab include'. "
    "The scene's first lines say how to render it. What renderslab does not have, such as fog, may "
    "be added to it."
    "\vExamples, for room.obj of share/canned/include-pov:\n"
    "  bakeslab include lamp.tif -o lamp.inc\n"
    "  renderslab pov room.obj --light 'lamp.tif at=0,190,20' \\\n"
    "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o view.pov\n"
    "  povray view.pov +W320 +H240 -D";

int cmd_pov(int argc, char **argv) {
  static const struct argp argp = {options_list, parse, "MESH", help_text, picture_options_children,
                                   NULL,         NULL};
  struct arguments arguments = {0};
  return cli_run(&argp, argc, argv, run, &arguments);
}
