/* bake_store.c - see bake_store.h. */
#include "bake_store.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>
#include <xxhash.h>

#include "files.h"

/* Scratch folders of processes that were killed: nobody else holds the store now. */
static void sweep(const char *directory) {
  DIR *list = opendir(directory);
  if (!list) return;
  for (struct dirent *entry; (entry = readdir(list));) {
    if (!strstr(entry->d_name, ".tmp")) continue;
    char *path = files_join(directory, entry->d_name);
    if (path) files_remove_tree(path);
    free(path);
  }
  closedir(list);
}

enum slab_result bake_store_open(const char *output, bool shared, struct bake_store *store,
                                 struct slab_error *error) {
  *store = (struct bake_store){.lock = -1};
  if (asprintf(&store->directory, "%s.partial", output) < 0) {
    store->directory = NULL;
    return slab_fail(error, SLAB_MEMORY, "out of memory");
  }
  enum slab_result result = files_make_directory(store->directory, error);
  if (result) return result;
  char *path = files_join(store->directory, "lock");
  if (!path) return slab_fail(error, SLAB_MEMORY, "out of memory");
  store->lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (store->lock < 0)
    result = slab_fail(error, SLAB_IO, "%s: %s", path, strerror(errno));
  else if (flock(store->lock, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0) {
    result = slab_fail(error, SLAB_IO, "%s: another bake of this output is at work; wait for it",
                       store->directory);
    close(store->lock); /* the store is the other's: closing it here removes nothing */
    store->lock = -1;
  } else if (!shared) {
    sweep(store->directory);
  }
  free(path);
  return result;
}

/* Whether there is a batch, finished or in hand. */
static bool holds_batches(const char *directory) {
  DIR *list = opendir(directory);
  bool found = false;
  for (struct dirent *entry; list && (entry = readdir(list));)
    found |= entry->d_name[0] != '.' && strcmp(entry->d_name, "lock") != 0;
  if (list) closedir(list);
  return found;
}

void bake_store_close(struct bake_store *store, bool finished) {
  if (store->lock >= 0 && (finished || !holds_batches(store->directory)))
    files_remove_tree(store->directory);
  if (store->lock >= 0) close(store->lock);
  free(store->directory);
  *store = (struct bake_store){.lock = -1};
}

void bake_store_key(char key[33], ...) {
  XXH3_state_t *state = XXH3_createState();
  XXH3_128bits_reset(state);
  va_list texts;
  va_start(texts, key);
  for (const char *text; (text = va_arg(texts, const char *));)
    XXH3_128bits_update(state, text, strlen(text) + 1);
  va_end(texts);
  XXH128_hash_t hash = XXH3_128bits_digest(state);
  XXH3_freeState(state);
  snprintf(key, 33, "%016llx%016llx", (unsigned long long)hash.high64,
           (unsigned long long)hash.low64);
}

char *bake_store_path(const struct bake_store *store, const char *key) {
  return files_join(store->directory, key);
}

char *bake_store_scratch(const struct bake_store *store, const char *key) {
  char *path = NULL;
  if (asprintf(&path, "%s/%s.tmp%ld", store->directory, key, (long)getpid()) < 0) return NULL;
  return path;
}

bool bake_store_has(const struct bake_store *store, const char *key) {
  char *path = bake_store_path(store, key);
  bool has = path && access(path, F_OK) == 0;
  free(path);
  return has;
}

enum slab_result bake_store_commit(const struct bake_store *store, const char *key,
                                   struct slab_error *error) {
  enum slab_result result = SLAB_OK;
  char *scratch = bake_store_scratch(store, key), *path = bake_store_path(store, key);
  if (!scratch || !path)
    result = slab_fail(error, SLAB_MEMORY, "out of memory");
  else if (rename(scratch, path) != 0) {
    int reason = errno;
    files_remove_tree(scratch);
    if (reason != ENOTEMPTY && reason != EEXIST)
      result = slab_fail(error, SLAB_IO, "%s: %s", path, strerror(reason));
  }
  free(scratch);
  free(path);
  return result;
}
