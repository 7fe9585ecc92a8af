#include "batch/bake_status.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"
#include "batch/bake_claim.h"
#include "povray/povray_log.h"

/* ---- Batches ---- */

static bool exists(const char *folder, const char *name) {
  char *path = files_join(folder, name);
  bool there = path && access(path, F_OK) == 0;
  free(path);
  return there;
}

/* Seconds since a batch was begun: its scene was written then. */
static double find_since(const char *folder, const char *worker, const char *key, double now) {
  struct stat status;
  char *path = NULL;
  double since = 0;
  if (asprintf(&path, "%s/scratch.%s.%s/scene.pov", folder, worker, key) < 0) return 0;
  if (stat(path, &status) == 0) since = fmax(0, now - (double)status.st_mtim.tv_sec);
  free(path);
  return since;
}

static enum result add_claim(struct bake_status *status, const struct bake_status_claim *claim,
                             struct error *error) {
  size_t count = (size_t)status->claim_count;
  struct bake_status_claim *grown = realloc(status->claims, (count + 1) * sizeof *grown);
  if (!grown) return result_no_memory(error);
  status->claims = grown;
  status->claims[status->claim_count++] = *claim;
  return RESULT_OK;
}

static enum result look_at_round(const char *folder, double now, int number,
                                 struct bake_status *status, struct error *error) {
  struct bake_status_round *round = &status->rounds[number];
  enum result result = RESULT_OK;
  round->state = malloc(round->list.count + 1);
  if (!round->state) return result_no_memory(error);
  for (size_t n = 0; n < round->list.count && result == RESULT_OK; ++n) {
    const struct bake_list_batch *batch = &round->list.batches[n];
    struct bake_status_claim claim = {.round = number};
    round->rays += (double)batch->rays;
    if (exists(folder, batch->key)) {
      ++round->done;
      round->rays_done += (double)batch->rays;
      round->state[n] = BAKE_STATUS_DONE;
    } else if (bake_claim_look(folder, batch->key, now, &claim.holder)) {
      ++round->claimed;
      round->state[n] = BAKE_STATUS_CLAIMED;
      memcpy(claim.key, batch->key, sizeof claim.key);
      claim.since = find_since(folder, claim.holder.name.id, batch->key, now);
      result = add_claim(status, &claim, error);
    } else {
      ++round->missing;
      round->state[n] = BAKE_STATUS_MISSING;
    }
  }
  status->rays += round->rays;
  status->rays_done += round->rays_done;
  return result;
}

static enum result read_rounds(const char *folder, double now, struct bake_status *status,
                               struct error *error) {
  enum result result = RESULT_OK;
  while (result == RESULT_OK) {
    struct bake_list list;
    result = bake_ledger_read_list(folder, status->round_count + 1, &list, error);
    size_t count = (size_t)status->round_count;
    struct bake_status_round *grown =
        list.label[0] ? realloc(status->rounds, (count + 1) * sizeof *grown) : NULL;
    if (grown) {
      status->rounds = grown;
      status->rounds[status->round_count++] = (struct bake_status_round){.list = list};
    } else {
      free(list.batches);
    }
    if (result != RESULT_OK || !list.label[0]) break;
    if (!grown) return result_no_memory(error);
    status->planned = !strcmp(list.label, BAKE_LEDGER_LAST);
    result = look_at_round(folder, now, status->round_count - 1, status, error);
  }
  return result;
}

/* ---- The time left ---- */

/* CPU seconds a ray, by the logs of some finished batches; NAN: not known. */
static double find_cost(const char *folder, const struct bake_status *status) {
  enum { MOST = 64 };
  double seconds = 0, rays = 0;
  for (int r = status->round_count - 1; r >= 0; --r) {
    const struct bake_status_round *round = &status->rounds[r];
    size_t step = round->list.count / MOST + 1;
    for (size_t n = 0; n < round->list.count; n += step) {
      char *path = round->state[n] == BAKE_STATUS_DONE
                       ? files_join(folder, round->list.batches[n].key)
                       : NULL;
      double cpu = path ? povray_log_cpu(path) : 0;
      free(path);
      if (cpu > 0) seconds += cpu, rays += (double)round->list.batches[n].rays;
    }
  }
  return rays > 0 ? seconds / rays : NAN;
}

enum result bake_status(const char *folder, struct bake_status *status, struct error *error) {
  *status = (struct bake_status){0};
  enum result result = bake_ledger_read(folder, &status->ledger, error);
  if (result != RESULT_OK) return result;
  double now = bake_worker_clock(folder);
  result = bake_worker_list(folder, now, &status->workers, &status->worker_count, error);
  for (int n = 0; n < status->worker_count; ++n)
    if (!status->workers[n].dead) status->jobs += status->workers[n].name.jobs;
  if (result == RESULT_OK) result = read_rounds(folder, now, status, error);
  if (result != RESULT_OK) return result;
  if (!status->planned) status->rays = fmax(status->rays, status->ledger.rays);
  status->written = exists(folder, "done");
  status->seconds = (status->rays - status->rays_done) * find_cost(folder, status) /
                    (status->jobs > 0 ? status->jobs : 1);
  return RESULT_OK;
}

void bake_status_free(struct bake_status *status) {
  for (int n = 0; n < status->round_count; ++n) {
    free(status->rounds[n].list.batches);
    free(status->rounds[n].state);
  }
  free(status->rounds);
  free(status->claims);
  free(status->workers);
  *status = (struct bake_status){0};
}

/* ---- Shards ---- */

/* Does a shard, from 0, lack something? */
static bool lacks(const struct bake_status *status, const struct bake_status_round *round,
                  size_t shard) {
  if (!round || (!status->planned && round->done == round->list.count)) return true;
  for (size_t n = shard; n < round->list.count; n += (size_t)status->ledger.shards)
    if (round->state[n] == BAKE_STATUS_MISSING) return true;
  return false;
}

enum result bake_status_shards(const char *folder, const struct bake_status *status, char **text,
                               struct error *error) {
  const int shards = status->ledger.shards;
  const struct bake_status_round *round =
      status->round_count > 0 ? &status->rounds[status->round_count - 1] : NULL;
  size_t size;
  *text = NULL;
  if (shards == 0)
    return result_fail(error, RESULT_BAD,
                       "%s: is not shared out into shards; any number of bakes without --shard "
                       "help each other there",
                       folder);
  FILE *out = open_memstream(text, &size);
  if (!out) return result_no_memory(error);
  for (int k = 0; k < shards; ++k) {
    int first = k;
    if (!lacks(status, round, (size_t)k)) continue;
    while (k + 1 < shards && lacks(status, round, (size_t)k + 1)) ++k;
    fprintf(out, k > first ? "%s%d-%d" : "%s%d", ftell(out) > 0 ? "," : "", first + 1, k + 1);
  }
  return fclose(out) == 0 ? RESULT_OK : result_no_memory(error);
}
