/* lamp_reads.h - the files that a lamp script reads, whether they are still the same, and those
 * that it writes. A library preloaded into POV-Ray lists their paths (preload/reads.c). */
#ifndef LAMP_READS_H
#define LAMP_READS_H

#include <stdbool.h>

#include "base/result.h"

struct lamp_read;

struct lamp_reads {
  struct lamp_read *files;
  int count;
  bool highlights;  /* a script that it includes has `specular` or `phong` */
  bool translucent; /* one has a finish with `diffuse` of two numbers */
  char key[33];     /* of all files' content, whatever folders they lie in */
  char write[80];   /* the name of the first file that the script writes, without its folder */
};

/* Reads the list that POV-Ray left in `directory`; files in that folder itself don't
 * count. `script` must be among the others; `name` is what the user calls it. Free with
 * lamp_reads_free in any case. */
enum result lamp_reads_collect(const char *directory, const char *script, const char *name,
                               struct lamp_reads *reads, struct error *error);
/* Refuses where a file has other content now. */
enum result lamp_reads_unchanged(const struct lamp_reads *reads, struct error *error);
/* The n-th file, absolute and without links; owned by the reads. */
const char *lamp_reads_path(const struct lamp_reads *reads, int n);
void lamp_reads_free(struct lamp_reads *reads);

#endif
