/* main.c - bakeslab: makes, inspects and converts light slabs. A table of
 * subcommands; each lives in its own cmd_NAME.c. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

struct command {
  const char *name;
  int (*run)(int argc, char **argv);
  const char *help;
};

static const struct command commands[] = {
    {"bake", cmd_bake, "render a lamp with POV-Ray into a light slab"},
    {"info", cmd_info, "geometry, samples, flux, peak and provenance of a slab"},
    {"check", cmd_check, "validate a slab and warn where its light is cut off"},
    {"lookup", cmd_lookup, "radiance of rays read from stdin"},
    {"convert", cmd_convert, "other container, precision or resolution"},
    {"diff", cmd_diff, "compare two slabs"},
    {"include", cmd_include, "write a POV-Ray include that lights a scene"},
};
enum { COMMANDS = sizeof commands / sizeof *commands };

static void print_help(FILE *out) {
  fputs("Usage: bakeslab COMMAND [OPTION...] ARGUMENT...\n"
        "Canned light sources: bake a lamp once, reuse its light in any scene.\n\n",
        out);
  for (int k = 0; k < COMMANDS; ++k)
    fprintf(out, "  %-10s%s\n", commands[k].name, commands[k].help);
  fputs("  help      this text, or `bakeslab help COMMAND` for one command\n"
        "\n"
        "  --help, --version\n"
        "\n"
        "Examples:\n"
        "  bakeslab bake lamps/parabolic.pov -o lamp.tif\n"
        "  bakeslab info lamp.tif\n"
        "  bakeslab include lamp.tif -o lamp.inc\n"
        "\n"
        "Exit status: 0 done, 1 failed, 2 usage; diff: 0 same, 1 differ, 2 trouble.\n",
        out);
}

static const struct command *find_command(const char *name) {
  for (int k = 0; k < COMMANDS; ++k)
    if (!strcmp(commands[k].name, name)) return &commands[k];
  return NULL;
}

static int unknown(const char *name) {
  cli_complain("%s: no such command; see bakeslab --help", name);
  return CLI_USAGE;
}

/* argp names the program by argv[0], so that usage lines say "bakeslab info". */
static int run_command(const struct command *command, int argc, char **argv) {
  char name[64];
  snprintf(name, sizeof name, "bakeslab %s", command->name);
  argv[0] = name;
  return command->run(argc, argv);
}

static int run_help(int argc, char **argv) {
  if (argc < 3) {
    print_help(stdout);
    return cli_close_stdout();
  }
  const struct command *command = find_command(argv[2]);
  if (!command) return unknown(argv[2]);
  char option[] = "--help";
  char *help_argv[] = {argv[0], option, NULL};
  return run_command(command, 2, help_argv);
}

int main(int argc, char **argv) {
  atexit(cli_check_stdout_at_exit);
  argp_err_exit_status = CLI_USAGE;
  argp_program_version = "bakeslab " BAKESLAB_VERSION;
  cli_set_command_line(argc, argv);
  if (argc < 2) {
    print_help(stderr);
    return CLI_USAGE;
  }
  const char *name = argv[1];
  if (!strcmp(name, "help") || !strcmp(name, "--help") || !strcmp(name, "-?"))
    return run_help(name[0] == '-' ? 1 : argc, argv);
  if (!strcmp(name, "--version") || !strcmp(name, "-V")) {
    puts(argp_program_version);
    return cli_close_stdout();
  }
  const struct command *command = find_command(name);
  if (!command) return unknown(name);
  return run_command(command, argc - 1, argv + 1);
}
