/* made_gltf.h - glTF files made by tests, number by number, in either container. */
#ifndef MADE_GLTF_H
#define MADE_GLTF_H

#include <stdbool.h>
#include <stddef.h>

enum made_kind {
  MADE_BYTE = 5120,
  MADE_UNSIGNED_BYTE,
  MADE_SHORT,
  MADE_UNSIGNED_SHORT,
  MADE_UNSIGNED_INT = 5125,
  MADE_FLOAT
};

/* A file in the making; begins as zeros. */
struct made_gltf {
  unsigned char bytes[4096];
  size_t size;
  char views[4096], accessors[4096];
  int view_count, accessor_count;
};

/* Adds `count` elements of `width` numbers, with `gap` bytes before the first and after each of
 * them; `more` is appended to the accessor: ",\"normalized\":true" and so on. Returns its number,
 * which is that of its bufferView too. */
int made_accessor(struct made_gltf *made, enum made_kind kind, int width, size_t count,
                  const double *numbers, size_t gap, const char *more);

/* A file of these bytes among the scratch files. */
const char *made_bytes(const char *name, const void *bytes, size_t size);

/* Writes NAME.gltf with its numbers in a file of bytes, or NAME.glb. `rest` follows the buffers,
 * bufferViews and accessors: ",\"nodes\":..." and so on. */
const char *made_write(const struct made_gltf *made, const char *name, const char *rest);

/* The nodes, one mesh 'm' of one primitive with attributes and what else it has, and a white
 * material that reflects 0.5: for `rest`. */
#define MADE_SCENE                                                                                 \
  ",\"scenes\":[{\"nodes\":[0]}],\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,"  \
  "\"baseColorFactor\":[0.5,0.5,0.5,1]}}]"
#define MADE_MESH(attributes, more)                                                                \
  ",\"meshes\":[{\"name\":\"m\",\"primitives\":[{\"attributes\":{" attributes                      \
  "},\"material\":0" more "}]}]"

#endif
