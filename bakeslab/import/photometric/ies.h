/* ies.h - reads IES LM-63 files (ANSI/IES LM-63-1986, 1991, 1995, 2002 and 2019): types A, B and C,
 * all symmetries, all shapes of openings, TILT. */
#ifndef IES_H
#define IES_H

#include "import/photometric/photometry.h"

/* Whether the first `size` bytes are of such a file: a first line of the standard, or a line that
 * starts with TILT=. */
bool ies_is(const char *head, size_t size);

/* `folder` is where TILT files are looked for; NULL: nowhere. Failures: "line N: ...". The lamp is
 * freed by photometry_free, also after a failure. */
enum result ies_read(const char *text, size_t size, const char *folder, struct photometry *lamp,
                     struct warnings *notes, struct error *error);

#endif
