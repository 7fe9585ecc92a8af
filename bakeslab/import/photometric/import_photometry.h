/* import_photometry.h - photometric files as a kind of import: IES LM-63 and EULUMDAT. */
#ifndef IMPORT_PHOTOMETRY_H
#define IMPORT_PHOTOMETRY_H

#include "import/kind/import_kind.h"

extern const struct import_kind import_ies, import_eulumdat;

#endif
