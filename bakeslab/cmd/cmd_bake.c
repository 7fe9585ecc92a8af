/* cmd_bake.c - bakeslab bake: a lamp script becomes a light slab. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#include "bake/bake.h"
#include "cmd/slab_options.h"
#include "lamp/lamp.h"

static volatile sig_atomic_t stop, timed_out;

static void on_signal(int number) {
  if (number == SIGALRM) timed_out = 1;
  stop = 1;
}

static const char *lamp; /* that is being baked */

static void warn(const char *line) {
  cli_complain("%s: warning: %s", lamp, line);
}

static void tell_plan(const char *line) {
  cli_note("%s: plan: %s", lamp, line);
}

struct arguments {
  struct bake_options bake;
  double timeout; /* seconds; 0: none */
  const char *libraries[LAMP_MAX_LIBRARIES + 1];
  int library_count;
};

#define BAKE(member) offsetof(struct arguments, bake.member)
#define KEY(member) VALUE_KEY(struct arguments, bake.member)

static const struct argp_option options[] = {
    {0, 'o', "SLAB", 0, "the slab to write: .tif (LogLuv unless --precision is given) or .exr", 1},
    {"uv", KEY(uv), "NxM", 0, "positions on the aperture (default 16x16)", 1},
    {"st", KEY(st), "NxM", 0, "directions at each position (default 64x64)", 1},
    {"precision", KEY(precision), CLI_PRECISIONS, 0, "number format of the samples", 1},
    {"rays", KEY(rays), "K", 0,
     "rays a sample, on average: 1 or an even number (default: as --noise asks for, at most 8, "
     "or 16 with --tolerance). A sample is the mean over its 4D cell. With more than 4, a first "
     "ray looks for light everywhere: a beam as wide as a sample is found, of a thinner one the "
     "part that it fills. Others follow around what was found, and most where these are noisy",
     2},
    {"rays-max", KEY(rays_max), "K", 0,
     "the most rays for a sample (default 4 x --rays, or 16 x where --noise decides)", 2},
    {"noise", KEY(noise), "T", 0,
     "shoot no more rays than it takes for noise of T in irradiance at --for-distance (relative "
     "RMS; default: a quarter of the error by the number of samples, or a third of --tolerance, "
     "and a flux known to 0.4 %). With --rays alone, all of those are shot",
     2},
    {"uniform", KEY(uniform), 0, 0,
     "the same number of rays for all samples, at the same places of their cells", 2},
    {"centre", KEY(centre), 0, 0,
     "one ray through the centre of each sample: fast, but fine parts of a lamp alias", 2},
    {"effects", KEY(effects), "auto|probe|all|none|LIST", 0,
     "which of interreflection, caustics, extended_source and deep_trace to simulate. probe: "
     "those that short test bakes show to matter. auto (the default): those of the lamp's "
     "Canned_Needs; without it, probe. A number says how far to go: interreflection=4 bounces, "
     "caustics=100000 photons, extended_source=9 lights a side, deep_trace=60 levels",
     3},
    {"effect-threshold", KEY(effect_threshold), "X", 0,
     "an effect matters if it changes the flux by more than this part of it, or the light by "
     "direction or position by twice that, in RMS (default 0.01)",
     3},
    {"window", KEY(window), "declared|narrowed|auto", 0,
     "narrowed (the default): a large slab's st windows that are much wider than the light are "
     "fitted to it, so that samples lie where they are needed. auto: all are, and become wider "
     "than the script declares if light is there, unless it says Canned_Window_Is_Final",
     3},
    {"tolerance", KEY(tolerance), "T", 0,
     "choose the fewest samples for which the error of irradiance is at most T (relative RMS) at "
     "--for-distance and beyond; --uv and --st, where given, stay",
     3},
    {"for-distance", KEY(for_distance), "D", 0,
     "distance of the nearest surface that is lit, in lamp units (default 4 apertures); sets "
     "--tolerance 0.01 if none is given. The st plane is put there if that needs fewer samples",
     3},
    {"gain", KEY(gain), "2^N", 0,
     "factor by which POV-Ray renders brighter, undone in the slab; its pictures hold radiance "
     "up to 65504 (default: chosen by a trial run)",
     3},
    {"camera", KEY(form), "mesh|perspective|transposed", 0,
     "what POV-Ray renders: many views in an image, one view a frame, or one direction a frame "
     "(default: the fastest)",
     3},
    {"jobs", 'j', "N", 0, "POV-Ray processes at a time (default: one a processor)", 4},
    {"shard", KEY(shard), "K/N", 0,
     "bake only part K of N (from 1) into SLAB.partial; a run without --shard bakes what is "
     "missing and writes the slab. For machines that share no folder: those that do need no shards",
     4},
    {"round", KEY(wave), "all|pilot|rest|next", 0,
     "which rounds a shard bakes: the pilot, by which the rest is planned; the rest, once all "
     "shards' pilots are in SLAB.partial (bakeslab gather); next: what SLAB.partial calls for, so "
     "that any number of waves are alike; or all (the default), for which each shard bakes the "
     "whole pilot itself",
     4},
    {"povray", KEY(povray), "PROGRAM", 0, "the POV-Ray to run (default povray)", 4},
    {"sandbox", KEY(sandbox), 0, 0,
     "run POV-Ray in a sandbox (bubblewrap): it can read files, but write only to its working "
     "folder, and has no network",
     4},
    {"dry-run", KEY(dry_run), 0, 0,
     "tell samples, rays, and estimates, and stop there: the time to wait for the slab, if the "
     "machine does nothing else, memory, and file size. Small bakes that this takes stay in "
     "SLAB.partial for the bake itself",
     4},
    {"yes", KEY(ask), 0, 0, "begin a bake of more than an hour on a terminal too", 4},
    {"strict", KEY(strict), 0, 0,
     "take a warning for a failure: no slab is written, and the exit status is 1. What is baked "
     "stays in SLAB.partial; without --strict the same command writes the slab from there",
     4},
    {"timeout", VALUE_KEY(struct arguments, timeout), "SECONDS", 0,
     "give up after this time, as for a script that does not end; finished batches stay in "
     "SLAB.partial",
     4},
    {"depend", KEY(depend), "FILE", 0,
     "write a rule for make: SLAB depends on every file that the script reads (as gcc's -MD -MF "
     "FILE -MP); with --dry-run, too",
     4},
    {0, 'L', "FOLDER", 0, "where the script finds files to include; may be repeated", 4},
    {0}};

static const char usage[] = "LAMP.pov -o SLAB";
static const char doc[] =
    "Renders a lamp script with POV-Ray into a light slab.\v"
    "The script declares its slabs with the macros of canned.inc, which bakeslab finds by itself. "
    "Effects that it does not declare are chosen by short test bakes; so are the window with "
    "--window auto and the number of samples with --tolerance. Finished batches are kept in "
    "SLAB.partial until the slab is written: after Ctrl-C, a crash or a full disk, run the same "
    "command again to go on from there. Where the script parts its bulbs into channels "
    "(Canned_Channel), the slab has each page once for each of them, and scenes dim them apart.\n"
    "\n"
    "Any number of processes with the same command, on one machine or on several that share the "
    "folder, by NFS too, help each other: each batch is baked by one of them, what a dead one had "
    "in "
    "hand is taken over (at once on its own machine, else after a minute), who comes late helps, "
    "and "
    "one writes the slab, for which the others wait. `bakeslab status` tells how far they are. "
    "Machines without a common folder bake --shard K/N, in waves by --round, and `bakeslab gather` "
    "brings their folders together.\n"
    "\n"
    "The samples are the same, bit for bit, for any --jobs and --shard. With --uniform or "
    "--centre they are the same for any --camera too. Otherwise each view, or with transposed "
    "each direction, has its own offsets of rays: mesh and perspective give the same samples, "
    "transposed gives others. With interreflection each --camera gives slightly other samples, "
    "since it is sampled anew in each batch.\n"
    "\n"
    "A lamp script is a program that POV-Ray runs with your permissions. With --sandbox it can "
    "read what you can read, but it cannot change files or use the network.\n"
    "\n"
    "Examples:\n"
    "  bakeslab bake parabolic.pov -o parabolic.tif\n"
    "  bakeslab bake lamp.pov -o draft.tif --uv 8 --st 32 --rays 4 --effects none\n"
    "  bakeslab bake lamp.pov -o fine.tif --st 128 --rays 64 --jobs 8\n"
    "  bakeslab bake lamp.pov -o lamp.tif --effects probe --window auto \\\n"
    "    --tolerance 0.02\n"
    "  for k in 1 2 3; do bakeslab bake lamp.pov -o big.tif --jobs 1 & done; wait\n";

static void parse_shard(struct argp_state *state, const char *text, struct bake_options *bake) {
  int k, n, used = 0;
  if (sscanf(text, "%d/%d%n", &k, &n, &used) != 2 || text[used] || n < 1 || k < 1 || k > n)
    argp_error(state, "--shard %s: not a part such as 1/4", text);
  bake->shard = k - 1;
  bake->shards = n;
}

static double parse_gain(struct argp_state *state, const char *text) {
  const char *number = strncmp(text, "2^", 2) ? text : text + 2;
  char *end;
  int exponent;
  double gain = strtod(number, &end);
  if (number != text) gain = exp2(gain);
  if (*end || end == number || !(gain >= 0x1p-100 && gain <= 0x1p100) ||
      frexp(gain, &exponent) != 0.5)
    argp_error(state, "--gain %s: not a power of two such as 2^-8 or 0.125", text);
  return gain;
}

static const struct value values[] = {
    {'o', VALUE_TEXT, BAKE(output), 0, 0},
    {KEY(uv), VALUE_SIZE, BAKE(uv), 0, 0},
    {KEY(st), VALUE_SIZE, BAKE(st), 0, 0},
    {KEY(precision), VALUE_WORD, BAKE(precision), SLAB_PRECISION_LOGLUV, 0},
    {KEY(rays), VALUE_WHOLE, BAKE(rays), 1, 4096},
    {KEY(rays_max), VALUE_WHOLE, BAKE(rays_max), 1, 65536},
    {KEY(noise), VALUE_POSITIVE, BAKE(noise), 0, 0},
    {KEY(uniform), VALUE_FLAG, BAKE(uniform), 0, 0},
    {KEY(centre), VALUE_FLAG, BAKE(centre), 0, 0},
    {KEY(effects), VALUE_TEXT, BAKE(effects), 0, 0},
    {KEY(effect_threshold), VALUE_POSITIVE, BAKE(effect_threshold), 0, 0},
    {KEY(window), VALUE_WORD, BAKE(window), BAKE_WINDOW_DECLARED, 0},
    {KEY(tolerance), VALUE_POSITIVE, BAKE(tolerance), 0, 0},
    {KEY(for_distance), VALUE_POSITIVE, BAKE(for_distance), 0, 0},
    {KEY(form), VALUE_WORD, BAKE(form), 0, 0},
    {'j', VALUE_WHOLE, BAKE(jobs), 1, 1024},
    {KEY(povray), VALUE_TEXT, BAKE(povray), 0, 0},
    {KEY(wave), VALUE_WORD, BAKE(wave), BAKE_WAVE_ALL, 0},
    {KEY(sandbox), VALUE_FLAG, BAKE(sandbox), 0, 0},
    {KEY(dry_run), VALUE_FLAG, BAKE(dry_run), 0, 0},
    {KEY(strict), VALUE_FLAG, BAKE(strict), 0, 0},
    {VALUE_KEY(struct arguments, timeout), VALUE_POSITIVE, offsetof(struct arguments, timeout), 0,
     0},
    {KEY(depend), VALUE_TEXT, BAKE(depend), 0, 0},
    {0}};

static error_t parse_option(int key, char *text, struct argp_state *state) {
  struct arguments *arguments = state->input;
  struct bake_options *bake = &arguments->bake;
  switch (key) {
  case KEY(gain):
    bake->gain = parse_gain(state, text);
    return 0;
  case KEY(ask):
    bake->ask = false;
    return 0;
  case KEY(shard):
    parse_shard(state, text, bake);
    return 0;
  case 'L':
    if (arguments->library_count == LAMP_MAX_LIBRARIES) argp_error(state, "too many -L");
    arguments->libraries[arguments->library_count++] = text;
    return 0;
  case ARGP_KEY_ARG:
    if (bake->lamp) argp_error(state, "%s: one lamp script at a time", text);
    bake->lamp = text;
    return 0;
  case ARGP_KEY_END:
    if (!bake->lamp) argp_error(state, "give a lamp script");
    if (!bake->output) argp_error(state, "give -o SLAB");
    if (bake->wave != BAKE_WAVE_ALL && bake->shards == 1)
      argp_error(state, "--round: only with --shard K/N, of more than one");
    return 0;
  default:
    return values_take(values, options, key, text, arguments, state);
  }
}

/* What only the options together can tell. */
static bool check_rays(struct bake_options *bake) {
  if (bake->centre && bake->rays == 0) bake->rays = 1;
  if (bake->rays > 0 && bake->noise == 0) bake->noise = NAN;
  bool tolerance = bake->tolerance > 0 || bake->for_distance > 0; /* chooses few samples */
  if (bake->rays == 0) bake->rays = bake->noise > 0 ? 64 : tolerance ? 16 : 8;
  if (bake->centre && bake->rays != 1) {
    cli_complain("--centre: shoots one ray a sample; leave --rays out");
    return false;
  }
  if (bake->rays > 1 && bake->rays % 2) {
    cli_complain("--rays %d: not 1 or an even number (rays come in pairs)", bake->rays);
    return false;
  }
  if (bake->rays_max == 0) bake->rays_max = (isnan(bake->noise) ? 4 : 16) * bake->rays;
  if (bake->rays_max < bake->rays || bake->rays_max % 2 > bake->rays % 2) {
    cli_complain("--rays-max %d: not an even number that is at least --rays (%d)", bake->rays_max,
                 bake->rays);
    return false;
  }
  return true;
}

/* A tolerance finds what neither --uv nor --st fixes. */
static void set_sizes(struct bake_options *bake) {
  if (bake->for_distance > 0 && bake->tolerance == 0) bake->tolerance = 0.01;
  if (bake->noise == 0) bake->noise = bake->tolerance / 3;
  bake->uv_free = bake->uv[0] == 0;
  bake->st_free = bake->st[0] == 0;
  for (int k = 0; k < 2; ++k) {
    if (bake->uv_free) bake->uv[k] = 16;
    if (bake->st_free) bake->st[k] = 64;
  }
}

/* A shard is done, or has to wait for others. */
static void report_shard(const struct bake_options *bake, const struct bake_report *report) {
  int k = bake->shard + 1, n = bake->shards;
  if (report->waits)
    fprintf(
        stderr,
        "%s: shard %d/%d of pilot %d is done; bring the folders of all shards together (bakeslab "
        "gather), and go on with --round %s\n",
        bake->output, k, n, report->pilot,
        bake->wave == BAKE_WAVE_NEXT ? "next"
        : report->more_pilots        ? "pilot again"
                                     : "rest");
  else if (bake->wave == BAKE_WAVE_PILOT)
    fprintf(stderr, "%s: the pilot is whole; go on with --shard %d/%d --round rest\n", bake->output,
            k, n);
  else
    fprintf(stderr, "%s: shard %d/%d is done; the run without --shard assembles the slab\n",
            bake->output, k, n);
}

static void report_done(const struct bake_options *bake, const struct bake_report *report) {
  if (report->assembled && bake->tolerance > 0)
    cli_note("%s: note: the slab's own error is about %.2g (tolerance %g)", bake->output,
             report->error, bake->tolerance);
  if (report->highlights)
    cli_note("%s: note: highlights (specular, phong) are no light, and are left out", bake->lamp);
  if (report->assembled) cli_note("%s: note: %s", bake->output, report->energy);
  if (bake->quiet || bake->dry_run) return;
  if (report->probe_cpu > 0)
    fprintf(stderr, "%s: small bakes before it took %.1f CPU s\n", bake->output, report->probe_cpu);
  if (report->assembled)
    fprintf(stderr, "%s: %d batches, %d of them found finished; %.3g rays, %.1f CPU s of POV-Ray\n",
            bake->output, report->batches, report->found, report->rays, report->cpu);
  else if (report->by_others)
    fprintf(stderr,
            "%s: was written by another bake of it; %.3g rays, %.1f CPU s of POV-Ray here\n",
            bake->output, report->rays, report->cpu);
  else
    report_shard(bake, report);
}

static void set_signals(double timeout) {
  const struct sigaction action = {.sa_handler = on_signal};
  struct sigaction hangup;
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
  sigaction(SIGALRM, &action, NULL);
  sigaction(SIGHUP, NULL, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, NULL); /* nohup stays in force */
  if (!(timeout > 0 && timeout < 1e9)) return;
  double whole = floor(timeout);
  const struct itimerval timer = {
      .it_value = {(time_t)whole, (suseconds_t)fmax(999999 * (timeout - whole), whole == 0)}};
  setitimer(ITIMER_REAL, &timer, NULL);
}

int cmd_bake(int argc, char **argv) {
  long processors = sysconf(_SC_NPROCESSORS_ONLN);
  struct arguments arguments = {.bake = {.povray = "povray",
                                         .effects = "auto",
                                         .effect_threshold = 0.01,
                                         .form = -1,
                                         .window = BAKE_WINDOW_NARROWED,
                                         .jobs = processors > 0 ? (int)processors : 1,
                                         .shards = 1,
                                         .warn = warn,
                                         .ask = isatty(STDERR_FILENO) != 0,
                                         .command = cli_command_line()}};
  struct bake_options *bake_options = &arguments.bake;
  static const struct argp argp = {options, parse_option, usage, doc, cli_options, NULL, NULL};
  cli_parse(&argp, argc, argv, &arguments);
  bake_options->libraries = arguments.libraries;
  bake_options->quiet = cli_quiet();
  lamp = bake_options->lamp;
  if ((bake_options->dry_run || isatty(STDERR_FILENO)) && !cli_quiet())
    bake_options->tell_plan = tell_plan;
  if (!check_rays(bake_options)) return CLI_USAGE;
  set_sizes(bake_options);
  set_signals(arguments.timeout);
  struct error error = {""};
  struct bake_report report;
  enum result result = bake(bake_options, &stop, &report, &error);
  if (result == RESULT_STOPPED && timed_out)
    result_at(result, &error, "%s: not done within --timeout %g", lamp, arguments.timeout);
  if (result == RESULT_OK) report_done(bake_options, &report);
  return cli_end(result, &error);
}
