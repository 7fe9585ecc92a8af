#include "batch/bake_store.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#define XXH_STATIC_LINKING_ONLY /* for the size of a state */
#include <xxhash.h>

#include "base/files.h"

static const char scratch_mark[] = "scratch.", lock_name[] = "lock";

/* Names that this file gives: keys, scratch folders, the lock. */
static bool is_ours(const char *name) {
  return !strcmp(name, lock_name) || !strncmp(name, scratch_mark, strlen(scratch_mark)) ||
         (strlen(name) == 32 && strspn(name, "0123456789abcdef") == 32);
}

/* Removes what begins so: all of ours but the lock, or the scratch folders of processes that
 * were killed (nobody else holds the store then). */
static void sweep(const char *directory, const char *beginning) {
  DIR *list = opendir(directory);
  if (!list) return;
  for (struct dirent *entry; (entry = readdir(list));) {
    if (!is_ours(entry->d_name) || strncmp(entry->d_name, beginning, strlen(beginning)) != 0)
      continue;
    if (!strcmp(entry->d_name, lock_name)) continue;
    char *path = files_join(directory, entry->d_name);
    if (path) files_remove_tree(path);
    free(path);
  }
  closedir(list);
}

/* Whether there is nothing but the lock. */
static bool is_empty(const char *directory) {
  DIR *list = opendir(directory);
  bool empty = true;
  for (struct dirent *entry; list && (entry = readdir(list));)
    empty &= entry->d_name[0] == '.' || !strcmp(entry->d_name, lock_name);
  if (list) closedir(list);
  return empty;
}

/* Whether the lock that we hold is still the one in the folder: who held it before us may have
 * removed both when it was done, and somebody else made new ones. */
static bool is_current(int lock, const char *path) {
  struct stat held, there;
  return fstat(lock, &held) == 0 && stat(path, &there) == 0 && held.st_ino == there.st_ino &&
         held.st_dev == there.st_dev;
}

/* F_RDLCK, F_WRLCK or F_UNLCK: false where others hold what that excludes. A record lock is the
 * process's own: one of flock() is held by the child of a fork too, until its exec, and a bake
 * that is killed just then would seem to be at work still. */
static bool set_lock(int lock, short type) {
  struct flock all = {.l_type = type, .l_whence = SEEK_SET};
  return fcntl(lock, F_SETLK, &all) == 0;
}

/* Opens and locks the file once; store->lock is -1 where it has to be tried again. */
static enum result try_lock(const char *path, bool shared, struct bake_store *store,
                            struct error *error) {
  enum result result = files_make_directory(store->directory, error);
  if (result != RESULT_OK) return result;
  store->lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (store->lock < 0) /* the folder may just have gone */
    return errno == ENOENT ? RESULT_OK
                           : result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  if (set_lock(store->lock, shared ? F_RDLCK : F_WRLCK)) {
    if (is_current(store->lock, path)) return RESULT_OK;
  } else if (errno == EAGAIN || errno == EACCES) {
    result =
        result_fail(error, RESULT_IO, "%s: another bake of this output is at work; wait for it",
                    store->directory);
  } else {
    result = result_fail(error, RESULT_IO, "%s: cannot be locked: %s; bake on another file system",
                         path, strerror(errno));
  }
  close(store->lock); /* the store is another's: closing it here removes nothing */
  store->lock = -1;
  return result;
}

enum result bake_store_open(const char *output, bool shared, struct bake_store *store,
                            struct error *error) {
  enum { MOST_TRIES = 1000 };
  *store = (struct bake_store){.lock = -1};
  if (asprintf(&store->directory, "%s.partial", output) < 0) {
    store->directory = NULL;
    return result_no_memory(error);
  }
  char *path = files_join(store->directory, lock_name);
  if (!path) return result_no_memory(error);
  enum result result = RESULT_OK;
  for (int tries = 0; result == RESULT_OK && store->lock < 0; ++tries)
    result = tries < MOST_TRIES
                 ? try_lock(path, shared, store, error)
                 : result_fail(error, RESULT_IO, "%s: others keep removing it", path);
  free(path);
  if (result == RESULT_OK && !shared) sweep(store->directory, scratch_mark);
  store->fresh = result == RESULT_OK && is_empty(store->directory);
  return result;
}

/* Whether nobody else has the store, nor gets it before it is closed. Whoever shares it lets go
 * first: of two who leave at the same time one is then alone. */
static bool is_alone(int lock, const char *path) {
  if (set_lock(lock, F_WRLCK)) return true;
  set_lock(lock, F_UNLCK);
  return set_lock(lock, F_WRLCK) && is_current(lock, path);
}

void bake_store_close(struct bake_store *store, bool finished) {
  char *lock = store->lock >= 0 ? files_join(store->directory, lock_name) : NULL;
  /* A store that others share stays; alone with it, nothing of ours does. */
  if (lock && is_alone(store->lock, lock) && (finished || is_empty(store->directory))) {
    sweep(store->directory, "");
    unlink(lock);            /* last: without it, the next one takes the store for its own */
    rmdir(store->directory); /* stays where somebody put something else into it */
  }
  if (store->lock >= 0) close(store->lock);
  free(lock);
  free(store->directory);
  *store = (struct bake_store){.lock = -1};
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

enum result bake_store_scratch(const struct bake_store *store, char **scratch,
                               struct error *error) {
  /* Not by process number: machines and containers that share the folder have the same. */
  *scratch = files_join(store->directory, "scratch.XXXXXX");
  if (!*scratch) return result_no_memory(error);
  if (mkdtemp(*scratch)) return RESULT_OK;
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
