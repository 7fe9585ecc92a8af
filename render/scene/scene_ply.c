/* scene_ply.c - is a PLY file whole? See scene_load.h. */
#include <ctype.h>
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_load.h"

enum { PROPERTIES = 64, ELEMENTS = 16 };

struct ply_property {
  size_t size;       /* bytes of a number, or of a list's items */
  size_t count_size; /* bytes of a list's length; 0: no list */
};

struct ply_element {
  unsigned long long count;
  int properties;
  struct ply_property property[PROPERTIES];
};

struct ply {
  FILE *file;
  const char *path;
  bool binary, big_endian;
  int elements;
  struct ply_element element[ELEMENTS];
};

static size_t type_size(const char *name) {
  static const struct {
    const char *name;
    size_t size;
  } types[] = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
               {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
               {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
               {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  for (size_t k = 0; k < sizeof types / sizeof *types; ++k)
    if (strcmp(name, types[k].name) == 0) return types[k].size;
  return 0;
}

static enum result bad_header(const struct ply *ply, const char *line, struct error *error) {
  return result_fail(error, RESULT_BAD, "%s: cannot be read as a mesh: its header says '%s'",
                     ply->path, line);
}

static enum result read_header_line(struct ply *ply, const char *line, struct error *error) {
  char words[4][32] = {"", "", "", ""};
  sscanf(line, "%31s %31s %31s %31s", words[0], words[1], words[2], words[3]);
  if (strcmp(words[0], "format") == 0) {
    ply->binary = strncmp(words[1], "binary", 6) == 0;
    ply->big_endian = strcmp(words[1], "binary_big_endian") == 0;
  } else if (strcmp(words[0], "element") == 0) {
    char *end;
    if (ply->elements == ELEMENTS) return bad_header(ply, line, error);
    struct ply_element *element = &ply->element[ply->elements++];
    element->count = strtoull(words[2], &end, 10);
    if (end == words[2] || *end || words[2][0] == '-') return bad_header(ply, line, error);
  } else if (strcmp(words[0], "property") == 0) {
    struct ply_element *element = ply->elements ? &ply->element[ply->elements - 1] : NULL;
    if (!element || element->properties == PROPERTIES) return bad_header(ply, line, error);
    struct ply_property *property = &element->property[element->properties++];
    bool list = strcmp(words[1], "list") == 0;
    property->count_size = list ? type_size(words[2]) : 0;
    property->size = type_size(words[list ? 3 : 1]);
    if (!property->size || (list && !property->count_size)) return bad_header(ply, line, error);
  }
  return RESULT_OK;
}

static enum result read_header(struct ply *ply, struct error *error) {
  enum result result = RESULT_OK;
  char *line = NULL;
  size_t room = 0;
  bool ended = false;
  while (result == RESULT_OK && !ended && getline(&line, &room, ply->file) >= 0) {
    line[strcspn(line, "\r\n")] = 0;
    ended = strcmp(line, "end_header") == 0;
    if (!ended) result = read_header_line(ply, line, error);
  }
  if (result == RESULT_OK && !ended && !feof(ply->file))
    result = result_fail(error, RESULT_IO, "%s: %s", ply->path, strerror(errno));
  free(line);
  if (result == RESULT_OK && !ended)
    result = result_fail(error, RESULT_BAD, "%s: cannot be read as a mesh: its header has no end",
                         ply->path);
  return result;
}

static bool skip(struct ply *ply, unsigned long long bytes) {
  char buffer[4096];
  while (bytes > 0) {
    size_t part = bytes < sizeof buffer ? (size_t)bytes : sizeof buffer;
    if (fread(buffer, 1, part, ply->file) != part) return false;
    bytes -= part;
  }
  return true;
}

/* Skips a word of a text; as a number, 0 where it is none. */
static bool skip_word(FILE *file, unsigned long long *number) {
  char word[32];
  size_t length = 0;
  int c = getc_unlocked(file);
  while (c != EOF && isspace(c)) c = getc_unlocked(file);
  for (; c != EOF && !isspace(c); c = getc_unlocked(file))
    if (length < sizeof word - 1) word[length++] = (char)c;
  word[length] = 0;
  *number = strtoull(word, NULL, 10);
  return length > 0;
}

static bool skip_text(struct ply *ply, const struct ply_property *property) {
  unsigned long long count = 0, number;
  if (!skip_word(ply->file, &count)) return false;
  for (; property->count_size > 0 && count > 0; --count)
    if (!skip_word(ply->file, &number)) return false;
  return true;
}

static bool skip_property(struct ply *ply, const struct ply_property *property) {
  unsigned char bytes[8];
  uint64_t count = 0;
  if (!ply->binary) return skip_text(ply, property);
  if (property->count_size == 0) return skip(ply, property->size);
  if (fread(bytes, 1, property->count_size, ply->file) != property->count_size) return false;
  for (size_t k = 0; k < property->count_size; ++k)
    count = count << 8 | bytes[ply->big_endian ? k : property->count_size - 1 - k];
  return count <= UINT32_MAX && skip(ply, count * property->size);
}

/* Of text too: assimp makes room for all elements that the header claims. */
static enum result skip_data(struct ply *ply, struct error *error) {
  for (int e = 0; e < ply->elements; ++e) {
    const struct ply_element *element = &ply->element[e];
    if (element->count > 0 && element->properties == 0)
      return result_fail(error, RESULT_BAD,
                         "%s: cannot be read as a mesh: element %d has no properties", ply->path,
                         e + 1);
    for (unsigned long long k = 0; k < element->count; ++k)
      for (int p = 0; p < element->properties; ++p)
        if (!skip_property(ply, &element->property[p]))
          return result_fail(error, RESULT_BAD, "%s: is cut off: element %llu of %llu is not whole",
                             ply->path, k + 1, element->count);
  }
  return RESULT_OK;
}

enum result scene_ply_check(const char *path, struct error *error) {
  struct ply ply = {.path = path, .file = fopen(path, "re")};
  if (!ply.file) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  enum result result = read_header(&ply, error);
  if (result == RESULT_OK) result = skip_data(&ply, error);
  fclose(ply.file);
  return result;
}
