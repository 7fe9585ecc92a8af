/* scene_import.c - assimp's nodes and meshes as vertices and triangles, see scene_load.h. */
#include <assimp/material.h>
#include <assimp/scene.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "base/vector.h"
#include "scene/scene_load.h"

struct import {
  struct scene_loading *loading;
  const struct aiScene *from;
  bool *used;  /* [materials] */
  int room[5]; /* of the scene's arrays, see reserve */
};

/* A node's transform, z mirrored; normals are turned by its cofactors, which are right for
 * any scale and don't need an inverse. */
struct placement {
  double matrix[3][4];
  double cofactor[3][3];
  double side; /* -1 where it mirrors, so that triangles must be wound the other way */
};

/* One mesh of one node. */
struct instance {
  const struct aiMesh *mesh;
  const struct aiVector3D *uv; /* NULL: none */
  const char *name;
  const struct placement *placement;
  bool flat; /* gets normals of its own: three vertices for each triangle */
};

static struct placement placement_child(const struct placement *parent,
                                        const struct aiMatrix4x4 *m) {
  const double child[4][4] = {
      {(double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4},
      {(double)m->b1, (double)m->b2, (double)m->b3, (double)m->b4},
      {(double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4},
      {0, 0, 0, 1},
  };
  struct placement placement = {0};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 4; ++k) placement.matrix[r][c] += parent->matrix[r][k] * child[k][c];
  for (int r = 0; r < 3; ++r)
    vector_cross(placement.matrix[(r + 1) % 3], placement.matrix[(r + 2) % 3],
                 placement.cofactor[r]);
  placement.side = vector_dot(placement.matrix[0], placement.cofactor[0]) < 0 ? -1 : 1;
  return placement;
}

static void mesh_position(const struct instance *instance, unsigned vertex, double out[3]) {
  const struct aiVector3D *p = &instance->mesh->mVertices[vertex];
  const double point[3] = {(double)p->x, (double)p->y, (double)p->z};
  for (int r = 0; r < 3; ++r) {
    const double *row = instance->placement->matrix[r];
    out[r] = vector_dot(row, point) + row[3];
  }
}

/* False where it has no direction. */
static bool mesh_normal(const struct instance *instance, unsigned vertex, double out[3]) {
  const struct aiVector3D *n = &instance->mesh->mNormals[vertex];
  const double normal[3] = {(double)n->x, (double)n->y, (double)n->z};
  for (int r = 0; r < 3; ++r)
    out[r] = instance->placement->side * vector_dot(instance->placement->cofactor[r], normal);
  return vector_normalise(out);
}

static enum result reserve(struct import *import, size_t vertices, size_t triangles,
                           struct error *error) {
  struct scene *scene = import->loading->scene;
  int *room = import->room;
  vertices += scene->vertices;
  triangles += scene->triangles;
  if (vertices > INT_MAX || triangles > INT_MAX)
    return result_fail(error, RESULT_BAD, "%s: has more than %d vertices or triangles",
                       import->loading->path, INT_MAX);
  int v = (int)vertices, t = (int)triangles;
  bool good = array_reserve(&scene->position, &room[0], v, sizeof *scene->position) &&
              array_reserve(&scene->corners, &room[1], t, sizeof *scene->corners);
  if (good && import->loading->needs == SCENE_SURFACES)
    good = array_reserve(&scene->normal, &room[2], v, sizeof *scene->normal) &&
           array_reserve(&scene->uv, &room[3], v, sizeof *scene->uv) &&
           array_reserve(&scene->material, &room[4], t, sizeof *scene->material);
  return good ? RESULT_OK
              : result_fail(error, RESULT_MEMORY, "%s: out of memory", import->loading->path);
}

static void add_vertex(struct scene *scene, const struct instance *instance, unsigned vertex,
                       const double *flat_normal) {
  size_t k = scene->vertices++;
  mesh_position(instance, vertex, scene->position[k]);
  if (!scene->normal) return;
  if (flat_normal)
    memcpy(scene->normal[k], flat_normal, sizeof scene->normal[k]);
  else
    mesh_normal(instance, vertex, scene->normal[k]);
  const struct aiVector3D *uv = instance->uv;
  scene->uv[k][0] = uv ? (double)uv[vertex].x : 0;
  scene->uv[k][1] = uv ? (double)uv[vertex].y : 0;
}

static enum result bad_triangle(const struct import *import, const struct instance *instance,
                                unsigned face, const char *what, struct error *error) {
  return result_fail(error, RESULT_BAD, "%s: mesh '%s': triangle %u %s", import->loading->path,
                     instance->name, face + 1, what);
}

static enum result add_triangle(struct import *import, const struct instance *instance,
                                unsigned face, size_t base, struct error *error) {
  struct scene *scene = import->loading->scene;
  unsigned index[3];
  double corner[3][3], normal[3];
  memcpy(index, instance->mesh->mFaces[face].mIndices, sizeof index);
  if (instance->placement->side < 0) {
    unsigned swap = index[1];
    index[1] = index[2];
    index[2] = swap;
  }
  for (int k = 0; k < 3; ++k) {
    if (index[k] >= instance->mesh->mNumVertices)
      return bad_triangle(import, instance, face, "has a corner that is no vertex", error);
    mesh_position(instance, index[k], corner[k]);
    for (int c = 0; c < 3; ++c)
      if (!isfinite((float)corner[k][c]))
        return bad_triangle(import, instance, face, "has coordinates that are not finite", error);
    if (instance->uv && !(isfinite(instance->uv[index[k]].x) && isfinite(instance->uv[index[k]].y)))
      return bad_triangle(import, instance, face, "has texture coordinates that are not finite",
                          error);
  }
  if (!scene_has_area((const double *const[]){corner[0], corner[1], corner[2]}, normal)) {
    ++import->loading->dropped;
    if (import->loading->repair) return RESULT_OK;
    return bad_triangle(import, instance, face, "has no area; --repair drops it", error);
  }
  size_t t = scene->triangles++;
  for (int k = 0; k < 3; ++k) {
    scene->corners[t][k] = (int)(instance->flat ? scene->vertices : base + index[k]);
    if (instance->flat) add_vertex(scene, instance, index[k], normal);
  }
  if (scene->material) scene->material[t] = (int)instance->mesh->mMaterialIndex;
  return RESULT_OK;
}

/* Ends of lines need none, nor does a corner that is no vertex: add_triangle refuses it. */
static bool has_normals(const struct instance *instance, const struct aiFace *face) {
  double normal[3];
  for (unsigned k = 0; k < face->mNumIndices && face->mNumIndices == 3; ++k)
    if (face->mIndices[k] < instance->mesh->mNumVertices &&
        !mesh_normal(instance, face->mIndices[k], normal))
      return false;
  return true;
}

/* Decides whether the mesh gets flat normals. */
static enum result check_normals(struct import *import, struct instance *instance,
                                 struct error *error) {
  const struct aiMesh *mesh = instance->mesh;
  const char *what = "has no normals";
  instance->flat = !mesh->mNormals;
  for (unsigned f = 0; f < mesh->mNumFaces && !instance->flat; ++f) {
    if (has_normals(instance, &mesh->mFaces[f])) continue;
    instance->flat = true;
    what = "has a normal without direction";
  }
  if (!instance->flat) return RESULT_OK;
  ++import->loading->flat;
  if (import->loading->repair) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s: mesh '%s' %s; --repair gives it flat ones",
                     import->loading->path, instance->name, what);
}

static const struct aiVector3D *find_uv(const struct import *import, const struct aiMesh *mesh) {
  int channel = 0;
  if (import->loading->needs != SCENE_SURFACES) return NULL;
  aiGetMaterialIntegerArray(import->from->mMaterials[mesh->mMaterialIndex],
                            AI_MATKEY_UVWSRC_DIFFUSE(0), &channel, NULL);
  if (channel < 0 || channel >= AI_MAX_NUMBER_OF_TEXTURECOORDS) return NULL;
  return mesh->mTextureCoords[channel];
}

static enum result add_mesh(struct import *import, const struct aiMesh *mesh, const char *node,
                            const struct placement *placement, struct error *error) {
  struct scene *scene = import->loading->scene;
  unsigned triangles = 0;
  for (unsigned f = 0; f < mesh->mNumFaces; ++f) triangles += mesh->mFaces[f].mNumIndices == 3;
  if (triangles == 0) return RESULT_OK; /* lines and points have no surface */
  struct instance instance = {.mesh = mesh,
                              .uv = find_uv(import, mesh),
                              .name = mesh->mName.length > 0 ? mesh->mName.data : node,
                              .placement = placement};
  enum result result = RESULT_OK;
  if (import->loading->needs == SCENE_SURFACES) result = check_normals(import, &instance, error);
  size_t vertices = instance.flat ? 3 * (size_t)triangles : mesh->mNumVertices;
  if (result == RESULT_OK) result = reserve(import, vertices, triangles, error);
  if (result != RESULT_OK) return result;
  size_t base = scene->vertices;
  for (unsigned v = 0; v < mesh->mNumVertices && !instance.flat; ++v)
    add_vertex(scene, &instance, v, NULL);
  for (unsigned f = 0; f < mesh->mNumFaces && result == RESULT_OK; ++f)
    if (mesh->mFaces[f].mNumIndices == 3) result = add_triangle(import, &instance, f, base, error);
  import->used[mesh->mMaterialIndex] = true;
  return result;
}

static enum result add_node(struct import *import, const struct aiNode *node,
                            const struct placement *parent, struct error *error) {
  enum result result = RESULT_OK;
  struct placement placement = placement_child(parent, &node->mTransformation);
  for (unsigned k = 0; k < node->mNumMeshes && result == RESULT_OK; ++k)
    result = add_mesh(import, import->from->mMeshes[node->mMeshes[k]], node->mName.data, &placement,
                      error);
  for (unsigned k = 0; k < node->mNumChildren && result == RESULT_OK; ++k)
    result = add_node(import, node->mChildren[k], &placement, error);
  return result;
}

enum result scene_import_meshes(struct scene_loading *loading, const struct aiScene *from,
                                bool *used, struct error *error) {
  struct import import = {.loading = loading, .from = from, .used = used};
  /* to POV-Ray's left-handed coordinates */
  struct placement mirror = {.matrix = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}}};
  enum result result = RESULT_OK;
  if (from->mRootNode) result = add_node(&import, from->mRootNode, &mirror, error);
  return result;
}
