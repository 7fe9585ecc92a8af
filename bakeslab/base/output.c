/* output.c - temporary name, fsync, rename; or a copy to standard output. */
#include "base/output.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/temporary.h"

/* TIFF and EXR are not written from front to back, as a pipe needs it: a temporary file first. */
static enum result begin_stdout(struct output *output, struct error *error) {
  output->target = strdup("stdout");
  if (!output->target) return result_at(result_no_memory(error), error, "stdout");
  FILE *file = tmpfile();
  output->fd = file ? dup(fileno(file)) : -1;
  int why = errno;
  if (file) fclose(file);
  if (output->fd >= 0) return RESULT_OK;
  return result_fail(error, RESULT_IO, "stdout: no temporary file: %s", strerror(why));
}

static enum result copy_to_stdout(const struct output *output, struct error *error) {
  char buffer[1 << 16];
  ssize_t got, done, n;
  for (off_t at = 0; (got = pread(output->fd, buffer, sizeof buffer, at)) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      return result_fail(error, RESULT_IO, "stdout: its temporary file: %s", strerror(errno));
    at += got;
    for (done = 0; done < got;) {
      n = write(STDOUT_FILENO, buffer + done, (size_t)(got - done));
      if (n < 0 && errno != EINTR)
        return result_fail(error, RESULT_IO, "stdout: cannot be written: %s", strerror(errno));
      if (n > 0) done += n;
    }
  }
  return RESULT_OK;
}

/* Sets the target: the path, or what its links lead to. */
static enum result find_target(struct output *output, const char *path, struct error *error) {
  struct stat status;
  bool exists = stat(path, &status) == 0;
  if (exists && !S_ISREG(status.st_mode))
    return result_fail(error, RESULT_IO, "%s: exists and is not a regular file", path);
  if (!exists && lstat(path, &status) == 0)
    return result_fail(error, RESULT_IO,
                       "%s: is a link to what is not there; remove it or make its target", path);
  output->target = exists ? realpath(path, NULL) : strdup(path);
  return output->target ? RESULT_OK : result_at(result_no_memory(error), error, "%s", path);
}

static enum result begin_file(struct output *output, const char *path, struct error *error) {
  enum result result = find_target(output, path, error);
  if (result != RESULT_OK) return result;
  int fd = -1;
  output->temporary = temporary_file(output->target, &fd);
  output->fd = fd;
  if (output->temporary) return RESULT_OK;
  if (errno == ENOMEM) return result_at(result_no_memory(error), error, "%s", path);
  return result_fail(error, RESULT_IO, "%s: cannot be written: %s", path, strerror(errno));
}

/* By whatever links; files that are not there are the same by name. */
static bool same_file(const char *output, const char *other, bool input) {
  struct stat a, b;
  if (!strcmp(output, "-")) return !input && !strcmp(other, "-");
  if (!strcmp(output, other)) return true;
  bool there = input && !strcmp(other, "-") ? fstat(STDIN_FILENO, &b) == 0 : stat(other, &b) == 0;
  return there && stat(output, &a) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

enum result output_check(const char *const *outputs, int output_count, const char *const *inputs,
                         int input_count, struct error *error) {
  for (int k = 0; k < output_count; ++k) {
    if (!outputs[k]) continue;
    for (int i = 0; i < input_count; ++i)
      if (inputs[i] && same_file(outputs[k], inputs[i], true))
        return result_fail(error, RESULT_BAD,
                           "%s: is read too and would be overwritten; choose another name",
                           outputs[k]);
    for (int i = 0; i < k; ++i)
      if (outputs[i] && same_file(outputs[k], outputs[i], false))
        return result_fail(error, RESULT_BAD,
                           "%s: is to hold two different outputs; choose another name", outputs[k]);
    struct output trial;
    enum result result = output_begin(&trial, outputs[k], error);
    output_abandon(&trial);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

enum result output_begin(struct output *output, const char *path, struct error *error) {
  *output = (struct output){.fd = -1};
  bool piped = !strcmp(path, "-");
  enum result result = piped ? begin_stdout(output, error) : begin_file(output, path, error);
  if (result != RESULT_OK) output_abandon(output);
  return result;
}

int output_write(struct output *output, const void *bytes, size_t count, uint64_t offset) {
  const char *from = bytes;
  output->flushed = 0;
  while (count > 0) {
    ssize_t written = pwrite(output->fd, from, count, (off_t)offset);
    if (written < 0 && errno == EINTR) continue;
    if (written == 0) errno = ENOSPC;
    if (written <= 0) return -1;
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

/* Closes the file and gives it its name. */
static enum result rename_file(struct output *output, struct error *error) {
  int fd = output->fd;
  output->fd = -1;
  if (close(fd) != 0 || rename(output->temporary, output->target) != 0)
    return result_fail(error, RESULT_IO, "%s: cannot be written: %s", output->target,
                       strerror(errno));
  temporary_keep(output->temporary);
  output->temporary = NULL;
  return RESULT_OK;
}

enum result output_commit(struct output *output, struct error *error) {
  enum result result = output_flush(output, error);
  if (result == RESULT_OK)
    result = output->temporary ? rename_file(output, error) : copy_to_stdout(output, error);
  output_abandon(output);
  return result;
}

enum result output_text(const char *path, const char *text, size_t length, struct error *error) {
  struct output output = {0};
  enum result result = output_begin(&output, path, error);
  if (result == RESULT_OK && output_write(&output, text, length, 0) != 0)
    result = result_fail(error, RESULT_IO, "%s: cannot be written: %s", path, strerror(errno));
  if (result == RESULT_OK) result = output_commit(&output, error);
  output_abandon(&output);
  return result;
}

void output_abandon(struct output *output) {
  if (output->target && output->fd >= 0) close(output->fd); /* 0 in a zeroed output */
  temporary_remove(output->temporary);
  free(output->target);
  *output = (struct output){.fd = -1};
}
