/* engine.h - other renderers, where they are installed: Mitsuba and Blender as modules of python3,
 * or of what MITSUBA_PYTHON and BLENDER_PYTHON name; Radiance's programs on the path. Mitsuba takes
 * samples only where DRJIT_LIBLLVM_PATH names an LLVM that compiles it. */
#ifndef ENGINE_H
#define ENGINE_H

#include <stdbool.h>

enum engine { RADIANCE, MITSUBA_RAYS, MITSUBA, BLENDER };

/* Whether it is there; says so where it is not. */
bool engine_there(enum engine engine);

/* What they say of rows, which are in their own spaces: columns of `rgb`. The folder and name of an
 * export; more: words for the script, of which its head tells, or options of rtrace. All give the
 * CPU seconds, and fail the test where the engine does. */
double engine_mitsuba(const char *folder, const char *name, const char *more, double (*rows)[6],
                      int count, double (*rgb)[3]);
double engine_blender(const char *script, const char *folder, const char *name, const char *more,
                      double (*rows)[6], int count, double (*rgb)[3]);
/* scene: a line of Radiance's scene language. */
double engine_radiance(const char *folder, const char *scene, const char *more, double (*rows)[6],
                       int count, double (*rgb)[3]);

#endif
