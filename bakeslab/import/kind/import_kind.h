/* import_kind.h - what each kind of file that can be imported has: a name, how it is known, and
 * the way from it to slabs. import.c holds the table of kinds. */
#ifndef IMPORT_KIND_H
#define IMPORT_KIND_H

#include <stdbool.h>
#include <stddef.h>

#include "base/warnings.h"
#include "slab/slab.h"

enum { IMPORT_HEAD = 65536 }; /* bytes of a file by which its kind is known, at most */

/* A page that rays are carried to; lengths in the wish's unit. */
struct import_aperture {
  double center[3], u[3], v[3], normal[3];
};
enum { IMPORT_APERTURES = 64 };

/* What the user wants. Numbers that are 0 were not given. */
struct import_wish {
  const char *const *files;
  int file_count;
  int uv[2], st[2]; /* samples of each page */
  double tolerance; /* relative error that chooses them */
  double lumens;    /* photometric files: rescales the flux */
  double kelvin;    /* photometric files: colour, of a black body */
  int turn;         /* photometric files: turns the distribution about the vertical, degrees */
  bool narrow;      /* photometric files: small windows, for an include */
  struct import_aperture apertures[IMPORT_APERTURES]; /* ray files, pictures: pages */
  int aperture_count;
  bool box;               /* ray files: pages are the faces of the box of the rays' origins */
  double metres;          /* per unit of the apertures' lengths, of a text's and of poses; 0: 1 */
  bool views;             /* pictures: the one file's name is a pattern (views.h) */
  double window[4];       /* pictures: of st, slopes; all 0: chosen by the poses */
  double distance;        /* pictures: of the st plane, in the wish's unit; 0: infinity */
  double exposure;        /* pictures: factor on their values; 0: 1 */
  double vignetting[3];   /* posed pictures (posed.h) */
  const char *name;       /* of the slabs; NULL: from the first file's name */
  struct warnings *notes; /* what the user may not expect; told as it comes */
};

/* What provenance.import tells (import_provenance.h). */
struct import_story {
  char assumptions[600]; /* one sentence */
  double flux_in;        /* lm or W: what the file holds */
  double flux_out;       /* what the slabs give, as slab_flux_metric */
  double error;          /* relative RMS error of the samples, weighted as they shine */
  char error_is[300];    /* how that was found: one sentence */
  double sample_error;   /* RMS error of the samples' luminance, in their unit; NAN: not known */
  double flux_error;     /* relative error of the flux; NAN: not known */
  double missed;         /* part of the light that no page has; 0: not known */
  bool points;           /* samples are no means over their cells */
};

/* The result: freed by import_free (import.h). */
struct import_light {
  struct slab *slabs; /* `count` of them, owned; names and provenance are set by import.c */
  int count;
  struct import_story story;
};

/* Each has options of its own. Those that are photometric photometry_read (photometry.h) reads,
 * too. */
enum import_family { IMPORT_PHOTOMETRIC, IMPORT_RAYS, IMPORT_PICTURES };

struct import_kind {
  const char *name; /* as provenance.import says */
  /* Whether a file is of this kind, by its first `size` bytes (up to IMPORT_HEAD; a zero
   * follows them) and, where they leave it open, its path. */
  bool (*is)(const char *head, size_t size, const char *path);
  enum import_family family;
  /* Reads wish->files. Messages of failures name file and line or byte. */
  enum result (*slabs)(const struct import_wish *wish, struct import_light *light,
                       struct error *error);
};

#endif
