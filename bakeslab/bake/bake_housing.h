/* bake_housing.h - what a script declares of the lamp's visible housing. */
#ifndef BAKE_HOUSING_H
#define BAKE_HOUSING_H

#include "batch/bake_run.h"

/* The housing as SDL, where the script declares one that stands alone; else NULL, with a warning in
 * the report where one is left out. The caller frees it. */
enum result bake_housing(const struct bake_work *work, struct bake_report *report, char **housing,
                         struct error *error);

#endif
