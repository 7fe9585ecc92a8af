/* matt.h - scripts without highlights and rainbows: POV-Ray's `specular` and `phong` are no light,
 * and a `rainbow` is not the lamp's, but would be baked as if they were. */
#ifndef MATT_H
#define MATT_H

#include <stdio.h>

/* The script in `file`, which is closed, with "specular 0 phong 0" at the end of each finish, and
 * a clear color_map in each rainbow: the last one counts. *found: a finish had highlights. What is
 * no script, or holds neither, is given back as it is. */
FILE *matt_script(FILE *file, int *found);

#endif
