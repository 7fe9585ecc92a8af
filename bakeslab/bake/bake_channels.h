/* bake_channels.h - the pages of a lamp whose bulbs are in channels. */
#ifndef BAKE_CHANNELS_H
#define BAKE_CHANNELS_H

#include "lamp/lamp.h"

/* The lamp's pages without samples, once for each of its channels, whose name they bear: all pages
 * of the first, then those of the second. Once, with no name, where it has none. Free with
 * slab_file_free_all, also after a failure. */
enum result bake_channels_pages(const struct lamp *lamp, struct slab **pages, int *count,
                                struct error *error);

#endif
