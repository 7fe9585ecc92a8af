#include "gather/method.h"

#include <string.h>

enum { RAYS = METHOD_TAKES_SHADOW_RAYS, MAPS = METHOD_TAKES_SHADOW_MAPS };
enum { LEVEL = METHOD_TAKES_LEVEL, SEED = METHOD_TAKES_SEED };

/* paper is section 4.1 as published, levels section 4.2 kept in memory, paper-levels the same as
 * published; views is what projective textures sum (section 4.3), and POV-Ray's lights of the
 * sheet include. */
/* clang-format off */
const struct method gather_methods[GATHER_METHODS] = {
    [GATHER_AUTO] = {"auto", METHOD_TREES_FOR_MANY, METHOD_CHEAPEST, METHOD_BY_TOLERANCE,
        RAYS, 0.01, true, false, "the cheapest within the tolerance"},
    [GATHER_REFERENCE] = {"reference", METHOD_NOTHING, METHOD_GAUSS, METHOD_BY_TOLERANCE,
        RAYS, 1e-6, true, false, "Gauss rules within the tolerance"},
    [GATHER_PAPER] = {"paper", METHOD_NOTHING, METHOD_RANDOM, METHOD_NO_DIAL,
        RAYS | SEED, 0.01, false, false, "a random sample in each micro light"},
    [GATHER_MIDPOINT] = {"midpoint", METHOD_NOTHING, METHOD_MIDPOINT, METHOD_NO_DIAL,
        RAYS, 0.01, false, false, "a sample in the middle of each"},
    [GATHER_PI] = {"pi", METHOD_NOTHING, METHOD_MEANS, METHOD_NO_DIAL,
        RAYS, 0.01, true, false, "the mean radiance of each, the cosine in its middle"},
    [GATHER_CLOSED] = {"closed", METHOD_NOTHING, METHOD_CLOSED, METHOD_NO_DIAL,
        RAYS, 0.01, true, true, "closed form, without highlights and shadows"},
    [GATHER_VIEWS] = {"views", METHOD_NOTHING, METHOD_VIEWS, METHOD_NO_DIAL,
        RAYS, 0.01, false, false, "a point light for each uv sample"},
    [GATHER_LEVELS] = {"levels", METHOD_LEVELS, METHOD_CHEAPEST, METHOD_BY_LEVEL,
        RAYS | LEVEL, 0.01, true, false, "fewer, averaged samples far away"},
    [GATHER_PAPER_LEVELS] = {"paper-levels", METHOD_LEVELS, METHOD_RANDOM, METHOD_BY_LEVEL,
        RAYS | LEVEL | SEED, 0.01, false, false, "the same by random samples"},
    [GATHER_CUT] = {"cut", METHOD_TREES, METHOD_CHEAPEST, METHOD_BY_TOLERANCE,
        RAYS, 0.01, true, false, "blocks of uv samples, as few as the tolerance allows"},
    [GATHER_GL] = {"gl", METHOD_LEVELS, METHOD_OPENGL, METHOD_BY_LEVEL,
        MAPS | LEVEL, 0.01, false, false, "views, by OpenGL"},
};
/* clang-format on */

bool method_parse(const char *name, enum gather_method *method) {
  for (int k = 0; k < GATHER_METHODS; ++k)
    if (!strcmp(name, gather_methods[k].name)) {
      *method = (enum gather_method)k;
      return true;
    }
  return false;
}
