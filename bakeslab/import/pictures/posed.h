/* posed.h - a lamp's pictures with poses (poses.h) become its slabs. */
#ifndef POSED_H
#define POSED_H

#include "import/kind/import_kind.h"

/* The kind's `slabs`. Pages are the wish's apertures; the notes tell how many of the samples were
 * filled in, and how much light the pages miss. */
enum result posed_slabs(const struct import_wish *wish, struct import_light *light,
                        struct error *error);

#endif
