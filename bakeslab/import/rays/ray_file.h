/* ray_file.h - files of rays, as makers of LEDs give them out and simulations write them, as a
 * stream: TM-25, Zemax binary source files, and text.
 *
 * Lengths become metres. Axes stay those of the file: TM-25 and Zemax are right-handed, so that
 * in lamp space, which is left-handed, their lamps are mirror images (import_rays.c tells).
 * Messages name the file and the line or byte. */
#ifndef RAY_FILE_H
#define RAY_FILE_H

#include <stdbool.h>

#include "base/warnings.h"
#include "import/rays/ray_bytes.h"

struct ray {
  double origin[3];    /* metres; a point of the ray's line, not always where light leaves a lamp */
  double direction[3]; /* of unit length */
  double flux[3];      /* linear Rec. 709, in W or lm; all alike where the file has no colours */
};

/* Records of floats, one a ray: TM-25 and Zemax. */
struct ray_records {
  bool swapped;      /* big-endian */
  int columns;       /* floats a ray; the first six are its place and direction */
  int flux;          /* the column of its flux, or of Y */
  int x, z;          /* those of the tristimulus values X and Z, or 0 */
  double metres;     /* per unit of length */
  uint64_t promised; /* rays */
  int promise;       /* the header's byte that says so */
  uint64_t next;     /* ray, from 0 */
};

struct ray_format;

struct ray_file {
  const char *path;
  const struct ray_format *format;
  struct ray_bytes bytes;
  struct ray_records records;
  double metres;           /* text: per unit of length */
  unsigned long long line; /* text: lines read */
  bool lumens;             /* rather than watts */
  bool coloured;
  double stated; /* flux of all rays, as the file says; NAN: it does not */
  struct warnings *notes;
};

/* A kind of ray file. */
struct ray_format {
  const char *name; /* "tm25", "zemax", "ray text" */
  /* By a file's first bytes, which a zero follows. */
  bool (*is)(const char *head, size_t size);
  /* Reads the header, and fills what the file says. */
  enum result (*open)(struct ray_file *file, struct error *error);
  /* At most `most` rays; *count is 0 at the end. */
  enum result (*read)(struct ray_file *file, struct ray *rays, size_t most, size_t *count,
                      struct error *error);
};

extern const struct ray_format ray_format_tm25, ray_format_zemax, ray_format_text;

/* `metres`: per unit of the lengths of a text; other files say it themselves. `notes` gets what
 * was read although it is not as it should be. */
enum result ray_file_open(const char *path, const struct ray_format *format, double metres,
                          struct warnings *notes, struct ray_file *file, struct error *error);
void ray_file_close(struct ray_file *file);

/* The next rays, at most `most`; *count is 0 at the end. Each has a direction and a finite flux of
 * 0 or more. */
enum result ray_file_read(struct ray_file *file, struct ray *rays, size_t most, size_t *count,
                          struct error *error);

#endif
