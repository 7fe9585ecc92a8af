/* matt.h - scripts without highlights and rainbows: POV-Ray's `specular` and `phong` are no light,
 * and a `rainbow` is not the lamp's, but would be baked as if they were; and what else a finish has
 * that a bake must know. */
#ifndef MATT_H
#define MATT_H

#include <stdio.h>

/* What a finish may have. */
enum matt_found {
  MATT_HIGHLIGHTS = 1, /* specular or phong */
  MATT_TRANSLUCENT = 2 /* diffuse with two numbers: its back side shines, too */
};

/* The script in `file`, which is closed, with "specular 0 phong 0" at the end of each finish, and
 * a clear color_map in each rainbow: the last one counts. *found gets what its finishes have. What
 * is no script, or holds neither, is given back as it is. */
FILE *matt_script(FILE *file, int *found);

#endif
