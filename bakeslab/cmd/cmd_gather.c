/* cmd_gather.c - bakeslab gather: what shards baked in folders of their own goes into one. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_gather.h"
#include "cmd/slab_options.h"

struct options {
  const char *output;   /* SLAB.partial */
  const char **folders; /* into argv */
  int count;
};

static const struct argp_option options_list[] = {
    {"output", 'o', "SLAB.partial", 0, "The folder that they go into; made, where it is not there",
     0},
    {0}};
static const struct value values[] = {{'o', VALUE_TEXT, offsetof(struct options, output), 0, 0},
                                      {0}};

static const char ending[] = ".partial";

static void check(const struct options *options, struct argp_state *state) {
  size_t length = options->output ? strlen(options->output) : 0, end = strlen(ending);
  if (options->count == 0) argp_error(state, "no folders given");
  if (length <= end || strcmp(options->output + length - end, ending) != 0)
    argp_error(state, "give -o SLAB%s, the folder where `bakeslab bake -o SLAB` looks", ending);
}

static error_t parse(int key, char *argument, struct argp_state *state) {
  struct options *options = state->input;
  switch (key) {
  case ARGP_KEY_ARGS: /* all that are left */
    options->folders = (const char **)state->argv + state->next;
    options->count = state->argc - state->next;
    return 0;
  case ARGP_KEY_END:
    check(options, state);
    return 0;
  default:
    return values_take(values, options_list, key, argument, options, state);
  }
}

static void warn(const char *line) {
  cli_complain("%s", line);
}

static enum result run(void *input, struct error *error) {
  const struct options *options = input;
  struct bake_gather gather = {.warn = warn};
  char *output = strndup(options->output, strlen(options->output) - strlen(ending));
  enum result result = output
                           ? bake_gather(options->folders, options->count, output, &gather, error)
                           : result_no_memory(error);
  free(output);
  if (result != RESULT_OK) return result;
  cli_note("%s: note: %zu batches are new, %zu were there, %zu are damaged and left out",
           options->output, gather.batches, gather.had, gather.damaged);
  if (gather.differ == 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "%s: %zu batches differ from what is there; machines of different arithmetic, "
                     "or damaged files",
                     options->output, gather.differ);
}

static const char doc[] =
    "Brings together what shards of one bake have baked in folders of their own, copied from other "
    "machines: each batch is read, and goes into SLAB.partial if it is whole. What is damaged, cut "
    "off say, is told and left out; what differs from a batch that is there is told, and the exit "
    "status is 1. Folders of other bakes or versions, or of another number of shards, are refused."
    "\vAlone, shards bake a lamp in two waves: each machine's --shard K/N --round pilot; gather, "
    "and "
    "copy the folder back to all; --round rest; gather; and the bake without --shard writes the "
    "slab. A lamp whose light is searched for has a few pilots, and the bake says when it is their "
    "turn again.\n\nExamples:\n"
    "  bakeslab gather one/night.tif.partial two/night.tif.partial \\\n"
    "    -o night.tif.partial\n";

static const struct argp argp = {options_list, parse, "FOLDER...", doc, cli_options, NULL, NULL};

int cmd_gather(int argc, char **argv) {
  struct options options = {0};
  return cli_run(&argp, argc, argv, run, &options);
}
