/* radiance_page.h - the files of one page of a lamp for Radiance. */
#ifndef RADIANCE_PAGE_H
#define RADIANCE_PAGE_H

#include "export/export_wish.h"
#include "export/radiance_source.h"

/* Whether all samples have R = G = B: one data file does for the three. */
bool radiance_page_grey(const struct slab *slab);

/* Writes STEM.cal, and STEM_r.dat, STEM_g.dat and STEM_b.dat, of a grey page STEM_r.dat alone. */
enum result radiance_page_write(const struct slab *slab, const struct radiance_source *source,
                                const struct export_wish *wish, const char *folder,
                                const char *stem, struct error *error);

#endif
