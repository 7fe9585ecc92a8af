/* export_mitsuba_plain.h - a lamp for Mitsuba 3 without a plugin: NAME.xml with a projector on each
 * of some positions of each page (projectors.h), and a picture for each. Not exact: the error is
 * told. Mitsuba's space is right-handed with y up: a lamp point (x, y, z) is (x, y, -z) there. */
#ifndef EXPORT_MITSUBA_PLAIN_H
#define EXPORT_MITSUBA_PLAIN_H

#include "export/export_wish.h"

export_write export_mitsuba_plain;

#endif
