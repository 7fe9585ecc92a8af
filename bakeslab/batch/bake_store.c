#include "batch/bake_store.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#define XXH_STATIC_LINKING_ONLY /* for the size of a state */
#include <xxhash.h>

#include "base/files.h"

static const char scratch_mark[] = "scratch.", worker_mark[] = "worker.", round_mark[] = "round.",
                  removal_name[] = "removal", done_name[] = "done";

static bool begins(const char *name, const char *mark) {
  return strncmp(name, mark, strlen(mark)) == 0;
}

bool bake_store_is_key(const char *name) {
  return strlen(name) == 32 && strspn(name, "0123456789abcdef") == 32;
}

/* Names that this room gives, claims and the lock of earlier versions among them. */
static bool is_ours(const char *name) {
  static const char *const whole[] = {"bake", removal_name, done_name, "lock"};
  for (size_t n = 0; n < sizeof whole / sizeof *whole; ++n)
    if (!strcmp(name, whole[n])) return true;
  return begins(name, scratch_mark) || begins(name, worker_mark) || begins(name, round_mark) ||
         (strspn(name, "0123456789abcdef") == 32 && (!name[32] || name[32] == '.'));
}

/* A batch, or what somebody else has put there. */
static bool is_content(const char *name) {
  return name[0] != '.' && (bake_store_is_key(name) || !is_ours(name));
}

/* ---- Names in the folder ---- */

static bool exists(const char *directory, const char *name) {
  char *path = files_join(directory, name);
  bool there = path && access(path, F_OK) == 0;
  free(path);
  return there;
}

static void remove_name(const char *directory, const char *name) {
  char *path = files_join(directory, name);
  if (path) files_remove_tree(path);
  free(path);
}

/* Calls `act` with each name in the folder; returns how many answered true. */
static int for_each(const char *directory, bool (*act)(const struct bake_store *, const char *),
                    const struct bake_store *store) {
  int count = 0;
  DIR *list = opendir(directory);
  for (struct dirent *entry; list && (entry = readdir(list));) count += act(store, entry->d_name);
  if (list) closedir(list);
  return count;
}

static bool count_content(const struct bake_store *store, const char *name) {
  (void)store;
  return is_content(name);
}

/* All of ours but what says that it is being removed, and who removes it. */
static bool sweep_all(const struct bake_store *store, const char *name) {
  bool own = store->worker->path && !strcmp(strrchr(store->worker->path, '/') + 1, name);
  if (is_ours(name) && strcmp(name, removal_name) != 0 && !own) remove_name(store->directory, name);
  return false;
}

static bool sweep_list(const struct bake_store *store, const char *name) {
  if (begins(name, round_mark)) remove_name(store->directory, name);
  return false;
}

/* A scratch folder whose worker is gone, or not heard of for long. */
static bool sweep_scratch(const struct bake_store *store, const char *name) {
  char worker[16];
  struct bake_worker_seen seen;
  if (!begins(name, scratch_mark)) return false;
  snprintf(worker, sizeof worker, "%s%.6s", worker_mark, name + strlen(scratch_mark));
  char *path = files_join(store->directory, worker);
  bool lost =
      path && (!bake_worker_look(path, bake_worker_now(store->worker), &seen) || seen.forgotten);
  if (lost) remove_name(store->directory, name);
  free(path);
  return lost;
}

static bool sweep_worker(const struct bake_store *store, const char *name) {
  struct bake_worker_seen seen;
  char *path = begins(name, worker_mark) ? files_join(store->directory, name) : NULL;
  bool lost =
      path && bake_worker_look(path, bake_worker_now(store->worker), &seen) && seen.forgotten;
  if (lost) unlink(path);
  free(path);
  return lost;
}

/* Somebody else who is alive. */
static bool is_other(const struct bake_store *store, const char *name) {
  struct bake_worker_seen seen;
  char *path = begins(name, worker_mark) ? files_join(store->directory, name) : NULL;
  bool other = path && bake_worker_look(path, bake_worker_now(store->worker), &seen) &&
               !seen.dead && seen.file != store->worker->file;
  free(path);
  return other;
}

/* ---- Coming and going ---- */

static void wait_a_moment(void) {
  nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
}

/* Whether somebody alive is about to remove the store. */
static bool is_being_removed(const struct bake_store *store) {
  struct bake_worker_seen holder;
  char *path = files_join(store->directory, removal_name);
  bool held = path && bake_worker_look(path, bake_worker_now(store->worker), &holder);
  if (held && holder.dead) unlink(path);
  free(path);
  return held && !holder.dead;
}

/* Joins once; *again: the folder just goes. Who removes it looks for others once `removal` is
 * there, and who joins looks for that once its own file is: one of them sees the other. */
static enum result try_open(struct bake_store *store, int jobs, bool *again, struct error *error) {
  enum result result = files_make_directory(store->directory, error);
  if (result != RESULT_OK) return result;
  result = bake_worker_join(store->directory, jobs, store->worker, again, error);
  if (*again) return RESULT_OK;
  if (result != RESULT_OK) rmdir(store->directory); /* if nothing is in it */
  if (result != RESULT_OK || !is_being_removed(store)) return result;
  bake_worker_leave(store->worker);
  wait_a_moment();
  *again = true;
  return RESULT_OK;
}

/* Takes the right to remove the store, which only one has at a time. */
static bool take_removal(const struct bake_store *store) {
  enum { MOST_TRIES = 6000 };
  char *path = files_join(store->directory, removal_name);
  bool taken = false;
  for (int tries = 0; path && !taken && tries < MOST_TRIES; ++tries) {
    taken = link(store->worker->path, path) == 0;
    if (!taken && errno != EEXIST) break; /* no store, or no links there */
    if (!taken && is_being_removed(store)) wait_a_moment();
  }
  free(path);
  return taken;
}

/* Removes what is left of a bake that is done, where nobody else is there: who comes meanwhile
 * waits for the right to do so to be given up. */
static void sweep_done(const struct bake_store *store) {
  if (!bake_store_is_done(store) || bake_store_has_others(store)) return;
  bool taken = take_removal(store);
  if (bake_store_is_done(store) && !bake_store_has_others(store))
    for_each(store->directory, sweep_all, store);
  if (taken) remove_name(store->directory, removal_name);
}

enum result bake_store_open(const char *output, int jobs, struct bake_store *store,
                            struct error *error) {
  enum { MOST_TRIES = 6000 }; /* a minute */
  *store = (struct bake_store){.worker = calloc(1, sizeof *store->worker)};
  if (!store->worker || asprintf(&store->directory, "%s.partial", output) < 0) {
    store->directory = NULL;
    return result_no_memory(error);
  }
  enum result result = RESULT_OK;
  bool again = true;
  for (int tries = 0; result == RESULT_OK && again; ++tries) {
    again = false;
    result = tries < MOST_TRIES
                 ? try_open(store, jobs, &again, error)
                 : result_fail(error, RESULT_IO, "%s: others keep removing it", store->directory);
  }
  if (result != RESULT_OK) return result;
  for_each(store->directory, sweep_scratch, store);
  for_each(store->directory, sweep_worker, store);
  sweep_done(store);
  store->fresh = for_each(store->directory, count_content, store) == 0;
  return RESULT_OK;
}

static void mark_done(const struct bake_store *store) {
  char *path = files_join(store->directory, done_name);
  int file = path ? open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0666) : -1;
  if (file >= 0) close(file);
  free(path);
}

void bake_store_close(struct bake_store *store, enum bake_store_end end) {
  if (store->worker && store->worker->path) {
    if (end == BAKE_STORE_DONE) mark_done(store);
    bool taken = take_removal(store);
    /* Lets go first: of two who leave at the same time one is then alone. */
    unlink(store->worker->path);
    bool last = for_each(store->directory, is_other, store) == 0 &&
                (end == BAKE_STORE_DROPPED || bake_store_is_done(store) ||
                 (end == BAKE_STORE_KEPT && for_each(store->directory, count_content, store) == 0));
    if (last) for_each(store->directory, sweep_all, store);
    if (taken) remove_name(store->directory, removal_name); /* last: who comes waits for it */
    if (last) rmdir(store->directory); /* stays where somebody put something else into it */
  }
  if (store->worker) bake_worker_leave(store->worker);
  free(store->worker);
  free(store->directory);
  *store = (struct bake_store){0};
}

bool bake_store_is_done(const struct bake_store *store) {
  return exists(store->directory, done_name);
}

bool bake_store_has_others(const struct bake_store *store) {
  return for_each(store->directory, is_other, store) > 0;
}

void bake_store_drop_lists(const struct bake_store *store) {
  for_each(store->directory, sweep_list, store);
}

void bake_store_key(char key[33], ...) {
  XXH3_state_t state; /* XXH3_createState could find no memory */
  XXH3_128bits_reset(&state);
  va_list texts;
  va_start(texts, key);
  for (const char *text; (text = va_arg(texts, const char *));)
    XXH3_128bits_update(&state, text, strlen(text) + 1);
  va_end(texts);
  XXH128_hash_t hash = XXH3_128bits_digest(&state);
  snprintf(key, 33, "%016llx%016llx", (unsigned long long)hash.high64,
           (unsigned long long)hash.low64);
}

char *bake_store_path(const struct bake_store *store, const char *key) {
  return files_join(store->directory, key);
}

enum result bake_store_scratch(const struct bake_store *store, const char *key, char **scratch,
                               struct error *error) {
  const char *id = store->worker->name.id;
  if (asprintf(scratch, "%s/%s%s.%s", store->directory, scratch_mark, id, key ? key : "XXXXXX") <
      0) {
    *scratch = NULL;
    return result_no_memory(error);
  }
  if (key ? mkdir(*scratch, 0777) == 0 : mkdtemp(*scratch) != NULL) return RESULT_OK;
  enum result result =
      result_fail(error, RESULT_IO, "%s: cannot make this folder: %s", *scratch, strerror(errno));
  free(*scratch);
  *scratch = NULL;
  return result;
}

enum result bake_store_commit(const struct bake_store *store, const char *scratch, const char *key,
                              struct error *error) {
  char *path = bake_store_path(store, key);
  if (!path) return result_no_memory(error);
  enum result result = RESULT_OK;
  if (rename(scratch, path) != 0) {
    int reason = errno;
    files_remove_tree(scratch);
    if (reason != ENOTEMPTY && reason != EEXIST)
      result = result_fail(error, RESULT_IO, "%s: %s", path, strerror(reason));
  }
  free(path);
  return result;
}
