/* cycles_blend.h - NAME.blend, an asset, made by running the exported add-on in Blender. */
#ifndef CYCLES_BLEND_H
#define CYCLES_BLEND_H

#include "base/result.h"

/* Of FOLDER/NAME.json. Tries the program that the environment's BLENDER names, or else `blender`,
 * and then a python3 with the module bpy. RESULT_IO where there is none, or where it fails. */
enum result cycles_blend(const char *folder, const char *name, struct error *error);

#endif
