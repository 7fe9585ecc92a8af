/* photometry_pages.h - the pages of a lamp: the faces of the box around its opening that send
 * light, each with the window of slopes that it sends it to.
 *
 * A window has an end, but directions along a face lie at infinite slopes. What a face would send
 * beyond its window, its neighbours send instead: page p has a weight w_p(d) that is 1 in its
 * window, falls to 0 at those ends beyond which a neighbour goes on, and is 0 outside, and the
 * radiance of page p towards d is
 *     L_p(d) = w_p(d) I(d) / sum over pages q of w_q(d) A_q(d),
 * A_q being the projected area of the rays that leave through q. So the far field is the table's in
 * every direction that a page holds. Where all weights are 1, which is so but for directions within
 * some degrees of a face, this is I(d) over the projected luminous area. */
#ifndef PHOTOMETRY_PAGES_H
#define PHOTOMETRY_PAGES_H

#include "import/photometry_body.h"

struct photometry_page {
  int face;
  double window[4]; /* s0, s1, t0, t1 */
  bool fades[4];    /* at these ends, where a neighbour goes on */
};

struct photometry_pages {
  struct photometry_body body;
  int count;
  struct photometry_page page[BODY_FACES]; /* in the faces' order */
  bool thick;                              /* the opening is thicker than the file says */
};

/* Chooses the pages. Flat openings get sides where too much of their light would run along them to
 * be held by a window. Refuses lamps without light. */
enum result photometry_pages(const struct photometry *lamp, double tolerance,
                             struct photometry_pages *pages, struct error *error);

/* Positions along both edges of a page, `along` of them on the longer. Pages that are alike
 * everywhere in a direction do with few, others need LEAST_ROUND. */
enum { PHOTOMETRY_LEAST_EVEN = 2, PHOTOMETRY_LEAST_ROUND = 12 };
void photometry_positions(const struct photometry_pages *pages, int page, int along, int uv[2]);

/* The direction (unit) of slopes on a page, and back; false behind it. */
void photometry_direction(const struct photometry_pages *pages, int page, double s, double t,
                          double direction[3]);
bool photometry_slopes(const struct photometry_pages *pages, int page, const double direction[3],
                       double st[2]);

/* Radiance of a page towards a direction (unit), cd/m2. */
double photometry_radiance(const struct photometry *lamp, const struct photometry_pages *pages,
                           int page, const double direction[3]);

#endif
