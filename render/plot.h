/* plot.h - plots by gnuplot, run as a program of its own. */
#ifndef PLOT_H
#define PLOT_H

#include "slab_error.h"

/* Can there be a plot of that name: does it end in .svg or .png, and is gnuplot there? Before
 * the work. */
enum slab_result plot_check(const char *path, struct slab_error *error);

/* Runs the script, which names neither terminal nor output. The file appears whole or not at
 * all. */
enum slab_result plot_write(const char *path, const char *script, struct slab_error *error);

#endif
