#include "scene/scene_ply_header.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS = 5, LINE = 512 };

const int ply_sizes[PLY_TYPES] = {0, 1, 1, 2, 2, 4, 4, 4, 8};

/* A line without its end; of a longer one the start. False at the end of the file, and at a zero
 * byte, which no text has. */
static bool read_line(FILE *file, char line[LINE]) {
  size_t length = 0;
  int c = getc_unlocked(file);
  if (c == EOF) return false;
  for (; c != EOF && c != 0 && c != '\n' && c != '\r'; c = getc_unlocked(file))
    if (length < LINE - 1) line[length++] = (char)c;
  if (c == '\r' && (c = getc_unlocked(file)) != '\n' && c != EOF) ungetc(c, file);
  line[length] = 0;
  return c != 0;
}

static enum result refuse(const char *path, const char *line, struct error *error) {
  return result_fail(error, RESULT_BAD, "%s: cannot be read as a mesh: its header says '%s'", path,
                     line);
}

static enum ply_type find_type(const char *name) {
  static const char *const names[PLY_TYPES][2] = {
      {"", ""},           {"char", "int8"},     {"uchar", "uint8"},
      {"short", "int16"}, {"ushort", "uint16"}, {"int", "int32"},
      {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  for (int type = 1; type < PLY_TYPES; ++type)
    for (int k = 0; k < 2; ++k)
      if (strcmp(name, names[type][k]) == 0) return (enum ply_type)type;
  return PLY_NONE;
}

static bool read_format(struct ply_header *header, char words[WORDS][64]) {
  header->binary = strcmp(words[1], "ascii") != 0;
  header->big_endian = strcmp(words[1], "binary_big_endian") == 0;
  return !header->binary || header->big_endian || strcmp(words[1], "binary_little_endian") == 0;
}

static bool read_element(struct ply_header *header, char words[WORDS][64]) {
  char *end;
  if (header->elements == PLY_ELEMENTS) return false;
  struct ply_element *element = &header->element[header->elements++];
  memcpy(element->name, words[1], sizeof element->name);
  element->count = strtoull(words[2], &end, 10);
  return end > words[2] && !*end && words[2][0] != '-';
}

static bool read_property(struct ply_header *header, char words[WORDS][64]) {
  struct ply_element *element = header->elements ? &header->element[header->elements - 1] : NULL;
  if (!element || element->properties == PLY_PROPERTIES) return false;
  struct ply_property *property = &element->property[element->properties++];
  bool list = strcmp(words[1], "list") == 0;
  property->count = list ? find_type(words[2]) : PLY_NONE;
  property->type = find_type(words[list ? 3 : 1]);
  memcpy(property->name, words[list ? 4 : 2], sizeof property->name);
  return property->type != PLY_NONE && property->name[0] &&
         (!list || (property->count != PLY_NONE && property->count < PLY_FLOAT));
}

static bool read_statement(struct ply_header *header, const char *line, bool *ended) {
  char words[WORDS][64] = {"", "", "", "", ""};
  bool good = true;
  sscanf(line, "%63s %63s %63s %63s %63s", words[0], words[1], words[2], words[3], words[4]);
  *ended = strcmp(words[0], "end_header") == 0;
  if (strcmp(words[0], "format") == 0)
    good = read_format(header, words);
  else if (strcmp(words[0], "element") == 0)
    good = read_element(header, words);
  else if (strcmp(words[0], "property") == 0)
    good = read_property(header, words);
  else if (strcmp(words[0], "comment") == 0 && strcmp(words[1], "TextureFile") == 0)
    sscanf(line, " comment TextureFile %255[^\n]", header->texture);
  return good;
}

enum result ply_header_read(FILE *file, const char *path, struct ply_header *header,
                            struct error *error) {
  char line[LINE];
  bool ended = false;
  memset(header, 0, sizeof *header);
  char magic[4] = "";
  if (fread(magic, 1, 3, file) != 3 || strcmp(magic, "ply") != 0)
    return result_fail(error, RESULT_BAD,
                       "%s: cannot be read as a mesh: it does not begin with ply", path);
  while (!ended && read_line(file, line))
    if (!read_statement(header, line, &ended)) return refuse(path, line, error);
  if (ferror(file)) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  if (!ended)
    return result_fail(error, RESULT_BAD, "%s: cannot be read as a mesh: its header has no end",
                       path);
  for (int e = 0; e < header->elements; ++e)
    if (header->element[e].count > 0 && header->element[e].properties == 0)
      return result_fail(error, RESULT_BAD,
                         "%s: cannot be read as a mesh: element '%s' has no properties", path,
                         header->element[e].name);
  return RESULT_OK;
}
