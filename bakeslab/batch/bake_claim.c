#include "batch/bake_claim.h"

#include <errno.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A batch at which as many workers died is given up. */
enum { MOST = 1000 };

/* FOLDER/KEY.NUMBER; NULL without memory. */
static char *claim_path(const char *folder, const char *key, int number) {
  char *path = NULL;
  return asprintf(&path, "%s/%s.%d", folder, key, number) < 0 ? NULL : path;
}

/* The same in the worker's folder. */
static char *own_path(const struct bake_worker *worker, const char *key, int number) {
  char *path = NULL;
  const char *end = strrchr(worker->path, '/');
  return asprintf(&path, "%.*s/%s.%d", (int)(end - worker->path), worker->path, key, number) < 0
             ? NULL
             : path;
}

static bool has_no_links(int reason) {
  return reason == EPERM || reason == EOPNOTSUPP || reason == ENOSYS || reason == EMLINK;
}

/* Tries one number; *next: its holder is dead. */
static enum result try_number(struct bake_worker *worker, const char *key, int number, int *claim,
                              bool *next, struct error *error) {
  struct bake_worker_seen holder;
  char *path = own_path(worker, key, number);
  enum result result = path ? RESULT_OK : result_no_memory(error);
  *next = false;
  if (path && (link(worker->path, path) == 0 || has_no_links(errno))) {
    *claim = number;
  } else if (path && errno != EEXIST) {
    result = result_fail(error, RESULT_IO, "%s: cannot be claimed: %s", path, strerror(errno));
  } else if (path && bake_worker_look(path, bake_worker_now(worker), &holder)) {
    /* Ours, where NFS lost the answer to a request that was done. */
    if (holder.file == worker->file) *claim = number;
    *next = holder.dead && holder.file != worker->file;
  }
  free(path);
  return result;
}

enum result bake_claim_take(struct bake_worker *worker, const char *key, int *claim,
                            struct error *error) {
  bool next = true;
  enum result result = RESULT_OK;
  *claim = BAKE_CLAIM_OTHERS;
  if (!bake_worker_hold(worker, key)) return RESULT_OK;
  for (int number = 0; next && result == RESULT_OK; ++number)
    result = number < MOST ? try_number(worker, key, number, claim, &next, error)
                           : result_fail(error, RESULT_IO, "%s: %d processes died of batch %s",
                                         worker->path, MOST, key);
  if (*claim == BAKE_CLAIM_OTHERS) bake_worker_let_go(worker, key);
  return result;
}

static bool remove_claim(const struct bake_worker *worker, const char *key, int number) {
  char *path = own_path(worker, key, number);
  bool removed = path && unlink(path) == 0;
  free(path);
  return removed;
}

void bake_claim_leave(struct bake_worker *worker, const char *key, int claim) {
  struct stat status;
  char *path = claim == BAKE_CLAIM_OTHERS ? NULL : own_path(worker, key, claim);
  if (path && stat(path, &status) == 0 && status.st_ino == worker->file) unlink(path);
  free(path);
  if (claim != BAKE_CLAIM_OTHERS) bake_worker_let_go(worker, key);
}

void bake_claim_end(struct bake_worker *worker, const char *key, int claim) {
  for (int number = 0; remove_claim(worker, key, number) || number < claim; ++number) continue;
  bake_worker_let_go(worker, key);
}

bool bake_claim_look(const char *folder, const char *key, double now,
                     struct bake_worker_seen *holder) {
  bool there = true, held = false;
  for (int number = 0; there && number < MOST && !held; ++number) {
    char *path = claim_path(folder, key, number);
    there = path && bake_worker_look(path, now, holder);
    held = there && !holder->dead;
    free(path);
  }
  return held;
}
