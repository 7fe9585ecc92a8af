/* export_pages.h - a lamp as NAME.json and pictures, which Mitsuba's emitter and Blender's add-on
 * read.
 *
 * NAME.json: {"format": "light-slab-pages", "version": 1, "name": NAME, "pages": [...]}. A page is
 * the JSON of light-slab(5), in lamp space, without "provenance" and with "image": a float EXR
 * beside it, which holds the page's raster as light-slab(5) lays it out. Pages without light are
 * left out. */
#ifndef EXPORT_PAGES_H
#define EXPORT_PAGES_H

#include "export/export_wish.h"

/* The first page with light; NULL where there is none. */
const struct slab *export_pages_first(const struct slab *slabs, int count);

/* Writes NAME.json and the pictures: NAME.exr of a lamp of one page, else NAME_1.exr and so on,
 * by the pages' numbers in the slab. RESULT_BAD where no page has light. */
enum result export_pages_write(const struct slab *slabs, int count, const struct export_wish *wish,
                               const char *folder, struct error *error);

#endif
