/* export_wish.h - what is asked of an export, and what a kind of export is. */
#ifndef EXPORT_WISH_H
#define EXPORT_WISH_H

#include <stdbool.h>

#include "base/warnings.h"
#include "slab/slab.h"

struct export_wish {
  const char *slab;       /* its file, for messages and for what is recorded */
  const char *name;       /* of the lamp: an identifier */
  const char *command;    /* the whole command line */
  double tolerance;       /* relative error of what the kind approximates */
  int polygons[2];        /* of an aperture, along u and v; 0: as many as the tolerance asks */
  bool plain;             /* mitsuba: by its own projectors */
  bool blend;             /* cycles: make NAME.blend, too */
  int rays;               /* of a ray file */
  int seed;               /* of what is drawn at random */
  struct warnings *notes; /* what the user is told: what was chosen, what is lost */
};

/* Writes the pages of a lamp: the file `path`, or the files of a kind that makes a folder into
 * the folder `path`, which is there and empty and gets its real name afterwards. Refuses what
 * the kind cannot hold; messages do not name the slab's file. */
typedef enum result export_write(const struct slab *slabs, int count,
                                 const struct export_wish *wish, const char *path,
                                 struct error *error);

struct export_kind {
  const char *name;    /* for --as */
  const char *ending;  /* of the file, with its point; NULL: the kind makes a folder */
  export_write *write; /* NULL ends a table */
};

#endif
