#include "probe/probe_bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_rounds.h"

enum result probe_bake(const struct bake_work *work, const struct slab *slabs,
                       const struct effects *effects, const int samples[SLAB_AXES], int rays,
                       struct probe_bake *bake, struct bake_report *report, struct error *error) {
  struct bake_work small = *work;
  struct bake_rounds rounds = {0};
  struct bake_report own = {0};
  small.effort = (struct bake_effort){.rays = rays, .shards = 1}; /* each shard needs all of it */
  small.look.effects = effects;
  small.look.offsets = BAKE_OWN;
  /* As frames, a quarter of a second each, its cameras would take minutes. */
  small.look.form = work->lamp->mesh_camera ? BAKE_MESH : BAKE_PERSPECTIVE;
  int pages = work->lamp->slab_count;
  *bake = (struct probe_bake){.pages = calloc((size_t)pages, sizeof *bake->pages)};
  enum result result = bake->pages ? RESULT_OK : result_no_memory(error);
  for (; bake->count < pages && result == RESULT_OK; ++bake->count) {
    struct slab *page = &bake->pages[bake->count];
    result = slab_copy_geometry(&slabs[bake->count], page, error);
    if (samples) memcpy(page->samples, samples, sizeof page->samples);
  }
  small.slabs = bake->pages;
  if (result == RESULT_OK) result = bake_rounds_run(&small, "probe", &rounds, &own, error);
  if (result == RESULT_OK)
    result = bake_sum_finish(rounds.sum, small.look.gain, bake->pages, error);
  bake_rounds_free(&rounds);
  bake->cpu = fmax(own.cpu, own.traced_cpu);
  bake->traced = own.traced;
  bake->depth = own.depth;
  memcpy(bake->photons_lost, own.photons_lost, sizeof bake->photons_lost);
  report->probe_cpu += own.cpu;
  return result;
}

void probe_bake_free(struct probe_bake *bake) {
  for (int n = 0; n < bake->count; ++n) slab_free(&bake->pages[n]);
  free(bake->pages);
  *bake = (struct probe_bake){0};
}
