/* export_mitsuba.h - a lamp for Mitsuba 3: NAME.xml, a rectangle a page with the emitter of
 * slab_emitter.py, which reads NAME.json and its pictures (export_pages.h). Exact for single rays.
 * Mitsuba's space is right-handed with y up: a lamp point (x, y, z) is (x, y, -z) there. */
#ifndef EXPORT_MITSUBA_H
#define EXPORT_MITSUBA_H

#include "export/export_wish.h"

export_write export_mitsuba;

#endif
