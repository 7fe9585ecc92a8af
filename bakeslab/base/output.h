/* output.h - a file that appears whole or not at all: it is written under
 * a temporary name beside the target and renamed when all of it is on disk. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stddef.h>
#include <stdint.h>

#include "base/result.h"

struct output {
  int fd;          /* open for reading and writing until it is committed or abandoned */
  char *target;    /* what the file will be called; owned */
  char *temporary; /* owned; NULL when there is nothing to remove */
  int flushed;     /* nothing was written since */
};

/* Before the work: refuses outputs that cannot be written, that are one file, or that are one of
 * the inputs, naming them. NULL among either is skipped; "-" is standard output, or input. */
enum result output_check(const char *const *outputs, int output_count, const char *const *inputs,
                         int input_count, struct error *error);

/* Creates the temporary file. The path "-" is standard output, to which an unnamed
 * temporary file is copied in the end. Any other target may exist if it is a regular file
 * (through symbolic links, which are kept); a link to nothing is refused. */
enum result output_begin(struct output *output, const char *path, struct error *error);

/* Writes all bytes at an offset. On failure errno says why. */
int output_write(struct output *output, const void *bytes, size_t count, uint64_t offset);

/* Gets all that was written to the disk, so that little can fail when several files that belong
 * together are committed one after the other. */
enum result output_flush(struct output *output, struct error *error);

/* Flushes to disk, closes and renames. After a failure nothing is left behind. */
enum result output_commit(struct output *output, struct error *error);

/* Makes a file of a text. */
enum result output_text(const char *path, const char *text, size_t length, struct error *error);

/* Closes and removes the temporary file. Allowed on a zeroed output, and after
 * a commit, where it does nothing. */
void output_abandon(struct output *output);

#endif
