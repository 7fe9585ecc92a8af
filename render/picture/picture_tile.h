/* picture_tile.h - a picture in parts that different processes render: tile K of N is a run of
 * whole rows of image.h's tiles, in a file of its own.
 *
 * The file is an EXR of two parts, the rows' pixels and their errors; its attribute "tile" is a
 * JSON object of the members below and of what rendering took. Put together, the tiles are the
 * whole picture, to the last bit. */
#ifndef PICTURE_TILE_H
#define PICTURE_TILE_H

#include "picture/image.h"

struct picture_tile {
  int number, count; /* K from 1, N */
  int width, height; /* of the whole picture */
  int top, end;      /* its rows of pixels, the last one excluded */
  char key[33];      /* of all that decides the picture */
  struct gather_counts counts;
  double seconds;   /* that it took */
  double luminance; /* of 1 in the picture, cd/m2 */
};

/* Rows of tiles of K of N: from *first to before *end. False where N is more than there are. */
bool picture_tile_rows(int height, int number, int count, int *first, int *end);

/* The key of what is rendered: scene, lights, camera and all settings but threads and rows. */
void picture_tile_key(const struct image_settings *settings, char key[33]);

/* Writes the tile's rows of a whole picture, whole or not at all. */
enum result picture_tile_write(const char *path, const struct picture_tile *tile,
                               const struct picture *picture, struct error *error);

/* Puts all tiles of a picture together: counts and seconds are summed, the larger error is taken.
 * Refuses files that are no tiles, of different pictures or numbers of tiles, twice the same, or
 * too few. The caller frees the picture. */
enum result picture_tile_join(const char *const *paths, int count, struct picture *picture,
                              struct picture_tile *sum, struct error *error);

#endif
