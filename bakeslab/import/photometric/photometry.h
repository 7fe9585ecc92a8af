/* photometry.h - a lamp as its maker measured it: luminous intensity by direction, and the opening
 * that the light comes from. Read from IES LM-63 (ies.h) and EULUMDAT (eulumdat.h) files.
 *
 * Frame: lamp space in metres, the opening's middle at the origin. Gamma 0 is -y (down), C0 is +x
 * and C90 is +z. Towards a unit vector (x, y, z) the angles of the types (LM-63-2002, section 3)
 * are
 *
 *   - C:  x = sin gamma cos C,  y = -cos gamma,     z = sin gamma sin C
 *   - B:  x = cos H sin V,      y = -cos H cos V,   z = -sin H          (V about a horizontal axis)
 *   - A:  x = cos V cos H,      y = sin V,          z = -cos V sin H    (H about the vertical)
 *
 * so that H = V = 0 is down for B, the horizontal C0 for A, and H grows clockwise.
 *
 * Intensity is candela of the whole luminaire: the lamps' lumens, multipliers and ballast factors
 * are in. It is bilinear in the two angles between the table's, and 0 outside of them. */
#ifndef PHOTOMETRY_H
#define PHOTOMETRY_H

#include <stdbool.h>
#include <stddef.h>

#include "base/result.h"
#include "base/warnings.h"

#define PHOTOMETRY_MOST 1e15 /* larger numbers no lamp has */

enum photometry_type { PHOTOMETRY_A = 'A', PHOTOMETRY_B = 'B', PHOTOMETRY_C = 'C' };

/* What the light comes from: convex, centred on the origin. */
enum photometry_shape {
  PHOTOMETRY_POINT,
  PHOTOMETRY_BOX,      /* a size of 0: a rectangle */
  PHOTOMETRY_CYLINDER, /* along `axis`, of elliptical cross-section; 0 along it: a disc */
  PHOTOMETRY_ELLIPSOID
};

enum { PHOTOMETRY_LABEL = 200, PHOTOMETRY_MOST_ANGLES = 10000 };

struct photometry {
  enum photometry_type type;
  int planes;      /* of C, or of H: how many */
  int rows;        /* of gamma, or of V */
  double *plane;   /* degrees, ascending, with all symmetries unfolded: C from 0 to 360, 360
                      being 0 again, or a 0 alone for a lamp that is alike all around; H
                      within -90..90; owned */
  double *row;     /* degrees, ascending: gamma within 0..180, V within -90..90; owned */
  double *candela; /* [plane * rows + row]; may be negative; owned */
  int turn;        /* quarter turns of the distribution about the vertical, C0 towards C90 */
  enum photometry_shape shape;
  int axis;       /* of a cylinder: 0, 1, 2 for x, y, z */
  double size[3]; /* full sizes along x, y, z, metres */
  double side[4]; /* of a box: heights of its sides towards C0, C90, C180, C270, from its bottom
                     upwards; none above size[1] */
  double lumens;  /* of all lamps, as the file states; NAN: it does not (absolute photometry) */
  char label[PHOTOMETRY_LABEL]; /* maker, number and name as the file says, UTF-8, one line */
};

void photometry_free(struct photometry *lamp); /* zeroed ones allowed */

/* Reads a file of either kind: EULUMDAT where its content is not IES LM-63. Folders of TILT files
 * are the file's own. `notes` receives what the user may not expect. Failures: "FILE: line N: ...".
 */
enum result photometry_read(const char *path, struct photometry *lamp, struct warnings *notes,
                            struct error *error);

/* The number of intensities, for planes and rows that are set; allocates them, zeroed. */
enum result photometry_alloc(struct photometry *lamp, struct error *error);

/* Intensity towards a direction of any length but 0. */
double photometry_candela(const struct photometry *lamp, const double direction[3]);

/* The direction (unit) of the table's entry number plane * rows + row. */
void photometry_table_direction(const struct photometry *lamp, size_t entry, double direction[3]);

/* The table's own integral over all directions, lm: exact for the interpolated intensity. */
double photometry_flux(const struct photometry *lamp);

/* The largest intensity of the table. */
double photometry_peak(const struct photometry *lamp);

/* Multiplies all intensities. Refuses those that no lamp has. */
enum result photometry_scale(struct photometry *lamp, double factor, struct error *error);

#endif
