/* import_rays.h - ray files as kinds of import: TM-25, Zemax binary source files, text. */
#ifndef IMPORT_RAYS_H
#define IMPORT_RAYS_H

#include "import/kind/import_kind.h"

extern const struct import_kind import_tm25, import_zemax, import_ray_text;

#endif
