/* slab_output.h - a file that appears whole or not at all: it is written under
 * a temporary name beside the target and renamed when all of it is on disk. */
#ifndef SLAB_OUTPUT_H
#define SLAB_OUTPUT_H

#include <stddef.h>
#include <stdint.h>

#include "slab_error.h"

#ifdef __cplusplus
extern "C" {
#endif

struct slab_output {
  int fd;          /* open for reading and writing until it is committed or abandoned */
  char *target;    /* what the file will be called; owned */
  char *temporary; /* owned; NULL when there is nothing to remove */
  int flushed;     /* nothing was written since */
};

/* Creates the temporary file. The path "-" is standard output, to which an unnamed
 * temporary file is copied in the end. Any other target may exist if it is a regular file
 * (through symbolic links, which are kept); a link to nothing is refused. */
enum slab_result slab_output_begin(struct slab_output *output, const char *path,
                                   struct slab_error *error);

/* Writes all bytes at an offset. On failure errno says why. */
int slab_output_write(struct slab_output *output, const void *bytes, size_t count, uint64_t offset);

/* Gets all that was written to the disk, so that little can fail when several files that belong
 * together are committed one after the other. */
enum slab_result slab_output_flush(struct slab_output *output, struct slab_error *error);

/* Flushes to disk, closes and renames. After a failure nothing is left behind. */
enum slab_result slab_output_commit(struct slab_output *output, struct slab_error *error);

/* Closes and removes the temporary file. Allowed on a zeroed output, and after
 * a commit, where it does nothing. */
void slab_output_abandon(struct slab_output *output);

#ifdef __cplusplus
}
#endif
#endif
