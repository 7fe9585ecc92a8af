/* light_text.h - parses `LIGHT` of the command line (light.h): a file and where the light is. */
#ifndef LIGHT_TEXT_H
#define LIGHT_TEXT_H

#include <stdbool.h>

#include "base/result.h"

struct light_text {
  char *path; /* owned */
  double at[3], toward[3], up[3];
  double matrix[4][3];
  double scale, gain[3];
  double lumens, kelvin, metres; /* 0: not given */
  bool has_at, has_toward, has_up, has_matrix;
};

/* FILE may hold blanks: it ends where the first KEY=VALUE begins. Refuses numbers that are not
 * finite, a scale or lumens that are not positive, kelvin beyond those of kelvin.h, keys that are
 * not known, twice or exclude each other. */
enum result light_text_parse(const char *text, struct light_text *light, struct error *error);
void light_text_free(struct light_text *light);

#endif
