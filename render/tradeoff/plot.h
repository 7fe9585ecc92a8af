/* plot.h - plots by gnuplot, run as a program of its own. */
#ifndef PLOT_H
#define PLOT_H

#include <stdio.h>

#include "base/result.h"

/* Can there be a plot of that name: does it end in .svg or .png, and is gnuplot there? Before
 * the work. */
enum result plot_check(const char *path, struct error *error);

/* Runs the script, which names neither terminal nor output. The file appears whole or not at
 * all. */
enum result plot_write(const char *path, const char *script, struct error *error);

/* For a script: a text in single quotes, as gnuplot reads it. */
void plot_quote(FILE *file, const char *text);

#endif
