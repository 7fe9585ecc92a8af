#include "left.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <xxhash.h>

static size_t without_numbers(char *text, size_t size) {
  size_t kept = 0;
  for (size_t k = 0; k < size; ++k)
    if (!strchr("0123456789.e+-", text[k])) text[kept++] = text[k];
  return kept;
}

/* Of a plot, whose ticks depend on the times, the end. */
static uint64_t hash_file(const char *path, bool timed) {
  enum { PLOT_END = 7 }; /* "</svg>" */
  char block[1 << 16];
  size_t n;
  uint64_t hash = 0;
  FILE *file = fopen(path, "rbe");
  if (!file) return 0;
  if (timed && strstr(path, ".svg")) fseek(file, -PLOT_END, SEEK_END);
  while ((n = fread(block, 1, sizeof block, file)) > 0)
    hash = XXH64(block, timed ? without_numbers(block, n) : n, hash);
  fclose(file);
  return hash;
}

static int is_entry(const struct dirent *entry) {
  size_t length = strlen(entry->d_name);
  const char *end = entry->d_name + (length < 8 ? 0 : length - 8);
  return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0 &&
         strcmp(end, ".partial") != 0;
}

static uint64_t hash_entry(const char *path, bool timed);

/* Names and contents, in the order of names. */
static uint64_t hash_folder(const char *path, bool timed) {
  struct dirent **entries = NULL;
  uint64_t hash = 1;
  int count = scandir(path, &entries, is_entry, alphasort);
  for (int k = 0; k < count; ++k) {
    char below[512];
    snprintf(below, sizeof below, "%s/%s", path, entries[k]->d_name);
    uint64_t content = hash_entry(below, timed);
    hash = XXH64(below, strlen(below), hash);
    hash = XXH64(&content, sizeof content, hash);
    free(entries[k]);
  }
  free(entries);
  return hash;
}

static uint64_t hash_entry(const char *path, bool timed) {
  struct stat status;
  bool folder = lstat(path, &status) == 0 && S_ISDIR(status.st_mode);
  return folder ? hash_folder(path, timed) : hash_file(path, timed);
}

struct left left_look(const char *output, bool timed) {
  struct left left = {.output = hash_file(output, false)};
  struct dirent **entries = NULL;
  int count = scandir(".", &entries, is_entry, alphasort);
  for (int k = 0; k < count; ++k) {
    const char *name = entries[k]->d_name;
    if (left.count == LEFT_MOST || strlen(name) >= LEFT_NAME_SIZE) {
      printf("Bail out! %s: too many files, or too long a name\n", name);
      exit(1);
    }
    strcpy(left.files[left.count].name, name);
    left.files[left.count++].hash = hash_entry(name, timed);
    free(entries[k]);
  }
  free(entries);
  return left;
}

/* Whether the other has the k-th file of one too, alike. */
static bool has(const struct left *other, const struct left *one, int k) {
  for (int n = 0; n < other->count; ++n)
    if (!strcmp(other->files[n].name, one->files[k].name))
      return other->files[n].hash == one->files[k].hash;
  return false;
}

bool left_is_same(const struct left *a, const struct left *b) {
  int alike = 0;
  for (int k = 0; k < a->count; ++k) alike += has(b, a, k);
  return alike == a->count && a->count == b->count;
}

bool left_is_old_or_new(const struct left *now, const struct left *before, const struct left *whole,
                        bool together) {
  int old = 0, new = 0;
  for (int k = 0; k < now->count; ++k) {
    old += has(before, now, k);
    new += !has(before, now, k) && has(whole, now, k);
  }
  bool all = old + new == now->count && now->count >= before->count;
  return all && (!together || !old || !new);
}
