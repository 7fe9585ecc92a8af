/* views.h - an array of views: for each position (i, j) of the aperture a picture, whose pixel in
 * column k and row l is the sample L(u_i, v_j, s_k, t_l): columns run with s, rows downwards with
 * t, as the slab's raster does, and as the cameras of `bakeslab bake --camera perspective` look.
 *
 * The names are a pattern: %u and %v stand for i and j, from 0, as in printf: %02u for two
 * digits. */
#ifndef VIEWS_H
#define VIEWS_H

#include "base/result.h"

enum { VIEWS_MOST = 4096 }; /* along an axis */

/* Refuses a pattern without both %u and %v, or with another %. */
enum result views_check(const char *pattern, struct error *error);

/* The name of view (i, j), to be freed; NULL without memory. The pattern is a checked one. */
char *views_name(const char *pattern, int i, int j);

/* How many views there are: all names in the pattern's folder that fit count. Gaps are found when
 * the views are read. */
enum result views_count(const char *pattern, int count[2], struct error *error);

#endif
