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
#include "povray/povray_log.h"

/* A POV-Ray process is idle for some 0.05 s before its first pixel and after its last one: the next
 * may start when one has no more than these seconds left to render. */
static const double overlap = 0.1;

enum process_state { IDLE, RENDERING, CLOSING };

struct process {
  enum process_state state;
  pid_t pid;
  double start; /* seconds */
  size_t batch;
  int times; /* that its POV-Ray started too late */
  char key[33];
  char *scratch;
  struct povray_job job; /* directory is scratch */
};

struct run {
  const struct bake_work *work;
  const struct bake_round *round;
  struct lamp_library library;
  struct process *processes; /* 2 * jobs: as many may be closing as are rendering */
  int slots;
  float *rgb;           /* room for the largest batch, to verify it */
  struct bake_sum *sum; /* or NULL */
  bool *ready;          /* by batch: finished */
  size_t summed;        /* batches added to the sum */
  size_t *order;        /* batches to render, in this order */
  size_t count, next;
  size_t rays_done, rays_all;
  double traced, traced_cpu, depth; /* see bake_report */
  char photons_lost[48];
  struct progress progress;
};

/* The scene of a batch, and the key under which the store has it. */
static char *batch_text(const struct bake_work *work, const struct bake_round *round, size_t batch,
                        struct povray_job *job, char key[33]) {
  *job = (struct povray_job){0};
  bake_scene_size(&work->look, round, &round->batches[batch], job);
  char *text = bake_scene_text(&work->look, work->slabs, work->lamp->slab_count, round,
                               &round->batches[batch]);
  if (text) bake_store_key(key, text, work->lamp->reads.key, work->povray->version, NULL);
  return text;
}

/* The folder of a batch in the store, there or not, which is that of the job too; to be freed.
 * NULL without memory. */
static char *batch_folder(const struct run *run, size_t batch, struct povray_job *job) {
  char key[33];
  char *text = batch_text(run->work, run->round, batch, job, key);
  char *folder = text ? bake_store_path(run->work->store, key) : NULL;
  free(text);
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
  return result;
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

/* Frees the slot of a process; `remove`: with its scratch folder, which has else moved to the
 * store. */
static void release(struct process *process, bool remove) {
  if (remove && process->scratch) files_remove_tree(process->scratch);
  free(process->scratch);
  process->scratch = NULL;
  process->state = IDLE;
}

static enum result start_batch(struct run *run, struct process *process, size_t batch,
                               struct error *error) {
  const struct bake_work *work = run->work;
  *process = (struct process){.batch = batch, .times = process->times};
  char *text = batch_text(work, run->round, batch, &process->job, process->key);
  enum result result =
      text ? bake_store_scratch(work->store, &process->scratch, error) : result_no_memory(error);
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
  release(process, true);
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

/* Whether there is something in the batch's channel to shoot photons. */
static bool has_bulbs(const struct run *run, size_t batch) {
  const struct bake_round *round = run->round;
  const struct bake_unit *unit = &round->units[round->batches[batch].first];
  const char *name = run->work->slabs[round->boxes[unit->box].page].channel;
  const struct lamp *lamp = run->work->lamp;
  for (int n = 0; n < lamp->channel_count; ++n)
    if (!strcmp(lamp->channels[n].name, name)) return lamp->channels[n].bulbs > 0;
  return true;
}

/* POV-Ray says nothing of photons that miss their targets, and their light is lost. Where nobody
 * named the effect, a lamp without targets loses nothing. */
static void check_photons(struct run *run, size_t batch, const char *directory) {
  enum { TOO_FEW = 1000 };
  const struct effects *effects = run->work->look.effects;
  if (!effects->setting[CAUSTICS] || !has_bulbs(run, batch)) return;
  double shot = fmax(0, povray_statistic(directory, "Number of photons shot:"));
  double stored = fmax(0, povray_statistic(directory, "Surface photons stored:"));
  if (shot >= TOO_FEW && stored > 0) return;
  if (!effects->named && (shot == 0 || shot >= TOO_FEW)) return;
  snprintf(run->photons_lost, sizeof run->photons_lost, "POV-Ray shot %.0f photons and stored %.0f",
           shot, stored);
}

/* Adds POV-Ray's own counts, from the log of a finished batch. */
static void count_work(struct run *run, size_t batch, const char *directory) {
  static const char *const labels[] = {"Rays:", "Shadow Ray Tests:", "Number of photons shot:"};
  for (size_t n = 0; n < sizeof labels / sizeof *labels; ++n)
    run->traced += fmax(0, povray_statistic(directory, labels[n]));
  run->traced_cpu += povray_log_cpu(directory);
  run->depth = fmax(run->depth, povray_statistic(directory, "Max Level:"));
  check_photons(run, batch, directory);
}

static enum result end_batch(struct run *run, struct process *process, int status,
                             struct error *error) {
  const struct bake_work *work = run->work;
  const struct bake_batch *batch = &run->round->batches[process->batch];
  enum result result = povray_finish(&process->job, status, error);
  if (result == RESULT_BAD && povray_is_late(&process->job, &process->times)) {
    release(process, true);
    return start_batch(run, process, process->batch, error);
  }
  process->times = 0;
  if (result != RESULT_OK) lamp_source_rename(work->source, error);
  bool crashed = result == RESULT_IO;
  if (result == RESULT_OK) result = read_batch(run, process->batch, &process->job, error);
  if (result == RESULT_OK) count_work(run, process->batch, process->scratch);
  if (result == RESULT_OK && run->photons_lost[0] && work->look.effects->named)
    result =
        result_fail(error, RESULT_BAD, "caustics: %s; " BAKE_PHOTONS_ADVICE, run->photons_lost);
  if (result == RESULT_BAD || crashed)
    result_fail(error, result, "%s: %s", work->options->lamp, error->text);
  if (result == RESULT_OK) result = lamp_reads_unchanged(&work->lamp->reads, error);
  if (result == RESULT_OK)
    result = bake_store_commit(work->store, process->scratch, process->key, error);
  if (result != RESULT_OK) result = explain_full_disk(work->store, batch->rays, result, error);
  release(process, result != RESULT_OK);
  return result != RESULT_OK ? result : take_batch(run, process->batch, error);
}

static void kill_all(struct run *run) {
  for (int n = 0; n < run->slots; ++n) /* all of them before any is waited for */
    if (run->processes[n].state != IDLE) povray_kill(run->processes[n].pid);
  for (int n = 0; n < run->slots; ++n) {
    struct process *process = &run->processes[n];
    if (process->state == IDLE) continue;
    while (waitpid(process->pid, NULL, 0) < 0 && errno == EINTR) continue;
    release(process, true);
  }
}

/* ---- The loop ---- */

/* Whether the store has a batch, which is in run->rgb then. */
static bool is_found(struct run *run, size_t batch) {
  struct povray_job job;
  char *folder = batch_folder(run, batch, &job);
  bool there = folder && access(folder, F_OK) == 0;
  bool whole = there && read_batch(run, batch, &job, NULL) == RESULT_OK;
  if (whole) count_work(run, batch, folder);
  if (there && !whole) files_remove_tree(folder); /* damaged: bake it again */
  free(folder);
  return whole;
}

/* Moves run->next on to a batch that the store lacks. */
static enum result skip_found(struct run *run, struct bake_report *report, struct error *error) {
  for (; run->next < run->count; ++run->next) {
    size_t batch = run->order[run->next];
    if (!is_found(run, batch)) return RESULT_OK;
    ++report->found;
    enum result result = take_batch(run, batch, error);
    if (result != RESULT_OK) return result;
    run->progress.start_part = (double)run->rays_done / (double)run->rays_all;
  }
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

static enum result loop(struct run *run, const char *label, struct bake_report *report,
                        struct error *error) {
  for (;;) {
    if (*run->work->stop)
      return result_fail(error, RESULT_STOPPED,
                         "interrupted; finished batches are in %s, and the same command goes on "
                         "from them",
                         run->work->store->directory);
    enum result result = collect(run, report, error);
    if (result != RESULT_OK) return result;
    double rays;
    int rendering = count_rendering(run, &rays);
    progress_show(&run->progress, rays / (double)run->rays_all, label);
    for (; rendering < run->work->options->jobs; ++rendering) {
      struct process *process = idle_process(run);
      if (process) result = skip_found(run, report, error);
      if (result != RESULT_OK) return result;
      if (!process || run->next == run->count) break;
      result = start_batch(run, process, run->order[run->next++], error);
      if (result != RESULT_OK) return explain_full_disk(run->work->store, 0, result, error);
    }
    bool busy = false;
    for (int n = 0; n < run->slots; ++n) busy |= run->processes[n].state != IDLE;
    if (!busy && run->next == run->count) return RESULT_OK;
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
  }
}

/* This shard's batches first, then the others'. Returns the rays of the largest. */
static size_t put_in_order(struct run *run) {
  size_t largest = 1, shards = (size_t)run->work->effort.shards;
  for (size_t turn = 0; turn < (run->sum ? shards : 1); ++turn)
    for (size_t n = ((size_t)run->work->effort.shard + turn) % shards; n < run->round->batch_count;
         n += shards) {
      run->order[run->count++] = n;
      run->rays_all += run->round->batches[n].rays;
      if (run->round->batches[n].rays > largest) largest = run->round->batches[n].rays;
    }
  return largest;
}

enum result bake_run(const struct bake_work *work, const struct bake_round *round,
                     struct bake_sum *sum, const char *label, struct bake_report *report,
                     struct error *error) {
  struct run run = {.work = work, .round = round, .sum = sum, .slots = 2 * work->options->jobs};
  run.processes = calloc((size_t)run.slots, sizeof *run.processes);
  run.order = malloc((round->batch_count + 1) * sizeof *run.order);
  run.ready = calloc(round->batch_count + 1, sizeof *run.ready);
  size_t largest = run.order ? put_in_order(&run) : 1;
  run.rgb = malloc(largest * 3 * sizeof *run.rgb);
  report->batches += (int)run.count;
  lamp_source_library(work->source, &run.library);
  enum result result = RESULT_OK;
  if (!run.processes || !run.order || !run.ready || !run.rgb) result = result_no_memory(error);
  progress_start(&run.progress, work->options->quiet, 0);
  if (result == RESULT_OK) result = loop(&run, label, report, error);
  if (run.processes) kill_all(&run);
  progress_end(&run.progress);
  report->traced += run.traced;
  report->traced_cpu += run.traced_cpu;
  if (report->depth < run.depth) report->depth = (int)run.depth;
  if (run.photons_lost[0])
    memcpy(report->photons_lost, run.photons_lost, sizeof report->photons_lost);
  free(run.processes);
  free(run.order);
  free(run.ready);
  free(run.rgb);
  return result;
}
