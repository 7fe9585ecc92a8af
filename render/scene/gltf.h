/* gltf.h - what the files that read glTF 2.0 share (.gltf and .glb; the sections below are those of
 * its specification). They fill in a scene, scene_load.h.
 *
 * Numbers are doubles; vertices may be floats or integers, normalised or not
 * (KHR_mesh_quantization), sparse or not. Messages come without the path of the scene's file:
 * gltf_load (scene_load.h) puts it before them. Nothing is trusted: each index, offset and length
 * is checked before it is used, nothing outside the file's folder is opened, and memory is asked
 * for only as far as the files have bytes. */
#ifndef GLTF_H
#define GLTF_H

#include <stdio.h>

#include "file/json_text.h"
#include "scene/scene_build.h"

struct gltf_bytes {
  unsigned char *at;
  size_t size;
};

/* A bufferView, or a part of one. */
struct gltf_view {
  size_t buffer;     /* its number */
  size_t from, size; /* bytes of it */
  size_t stride;     /* 0: none is said */
};

/* A node's transform: rows of a 3 x 4 matrix. */
struct gltf_place {
  double row[3][4];
};

/* How a material's texture lies on a surface. */
struct gltf_look {
  bool read;
  int set;            /* TEXCOORD_... */
  double place[2][3]; /* KHR_texture_transform: u', v' = place (u, v, 1), v down */
  bool repeats;       /* beyond 0..1, in both directions */
};

struct gltf {
  struct scene_loading *loading;
  json_t *root;
  FILE *file;
  size_t chunk, chunk_size; /* where a .glb has its binary chunk; 0: nowhere */
  size_t buffer_count;
  struct gltf_bytes *buffers; /* [buffer_count]: those within the text, when they are used; owned */
  size_t node_count;
  struct gltf_place *places; /* [node_count]; in the scene; owned */
  size_t *order;             /* [shown]: the nodes of the scene, parents first; owned */
  size_t shown;
  bool *seen;              /* [node_count]; owned */
  struct gltf_look *looks; /* [materials + 1]; owned */
};

/* gltf_file.c: the file and its buffers (3.6.1, 4). Opens the file, finds its JSON text and its
 * binary chunk. */
enum result gltf_open(struct gltf *gltf, struct error *error);
void gltf_close(struct gltf *gltf);

/* Where a bufferView is; it lies within its buffer's byteLength. */
enum result gltf_view(struct gltf *gltf, const json_t *number, struct gltf_view *view,
                      struct error *error);

/* Reads `size` of its bytes from `from` on; the caller frees them. */
enum result gltf_view_read(struct gltf *gltf, const struct gltf_view *view, size_t from,
                           size_t size, struct gltf_bytes *bytes, struct error *error);

/* What number `number` of the list is, *item. Refuses what is no such number. */
enum result gltf_item(const struct gltf *gltf, const char *list, const json_t *number,
                      const json_t **item, struct error *error);

/* owner[key], 0 where there is none. Refuses what is no whole number, or negative. */
enum result gltf_size(const json_t *owner, const char *key, size_t *size, struct error *error);

/* False, and nothing is changed, where owner[key] is no array of so many numbers. */
bool gltf_array(const json_t *owner, const char *key, size_t count, double *numbers);

/* owner[key], or `other` where that is no number. */
double gltf_number(const json_t *owner, const char *key, double other);

/* The extension of that name on an object, or NULL. */
const json_t *gltf_extension(const json_t *owner, const char *name);

/* gltf_uri.c: what URIs say (2.8). Is it a data: URI? */
bool gltf_uri_is_data(const char *uri);

/* The bytes of a data: URI of any media type; the caller frees them. */
enum result gltf_uri_bytes(const char *uri, struct gltf_bytes *bytes, struct error *error);

/* The path of the file that a relative URI names, escapes decoded; the caller frees it. Refuses
 * absolute paths, other schemes, what is outside the folder of `beside`, and what is no file. */
enum result gltf_uri_path(const char *beside, const char *uri, char **path, struct error *error);

/* gltf_accessor.c: numbers of an accessor (3.6.2). */
struct gltf_wanted {
  int least, most; /* components of an element */
  size_t count;    /* elements; 0: any number but 0 */
  bool whole;      /* unsigned integers, not normalised */
};

struct gltf_numbers {
  double *at; /* [count][width]; the caller frees it */
  size_t count;
  int width;
};

enum result gltf_read(struct gltf *gltf, const json_t *number, const struct gltf_wanted *wanted,
                      struct gltf_numbers *numbers, struct error *error);

/* gltf_node.c: the nodes of the scene that is shown (3.5): their places, and cameras. */
enum result gltf_nodes(struct gltf *gltf, struct error *error);
enum result gltf_cameras(struct gltf *gltf, struct error *error);

/* gltf_mesh.c: a mesh of a node (3.7). */
enum result gltf_mesh(struct gltf *gltf, const json_t *node, const struct gltf_place *place,
                      struct error *error);

/* gltf_pose.c: morph targets and skins (3.7.2.2, 3.7.3). Moves numbers of an attribute by the
 * morph targets that have a weight. */
enum result gltf_morph(struct gltf *gltf, const json_t *node, const json_t *mesh,
                       const json_t *primitive, const char *attribute, struct gltf_numbers *numbers,
                       struct error *error);

/* Moves positions and normals (none: at is NULL) by the joints of the node's skin; *place becomes
 * the one for them: a skin does not care where its node is. */
enum result gltf_skin(struct gltf *gltf, const json_t *node, const json_t *attributes,
                      struct gltf_numbers *position, struct gltf_numbers *normal,
                      struct gltf_place *place, struct error *error);

/* gltf_material.c (3.9): makes room for all materials. */
enum result gltf_materials(struct gltf *gltf, struct error *error);

/* The material of that number, which is read once; NULL: none, for a mesh of that name. *look tells
 * how its texture lies and stays gltf's; NULL: it has none. */
enum result gltf_material(struct gltf *gltf, const json_t *number, const char *mesh, int *material,
                          const struct gltf_look **look, struct error *error);

/* gltf_texture.c: the texture of a textureInfo (3.8), and how it lies; *texture is -1 where it has
 * none that can be read and repairs are allowed. */
enum result gltf_texture(struct gltf *gltf, const json_t *info, int *texture,
                         struct gltf_look *look, struct error *error);

/* gltf_extension.c (3.12): refuses what the file requires and is not read; notes what it uses. */
enum result gltf_extensions(struct gltf *gltf, struct error *error);

/* Notes the extensions of a material that are not read. */
enum result gltf_extensions_of(struct gltf *gltf, const json_t *material, struct error *error);

#endif
