/* export_provenance.h - the file provenance.json of an exported folder: which command made it of
 * which slab, and what its error against that slab is. It marks the folder as an export, too. */
#ifndef EXPORT_PROVENANCE_H
#define EXPORT_PROVENANCE_H

#include <jansson.h>

#include "export/export_wish.h"

/* Takes over `errors`, an object of the kind's own, which may be NULL where memory ran out. `mark`
 * was taken before it was built (json_text.h). */
enum result export_provenance(const struct slab *slabs, int count, const struct export_wish *wish,
                              const char *kind, json_t *errors, unsigned long mark,
                              const char *folder, struct error *error);

#endif
