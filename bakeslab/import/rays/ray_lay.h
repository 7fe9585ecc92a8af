/* ray_lay.h - lays apertures where rays leave a lamp. */
#ifndef RAY_LAY_H
#define RAY_LAY_H

#include "import/rays/ray_look.h"
#include "import/rays/ray_pages.h"

/* The faces of the box of the rays' origins through which more than 1/10000 of the light leaves. */
enum result ray_lay_box(const struct ray_look *look, struct ray_pages *pages, struct error *error);

/* One page, square to the axis that is closest to where most light goes, or to the light itself:
 * where the rays' lines come closest together, as large as their light there. */
enum result ray_lay_best(const struct ray_look *look, struct ray_pages *pages, struct error *error);

/* Windows that hold the light that leaves through each page; those of parallel rays are this wide.
 */
#define RAY_LAY_LEAST_WINDOW 1e-3
enum result ray_lay_windows(const struct ray_look *look, struct ray_pages *pages,
                            struct error *error);

#endif
