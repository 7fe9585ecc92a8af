/* ray_pages.h - the apertures of a lamp that is known by its rays, and the rays carried there along
 * their lines: a ray belongs to the page that its line crosses, outwards, closest to where it
 * starts. */
#ifndef RAY_PAGES_H
#define RAY_PAGES_H

#include "import/kind/import_kind.h"
#include "import/rays/ray_file.h"
#include "slab/slab.h"

enum { RAY_PAGES_MOST = IMPORT_APERTURES };

struct ray_page {
  struct slab geometry; /* without samples; owns nothing */
  double u[3], v[3];    /* unit vectors */
  double half[2];       /* the edges' half lengths: */
  double edge[2];       /* rays up to there count, */
  double inside[2];     /* and are moved to there */
};

struct ray_pages {
  int count;
  struct ray_page page[RAY_PAGES_MOST];
};

/* A page from its centre, edges and normal; says what is wrong with them. */
enum result ray_pages_add(struct ray_pages *pages, const double center[3], const double u[3],
                          const double v[3], const double normal[3], struct error *error);

/* The page of a ray, with its place and slopes there; -1: it reaches none. */
int ray_pages_find(const struct ray_pages *pages, const struct ray *ray, double abst[SLAB_AXES]);

#endif
