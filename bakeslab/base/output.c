/* output.c - temporary name, fsync, rename; or a copy to standard output. */
#include "base/output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Containers are not written front to back, as a pipe wants it. */
static enum result begin_stdout(struct output *output, struct error *error) {
  FILE *file = tmpfile();
  output->fd = file ? dup(fileno(file)) : -1;
  int why = errno;
  if (file) fclose(file);
  if (output->fd < 0)
    return result_fail(error, RESULT_IO, "stdout: no temporary file: %s", strerror(why));
  output->target = strdup("stdout");
  if (output->target) return RESULT_OK;
  close(output->fd);
  output->fd = -1;
  return result_fail(error, RESULT_MEMORY, "stdout: out of memory");
}

static enum result copy_to_stdout(struct output *output, struct error *error) {
  char buffer[1 << 16];
  off_t at = 0;
  for (;;) {
    ssize_t got = pread(output->fd, buffer, sizeof buffer, at);
    if (got < 0 && errno == EINTR) continue;
    if (got == 0) return RESULT_OK;
    if (got < 0) break;
    at += got;
    for (ssize_t done = 0, n; done < got; done += n) {
      n = write(STDOUT_FILENO, buffer + done, (size_t)(got - done));
      if (n < 0 && errno != EINTR)
        return result_fail(error, RESULT_IO, "stdout: cannot be written: %s", strerror(errno));
      if (n < 0) n = 0;
    }
  }
  return result_fail(error, RESULT_IO, "stdout: its temporary file: %s", strerror(errno));
}

enum result output_begin(struct output *output, const char *path, struct error *error) {
  memset(output, 0, sizeof *output);
  output->fd = -1;
  if (!strcmp(path, "-")) return begin_stdout(output, error);
  struct stat status;
  if (stat(path, &status) == 0) {
    if (!S_ISREG(status.st_mode))
      return result_fail(error, RESULT_IO, "%s: exists and is not a regular file", path);
    output->target = realpath(path, NULL);
  } else if (lstat(path, &status) == 0) {
    return result_fail(error, RESULT_IO,
                       "%s: is a link to what is not there; remove it or make its target", path);
  } else {
    output->target = strdup(path);
  }
  size_t room = output->target ? strlen(output->target) + sizeof ".XXXXXX" : 0;
  output->temporary = room ? malloc(room) : NULL;
  if (!output->temporary) {
    output_abandon(output);
    return result_fail(error, RESULT_MEMORY, "%s: out of memory", path);
  }
  snprintf(output->temporary, room, "%s.XXXXXX", output->target);
  output->fd = mkstemp(output->temporary);
  if (output->fd < 0) {
    int why = errno;
    free(output->temporary);
    output->temporary = NULL;
    output_abandon(output);
    return result_fail(error, RESULT_IO, "%s: cannot be written: %s", path, strerror(why));
  }
  mode_t mask = umask(0);
  umask(mask);
  /* mkstemp made it private; a file system without modes does not matter. */
  (void)!fchmod(output->fd, 0666 & ~mask);
  return RESULT_OK;
}

int output_write(struct output *output, const void *bytes, size_t count, uint64_t offset) {
  const char *from = bytes;
  output->flushed = 0;
  while (count > 0) {
    ssize_t written = pwrite(output->fd, from, count, (off_t)offset);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      if (written == 0) errno = ENOSPC;
      return -1;
    }
    from += written;
    count -= (size_t)written;
    offset += (uint64_t)written;
  }
  return 0;
}

enum result output_flush(struct output *output, struct error *error) {
  if (output->flushed || !output->temporary) return RESULT_OK;
  if (fsync(output->fd) != 0 && errno != EINVAL)
    return result_fail(error, RESULT_IO, "%s: cannot be written: %s", output->target,
                       strerror(errno));
  output->flushed = 1;
  return RESULT_OK;
}

enum result output_commit(struct output *output, struct error *error) {
  enum result result = output_flush(output, error);
  if (result != RESULT_OK) {
    output_abandon(output);
    return result;
  }
  if (!output->temporary) {
    result = copy_to_stdout(output, error);
    output_abandon(output);
    return result;
  }
  int failed = close(output->fd) != 0, why = errno;
  output->fd = -1;
  if (!failed && rename(output->temporary, output->target) != 0) {
    failed = 1;
    why = errno;
  }
  if (failed) {
    result =
        result_fail(error, RESULT_IO, "%s: cannot be written: %s", output->target, strerror(why));
  } else {
    free(output->temporary);
    output->temporary = NULL;
  }
  output_abandon(output);
  return result;
}

void output_abandon(struct output *output) {
  if (output->target && output->fd >= 0) close(output->fd); /* 0 in a zeroed output */
  if (output->temporary) unlink(output->temporary);
  free(output->temporary);
  free(output->target);
  memset(output, 0, sizeof *output);
  output->fd = -1;
}
