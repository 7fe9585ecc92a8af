/* main.c - bakeslab: makes, inspects and converts light slabs. A table of
 * subcommands; each lives in its own cmd_NAME.c. */
#include "cmd/slab_options.h"

static const struct cli_command commands[] = {
    {"bake", cmd_bake, "render a lamp with POV-Ray into a light slab"},
    {"status", cmd_status, "how far a bake is: batches done, claimed and missing, time left"},
    {"gather", cmd_gather, "bring together what shards baked in folders of their own"},
    {"info", cmd_info, "geometry, samples, flux, peak and provenance of a slab"},
    {"check", cmd_check, "validate a slab; warn when it misses light, loses it or counts it twice"},
    {"lookup", cmd_lookup, "radiance of rays read from stdin"},
    {"projector", cmd_projector, "make the slab of a slide projector from an image"},
    {"import", cmd_import, "make a slab from light that was measured, or simulated elsewhere"},
    {"convert", cmd_convert, "change the container, precision or resolution"},
    {"diff", cmd_diff, "compare two slabs"},
    {"include", cmd_include, "write a POV-Ray include that lights a scene"},
    {"export", cmd_export, "write the light for other programs"},
    {0}};

static const struct cli_program bakeslab = {
    .name = "bakeslab",
    .summary = "Make, inspect and convert light slabs: bake a lamp once, reuse its light anywhere.",
    .commands = commands,
    .examples = "  bakeslab bake parabolic.pov -o lamp.tif\n"
                "  bakeslab info lamp.tif\n"
                "  bakeslab include lamp.tif -o lamp.inc\n",
    .exit_status = "0 done, 1 failed, 2 usage; diff: 0 same, 1 differ, 2 trouble",
    .compares = "diff"};

int main(int argc, char **argv) {
  return cli_main(&bakeslab, argc, argv);
}
