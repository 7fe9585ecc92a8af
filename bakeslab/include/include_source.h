/* include_source.h - the lamp that an include is made of: a slab's file, or one that
 * `bakeslab import` reads, which is imported in memory with all of its defaults. */
#ifndef INCLUDE_SOURCE_H
#define INCLUDE_SOURCE_H

#include "import/import.h"
#include "include/point/point_table.h"

struct include_source {
  struct import_light light; /* its slabs */
  bool has_table;            /* it is a photometric file: */
  struct point_table table;
};

/* `command` is what provenance says, `notes` receives what the import notes. Failures name the
 * file. Free with include_source_free, also after a failure. */
enum result include_source_load(const char *path, const char *command, struct warnings *notes,
                                struct include_source *source, struct error *error);
void include_source_free(struct include_source *source);

#endif
