/* levels.h - the paper's hierarchy of light slabs (section 4.2): each level is the mean of
 * 2 x 2 uv samples of the one below and, where the st plane is not at infinity, of 2 x 2 st
 * samples too. Energy is the same on all; an odd last row or column counts by its area.
 *
 * Levels are kept in memory: a third more than the slab, or a fifteenth. (The paper averages
 * on the fly, which saves that and reads all samples again each time: paper.h.) */
#ifndef LEVELS_H
#define LEVELS_H

#include "light/light.h"
#include "microlight/seen_page.h"

struct levels {
  int count;               /* besides the page itself, which is level 0 */
  struct light_page *page; /* [count]: levels 1, 2, ...; owned */
};

/* All levels down to one view. */
enum result levels_build(const struct light_page *page, struct levels *levels, struct error *error);

/* The page was moved or turned. */
void levels_move(struct levels *levels, const struct light_page *page);

void levels_free(struct levels *levels); /* NULL allowed; frees what it points to and itself not */

/* The highest level at which a uv cell, seen from the receiver, covers at most about one st cell.
 * So the number of samples is proportional to the solid angle of the aperture. */
int levels_choose(const struct levels *levels, const struct seen_page *seen);

#endif
