/* probe_bake.c - see probe_bake.h. */
#include "probe/probe_bake.h"

#include <stdlib.h>
#include <string.h>

#include "batch/bake_rounds.h"

enum result probe_bake(const struct bake_work *work, const struct slab *slabs,
                       const struct effects *effects, const int samples[SLAB_AXES], int rays,
                       struct probe_bake *take, struct bake_report *report, struct error *error) {
  struct bake_options options = *work->options;
  struct bake_work small = *work;
  struct bake_rounds rounds = {0};
  struct bake_report own = {0};
  options.rays = rays;
  options.uniform = true;
  options.shard = 0, options.shards = 1; /* each shard wants to know all */
  small.options = &options;
  small.look.effects = effects;
  small.look.offsets = BAKE_OWN;
  if (small.look.form == BAKE_TRANSPOSED)
    small.look.form = work->lamp->mesh_camera ? BAKE_MESH : BAKE_PERSPECTIVE;
  int pages = work->lamp->slab_count;
  *take = (struct probe_bake){.pages = calloc((size_t)pages, sizeof *take->pages)};
  enum result result = take->pages ? RESULT_OK : result_fail(error, RESULT_MEMORY, "out of memory");
  for (; take->count < pages && result == RESULT_OK; ++take->count) {
    struct slab *page = &take->pages[take->count];
    result = slab_copy_geometry(&slabs[take->count], page, error);
    memcpy(page->samples, samples, sizeof page->samples);
  }
  small.slabs = take->pages;
  if (result == RESULT_OK) result = bake_rounds_run(&small, "probe", &rounds, &own, error);
  if (result == RESULT_OK)
    result = bake_sum_finish(rounds.sum, small.look.gain, take->pages, error);
  bake_rounds_free(&rounds);
  take->traced = own.traced;
  take->depth = own.depth;
  report->probe_cpu += own.cpu;
  return result;
}

void probe_bake_free(struct probe_bake *take) {
  for (int n = 0; n < take->count; ++n) slab_free(&take->pages[n]);
  free(take->pages);
  *take = (struct probe_bake){0};
}
