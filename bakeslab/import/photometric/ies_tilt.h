/* ies_tilt.h - what TILT= says of an IES file's lamps: how their output changes when the luminaire
 * is tilted. */
#ifndef IES_TILT_H
#define IES_TILT_H

#include "import/photometric/photometry_text.h"

/* `tilt` is what follows TILT=: NONE; INCLUDE, whose numbers are next in the text; or a file of
 * such numbers in the folder (NULL: nowhere), whose name may differ in case. *factor is what the
 * intensities are multiplied by, that of a luminaire that is not tilted. */
enum result ies_tilt(struct photometry_text *text, const char *tilt, size_t length,
                     const char *folder, double *factor, struct warnings *notes,
                     struct error *error);

#endif
