/* hard.h - hard cases of the includes in POV-Ray, made from seeds: each is right, against a
 * sum that shares no code with bakeslab, or refused in clear words, or it is missed.
 *
 * A case is a lamp of one kind, placed in a scene, and a plane that it lights. Right is a
 * picture whose error, relative and RMS over its pixels, is at most what is allowed: 5e-4
 * against the sum over the lights that the include promises (a sheet's: the slab's own
 * samples; a cluster's and the far field's: the numbers and the image of the include), of
 * which half floats take 2e-4; or what the header states, against the slab's integral.
 * Refused is one line of bakeslab's with exit status 1 or 2 and no file, or POV-Ray's stop
 * at an #error of the include. Lengths of lamps are in lamp units, all others in scene units. */
#ifndef HARD_H
#define HARD_H

#include <stdbool.h>

#include "chain.h"

enum hard_kind { HARD_SHEET, HARD_CLUSTER, HARD_POINT, HARD_KINDS };
extern const char *const hard_kind_names[HARD_KINDS];

enum { HARD_MOST_PIXELS = 64 * 64, HARD_LAMPS = 20, HARD_PAGES = 2 };

/* Where the lamp stands, and how: its point p is at scale * p M + t (chain.h). */
struct hard_lamp {
  double scale, gain[3], matrix[12];
  char arguments[96]; /* what the scene writes for Scale and Gain; empty: the numbers above */
};

enum hard_expect { HARD_EITHER, HARD_RIGHT, HARD_REFUSED, HARD_MISSED };

struct hard_case {
  enum hard_kind kind;
  struct slab pages[HARD_PAGES]; /* owned */
  int page_count;
  int lights;  /* --lights; 0: not given */
  double most; /* Test_Lamp_Lights; 0: not declared */
  struct hard_lamp lamps[HARD_LAMPS];
  int lamp_count;
  struct chain_plane plane;
  int size;             /* pixels along its edges */
  const char *switches; /* of POV-Ray's */
  bool stated;          /* against the slab's integral, `away` widths from the aperture */
  double away;
  enum hard_expect expect;
};

/* What came of a case: HARD_RIGHT, HARD_REFUSED or HARD_MISSED. */
struct hard_result {
  enum hard_expect verdict;
  double error, allowed;
  bool dark;     /* right, and there is no light to see */
  char why[300]; /* of what is not right */
};

/* ---- hard_run.c: makes the include, renders, compares. In the folder of chain.h. */
void hard_run(const struct hard_case *lit, struct hard_result *result);
void hard_free(struct hard_case *lit);

/* ---- hard_sum.c: the sums. */

/* A picture's radiance E/pi, and by how much it is in doubt: light at an
 * edge of a window or of a shadow, and what half floats cannot hold. Pixels that are too
 * close to a lamp to be compared, or where nothing is stated, are infinitely in doubt. */
struct hard_sum {
  double rgb[HARD_MOST_PIXELS][3], doubt[HARD_MOST_PIXELS];
};

/* Reads what it needs of the include, lamp.inc and lamp.exr. False where they lack it. */
bool hard_add(const struct hard_case *lit, struct hard_sum *sum);

/* Height of a page's sheet with so many lights, at Scale 1: the tiles, one texel wider than
 * the window on each side, meet along one axis; lower where one would jut out over the edge of the
 * page, and there are other pages. And the lights that a lamp gets, a page. */
double hard_height(const struct hard_case *lit, const struct slab *page, const int lights[2]);
void hard_lights(const struct hard_case *lit, const struct slab *page, int lights[2]);
double hard_width(const struct slab *page);
/* The radius of a far field's sphere, at Scale 1, of a lamp so wide. */
double hard_radius(const struct hard_lamp *lamp, double width);

/* ---- hard_text.c: what the include says. */

/* Reads `count` numbers after the text, from the include; false where there are fewer. */
bool hard_numbers(const char *after, double *numbers, int count);

/* The error that the header states at a distance in widths, INFINITY where it says that a
 * sheet is farther away, or -1. */
double hard_stated(const struct hard_case *lit);

/* ---- hard_rows.c: the kinds of hard cases. */
struct hard_row {
  const char *name, *text;
  void (*make)(uint64_t *seed, struct hard_case *lit); /* what is easy so far */
};
extern const struct hard_row hard_rows[];
extern const int hard_row_count;

/* One case; random numbers are the row's and the seed's own. */
void hard_make(int row, uint32_t seed, struct hard_case *lit);

#endif
