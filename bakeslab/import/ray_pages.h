/* ray_pages.h - the apertures through which a lamp's rays leave, and the rays carried there along
 * their lines: a ray belongs to the page that its line crosses, outwards, closest to where it
 * starts. */
#ifndef RAY_PAGES_H
#define RAY_PAGES_H

#include "import/import_kind.h"
#include "import/ray_look.h"
#include "slab/slab.h"

enum { RAY_PAGES_MOST = IMPORT_APERTURES };

struct ray_page {
  struct slab geometry; /* without samples; owns nothing */
  double u[3], v[3];    /* unit vectors */
  double half[2];       /* the edges' half lengths */
};

struct ray_pages {
  int count;
  struct ray_page page[RAY_PAGES_MOST];
};

/* A page from its centre, edges and normal; says what is wrong with them. */
enum result ray_pages_add(struct ray_pages *pages, const double center[3], const double u[3],
                          const double v[3], const double normal[3], struct error *error);

/* The faces of the box of the rays' origins through which more than 1/10000 of the light leaves. */
enum result ray_pages_box(const struct ray_look *look, struct ray_pages *pages,
                          struct error *error);

/* One page, square to the axis that is closest to where most light goes, or to the light itself:
 * where the rays' lines come closest together, as large as their light there. */
enum result ray_pages_best(const struct ray_look *look, struct ray_pages *pages,
                           struct error *error);

/* Windows that hold the light that leaves through each page; those of parallel rays are this wide.
 */
#define RAY_PAGES_LEAST_WINDOW 1e-3
enum result ray_pages_windows(const struct ray_look *look, struct ray_pages *pages,
                              struct error *error);

/* The page of a ray, with its place and slopes there; -1: it reaches none. */
int ray_pages_find(const struct ray_pages *pages, const struct ray *ray, double abst[SLAB_AXES]);

#endif
