/* photometry_pages.h - the pages of a lamp: the faces of the box around its opening that send
 * light, each with the window of slopes that it sends it to.
 *
 * Radiance is L(d) = I(d) / A(d), the intensity over the projected luminous area.
 *
 * A window has an end, but directions along a face lie at infinite slopes. Mostly little is lost
 * there. Where it is more (`shared`), a face's neighbours send what it would send beyond its
 * window: page p has a weight w_p(d) that is 1 in its window, falls to 0 at those ends beyond which
 * a neighbour goes on, and is 0 outside, and the radiance of page p towards d is L_p(d) = w_p(d)
 * I(d) / sum over pages q of w_q(d) A_q(d), A_q being the projected area of the rays that leave
 * through q. So the far field is the table's in every direction that a page holds, and only within
 * some degrees of a face its points do not shine alike. */
#ifndef PHOTOMETRY_PAGES_H
#define PHOTOMETRY_PAGES_H

#include "import/photometric/photometry_body.h"

struct photometry_page {
  int face;
  double window[4]; /* s0, s1, t0, t1 */
  bool fades[4];    /* at these ends, where a neighbour goes on */
};

struct photometry_pages {
  struct photometry_body body;
  int count;
  struct photometry_page page[BODY_FACES]; /* in the faces' order */
  bool narrow;                             /* windows, shared by all faces */
  bool shared;                             /* between neighbours, near the ends of windows */
  bool thick;                              /* the opening is thicker than the file says */
};

/* Chooses the pages. `narrow` asks for small windows, as POV-Ray's sheets want them
 * (include/sheet/): the far field stays, light near by is up to a tenth off. Flat openings get
 * sides where too much of their light would run along them to be held by a window. Refuses lamps
 * without light. */
enum result photometry_pages(const struct photometry *lamp, double tolerance, bool narrow,
                             struct photometry_pages *pages, struct error *error);

/* Positions along both edges of a page: `along` of them on the longer, and as dense on the other.
 * Of round bodies, `along` on both, but for a cylinder's axis, where a quarter does, 2 at least.
 * Pages that are alike everywhere in a direction do with few, others need LEAST_ROUND. */
enum { PHOTOMETRY_LEAST_EVEN = 2, PHOTOMETRY_LEAST_ROUND = 8 };
void photometry_positions(const struct photometry_pages *pages, int page, int along, int uv[2]);

/* The direction (unit) of slopes on a page, and back; false behind it. */
void photometry_direction(const struct photometry_pages *pages, int page, double s, double t,
                          double direction[3]);
bool photometry_slopes(const struct photometry_pages *pages, int page, const double direction[3],
                       double st[2]);

/* Radiance of a page towards a direction (unit) over the intensity there, 1/m2: what the body and
 * the windows make of it. */
double photometry_gain(const struct photometry_pages *pages, int page, const double direction[3]);

/* Radiance of a page towards a direction (unit), cd/m2. */
double photometry_radiance(const struct photometry *lamp, const struct photometry_pages *pages,
                           int page, const double direction[3]);

#endif
