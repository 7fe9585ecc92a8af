/* tiles.h - work in independent pieces by several threads. Which thread does which piece is not
 * determined: a piece must not depend on any other, so that results do not depend on the number
 * of threads. */
#ifndef TILES_H
#define TILES_H

#include "base/result.h"

/* Does piece number `tile`; `worker` (from 0) says whose scratch memory to use. */
typedef enum result tiles_work(void *context, int tile, int worker, struct error *error);

/* Called from the calling thread now and then, with the share that is done. */
typedef void tiles_progress(void *context, double done);

/* Runs all tiles on `threads` >= 1 threads, the calling one among them. After a failure no
 * new tile is started; of several failures that of the lowest tile is reported.
 * `progress` may be NULL. */
enum result tiles_run(int threads, int tiles, tiles_work *work, tiles_progress *progress,
                      void *context, struct error *error);

/* Processors that this process may use. */
int tiles_processors(void);

#endif
