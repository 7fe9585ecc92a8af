#include "probe/probe_bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_rounds.h"

/* What a small bake works with; its thread alone touches it until it is waited for. */
struct probe_bake_run {
  struct bake_work work;
  struct effects effects;
  struct slab *pages; /* not owned */
  pthread_t thread;
  bool threaded;
  struct bake_report report;
  enum result result;
  struct error error;
};

static void *run_bake(void *given) {
  struct probe_bake_run *run = given;
  struct bake_rounds rounds = {0};
  run->result = bake_rounds_run(&run->work, "probe", &rounds, &run->report, &run->error);
  if (run->result == RESULT_OK)
    run->result = bake_sum_finish(rounds.sum, run->work.look.gain, run->pages, &run->error);
  bake_rounds_free(&rounds);
  return NULL;
}

/* Of the work, what a small bake does in its own way. */
static struct probe_bake_run *make_run(const struct bake_work *work, const struct effects *effects,
                                       int rays, struct slab *pages) {
  struct probe_bake_run *run = calloc(1, sizeof *run);
  if (!run) return NULL;
  run->work = *work;
  run->work.plan[0] = 0;
  run->effects = *effects;
  run->pages = pages;
  run->work.effort =
      (struct bake_effort){.rays = rays, .shards = 1}; /* each shard needs all of it */
  run->work.look.effects = &run->effects;
  run->work.look.offsets = BAKE_OWN;
  /* As frames, a quarter of a second each, its cameras would take minutes. */
  run->work.look.form = work->lamp->mesh_camera ? BAKE_MESH : BAKE_PERSPECTIVE;
  run->work.slabs = pages;
  return run;
}

enum result probe_bake_start(const struct bake_work *work, const struct slab *slabs,
                             const struct effects *effects, const int samples[SLAB_AXES], int rays,
                             struct probe_bake *bake, struct error *error) {
  int pages = work->lamp->slab_count;
  *bake = (struct probe_bake){.pages = calloc((size_t)pages, sizeof *bake->pages)};
  enum result result = bake->pages ? RESULT_OK : result_no_memory(error);
  for (; bake->count < pages && result == RESULT_OK; ++bake->count) {
    struct slab *page = &bake->pages[bake->count];
    result = slab_copy_geometry(&slabs[bake->count], page, error);
    if (samples) memcpy(page->samples, samples, sizeof page->samples);
  }
  if (result != RESULT_OK) return result;
  struct probe_bake_run *run = bake->run = make_run(work, effects, rays, bake->pages);
  if (!run) return result_no_memory(error);
  run->threaded = work->options->jobs > 1 && pthread_create(&run->thread, NULL, run_bake, run) == 0;
  return RESULT_OK;
}

enum result probe_bake_wait(struct probe_bake *bake, struct bake_report *report,
                            struct error *error) {
  struct probe_bake_run *run = bake->run;
  if (!run) return RESULT_OK;
  if (run->threaded)
    pthread_join(run->thread, NULL);
  else
    run_bake(run);
  const struct bake_report *own = &run->report;
  enum result result = run->result;
  if (result != RESULT_OK && error) *error = run->error;
  bake->cpu = fmax(own->cpu, own->traced_cpu);
  bake->traced = own->traced;
  bake->depth = own->depth;
  memcpy(bake->photons_lost, own->photons_lost, sizeof bake->photons_lost);
  report->probe_cpu += own->cpu;
  free(run);
  bake->run = NULL;
  return result;
}

enum result probe_bake(const struct bake_work *work, const struct slab *slabs,
                       const struct effects *effects, const int samples[SLAB_AXES], int rays,
                       struct probe_bake *bake, struct bake_report *report, struct error *error) {
  enum result result = probe_bake_start(work, slabs, effects, samples, rays, bake, error);
  return result == RESULT_OK ? probe_bake_wait(bake, report, error) : result;
}

void probe_bake_free(struct probe_bake *bake) {
  if (bake->run && bake->run->threaded) pthread_join(bake->run->thread, NULL);
  free(bake->run);
  for (int n = 0; n < bake->count; ++n) slab_free(&bake->pages[n]);
  free(bake->pages);
  *bake = (struct probe_bake){0};
}
