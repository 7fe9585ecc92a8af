/* bake_estimate.c - see bake_estimate.h.
 *
 * 1. Two small bakes of different numbers of rays give the CPU time of a process before its first
 *    ray (parsing, photons, most of radiosity's samples) and of each ray.
 * 2. The time is that until the slab is there, on a machine that does nothing else: of the rounds'
 *    batches (bake_plan.h), as many at a time as there are jobs, and of the balance beside them
 *    (bake_energy.h). A process is idle for a while, and after each frame.
 * 3. Memory is that of the sums (bake_sum.c) and the samples, and of POV-Ray for each job.
 * 4. The small bakes, written as the slab will be, give the bytes of a row of t and of a sample:
 *    dark and smooth lamps are packed ten times as tight as noisy ones. */
#include "bake/bake_estimate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bake/bake_energy.h"
#include "base/files.h"
#include "batch/bake_rounds.h"
#include "file/slab_file.h"
#include "probe/probe_bake.h"

enum { SUM_BYTES = 80 };
/* Of the small bakes, along an axis: positions of the first, and of the second of a lamp of one
 * page; directions of both. A ray of the second costs about what one of the bake does: with fewer,
 * radiosity would take new samples for most of them. */
enum { FEW_POSITIONS = 4, MOST_POSITIONS = 8, FEW = 16, MANY = 64, PROBE_RAYS = 2 };
static const double program_bytes = 10e6, povray_bytes = 20e6, povray_ray_bytes = 45,
                    idle_seconds = 0.1, frame_seconds = 0.02;

/* The bytes of a view in a file of such pages. */
static enum result measure_bytes(const struct bake_work *work, const struct probe_bake *bake,
                                 double *bytes, struct error *error) {
  const char *output = work->options->output, *dot = strrchr(output, '.');
  char *scratch = NULL, *path = NULL;
  struct stat file;
  enum result result = bake_store_scratch(work->store, NULL, &scratch, error);
  if (result != RESULT_OK) goto out;
  path = files_join(scratch, dot && !strcasecmp(dot, ".exr") ? "slab.exr" : "slab.tif");
  result = path ? slab_file_write(path, bake->pages, bake->count, work->options->precision, error)
                : result_no_memory(error);
  if (result == RESULT_OK && stat(path, &file) != 0)
    result = result_fail(error, RESULT_IO, "%s: cannot read", path);
  if (result == RESULT_OK)
    *bytes = (double)file.st_size /
             ((double)slab_sample_count(bake->pages) /
              (bake->pages->samples[SLAB_S] * bake->pages->samples[SLAB_T])) /
             bake->count;
  files_remove_tree(scratch);
out:
  free(path);
  free(scratch);
  return result;
}

static enum result measure(const struct bake_work *work, int positions, int directions, double *cpu,
                           double *rays, double *bytes, struct bake_report *report,
                           struct error *error) {
  const int samples[SLAB_AXES] = {positions, positions, directions, directions};
  struct probe_bake bake = {0};
  enum result result =
      probe_bake(work, work->slabs, work->look.effects, samples, PROBE_RAYS, &bake, report, error);
  if (result == RESULT_OK) result = measure_bytes(work, &bake, bytes, error);
  *cpu = bake.cpu;
  probe_bake_free(&bake);
  *rays = PROBE_RAYS * pow((double)positions * directions, 2) * work->lamp->slab_count;
  return result;
}

/* Time and memory. The next process starts while the one before ends: there are two a job. */
static enum result estimate_time(const struct bake_work *work, const double cpu[2],
                                 const double rays[2], struct bake_estimate *estimate,
                                 struct error *error) {
  const struct bake_options *options = work->options;
  double per_ray = fmax(0, (cpu[1] - cpu[0]) / (rays[1] - rays[0]));
  double first = fmax(0, cpu[0] - per_ray * rays[0]), cores = (double)sysconf(_SC_NPROCESSORS_ONLN);
  int round[2] = {bake_rounds_first(work), 0}, balances;
  round[1] = work->effort.rays - round[0];
  estimate->memory = program_bytes + SUM_BYTES * estimate->samples;
  for (int n = 0; n < 2 && round[n] > 0; ++n) {
    struct bake_plan_size size;
    bake_plan_count(work->slabs, work->lamp->slab_count, round[n], work->look.form,
                    bake_rounds_are_dear(work), &size);
    double batches = size.batches, round_rays = estimate->samples * round[n];
    double jobs = fmin(options->jobs, batches);
    double time = (batches * first + round_rays * per_ray) / fmin(jobs, fmax(1, cores)) +
                  (batches * idle_seconds + size.frames * frame_seconds) / jobs;
    estimate->seconds += time / options->shards;
    estimate->memory = fmax(estimate->memory, program_bytes + SUM_BYTES * estimate->samples +
                                                  jobs * (fmin(2, batches / jobs) * povray_bytes +
                                                          povray_ray_bytes * size.largest));
  }
  double balance_rays;
  enum result result = bake_energy_cost(work, &balances, &balance_rays, error);
  estimate->seconds += (balances * (first + idle_seconds) + balance_rays * per_ray) /
                       fmin(options->jobs, fmax(1, cores));
  return result;
}

enum result bake_estimate(const struct bake_work *work, struct bake_estimate *estimate,
                          struct bake_report *report, struct error *error) {
  double cpu[2], rays[2], bytes[2];
  int positions =
      (int)fmax(FEW_POSITIONS, round(MOST_POSITIONS / sqrt((double)work->lamp->slab_count)));
  *estimate = (struct bake_estimate){0};
  for (int n = 0; n < work->lamp->slab_count; ++n)
    estimate->samples += (double)slab_sample_count(&work->slabs[n]);
  estimate->rays = estimate->samples * work->effort.rays;
  enum result result =
      measure(work, FEW_POSITIONS, FEW, &cpu[0], &rays[0], &bytes[0], report, error);
  if (result == RESULT_OK)
    result = measure(work, positions, MANY, &cpu[1], &rays[1], &bytes[1], report, error);
  if (result == RESULT_OK) result = estimate_time(work, cpu, rays, estimate, error);
  if (result != RESULT_OK) return result;
  double sample_bytes =
      fmax(0, (bytes[1] - bytes[0] * MANY / FEW) / ((double)MANY * MANY - MANY * FEW));
  double row_bytes = fmax(0, bytes[1] - sample_bytes * MANY * MANY) / MANY;
  for (int n = 0; n < work->lamp->slab_count; ++n) {
    const int *samples = work->slabs[n].samples;
    double rows = (double)samples[SLAB_U] * samples[SLAB_V] * samples[SLAB_T];
    estimate->bytes += rows * (row_bytes + sample_bytes * samples[SLAB_S]);
  }
  return RESULT_OK;
}

/* To two digits, for %g to print without an exponent. */
static double rounded(double x) {
  double unit = x > 0 ? pow(10, floor(log10(x)) - 1) : 1;
  return unit * round(x / unit);
}

void bake_estimate_say(const struct bake_work *work, const struct bake_estimate *estimate,
                       const char *why, char line[BAKE_ESTIMATE_LINE]) {
  const int *n = work->slabs[0].samples;
  /* How soon the noise is little enough the bake itself shows. */
  bool open = work->effort.adaptive && !isnan(work->options->noise);
  const char *about = open ? "at most " : "some ", *bound = open ? "at most " : "";
  char time[64];
  if (estimate->seconds < 120)
    snprintf(time, sizeof time, "%.6g s", rounded(estimate->seconds));
  else if (estimate->seconds < 7200)
    snprintf(time, sizeof time, "%.6g min", rounded(estimate->seconds / 60));
  else
    snprintf(time, sizeof time, "%.6g h", rounded(estimate->seconds / 3600));
  snprintf(line, BAKE_ESTIMATE_LINE,
           "%d page%s of %d x %d x %d x %d samples (%s); %s%.3g rays; time %s%s with %d job%s, "
           "memory %.6g MB, file %.6g MB",
           work->lamp->slab_count, work->lamp->slab_count == 1 ? "" : "s", n[0], n[1], n[2], n[3],
           why, bound, estimate->rays, about, time, work->options->jobs,
           work->options->jobs == 1 ? "" : "s", rounded(estimate->memory / 1e6),
           rounded(estimate->bytes / 1e6));
}
