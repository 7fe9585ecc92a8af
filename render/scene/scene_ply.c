/* scene_ply.c - reads PLY files into a scene, see scene_load.h: ASCII and binary in both orders of
 * bytes, properties in any order and of any type, faces and triangle strips.
 *
 * Memory grows with what the file holds, not with what its header claims. All surfaces are white;
 * colours and textures are noted as ignored. */
#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "scene/scene_faces.h"
#include "scene/scene_lines.h"
#include "scene/scene_ply_header.h"

/* What a property of a vertex is: an index of struct vertex's numbers. */
enum role { X, Y, Z, NX, NY, NZ, U, V, ROLES, COLOUR, OTHER };

struct ply {
  struct scene_loading *loading;
  FILE *file;
  struct ply_header header;
  struct scene_faces faces;
  bool normals, uvs, vertices_read;
  double *list; /* of a face or strip; owned */
  int list_count, list_room;
};

static enum result checked(const struct ply *ply, bool good, struct error *error) {
  return good ? RESULT_OK : result_at(result_no_memory(error), error, "%s", ply->loading->path);
}

static enum role find_role(const char *name) {
  static const char *const names[][3] = {{"x"},
                                         {"y"},
                                         {"z"},
                                         {"nx"},
                                         {"ny"},
                                         {"nz"},
                                         {"s", "u", "texture_u"},
                                         {"t", "v", "texture_v"}};
  static const char *const colours[] = {"red", "green", "blue", "r", "g", "b", "diffuse_red"};
  for (int role = 0; role < ROLES; ++role)
    for (int k = 0; k < 3 && names[role][k]; ++k)
      if (strcmp(name, names[role][k]) == 0) return (enum role)role;
  for (size_t k = 0; k < sizeof colours / sizeof *colours; ++k)
    if (strcmp(name, colours[k]) == 0) return COLOUR;
  return OTHER;
}

/* ASCII: false at the end of the file, and for what is no number. */
static bool read_word(FILE *file, double *number) {
  char word[64], *end;
  size_t length = 0;
  int c = getc_unlocked(file);
  while (c != EOF && isspace(c)) c = getc_unlocked(file);
  for (; c != EOF && !isspace(c); c = getc_unlocked(file)) {
    if (length == sizeof word - 1) return false;
    word[length++] = (char)c;
  }
  word[length] = 0;
  *number = scene_number(word, &end);
  return length > 0 && !*end;
}

static bool read_binary(const struct ply *ply, enum ply_type type, double *number) {
  unsigned char bytes[8];
  int size = ply_sizes[type];
  uint64_t bits = 0;
  for (int k = 0; k < size; ++k) {
    int c = getc_unlocked(ply->file);
    if (c == EOF) return false;
    bytes[k] = (unsigned char)c;
  }
  for (int k = 0; k < size; ++k)
    bits = bits << 8 | bytes[ply->header.big_endian ? k : size - 1 - k];
  uint32_t half = (uint32_t)bits;
  float single;
  switch (type) {
  case PLY_INT8:
    *number = (int8_t)bits;
    break;
  case PLY_INT16:
    *number = (int16_t)bits;
    break;
  case PLY_INT32:
    *number = (int32_t)half;
    break;
  case PLY_FLOAT:
    memcpy(&single, &half, sizeof single);
    *number = (double)single;
    break;
  case PLY_DOUBLE:
    memcpy(number, &bits, sizeof bits);
    break;
  default:
    *number = (double)bits;
  }
  return true;
}

static bool read_number(const struct ply *ply, enum ply_type type, double *number) {
  return ply->header.binary ? read_binary(ply, type, number) : read_word(ply->file, number);
}

static enum result not_whole(const struct ply *ply, const struct ply_element *element,
                             unsigned long long number, struct error *error) {
  if (ferror(ply->file))
    return result_fail(error, RESULT_IO, "%s: %s", ply->loading->path, strerror(errno));
  if (feof(ply->file))
    return result_fail(error, RESULT_BAD, "%s: is cut off: element '%s' %llu of %llu is not whole",
                       ply->loading->path, element->name, number + 1, element->count);
  return result_fail(error, RESULT_BAD, "%s: element '%s' %llu has something that is no number",
                     ply->loading->path, element->name, number + 1);
}

/* Reads a property; lists into ply->list where they are `kept`. False where it is not whole. */
static bool read_property(struct ply *ply, const struct ply_property *property, bool kept,
                          double *number, enum result *result, struct error *error) {
  double count;
  if (property->count == PLY_NONE) return read_number(ply, property->type, number);
  if (!read_number(ply, property->count, &count) || !(count >= 0) || count > UINT32_MAX ||
      floor(count) < count)
    return false;
  if (kept) ply->list_count = 0;
  for (uint64_t left = (uint64_t)count; left > 0; --left) {
    if (!read_number(ply, property->type, number)) return false;
    if (!kept) continue;
    if (ply->list_count == INT_MAX ||
        !array_reserve(&ply->list, &ply->list_room, ply->list_count + 1, sizeof *ply->list)) {
      *result = checked(ply, false, error);
      return true;
    }
    ply->list[ply->list_count++] = *number;
  }
  return true;
}

static enum result add_vertex(struct ply *ply, const double numbers[], struct error *error) {
  enum result result = scene_faces_position(&ply->faces, numbers, error);
  if (result == RESULT_OK && ply->normals)
    result = scene_faces_normal(&ply->faces, numbers + NX, error);
  if (result == RESULT_OK && ply->uvs) result = scene_faces_uv(&ply->faces, numbers + U, error);
  return result;
}

/* What the properties of vertices are; notes the colours. */
static enum result find_roles(struct ply *ply, const struct ply_element *element, enum role *roles,
                              struct error *error) {
  bool there[OTHER + 1] = {false}, good = true;
  for (int p = 0; p < element->properties; ++p) {
    bool list = element->property[p].count != PLY_NONE;
    roles[p] = list ? OTHER : find_role(element->property[p].name);
    there[roles[p]] = true;
  }
  if (!there[X] || !there[Y] || !there[Z])
    return result_fail(error, RESULT_BAD, "%s: cannot be read as a mesh: vertices have no x, y, z",
                       ply->loading->path);
  bool surfaces = ply->loading->needs == SCENE_SURFACES;
  ply->normals = surfaces && there[NX] && there[NY] && there[NZ];
  ply->uvs = surfaces && there[U] && there[V];
  if (surfaces && there[COLOUR]) good = scene_ignore(ply->loading, SCENE_COLOURS, "vertex");
  return checked(ply, good, error);
}

static enum result read_vertices(struct ply *ply, const struct ply_element *element,
                                 struct error *error) {
  enum role roles[PLY_PROPERTIES] = {X};
  if (ply->vertices_read)
    return result_fail(error, RESULT_BAD, "%s: cannot be read as a mesh: it has vertices twice",
                       ply->loading->path);
  ply->vertices_read = true;
  enum result result = find_roles(ply, element, roles, error);
  for (unsigned long long k = 0; k < element->count && result == RESULT_OK; ++k) {
    double numbers[OTHER + 1] = {0};
    for (int p = 0; p < element->properties; ++p)
      if (!read_property(ply, &element->property[p], false, &numbers[roles[p]], &result, error))
        return not_whole(ply, element, k, error);
    result = add_vertex(ply, numbers, error);
  }
  return result;
}

/* Numbers that are none of a vertex become INT_MAX. */
static struct scene_corner make_corner(const struct ply *ply, double index) {
  int k = index >= 0 && index < INT_MAX && floor(index) == index ? (int)index : INT_MAX;
  return (struct scene_corner){k, ply->normals ? k : -1, ply->uvs ? k : -1};
}

static enum result add_face(struct ply *ply, struct scene_corner **corner, int *room,
                            struct error *error) {
  if (!array_reserve(corner, room, ply->list_count, sizeof **corner))
    return checked(ply, false, error);
  for (int k = 0; k < ply->list_count; ++k) (*corner)[k] = make_corner(ply, ply->list[k]);
  return scene_faces_add(&ply->faces, *corner, ply->list_count, error);
}

/* Each corner makes a triangle with the two before it, every other one turned over; -1 begins a new
 * strip. Triangles of less than three different corners only lead on. */
static enum result add_strip(struct ply *ply, struct error *error) {
  enum result result = RESULT_OK;
  int begun = 0;
  for (int k = 0; k < ply->list_count && result == RESULT_OK; ++k, ++begun) {
    const double *index = &ply->list[k];
    if (*index == -1) begun = -1;
    if (begun < 2 || index[0] == index[-1] || index[0] == index[-2] || index[-1] == index[-2])
      continue;
    int turned = begun % 2;
    struct scene_corner corners[3] = {make_corner(ply, index[-2 + turned]),
                                      make_corner(ply, index[-1 - turned]),
                                      make_corner(ply, index[0])};
    result = scene_faces_add(&ply->faces, corners, 3, error);
  }
  return result;
}

static int find_list(const struct ply_element *element) {
  for (int p = 0; p < element->properties; ++p)
    if (element->property[p].count != PLY_NONE &&
        (strcmp(element->property[p].name, "vertex_indices") == 0 ||
         strcmp(element->property[p].name, "vertex_index") == 0))
      return p;
  return -1;
}

static bool is(const struct ply_element *element, const char *name) {
  return strcmp(element->name, name) == 0;
}

/* Faces, or strips of triangles. */
static bool has_faces(const struct ply_element *element) {
  return is(element, "face") || is(element, "tristrips");
}

static enum result read_faces(struct ply *ply, const struct ply_element *element,
                              struct error *error) {
  bool strips = is(element, "tristrips");
  struct scene_corner *corner = NULL;
  int room = 0, list = find_list(element);
  enum result result = RESULT_OK;
  if (list < 0)
    return result_fail(error, RESULT_BAD,
                       "%s: cannot be read as a mesh: faces have no list vertex_indices",
                       ply->loading->path);
  for (unsigned long long k = 0; k < element->count && result == RESULT_OK; ++k) {
    double number;
    ply->faces.number = (size_t)k + 1;
    for (int p = 0; p < element->properties && result == RESULT_OK; ++p)
      if (!read_property(ply, &element->property[p], p == list, &number, &result, error))
        result = not_whole(ply, element, k, error);
    if (result == RESULT_OK)
      result = strips ? add_strip(ply, error) : add_face(ply, &corner, &room, error);
  }
  free(corner);
  return result;
}

static enum result skip(struct ply *ply, const struct ply_element *element, struct error *error) {
  enum result result = RESULT_OK;
  double number;
  for (unsigned long long k = 0; k < element->count; ++k)
    for (int p = 0; p < element->properties; ++p)
      if (!read_property(ply, &element->property[p], false, &number, &result, error))
        return not_whole(ply, element, k, error);
  return RESULT_OK;
}

/* Faces that come before the vertices are read after them. */
static enum result read_data(struct ply *ply, struct error *error) {
  enum result result = RESULT_OK;
  long later[PLY_ELEMENTS] = {0}; /* where they begin; 0: nothing is left to be read */
  for (int e = 0; e < ply->header.elements && result == RESULT_OK; ++e) {
    const struct ply_element *element = &ply->header.element[e];
    bool faces = has_faces(element);
    if (faces && !ply->vertices_read) later[e] = ftell(ply->file);
    if (is(element, "vertex"))
      result = read_vertices(ply, element, error);
    else if (faces && later[e] == 0)
      result = read_faces(ply, element, error);
    else
      result = skip(ply, element, error);
  }
  for (int e = 0; e < ply->header.elements && result == RESULT_OK; ++e)
    if (later[e] > 0)
      result = fseek(ply->file, later[e], SEEK_SET) == 0
                   ? read_faces(ply, &ply->header.element[e], error)
                   : result_fail(error, RESULT_IO, "%s: %s", ply->loading->path, strerror(errno));
  return result;
}

/* PLY knows no materials: one that is white. */
static enum result add_material(struct ply *ply, struct error *error) {
  struct scene *scene = ply->loading->scene;
  scene->materials = calloc(1, sizeof *scene->materials);
  if (!scene->materials) return checked(ply, false, error);
  scene->material_count = 1;
  *scene->materials = (struct scene_material){.diffuse = {1, 1, 1}, .texture = -1};
  bool good = !*ply->header.texture || scene_ignore_statement(ply->loading, "TextureFile");
  return checked(ply, good, error);
}

enum result scene_ply_read(struct scene_loading *loading, struct error *error) {
  struct ply *ply = calloc(1, sizeof *ply);
  if (!ply) return result_no_memory(error);
  ply->loading = ply->faces.loading = loading;
  ply->file = fopen(loading->path, "re");
  enum result result = RESULT_OK;
  if (!ply->file) result = result_fail(error, RESULT_IO, "%s: %s", loading->path, strerror(errno));
  if (result == RESULT_OK) result = ply_header_read(ply->file, loading->path, &ply->header, error);
  if (result == RESULT_OK && loading->needs == SCENE_SURFACES) result = add_material(ply, error);
  if (result == RESULT_OK) result = read_data(ply, error);
  if (ply->file) fclose(ply->file);
  scene_faces_free(&ply->faces);
  free(ply->list);
  free(ply);
  return result;
}
