/* export.h - a slab's light for other programs: which kinds there are, and how one is written. */
#ifndef EXPORT_H
#define EXPORT_H

#include "export/export_wish.h"

/* The kind of a name; of an output's ending where the name is NULL. NULL where there is none. */
const struct export_kind *export_kind_of(const char *name, const char *output);

/* The names of all kinds, for an option's words (values.h), and as a list in a sentence. */
#define EXPORT_KINDS "radiance|mitsuba|cycles|ies|ldt|tm25ray|rays"

/* Letters, digits and _, a letter first: a name that all the programs can hold; and not that of a
 * file which each folder holds. */
enum result export_check_name(const char *name, struct error *error);

/* Before the work: refuses an output that cannot be written, or is there without `force`. A folder
 * is replaced only where an export made it. */
enum result export_check_output(const struct export_kind *kind, const char *output,
                                const char *slab, bool force, struct error *error);

/* Writes the lamp, whole or not at all. */
enum result export_make(const struct export_kind *kind, const struct slab *slabs, int count,
                        const struct export_wish *wish, const char *output, bool force,
                        struct error *error);

#endif
