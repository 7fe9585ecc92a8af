/* include_own_error.h - what an include's header tells of the slab's own error, beside that of
 * its lights. */
#ifndef INCLUDE_OWN_ERROR_H
#define INCLUDE_OWN_ERROR_H

#include "slab/slab.h"

/* A comment line for each page with light, without the last line end, numbered as the header
 * numbers them: slab_accuracy_table's errors. Free with free. */
enum result include_own_error(const struct slab *slabs, int count, char **text,
                              struct error *error);

#endif
