#include "base/files.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <stdalign.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *files_join(const char *directory, const char *name) {
  char *path = NULL;
  if (asprintf(&path, "%s/%s", directory, name) < 0) return NULL;
  return path;
}

char *files_beside_program(const char *name) {
  char program[PATH_MAX];
  ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
  if (n <= 0) return NULL;
  program[n] = 0;
  char *joined = files_join(dirname(dirname(program)), name);
  char *path = joined ? realpath(joined, NULL) : NULL;
  free(joined);
  return path;
}

char *files_read(const char *directory, const char *name) {
  char *path = files_join(directory, name);
  char *text = NULL;
  size_t size = 0;
  FILE *file = path ? fopen(path, "re") : NULL;
  int why = errno;
  /* No text contains a 0: this reads all of it. */
  if (file && getdelim(&text, &size, 0, file) < 0) {
    why = errno;
    if (feof(file) && text) {
      text[0] = 0;
    } else {
      free(text);
      text = NULL;
    }
  }
  if (file) fclose(file);
  free(path);
  errno = why;
  return text;
}

enum result files_write(const char *directory, const char *name, const char *text,
                        struct error *error) {
  enum result result = RESULT_OK;
  char *path = files_join(directory, name);
  if (!path) return result_no_memory(error);
  FILE *file = fopen(path, "we");
  bool good = file && fputs(text, file) >= 0;
  int reason = errno;
  if (file && fclose(file) != 0 && good) {
    good = false;
    reason = errno;
  }
  if (!good) result = result_fail(error, RESULT_IO, "%s: %s", path, strerror(reason));
  free(path);
  return result;
}

int files_spool_stdin(void) {
  FILE *file = tmpfile();
  if (!file) return -1;
  char buffer[1 << 16];
  ssize_t got;
  bool ok = true;
  while (ok && (got = read(STDIN_FILENO, buffer, sizeof buffer)) != 0)
    ok = got > 0 ? fwrite(buffer, 1, (size_t)got, file) == (size_t)got : errno == EINTR;
  int fd = ok && fflush(file) == 0 ? dup(fileno(file)) : -1;
  int why = errno;
  fclose(file);
  if (fd >= 0) lseek(fd, 0, SEEK_SET);
  errno = why;
  return fd;
}

enum result files_make_directory(const char *path, struct error *error) {
  while (mkdir(path, 0777) != 0) {
    struct stat status;
    int reason = errno;
    if (reason == EEXIST && lstat(path, &status) != 0) continue; /* removed meanwhile */
    if (reason == EEXIST && S_ISLNK(status.st_mode) && stat(path, &status) != 0) status.st_mode = 0;
    if (reason == EEXIST && S_ISDIR(status.st_mode)) return RESULT_OK;
    return result_fail(error, RESULT_IO, "%s: cannot make this folder: %s", path, strerror(reason));
  }
  return RESULT_OK;
}

/* Empties an open folder, by what the system's call gives: nftw and readdir need memory, which may
 * be what is missing. Entries move up as others go: it begins again until none goes. */
static void remove_below(int folder) {
  alignas(struct dirent64) char room[4096];
  for (bool gone = true; gone;) {
    ssize_t size;
    gone = false;
    lseek(folder, 0, SEEK_SET);
    while ((size = getdents64(folder, room, sizeof room)) > 0)
      for (const char *at = room; at < room + size;) {
        const struct dirent64 *entry = (const void *)at;
        const char *name = entry->d_name;
        at += entry->d_reclen;
        if (!strcmp(name, ".") || !strcmp(name, "..")) continue;
        int below = openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (below >= 0) remove_below(below);
        gone |= unlinkat(folder, name, below < 0 ? 0 : AT_REMOVEDIR) == 0;
      }
  }
  close(folder);
}

void files_remove_tree(const char *path) {
  int folder = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder >= 0) remove_below(folder);
  (void)!remove(path);
}
