/* receiver_text.h - receivers from a text, one a line: `px py pz nx ny nz`. */
#ifndef RECEIVER_TEXT_H
#define RECEIVER_TEXT_H

#include <stdint.h>
#include <stdio.h>

#include "gather/gather.h"

struct receivers {
  struct receiver *receiver; /* in the order of the text; owned */
  int count, room;
  int *order;     /* a permutation in which neighbours lie near each other; owned */
  uint64_t line;  /* lines read so far */
  uint64_t index; /* receivers read so far */
};

void receiver_text_free(struct receivers *receivers);

/* Replaces what is there by the next `most` receivers, fewer at the end of the text. Empty
 * lines and lines that start with # are skipped. Normals become unit. Refuses, naming the
 * line, what is not six finite numbers and a normal without direction. */
enum result receiver_text_read(FILE *in, int most, struct receivers *receivers,
                               struct error *error);

#endif
