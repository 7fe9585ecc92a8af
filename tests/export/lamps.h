/* lamps.h - lamps that exports must carry: chiral, coloured, in all frames; and rays into them. */
#ifndef LAMPS_H
#define LAMPS_H

#include <stdbool.h>
#include <stdint.h>

#include "slab/slab.h"

enum { LAMP_PAGES = 2 };

struct lamp {
  const char *name;
  int samples[SLAB_AXES];
  double distance; /* of the st plane; INFINITY allowed */
  double window[4];
  int hand;  /* sign of (u x v).n; 0: with the frame of lamp space's axes, y down */
  int pages; /* the second faces away from the first and is of the other hand */
  const char *unit;
};

extern const struct lamp lamps[];
extern const int lamp_count;

/* Makes the pages, filled with positive colours; and writes them. The file's path. */
void lamp_make(const struct lamp *lamp, struct slab pages[LAMP_PAGES]);
const char *lamp_save(const struct lamp *lamp, const struct slab pages[LAMP_PAGES]);
const char *lamp_write(const struct lamp *lamp, struct slab pages[LAMP_PAGES]);
void lamp_free(struct slab pages[LAMP_PAGES]);

/* A projector of a letter F, which no turn brings onto its mirror image; the file's path. It shines
 * along z, onto a screen of 5 x 5 fields 3 before it, upright as it is seen from the projector. */
enum { LETTER_SIDE = 5, LETTER_FIELDS = LETTER_SIDE * LETTER_SIDE };
const char *lamp_letter(void);
bool lamp_letter_is_lit(int field);
void lamp_letter_place(int field, double lamp[3]);

/* A ray out of the lamp in lamp space: 6 numbers, origin and direction. It leaves through the
 * aperture of one of the pages, or just beside it, within the window or just outside. */
void lamp_ray(const struct lamp *lamp, const struct slab *pages, uint64_t *seed, double ray[6]);

/* side x side receivers that face a page, at a distance, over all that its light reaches there: 6
 * numbers, point and normal. */
void lamp_receivers(const struct slab *page, double distance, int side, double (*receivers)[6]);

/* What `bakeslab lookup` says of rays. */
void lamp_lookup(const char *path, double (*rays)[6], int count, double (*rgb)[3]);

/* `bakeslab export` with more arguments; the folder, and the exit status must be 0. */
const char *lamp_export(const char *path, const char *folder, const char *arguments);

/* Runs a shell command that reads the rows, `columns` numbers each, and prints a row of three
 * numbers for each. Fails the test where it does not. The CPU seconds that it took. */
double lamp_run(const char *command, const double *rows, int columns, int count, double (*rgb)[3]);

/* The largest difference; the root of the sum of its squares over that of `wanted`. */
double lamp_worst(double (*a)[3], double (*b)[3], int count);
double lamp_rms(double (*got)[3], double (*wanted)[3], int count);

/* A lamp point or vector, of y up, in the space of Radiance and Blender, and in that of Mitsuba. */
void lamp_z_up(const double lamp[3], double there[3]);
void lamp_y_up(const double lamp[3], double there[3]);

#endif
