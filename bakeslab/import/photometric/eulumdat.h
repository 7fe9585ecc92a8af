/* eulumdat.h - reads EULUMDAT files (.ldt; Stockmar 1990, 1998): all symmetries, intensities in
 * cd/klm, decimal commas. */
#ifndef EULUMDAT_H
#define EULUMDAT_H

#include "import/photometric/photometry.h"

/* Whether the first `size` bytes are of such a file: its second to seventh line are its numbers of
 * type, symmetry and angles. */
bool eulumdat_is(const char *head, size_t size);

/* Failures: "line N: ...". The lamp is freed by photometry_free, also after a failure. */
enum result eulumdat_read(const char *text, size_t size, struct photometry *lamp,
                          struct warnings *notes, struct error *error);

#endif
