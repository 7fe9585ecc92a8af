/* main.c - renderslab: lights things with slabs. A table of subcommands, each in its own
 * cmd_NAME.c. */
#include "cli/cli.h"
#include "cmd/commands.h"

static const struct cli_command commands[] = {
    {"irradiance", cmd_irradiance, "irradiance of receivers read from stdin"},
    {"image", cmd_image, "picture of an OBJ, glTF or PLY scene"},
    {"join", cmd_join, "one picture of the tiles that several processes rendered"},
    {"pov", cmd_pov, "the same view as a POV-Ray scene"},
    {"view", cmd_view, "a scene in a window, to look around and move lights"},
    {"tradeoff", cmd_tradeoff, "what accuracy costs in time, for a scene"},
    {0}};

static const struct cli_program renderslab = {
    .name = "renderslab",
    .summary = "Light things with slabs: the reference renderer of canned light sources.",
    .commands = commands,
    .examples = "  renderslab image room.obj --light 'lamp.tif at=0,190,20' \\\n"
                "    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o room.png\n"
                "  echo 0 0 0  0 1 0 | renderslab irradiance --light 'lamp.tif at=0,190,20'\n",
    .exit_status = "0 done, 1 failed, 2 usage"};

int main(int argc, char **argv) {
  return cli_main(&renderslab, argc, argv);
}
