/* tradeoff_write.c - the table of what accuracy costs, and its plot. */
#include <math.h>
#include <sys/resource.h>

#include "tradeoff/plot.h"
#include "tradeoff/tradeoff.h"

/* ---- The table ---- */

static const char *const explained[] = {
    "shadows: looked for in 1/N of the aperture's sides, their edges in 1/M: N/M",
    "cpu, wall: seconds of gathering for the whole picture: median, lowest, highest of the "
    "repeats; "
    "cpu of all threads",
    "rms: root mean square of the error over that of the reference",
    "max: largest error of a pixel, relative to its own light, or to 1/100 of the mean where it is "
    "darker",
    "sum_rms, sum_max: the same against a reference with the usual shadows: what the sum alone "
    "does",
    "predicted: the largest error that the method itself expects of its sum; - where it expects "
    "none",
    "microlights, nodes, shadow_rays: visited, evaluated, cast",
    "aids_bytes, aids_cpu: memory that the method adds to the slabs', and seconds to make it, once",
    "alike on all machines: rms, max, sum_rms, sum_max, predicted, microlights, nodes, "
    "shadow_rays, "
    "aids_bytes",
    "-: there is none"};

static const char columns[] =
    "method\ttolerance\tlevel\tshadows\tcpu\tcpu_low\tcpu_high\twall\twall_low\twall_"
    "high\trms\tmax\t"
    "sum_rms\tsum_max\tpredicted\tmicrolights\tnodes\tshadow_rays\taids_bytes\taids_cpu\n";

static size_t peak_memory(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return (size_t)usage.ru_maxrss * 1024;
}

/* A text in a comment: one line. */
static void print_line(FILE *file, const char *text) {
  for (; *text; ++text) fputc((unsigned char)*text < ' ' ? ' ' : *text, file);
  fputc('\n', file);
}

static void print_head(FILE *file, const struct tradeoff_settings *settings,
                       const struct tradeoff *tradeoff, const struct tradeoff_about *about) {
  fputs("# What accuracy costs in time, by renderslab tradeoff.\n# command: ", file);
  print_line(file, about->command);
  fprintf(file, "# picture: %dx%d, of which %zu pixels gather light\n", settings->shade.width,
          settings->shade.height, tradeoff->receivers);
  fprintf(file, "# reference: tolerance %g, ", tradeoff_truth);
  if (settings->gather.occlusion)
    fprintf(file, "shadows %d/%d", settings->gather.shadow_grid,
            TRADEOFF_FINER_SHADOWS * settings->gather.shadow_edge);
  else
    fputs("no shadows", file);
  fprintf(file,
          "; it took %.4g CPU seconds\n# threads: %d; repeats: %d, interleaved; what took over a "
          "second is not repeated\n",
          tradeoff->truth_cpu, settings->threads, settings->repeats);
  fprintf(file, "# memory: slabs %zu bytes; peak resident, with what all methods keep, %zu\n",
          about->slab_bytes, peak_memory());
  for (int k = 0; k < GATHER_METHODS; ++k) {
    if (!tradeoff->refusal[k][0]) continue;
    fprintf(file, "# left out: %s: ", gather_methods[k].name);
    print_line(file, tradeoff->refusal[k]);
  }
  for (size_t k = 0; k < sizeof explained / sizeof *explained; ++k)
    fprintf(file, "# %s\n", explained[k]);
}

/* With so many digits; - where there is none. */
static void print_number(FILE *file, bool there, int digits, double number) {
  if (there)
    fprintf(file, "%.*g\t", digits, number);
  else
    fputs("-\t", file);
}

static void print_setting(FILE *file, const struct tradeoff_settings *settings,
                          const struct tradeoff_rung *rung) {
  fprintf(file, "%s\t", gather_methods[rung->method].name);
  print_number(file, rung->tolerance > 0, 3, rung->tolerance);
  if (rung->level == -1)
    fputs("auto\t", file);
  else
    print_number(file, rung->level != TRADEOFF_NO_LEVEL, 3, rung->level);
  if (settings->gather.occlusion)
    fprintf(file, "%d/%d\t", rung->shadow_grid, rung->shadow_edge);
  else
    fputs("-\t", file);
}

static void print_rung(FILE *file, const struct tradeoff_rung *rung,
                       const struct tradeoff_prepared *prepared) {
  const struct gather_counts *counts = &rung->counts;
  fprintf(file, "%.4g\t%.4g\t%.4g\t%.4g\t%.4g\t%.4g\t", rung->cpu.middle, rung->cpu.low,
          rung->cpu.high, rung->wall.middle, rung->wall.low, rung->wall.high);
  fprintf(file, "%.4g\t%.4g\t", rung->error.rms, rung->error.most);
  print_number(file, !rung->shadows, 4, rung->sum.rms);
  print_number(file, !rung->shadows, 4, rung->sum.most);
  print_number(file, isfinite(counts->error), 4, counts->error);
  fprintf(file, "%llu\t%llu\t%llu\t%zu\t%.4g\n", (unsigned long long)counts->microlights,
          (unsigned long long)counts->nodes, (unsigned long long)counts->shadow_rays,
          prepared->bytes, prepared->cpu);
}

void tradeoff_print(FILE *file, const struct tradeoff_settings *settings,
                    const struct tradeoff *tradeoff, const struct tradeoff_about *about) {
  print_head(file, settings, tradeoff, about);
  fputs(columns, file);
  for (int k = 0; k < tradeoff->count; ++k) {
    const struct tradeoff_rung *rung = &tradeoff->rungs[k];
    if (rung->refused) continue;
    print_setting(file, settings, rung);
    print_rung(file, rung, &tradeoff->prepared[rung->method]);
  }
}

/* ---- The plot ---- */

/* Its lines: the methods, and one more for auto with other shadows. */
enum { SHADOWS = GATHER_METHODS, LINES };

/* Errors below that are drawn as that: on a logarithmic axis zero has no place. */
static const double exact = 1e-8;

/* A line in the order of its settings; levels by solid angle are a point apart. Returns
 * whether there is any. */
static bool print_points(FILE *file, const struct tradeoff *tradeoff, int line) {
  bool any = false;
  for (int k = 0; k < tradeoff->count; ++k) {
    const struct tradeoff_rung *rung = &tradeoff->rungs[k];
    int its = rung->shadows ? SHADOWS : (int)rung->method;
    if (its != line || rung->refused) continue;
    if (!any) fprintf(file, "$line%d << END\n", line);
    if (rung->level == -1) fputc('\n', file);
    fprintf(file, "%.6g %.6g\n", rung->cpu.middle, fmax(rung->error.rms, exact));
    any = true;
  }
  if (any) fputs("END\n", file);
  return any;
}

void tradeoff_plot(FILE *file, const struct tradeoff *tradeoff,
                   const struct tradeoff_about *about) {
  static const char *const colours[] = {"#d62728", "#1f77b4", "#7f7f7f", "#ff7f0e", "#2ca02c",
                                        "#9467bd", "#8c564b", "#17becf", "#444444", "#e377c2"};
  enum { COLOURS = sizeof colours / sizeof *colours };
  bool drawn[LINES];
  for (int k = 0; k < LINES; ++k) drawn[k] = print_points(file, tradeoff, k);
  fputs("set logscale xy\nset format y '10^{%T}'\nset format x '%g'\nset grid\n"
        "set key outside right noenhanced\nset xlabel 'CPU seconds'\n"
        "set ylabel 'relative error of the picture (RMS; 10^{-8}: that or less)'\n"
        "set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\nset title ",
        file);
  plot_quote(file, about->mesh);
  fputs(" noenhanced\nplot ", file);
  const char *between = "";
  for (int k = 0; k < LINES; ++k) {
    if (!drawn[k]) continue;
    const char *title = k == SHADOWS ? "auto, other shadows" : gather_methods[k].name;
    fprintf(file, "%s$line%d with linespoints lw 2 pt %d ps 1.2 lc rgb '%s' title '%s'", between, k,
            k + 4, colours[k % COLOURS], title);
    between = ", ";
  }
  fputc('\n', file);
}
