/* export_photometry.h - a lamp's far field as a photometric file: its luminous intensities, with
 * the size of its opening. What depends on the position in the opening is lost, and told.
 *   ies  ANSI/IES LM-63-2002: absolute, type C, metres; length along C0 (x), width along C90 (z)
 *   ldt  EULUMDAT (Stockmar 1998): cd/klm; length along C90 (z), width along C0 (x) */
#ifndef EXPORT_PHOTOMETRY_H
#define EXPORT_PHOTOMETRY_H

#include "export/export_wish.h"

export_write export_ies, export_ldt;

#endif
