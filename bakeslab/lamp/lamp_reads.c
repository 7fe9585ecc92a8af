#include "lamp/lamp_reads.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/files.h"

struct lamp_read {
  char *path;
  XXH128_hash_t hash; /* of its content */
};

static enum result hash_file(const char *path, XXH128_hash_t *hash, struct error *error) {
  FILE *file = fopen(path, "re");
  XXH3_state_t *state = XXH3_createState();
  enum result result = RESULT_OK;
  if (!file)
    result = result_fail(error, RESULT_IO, "%s: cannot be read again after POV-Ray read it: %s",
                         path, strerror(errno));
  else if (!state)
    result = result_no_memory(error);
  else
    XXH3_128bits_reset(state);
  char block[65536];
  size_t n;
  while (result == RESULT_OK && (n = fread(block, 1, sizeof block, file)) > 0)
    XXH3_128bits_update(state, block, n);
  if (result == RESULT_OK && ferror(file))
    result = result_fail(error, RESULT_IO, "%s: cannot be read", path);
  if (result == RESULT_OK) *hash = XXH3_128bits_digest(state);
  XXH3_freeState(state);
  if (file) fclose(file);
  return result;
}

static bool has_path(const struct lamp_reads *reads, const char *path) {
  for (int n = 0; n < reads->count; ++n)
    if (!strcmp(reads->files[n].path, path)) return true;
  return false;
}

static enum result add_path(struct lamp_reads *reads, const char *path, struct error *error) {
  struct lamp_read *grown = realloc(reads->files, (size_t)(reads->count + 1) * sizeof *grown);
  if (grown) reads->files = grown;
  char *copy = strdup(path);
  if (!grown || !copy) {
    free(copy);
    return result_no_memory(error);
  }
  struct lamp_read *read = &reads->files[reads->count++];
  *read = (struct lamp_read){.path = copy};
  return hash_file(path, &read->hash, error);
}

/* Notes a file that was opened to be written. `own` is the folder where POV-Ray runs, which it
 * leaves its picture in, and canned.inc what the script declares. */
static void add_written(struct lamp_reads *reads, const char *path, const char *own) {
  static const char *const usual[] = {"frame.", "scene.", "declared.txt", "log"};
  size_t length = strlen(own);
  const char *name = strrchr(path, '/');
  name = name ? name + 1 : path;
  bool inside = !strncmp(path, own, length) && path[length] == '/';
  for (size_t n = 0; inside && n < sizeof usual / sizeof *usual; ++n)
    if (!strncmp(name, usual[n], strlen(usual[n]))) return;
  if (!strncmp(path, "/dev/", 5) || !strncmp(path, "/proc/", 6)) return;
  if (!reads->write[0]) snprintf(reads->write, sizeof reads->write, "%s", name);
}

/* In the order in which the files were first read. */
static void make_key(struct lamp_reads *reads) {
  XXH128_hash_t all = {0};
  for (int n = 0; n < reads->count; ++n) {
    const XXH128_hash_t both[2] = {all, reads->files[n].hash};
    all = XXH3_128bits(both, sizeof both);
  }
  snprintf(reads->key, sizeof reads->key, "%016llx%016llx", (unsigned long long)all.high64,
           (unsigned long long)all.low64);
}

enum result lamp_reads_collect(const char *directory, const char *script, const char *name,
                               struct lamp_reads *reads, struct error *error) {
  *reads = (struct lamp_reads){0};
  char *own = realpath(directory, NULL);
  char *text = own ? files_read(directory, "reads.txt") : NULL;
  enum result result = RESULT_OK;
  if (!own || (!text && errno == ENOMEM)) result = result_no_memory(error);
  char *rest = text;
  for (char *path; own && result == RESULT_OK && rest && *rest && (path = strsep(&rest, "\n"));)
    if (*path == '*')
      reads->highlights = true;
    else if (*path == '&')
      reads->translucent = true;
    else if (*path == '>')
      add_written(reads, path + 1, own);
    else if (strncmp(path, own, strlen(own)) != 0 && strncmp(path, "/proc/", 6) != 0 &&
             !has_path(reads, path))
      result = add_path(reads, path, error);
  /* A statically linked POV-Ray ignores preloaded libraries. */
  if (result == RESULT_OK && !has_path(reads, script))
    result = result_fail(error, RESULT_IO,
                         "%s: cannot find out which files the script reads, since this POV-Ray "
                         "ignores LD_PRELOAD; use a dynamically linked one",
                         name);
  make_key(reads);
  free(text);
  free(own);
  return result;
}

enum result lamp_reads_unchanged(const struct lamp_reads *reads, struct error *error) {
  for (int n = 0; n < reads->count; ++n) {
    const struct lamp_read *read = &reads->files[n];
    XXH128_hash_t hash;
    enum result result = hash_file(read->path, &hash, error);
    if (result != RESULT_OK) return result;
    if (!XXH128_isEqual(hash, read->hash))
      return result_fail(
          error, RESULT_BAD,
          "%s: was changed while the lamp was being baked; run the same command again", read->path);
  }
  return RESULT_OK;
}

const char *lamp_reads_path(const struct lamp_reads *reads, int n) {
  return reads->files[n].path;
}

void lamp_reads_free(struct lamp_reads *reads) {
  for (int n = 0; n < reads->count; ++n) free(reads->files[n].path);
  free(reads->files);
  *reads = (struct lamp_reads){0};
}
