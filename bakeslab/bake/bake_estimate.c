/* bake_estimate.c - see bake_estimate.h.
 *
 * 1. Two small bakes of different numbers of rays give the CPU time of a process before its first
 *    ray (parsing, photons, most of radiosity's samples) and of each ray.
 * 2. The batches are as full as bake_plan.c makes them.
 * 3. Memory is that of the sums (bake_sum.c) and the samples, and of POV-Ray for each job. */
#include "bake/bake_estimate.h"

#include <math.h>
#include <stdio.h>

#include "file/slab_file.h"
#include "probe/probe_bake.h"

enum { SUM_BYTES = 60, BATCH_RAYS = 1 << 20 };
static const double program_bytes = 10e6, povray_bytes = 60e6, povray_ray_bytes = 45,
                    idle_seconds = 0.5;

static enum result measure(const struct bake_work *work, int directions, double *cpu, double *rays,
                           struct bake_report *report, struct error *error) {
  const int samples[SLAB_AXES] = {4, 4, directions, directions};
  struct probe_bake bake = {0};
  enum result result =
      probe_bake(work, work->slabs, work->look.effects, samples, 2, &bake, report, error);
  *cpu = bake.cpu;
  probe_bake_free(&bake);
  *rays = 2.0 * 16 * directions * directions * work->lamp->slab_count;
  return result;
}

enum result bake_estimate(const struct bake_work *work, struct bake_estimate *estimate,
                          struct bake_report *report, struct error *error) {
  const struct bake_options *options = work->options;
  double cpu[2], rays[2];
  *estimate = (struct bake_estimate){0};
  for (int n = 0; n < work->lamp->slab_count; ++n)
    estimate->samples += (double)slab_sample_count(&work->slabs[n]);
  estimate->rays = estimate->samples * options->rays;
  enum result result = measure(work, 16, &cpu[0], &rays[0], report, error);
  if (result == RESULT_OK) result = measure(work, 64, &cpu[1], &rays[1], report, error);
  if (result != RESULT_OK) return result;
  double per_ray = fmax(0, (cpu[1] - cpu[0]) / (rays[1] - rays[0]));
  double first = fmax(0, cpu[0] - per_ray * rays[0]);
  double batches = ceil(estimate->rays / BATCH_RAYS), jobs = fmin(options->jobs, batches);
  estimate->seconds =
      (batches * (first + idle_seconds) + estimate->rays * per_ray) / jobs / options->shards;
  estimate->memory = program_bytes + SUM_BYTES * estimate->samples +
                     jobs * (povray_bytes + povray_ray_bytes * fmin(BATCH_RAYS, estimate->rays));
  enum slab_precision precision = slab_file_precision_of(options->output, options->precision);
  estimate->bytes = estimate->samples * (precision == SLAB_PRECISION_LOGLUV ? 1
                                         : precision == SLAB_PRECISION_HALF ? 4
                                                                            : 8);
  return RESULT_OK;
}

void bake_estimate_say(const struct bake_work *work, const struct bake_estimate *estimate,
                       const char *why, char line[BAKE_ESTIMATE_LINE]) {
  const int *n = work->slabs[0].samples;
  char time[64];
  if (estimate->seconds < 120)
    snprintf(time, sizeof time, "some %.2g s", estimate->seconds);
  else if (estimate->seconds < 7200)
    snprintf(time, sizeof time, "some %.2g min", estimate->seconds / 60);
  else
    snprintf(time, sizeof time, "some %.2g h", estimate->seconds / 3600);
  snprintf(line, BAKE_ESTIMATE_LINE,
           "%d page%s of %d x %d x %d x %d samples (%s); %.3g rays; time %s with %d job%s, memory "
           "%.2g MB, file %.2g MB",
           work->lamp->slab_count, work->lamp->slab_count == 1 ? "" : "s", n[0], n[1], n[2], n[3],
           why, estimate->rays, time, work->options->jobs, work->options->jobs == 1 ? "" : "s",
           estimate->memory / 1e6, estimate->bytes / 1e6);
}
