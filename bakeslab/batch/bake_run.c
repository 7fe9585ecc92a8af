#include "batch/bake_run.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/files.h"
#include "batch/bake_claim.h"
#include "batch/bake_counts.h"
#include "batch/bake_order.h"

/* A POV-Ray process is idle for some 0.05 s before its first pixel and after its last one: the next
 * may start when one has no more than these seconds left to render. */
static const double overlap = 0.1;

enum process_state { IDLE, RENDERING, CLOSING };

struct process {
  enum process_state state;
  pid_t pid;
  double start; /* seconds */
  size_t batch;
  int claim; /* on the batch (bake_claim.h) */
  int times; /* that its POV-Ray started too late */
  char *scratch;
  struct povray_job job; /* directory is scratch */
};

struct run {
  const struct bake_work *work;
  const struct bake_round *round;
  struct lamp_library library;
  struct process *processes; /* 2 * jobs: as many may be closing as are rendering */
  int slots;
  float *rgb;               /* room for the largest batch, to verify it */
  struct bake_sum *sum;     /* or NULL */
  bool *ready;              /* by batch: finished */
  size_t summed;            /* batches added to the sum */
  size_t *order;            /* batches that are neither found nor in hand, in this order */
  size_t count, next, kept; /* of them; looked at, and left, since they were last gone through */
  double again, pause;      /* when others' batches are looked at again; seconds from then on */
  size_t rays_done, rays_all;
  struct bake_counts counts;
  struct progress progress;
};

/* The scene of a batch, and its job. */
static char *batch_text(const struct bake_work *work, const struct bake_round *round, size_t batch,
                        struct povray_job *job) {
  *job = (struct povray_job){0};
  bake_scene_size(&work->look, round, &round->batches[batch], job);
  return bake_scene_text(&work->look, work->slabs, work->lamp->slab_count, round,
                         &round->batches[batch]);
}

enum result bake_run_keys(const struct bake_work *work, struct bake_round *round,
                          struct error *error) {
  for (size_t n = 0; n < round->batch_count; ++n) {
    struct povray_job job;
    char *text = batch_text(work, round, n, &job);
    if (!text) return result_no_memory(error);
    bake_store_key(round->batches[n].key, text, work->lamp->reads.key, work->povray->version, NULL);
    free(text);
  }
  return RESULT_OK;
}

/* The folder of a batch in the store, there or not, which is that of the job too; to be freed.
 * NULL without memory. */
static char *batch_folder(const struct run *run, size_t batch, struct povray_job *job) {
  const struct bake_work *work = run->work;
  *job = (struct povray_job){0};
  bake_scene_size(&work->look, run->round, &run->round->batches[batch], job);
  char *folder = bake_store_path(work->store, run->round->batches[batch].key);
  job->directory = folder;
  return folder;
}

/* Reads a finished batch into run->rgb; refuses one that is not whole. */
static enum result read_batch(struct run *run, size_t batch, const struct povray_job *job,
                              struct error *error) {
  return bake_scene_read(&run->work->look, run->round, &run->round->batches[batch], job, run->rgb,
                         error);
}

static enum result read_stored(struct run *run, size_t batch, struct error *error) {
  struct povray_job job;
  char *folder = batch_folder(run, batch, &job);
  enum result result = folder ? read_batch(run, batch, &job, error) : result_no_memory(error);
  free(folder);
  return result == RESULT_OK ? bake_worker_renew(run->work->store->worker, error) : result;
}

/* Marks a batch, which run->rgb holds, as finished, and adds to the sum in the order of the
 * batches, as far as they are finished. */
static enum result take_batch(struct run *run, size_t batch, struct error *error) {
  run->rays_done += run->round->batches[batch].rays;
  run->ready[batch] = true;
  enum result result = RESULT_OK;
  while (run->sum && result == RESULT_OK && run->summed < run->round->batch_count &&
         run->ready[run->summed]) {
    size_t next = run->summed++;
    if (next != batch) result = read_stored(run, next, error);
    if (result == RESULT_OK)
      bake_sum_add(run->sum, run->round, &run->round->batches[next], run->rgb);
  }
  return result;
}

/* ---- Starting and ending processes ---- */

static const char *key_of(const struct run *run, const struct process *process) {
  return run->round->batches[process->batch].key;
}

/* Frees the slot of a process; `remove`: with its scratch folder, which has else moved to the
 * store, and its claim. */
static void release(const struct run *run, struct process *process, bool remove) {
  if (remove && process->scratch) files_remove_tree(process->scratch);
  if (remove) bake_claim_leave(run->work->store->worker, key_of(run, process), process->claim);
  free(process->scratch);
  process->scratch = NULL;
  process->state = IDLE;
}

static enum result start_batch(struct run *run, struct process *process, size_t batch, int claim,
                               struct error *error) {
  const struct bake_work *work = run->work;
  *process = (struct process){.batch = batch, .claim = claim, .times = process->times};
  char *text = batch_text(work, run->round, batch, &process->job);
  enum result result =
      text ? bake_store_scratch(work->store, key_of(run, process), &process->scratch, error)
           : result_no_memory(error);
  process->job.directory = process->scratch;
  process->job.library = run->library.paths;
  process->job.environment = lamp_without_highlights;
  if (result == RESULT_OK) result = lamp_source_link(work->source, process->scratch, error);
  if (result == RESULT_OK) result = files_write(process->scratch, "scene.pov", text, error);
  if (result == RESULT_OK) result = povray_start(work->povray, &process->job, &process->pid, error);
  free(text);
  if (result == RESULT_OK) {
    process->state = RENDERING;
    process->start = progress_now();
    return RESULT_OK;
  }
  release(run, process, true);
  return result;
}

/* POV-Ray dies of a full disk without saying so. Where the disk has no room for what it was about
 * to write, some 26 bytes a ray, since it may have removed the rest, that is taken for the
 * reason, and what it said is put in brackets. */
static enum result explain_full_disk(const struct bake_store *store, size_t rays,
                                     enum result result, struct error *error) {
  struct statvfs disk;
  if (result == RESULT_STOPPED || statvfs(store->directory, &disk) != 0) return result;
  if ((double)disk.f_bavail * (double)disk.f_frsize > (1 << 20) + 26.0 * (double)rays)
    return result;
  return result_fail(error, RESULT_IO,
                     "%s: the disk is full; make room and run the same command again, it goes on "
                     "from the finished batches (%s)",
                     store->directory, error->text);
}

static enum result end_batch(struct run *run, struct process *process, int status,
                             struct error *error) {
  const struct bake_work *work = run->work;
  const struct bake_batch *batch = &run->round->batches[process->batch];
  enum result result = povray_finish(&process->job, status, error);
  if (result == RESULT_BAD && povray_is_late(&process->job, &process->times)) {
    files_remove_tree(process->scratch);
    free(process->scratch);
    return start_batch(run, process, process->batch, process->claim, error);
  }
  process->times = 0;
  if (result != RESULT_OK) lamp_source_rename(work->source, error);
  bool crashed = result == RESULT_IO;
  if (result == RESULT_OK) result = read_batch(run, process->batch, &process->job, error);
  if (result == RESULT_OK)
    bake_counts_add(&run->counts, run->round, process->batch, process->scratch);
  if (result == RESULT_OK && run->counts.photons_lost[0] && work->look.effects->named)
    result = result_fail(error, RESULT_BAD, "caustics: %s; " BAKE_PHOTONS_ADVICE,
                         run->counts.photons_lost);
  if (result == RESULT_BAD || crashed)
    result_fail(error, result, "%s: %s", work->options->lamp, error->text);
  if (result == RESULT_OK) result = lamp_reads_unchanged(&work->lamp->reads, error);
  if (result == RESULT_OK)
    result = bake_store_commit(work->store, process->scratch, batch->key, error);
  if (result == RESULT_OK) bake_claim_end(work->store->worker, batch->key, process->claim);
  if (result != RESULT_OK) result = explain_full_disk(work->store, batch->rays, result, error);
  release(run, process, result != RESULT_OK);
  return result != RESULT_OK ? result : take_batch(run, process->batch, error);
}

static void kill_all(struct run *run) {
  for (int n = 0; n < run->slots; ++n) /* all of them before any is waited for */
    if (run->processes[n].state != IDLE) povray_kill(run->processes[n].pid);
  for (int n = 0; n < run->slots; ++n) {
    struct process *process = &run->processes[n];
    if (process->state == IDLE) continue;
    while (waitpid(process->pid, NULL, 0) < 0 && errno == EINTR) continue;
    release(run, process, true);
  }
}

/* ---- The loop ---- */

/* Takes a batch that the store has: with a sum, only if it is whole. */
static enum result take_found(struct run *run, size_t batch, bool *found,
                              struct bake_report *report, struct error *error) {
  struct povray_job job;
  char *folder = batch_folder(run, batch, &job);
  if (!folder) return result_no_memory(error);
  *found =
      access(folder, F_OK) == 0 && (!run->sum || read_batch(run, batch, &job, NULL) == RESULT_OK);
  if (*found && run->sum) bake_counts_add(&run->counts, run->round, batch, folder);
  free(folder);
  if (!*found) return RESULT_OK;
  ++report->found;
  run->pause = 0;
  enum result result = take_batch(run, batch, error);
  run->progress.start_part = (double)run->rays_done / (double)run->rays_all;
  return result;
}

/* Claims a batch that was not found, and looks once more: its claim may have gone since it is
 * there. One that is damaged goes. */
static enum result claim_batch(struct run *run, size_t batch, int *claim, bool *found,
                               struct bake_report *report, struct error *error) {
  const struct bake_store *store = run->work->store;
  const char *key = run->round->batches[batch].key;
  enum result result = bake_claim_take(store->worker, key, claim, error);
  if (result != RESULT_OK || *claim == BAKE_CLAIM_OTHERS) return result;
  result = take_found(run, batch, found, report, error);
  char *folder = *found ? NULL : bake_store_path(store, key);
  if (folder) files_remove_tree(folder);
  free(folder);
  if (*found) bake_claim_end(store->worker, key, *claim);
  return result;
}

/* Goes on through what is left to a batch that is ours to render: *claim is its number, or
 * BAKE_CLAIM_OTHERS where there is none for now. What others hold is looked at again after a
 * while. */
static enum result find_batch(struct run *run, size_t *batch, int *claim,
                              struct bake_report *report, struct error *error) {
  static const double least_pause = 0.05, most_pause = 1;
  *claim = BAKE_CLAIM_OTHERS;
  if (progress_now() < run->again) return RESULT_OK;
  while (run->next < run->count) {
    bool found = false;
    *batch = run->order[run->next++];
    enum result result = bake_worker_renew(run->work->store->worker, error);
    if (result == RESULT_OK) result = take_found(run, *batch, &found, report, error);
    if (result == RESULT_OK && !found)
      result = claim_batch(run, *batch, claim, &found, report, error);
    if (result != RESULT_OK || (!found && *claim != BAKE_CLAIM_OTHERS)) return result;
    *claim = BAKE_CLAIM_OTHERS;
    if (!found) run->order[run->kept++] = *batch;
  }
  run->count = run->kept;
  run->next = run->kept = 0;
  run->pause = fmin(fmax(2 * run->pause, least_pause), most_pause);
  run->again = progress_now() + run->pause;
  return RESULT_OK;
}

static int count_rendering(const struct run *run, double *rays) {
  int rendering = 0;
  *rays = (double)run->rays_done;
  for (int n = 0; n < run->slots; ++n) {
    struct process *process = &run->processes[n];
    if (process->state == IDLE) continue;
    double part = povray_progress(&process->job);
    if (part > 0 && (progress_now() - process->start) * (1 - part) / part < overlap)
      process->state = CLOSING;
    rendering += process->state == RENDERING;
    *rays += part * (double)run->round->batches[process->batch].rays;
  }
  return rendering;
}

static struct process *idle_process(struct run *run) {
  for (int n = 0; n < run->slots; ++n)
    if (run->processes[n].state == IDLE) return &run->processes[n];
  return NULL;
}

static enum result collect(struct run *run, struct bake_report *report, struct error *error) {
  for (int n = 0; n < run->slots; ++n) {
    struct process *process = &run->processes[n];
    int status;
    struct rusage usage;
    if (process->state == IDLE || wait4(process->pid, &status, WNOHANG, &usage) != process->pid)
      continue;
    report->cpu += (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                   1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    enum result result = end_batch(run, process, status, error);
    if (result != RESULT_OK) return result;
    if (process->state == IDLE) report->rays += (double)run->round->batches[process->batch].rays;
  }
  return RESULT_OK;
}

/* As many as there are jobs, where there is something for them. */
static enum result start_batches(struct run *run, int rendering, struct bake_report *report,
                                 struct error *error) {
  for (; rendering < run->work->options->jobs; ++rendering) {
    struct process *process = idle_process(run);
    size_t batch = 0;
    int claim;
    if (!process) return RESULT_OK;
    enum result result = find_batch(run, &batch, &claim, report, error);
    if (result != RESULT_OK || claim == BAKE_CLAIM_OTHERS) return result;
    result = start_batch(run, process, batch, claim, error);
    if (result != RESULT_OK) return explain_full_disk(run->work->store, 0, result, error);
  }
  return RESULT_OK;
}

enum result bake_run_stopped(const struct bake_work *work, struct error *error) {
  return result_fail(error, RESULT_STOPPED,
                     "interrupted; finished batches are in %s, and the same command goes on "
                     "from them",
                     work->store->directory);
}

static enum result loop(struct run *run, struct bake_report *report, struct error *error) {
  for (;;) {
    if (*run->work->stop) return bake_run_stopped(run->work, error);
    enum result result = collect(run, report, error);
    if (result == RESULT_OK) result = bake_worker_renew(run->work->store->worker, error);
    if (result != RESULT_OK) return result;
    double rays;
    int rendering = count_rendering(run, &rays);
    progress_show(&run->progress, rays / (double)run->rays_all, run->round->label);
    result = start_batches(run, rendering, report, error);
    if (result != RESULT_OK) return result;
    bool busy = false;
    for (int n = 0; n < run->slots; ++n) busy |= run->processes[n].state != IDLE;
    if (!busy && run->count == 0) return RESULT_OK;
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
  }
}

/* What is in the order to be rendered. Returns the rays of the largest batch. */
static size_t count_rays(struct run *run) {
  size_t largest = 1;
  for (size_t k = 0; k < run->count; ++k) {
    size_t rays = run->round->batches[run->order[k]].rays;
    run->rays_all += rays;
    if (rays > largest) largest = rays;
  }
  return largest;
}

enum result bake_run(const struct bake_work *work, const struct bake_round *round, bool part,
                     struct bake_sum *sum, struct bake_report *report, struct error *error) {
  struct run run = {.work = work, .round = round, .sum = sum, .slots = 2 * work->options->jobs};
  run.counts =
      (struct bake_counts){.effects = work->look.effects, .lamp = work->lamp, .slabs = work->slabs};
  run.processes = calloc((size_t)run.slots, sizeof *run.processes);
  run.order = malloc((round->batch_count + 1) * sizeof *run.order);
  run.ready = calloc(round->batch_count + 1, sizeof *run.ready);
  if (run.order)
    run.count =
        bake_order(round, work->store, work->effort.shard, work->effort.shards, part, run.order);
  size_t largest = count_rays(&run);
  run.rgb = malloc(largest * 3 * sizeof *run.rgb);
  report->batches += (int)run.count;
  lamp_source_library(work->source, &run.library);
  enum result result = RESULT_OK;
  if (!run.processes || !run.order || !run.ready || !run.rgb) result = result_no_memory(error);
  progress_start(&run.progress, work->options->quiet, 0);
  if (result == RESULT_OK) result = loop(&run, report, error);
  if (run.processes) kill_all(&run);
  progress_end(&run.progress);
  bake_counts_report(&run.counts, report);
  free(run.processes);
  free(run.order);
  free(run.ready);
  free(run.rgb);
  return result;
}
