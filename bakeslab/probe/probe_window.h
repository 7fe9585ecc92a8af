/* probe_window.h - fits the st windows to the light, so that no samples are spent where it
 * is black and none of the light is beyond; the declared window is the outer limit where the script
 * says Canned_Window_Is_Final. */
#ifndef PROBE_WINDOW_H
#define PROBE_WINDOW_H

#include "batch/bake_run.h"

enum { PROBE_WINDOW_LINE = 1024 };

struct probe_windows {
  char line[PROBE_WINDOW_LINE]; /* what was done, one line */
};

/* Whether a bake is asked for other windows, and, where these are only to be narrower, the small
 * bakes that take their measure are small beside it. */
bool probe_window_pays(const struct bake_work *work);

/* Fits the windows of slabs[work->lamp->slab_count], by the light that small bakes with the work's
 * effects show. A page without light keeps its window. */
enum result probe_window(const struct bake_work *work, struct slab *slabs,
                         struct probe_windows *windows, struct bake_report *report,
                         struct error *error);

#endif
