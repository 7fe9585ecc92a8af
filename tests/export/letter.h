/* letter.h - a slide projector with the letter F, which no turn brings onto its mirror image. It
 * shines along lamp space's z, its picture upright as it is seen from there; y is up. */
#ifndef LETTER_H
#define LETTER_H

enum { LETTER_PIXELS = 25 };

/* Makes the slab "letter"; its file's path. */
const char *letter_write(void);

/* A ray from the middle of a pixel on a screen to the lamp, in a right-handed space in which the
 * lamp stands at the origin and shines along `forward`; and the radiance it must see. */
void letter_ray(int pixel, const double forward[3], const double up[3], double ray[6]);
double letter_light(int pixel);

#endif
