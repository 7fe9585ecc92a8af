/* include_own_error.c - see include_own_error.h. */
#include "include/text/include_own_error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "file/slab_json.h"
#include "include/text/include_lamp.h"
#include "slab/plane.h"
#include "slab/slab_accuracy.h"

/* One number for each distance. */
static void print_part(const char *name, const double part[SLAB_ACCURACY_DISTANCES], FILE *out) {
  fputs(name, out);
  for (int d = 0; d < SLAB_ACCURACY_DISTANCES; ++d)
    if (isfinite(part[d]))
      fprintf(out, "%s %.2g %%", d ? "," : "", 100 * part[d]);
    else
      fprintf(out, "%s unknown", d ? "," : "");
}

/* The parts, and all of them with the lights'. */
static void print_parts(const struct slab_accuracy accuracy[SLAB_ACCURACY_DISTANCES],
                        const double lights[SLAB_ACCURACY_DISTANCES], FILE *out) {
  double noise[SLAB_ACCURACY_DISTANCES], resolution[SLAB_ACCURACY_DISTANCES];
  double logluv[SLAB_ACCURACY_DISTANCES], all[SLAB_ACCURACY_DISTANCES];
  for (int d = 0; d < SLAB_ACCURACY_DISTANCES; ++d) {
    noise[d] = accuracy[d].noise;
    resolution[d] = accuracy[d].resolution;
    logluv[d] = accuracy[d].logluv;
    all[d] = hypot(accuracy[d].all, lights[d]);
  }
  print_part("\n//     noise", noise, out);
  print_part("; resolution", resolution, out);
  print_part(";\n//     LogLuv", logluv, out);
  print_part("; lights", lights, out);
  print_part(";\n//     all, with the lights':", all, out);
}

static enum result print_page(const struct slab *slab, int number,
                              const double lights[SLAB_ACCURACY_DISTANCES], FILE *out,
                              struct error *error) {
  struct slab_sampling sampling;
  struct slab_accuracy all[SLAB_ACCURACY_DISTANCES];
  enum result result = slab_json_sampling(slab, &sampling, error);
  if (result == RESULT_OK) result = slab_accuracy_table(slab, &sampling, all, error);
  if (result != RESULT_OK) return result;
  fprintf(out, "%s//   page %d: ", number > 1 ? "\n" : "", number);
  if (isnan(all[0].all)) {
    fputs("not known, too few samples", out);
    return RESULT_OK;
  }
  fputs(isnan(all[0].st) || isnan(all[0].uv) ? "at least " : "about ", out);
  for (int d = 0; d < SLAB_ACCURACY_DISTANCES; ++d)
    fprintf(out, "%s%.2g %% at %g", d ? ", " : "", 100 * all[d].all,
            all[d].distance / plane_width(slab));
  if (isnan(all[0].noise)) fputs("; its noise is not known", out);
  print_parts(all, lights, out);
  return RESULT_OK;
}

enum result include_own_error(const struct slab *slabs, int count, include_lights_error *lights,
                              const void *of, char **text, struct error *error) {
  size_t size = 0;
  int number = 0;
  *text = NULL;
  FILE *stream = open_memstream(text, &size);
  if (!stream) return result_no_memory(error);
  enum result result = RESULT_OK;
  for (int k = 0; k < count && result == RESULT_OK; ++k) {
    double by_lights[SLAB_ACCURACY_DISTANCES];
    if (!(include_peak(&slabs[k]) > 0)) continue;
    lights(of, number, by_lights);
    result = print_page(&slabs[k], ++number, by_lights, stream, error);
  }
  if (fclose(stream) != 0 || !*text) /* glibc's fclose may lose the text without a word */
    result = result_no_memory(error);
  return result;
}
