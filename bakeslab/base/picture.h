/* picture.h - an RGB picture in memory: interleaved linear floats, rows downwards. */
#ifndef PICTURE_H
#define PICTURE_H

struct picture {
  int width, height;
  float *rgb;   /* owned */
  float *error; /* how far off each value may be, INFINITY where that is not known; owned, NULL
                   for none */
};

void picture_free(struct picture *picture); /* NULL and zeroed pictures allowed */

#endif
