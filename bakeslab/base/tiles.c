/* tiles.c - POSIX threads: the thread sanitizer does not know C11's. */
#include "base/tiles.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

struct tiles {
  int count;
  tiles_work *work;
  tiles_progress *progress;
  void *context;
  atomic_int next; /* tile to start; tiles start in order */
  atomic_int done;
  atomic_bool failed;
  pthread_mutex_t lock; /* of what follows */
  int failed_tile;
  enum result result;
  struct error error;
};

struct worker {
  struct tiles *tiles;
  int number;
  pthread_t thread;
};

/* All tiles below a failed one have been started and are finished, so the lowest failure is
 * the same whatever thread does what. */
static void note_failure(struct tiles *tiles, int tile, enum result result,
                         const struct error *error) {
  atomic_store(&tiles->failed, true);
  pthread_mutex_lock(&tiles->lock);
  if (tiles->failed_tile < 0 || tile < tiles->failed_tile) {
    tiles->failed_tile = tile;
    tiles->result = result;
    tiles->error = *error;
  }
  pthread_mutex_unlock(&tiles->lock);
}

static void *run(void *argument) {
  struct worker *worker = argument;
  struct tiles *tiles = worker->tiles;
  while (!atomic_load(&tiles->failed)) {
    int tile = atomic_fetch_add(&tiles->next, 1);
    if (tile >= tiles->count) break;
    struct error error = {""};
    enum result result = tiles->work(tiles->context, tile, worker->number, &error);
    if (result != RESULT_OK) note_failure(tiles, tile, result, &error);
    int done = atomic_fetch_add(&tiles->done, 1) + 1;
    if (worker->number == 0 && tiles->progress && result == RESULT_OK)
      tiles->progress(tiles->context, (double)done / tiles->count);
  }
  return NULL;
}

enum result tiles_run(int threads, int count, tiles_work *work, tiles_progress *progress,
                      void *context, struct error *error) {
  if (threads < 1 || count < 0)
    return result_fail(error, RESULT_BAD, "%d threads for %d tiles", threads, count);
  if (count == 0) return RESULT_OK;
  if (threads > count) threads = count;
  struct worker *workers = calloc((size_t)threads, sizeof *workers);
  if (!workers) return result_no_memory(error);
  struct tiles tiles = {
      .count = count, .work = work, .progress = progress, .context = context, .failed_tile = -1};
  pthread_mutex_init(&tiles.lock, NULL);
  int started = 1; /* fewer threads than asked for are no failure, only slower */
  for (; started < threads; ++started) {
    workers[started] = (struct worker){.tiles = &tiles, .number = started};
    if (pthread_create(&workers[started].thread, NULL, run, &workers[started]) != 0) break;
  }
  workers[0] = (struct worker){.tiles = &tiles};
  run(&workers[0]);
  for (int k = 1; k < started; ++k) pthread_join(workers[k].thread, NULL);
  pthread_mutex_destroy(&tiles.lock);
  free(workers);
  if (tiles.failed_tile < 0) return RESULT_OK;
  return result_fail(error, tiles.result, "%s", tiles.error.text);
}

int tiles_processors(void) {
  cpu_set_t set;
  int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
  return count > 0 ? count : 1;
}
