/* light_text.h - parses `LIGHT` of the command line (light.h): a file and where the light is. */
#ifndef LIGHT_TEXT_H
#define LIGHT_TEXT_H

#include <stdbool.h>

#include "slab/slab.h"

enum { LIGHT_CHANNELS = 16 };

/* The gain of a channel (slab->channel), beside that of the whole lamp: 0 or more. */
struct light_channel {
  char name[SLAB_CHANNEL_SIZE];
  double gain;
};

struct light_text {
  char *path; /* owned */
  double at[3], toward[3], up[3];
  double matrix[4][3];
  double scale, gain[3];
  struct light_channel channels[LIGHT_CHANNELS]; /* those of gain.NAME=, in their order */
  int channel_count;
  double lumens, kelvin, metres; /* 0: not given */
  bool has_at, has_toward, has_up, has_matrix;
};

/* FILE may hold blanks: it ends where the first KEY=VALUE begins. Refuses numbers that are not
 * finite, a scale or lumens that are not positive, a channel's gain below 0, kelvin beyond those of
 * kelvin.h, keys that are not known, twice or exclude each other. */
enum result light_text_parse(const char *text, struct light_text *light, struct error *error);
void light_text_free(struct light_text *light);

#endif
