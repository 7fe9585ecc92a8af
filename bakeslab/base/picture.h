/* picture.h - an RGB picture in memory: interleaved linear floats, rows downwards. */
#ifndef PICTURE_H
#define PICTURE_H

struct picture {
  int width, height;
  float *rgb;   /* owned */
  float *error; /* bound on the error of each value, INFINITY where unknown; owned; NULL: none */
  char *about;  /* what is known of the error of the whole; owned; NULL: nothing */
};

void picture_free(struct picture *picture); /* NULL and zeroed pictures allowed */

#endif
