/* ways_write.c - the advice in words, and the table of all ways. */
#include <math.h>
#include <string.h>

#include "base/sdl.h"
#include "tradeoff/ways.h"

static const char *const renderers[] = {"POV-Ray", "renderslab"};

/* ---- Words ---- */

/* As the command line wants it, with its seconds. */
static void say_bake(FILE *file, const struct ways_bake *bake) {
  if (bake->rays > 0)
    fprintf(file, "bake --uv %d --st %d --rays %d (%.3g s, %.2g MB), ", bake->uv, bake->st,
            bake->rays, bake->cpu, bake->bytes / 1e6);
  else
    fprintf(file, "the slab (%.2g MB), ", bake->bytes / 1e6);
}

static void say_whole(FILE *file, const struct ways *ways, const struct ways_advice *advice) {
  const struct ways_lamp *best = ways->lamp_count ? &ways->lamp[ways->lamp_count - 1] : NULL;
  const char *about = advice->reckoned ? "about " : "";
  if (advice->pays_from > 0)
    fprintf(file, "; cheaper than the whole lamp (%s%.4g s) from picture %d on", about,
            advice->whole, advice->pays_from);
  else if (advice->whole > 0)
    fprintf(file, "; the whole lamp is cheaper: %s%.2g s", about, advice->whole);
  else if (best)
    fprintf(file, "; the whole lamp still errs by %.3g %% in %.3g s", 100 * best->error, best->cpu);
}

static void say_way(FILE *file, const struct ways_settings *settings, const struct ways *ways,
                    const struct ways_advice *advice) {
  const struct ways_bake *bake = &ways->bakes[advice->bake];
  const struct ways_made *made = &ways->made[advice->bake][advice->picture];
  char name[WAYS_NAME];
  ways_name(bake, &ways_pictures[advice->picture], name);
  say_bake(file, bake);
  fputs(name, file);
  if (made->include_cpu > 0) fprintf(file, " (%.2g s)", made->include_cpu);
  fprintf(file, ", %.2g s a picture; the first after %.3g s, %s %.2g %% off", made->cpu,
          ways_first(ways, advice->bake, advice->picture),
          advice->missed ? "the closest that was tried:" : "tried:", 100 * made->measured);
  double cost = ways_cost(settings, ways, advice->bake, advice->picture);
  if (advice->best > 0 && advice->best < cost)
    fprintf(file, "; one of %d cheaper ways would do, for %.3g of the seconds", advice->cheaper,
            advice->best / cost);
  else if (advice->best > 0 && advice->cheaper > 0)
    fprintf(file, "; none of %d cheaper ways would do", advice->cheaper);
  else if (advice->best > 0)
    fputs("; nothing is cheaper", file);
}

static void say_rung(FILE *file, const char *before, const struct ways_settings *settings,
                     const struct ways *ways, int rung) {
  const struct ways_bake *reference = &ways->bakes[ways->bake_count - 1];
  double error = settings->errors[rung];
  char more[WAYS_NAME];
  if (error < reference->error) {
    ways_would_reach(ways, error, more);
    fprintf(file,
            "%sfor %g %% here: not known, since the reference itself errs by %.2g %%; a bake with "
            "%s would do\n",
            before, 100 * error, 100 * reference->error, more);
    return;
  }
  for (int renderer = 0; renderer < 2; ++renderer) {
    const struct ways_advice *advice = &ways->advice[rung][renderer];
    fprintf(file, "%sfor %g %% here, in %s: ", before, 100 * error, renderers[renderer]);
    if (advice->found) {
      say_way(file, settings, ways, advice);
      say_whole(file, ways, advice);
    } else if (advice->cheapest > 0) {
      fprintf(file, "nothing within %g s; the cheapest way takes %.3g s", settings->time_limit,
              advice->cheapest);
    } else {
      fputs("no way of those measured", file);
    }
    fputc('\n', file);
  }
}

void ways_say(FILE *file, const char *before, const struct ways_settings *settings,
              const struct ways *ways) {
  const struct ways_bake *reference = &ways->bakes[ways->bake_count - 1];
  fprintf(file, "%sreference: %s, %dx%d positions, %dx%d directions", before,
          reference->rays > 0 ? "the finest bake" : "the slab itself", reference->uv, reference->uv,
          reference->st, reference->st);
  if (reference->rays > 0) fprintf(file, ", %d rays a sample", reference->rays);
  fprintf(
      file,
      ", by renderslab's reference; it errs by about %.2g %% itself at %.3g lamp units, the mean "
      "distance of what is lit here",
      100 * reference->error, ways->distance);
  if (ways->doubt > 1)
    fprintf(file, " (it tells %.2g %%, but the bake before erred by %.2g times what it told)",
            100 * reference->told, ways->doubt);
  fputc('\n', file);
  for (int rung = 0; rung < settings->error_count; ++rung)
    say_rung(file, before, settings, ways, rung);
}

/* ---- The table ---- */

static const char columns[] = "way\tuv\tst\trays\tbytes\tbake_cpu\tinclude_cpu\tpicture_cpu\tfirst_"
                              "cpu\tslab_told\tslab_error\t"
                              "picture_error\tpredicted\tmeasured\tadvised\n";

static const char *const explained[] = {
    "errors: RMS over mean of the pixels that show a surface, against the reference's",
    "cpu: seconds, of all processes: of the bake, the include, a picture; first_cpu: their sum",
    "slab_told: the slab's own error as it tells itself; slab_error: that of its picture by",
    "  renderslab's reference; picture_error: of the include or method, against its slab's picture",
    "  by reference; predicted: the root of the sum of both squares; measured: - if not tried",
    "whole lamp: POV-Ray with the lamp itself; rays: those that gather at a point, or",
    "  photons / 1000"};

static void print_number(FILE *file, bool there, double number) {
  if (there)
    fprintf(file, "%.4g\t", number);
  else
    fputs("-\t", file);
}

/* The rungs for which it is advised, in percent. */
static void print_advised(FILE *file, const struct ways_settings *settings, const struct ways *ways,
                          int bake, int picture) {
  const char *between = "";
  for (int rung = 0; rung < settings->error_count; ++rung) {
    const struct ways_advice *advice = &ways->advice[rung][!ways_in_povray(picture)];
    if (!advice->found || advice->bake != bake || advice->picture != picture) continue;
    fprintf(file, "%s%g%%", between, 100 * settings->errors[rung]);
    between = ",";
  }
  fputs(*between ? "\n" : "-\n", file);
}

static void print_way(FILE *file, const struct ways_settings *settings, const struct ways *ways,
                      int number, int picture) {
  const struct ways_bake *bake = &ways->bakes[number];
  const struct ways_made *made = &ways->made[number][picture];
  char name[WAYS_NAME];
  ways_name(bake, &ways_pictures[picture], name);
  fprintf(file, "%s\t%d\t%d\t", name, bake->uv, bake->st);
  print_number(file, bake->rays > 0, bake->rays);
  fprintf(file, "%.0f\t%.4g\t%.4g\t%.4g\t%.4g\t%.4g\t%.4g\t%.4g\t%.4g\t", bake->bytes, bake->cpu,
          made->include_cpu, made->cpu, ways_first(ways, number, picture), bake->told, bake->error,
          made->error, made->predicted);
  print_number(file, made->tried, made->measured);
  print_advised(file, settings, ways, number, picture);
}

void ways_print(FILE *file, const struct ways_settings *settings, const struct ways *ways) {
  fputs("# What accuracy costs from the lamp to the picture, by renderslab tradeoff.\n# command: ",
        file);
  sdl_comment(settings->command, file);
  fprintf(file, "\n# picture: %dx%d, of which %zu pixels show a surface\n", ways->pixels.width,
          ways->pixels.height, ways->pixels.count);
  fprintf(file, "# POV-Ray starts in %.2g CPU seconds; a way pays for %d picture%s\n", ways->start,
          settings->pictures, settings->pictures > 1 ? "s" : "");
  ways_say(file, "# ", settings, ways);
  if (*ways->lamp_refusal) {
    fputs("# left out: the whole lamp: ", file);
    sdl_comment(ways->lamp_refusal, file);
    fputc('\n', file);
  }
  for (size_t k = 0; k < sizeof explained / sizeof *explained; ++k)
    fprintf(file, "# %s\n", explained[k]);
  fputs(columns, file);
  for (int picture = 0; picture < WAYS_PICTURES; ++picture)
    for (int bake = 0; bake < ways->bake_count; ++bake)
      if (!ways->made[bake][picture].refused) print_way(file, settings, ways, bake, picture);
  for (int k = 0; k < ways->lamp_count; ++k)
    fprintf(file, "whole lamp\t-\t-\t%d\t-\t0\t0\t%.4g\t%.4g\t-\t0\t%.4g\t%.4g\t%.4g\t-\n",
            ways->lamp[k].rays, ways->lamp[k].cpu, ways->lamp[k].cpu, ways->lamp[k].error,
            ways->lamp[k].error, ways->lamp[k].error);
}
