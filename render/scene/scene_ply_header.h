/* scene_ply_header.h - what the header of a PLY file declares. */
#ifndef SCENE_PLY_HEADER_H
#define SCENE_PLY_HEADER_H

#include <stdbool.h>
#include <stdio.h>

#include "base/result.h"

enum { PLY_PROPERTIES = 128, PLY_ELEMENTS = 32 };

/* The types of numbers, and their size in bytes. */
enum ply_type {
  PLY_NONE,
  PLY_INT8,
  PLY_UINT8,
  PLY_INT16,
  PLY_UINT16,
  PLY_INT32,
  PLY_UINT32,
  PLY_FLOAT,
  PLY_DOUBLE,
  PLY_TYPES
};
extern const int ply_sizes[PLY_TYPES];

struct ply_property {
  char name[64];
  enum ply_type count; /* of a list's length; PLY_NONE: no list */
  enum ply_type type;  /* of the number, or of a list's items */
};

struct ply_element {
  char name[64];
  unsigned long long count;
  int properties;
  struct ply_property property[PLY_PROPERTIES];
};

struct ply_header {
  bool binary, big_endian;
  char texture[256]; /* that a comment names, as MeshLab writes it; may be empty */
  int elements;
  struct ply_element element[PLY_ELEMENTS];
};

/* Reads it, and leaves the file at the data. Lines may be of any length and end with LF, CR or
 * both. Lines that begin with other words are comments: some programs break these. */
enum result ply_header_read(FILE *file, const char *path, struct ply_header *header,
                            struct error *error);

#endif
