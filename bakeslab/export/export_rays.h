/* export_rays.h - a lamp as a ray file: rays drawn by their luminance, whose
 * fluxes sum up to the slab's.
 *   rays     text: `x y z dx dy dz flux` a line, metres, in lamp space
 *   tm25ray  IES TM-25-13, little-endian, millimetres, in lamp space, as import reads it; one
 *            flux: luminous for cd/m2, else radiant */
#ifndef EXPORT_RAYS_H
#define EXPORT_RAYS_H

#include "export/export_wish.h"

export_write export_rays, export_tm25;

#endif
