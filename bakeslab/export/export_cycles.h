/* export_cycles.h - a lamp for Blender's Cycles: NAME.json and its pictures (export_pages.h), and
 * the add-on canned_lights.py, which makes area lights of them; NAME.blend, where it is asked for,
 * made by Blender itself. Exact for single rays. Blender's space is right-handed with z up: a lamp
 * point (x, y, z) is (x, z, y) there. */
#ifndef EXPORT_CYCLES_H
#define EXPORT_CYCLES_H

#include "export/export_wish.h"

export_write export_cycles;

#endif
