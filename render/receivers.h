/* receivers.h - receivers from a text, one a line: `px py pz nx ny nz`. */
#ifndef RECEIVERS_H
#define RECEIVERS_H

#include <stdint.h>
#include <stdio.h>

#include "gather.h"

struct receivers {
  struct receiver *receiver; /* in the order of the text; owned */
  int count, room;
  int *order;     /* a permutation in which neighbours lie near each other; owned */
  uint64_t line;  /* lines read so far */
  uint64_t index; /* receivers read so far */
};

void receivers_free(struct receivers *receivers);

/* Replaces what is there by the next `most` receivers, fewer at the end of the text. Empty
 * lines and lines that start with # are skipped. Normals become unit. Refuses, naming the
 * line, what is not six finite numbers and a normal without direction. */
enum slab_result receivers_read(FILE *in, int most, struct receivers *receivers,
                                struct slab_error *error);

#endif
