/* gltf_uri.c - what the URIs of a glTF file say, see gltf.h: bytes within the text (RFC 2397), or
 * a file in the scene's folder (RFC 3986, with any UTF-8). */
#include <ctype.h>
#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene/gltf.h"

bool gltf_uri_is_data(const char *uri) {
  return strncasecmp(uri, "data:", 5) == 0;
}

static int hex_digit(char c) {
  return isdigit((unsigned char)c) ? c - '0' : tolower((unsigned char)c) - 'a' + 10;
}

/* Decodes escapes; a % that begins none stands for itself. Returns the length; `out` has as much
 * room as the text. */
static size_t decode_escapes(const char *text, char *out) {
  size_t at = 0;
  while (*text) {
    if (text[0] == '%' && isxdigit((unsigned char)text[1]) && isxdigit((unsigned char)text[2])) {
      out[at++] = (char)(16 * hex_digit(text[1]) + hex_digit(text[2]));
      text += 3;
    } else {
      out[at++] = *text++;
    }
  }
  out[at] = 0;
  return at;
}

/* The value of a letter of base64, or -1; - and _ are those of file names. */
static int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

/* Decodes in place. False where a letter is none of base64. */
static bool decode_base64(struct gltf_bytes *bytes) {
  uint32_t bits = 0;
  int count = 0;
  size_t at = 0, size = bytes->size;
  while (size > 0 && bytes->at[size - 1] == '=') --size;
  for (size_t k = 0; k < size; ++k) {
    char letter = (char)bytes->at[k];
    int value = base64_value(letter);
    if (value < 0 && !isspace((unsigned char)letter)) return false;
    if (value < 0) continue;
    bits = bits << 6 | (uint32_t)value;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes->at[at++] = (unsigned char)(bits >> count);
  }
  bytes->size = at;
  return true;
}

enum result gltf_uri_bytes(const char *uri, struct gltf_bytes *bytes, struct error *error) {
  static const char base64[] = ";base64";
  const char *comma = strchr(uri, ',');
  if (!comma)
    return result_fail(error, RESULT_BAD, "has a data: URI without a comma before its bytes");
  bool packed = (size_t)(comma - uri) >= strlen(base64) &&
                strncasecmp(comma - strlen(base64), base64, strlen(base64)) == 0;
  bytes->at = malloc(strlen(comma));
  if (!bytes->at) return result_no_memory(error);
  bytes->size = decode_escapes(comma + 1, (char *)bytes->at);
  if (!packed || decode_base64(bytes)) return RESULT_OK;
  free(bytes->at);
  *bytes = (struct gltf_bytes){0};
  return result_fail(error, RESULT_BAD, "has a data: URI that is not base64");
}

/* Programs on Windows write \ between folders. */
static bool is_slash(char c) {
  return c == '/' || c == '\\';
}

/* Whether a relative path leads out of its folder. */
static bool leads_out(const char *path) {
  int depth = 0;
  if (is_slash(path[0])) return true;
  while (*path) {
    size_t length = strcspn(path, "/\\");
    if (length == 2 && path[0] == '.' && path[1] == '.')
      --depth;
    else if (length > 1 || (length == 1 && path[0] != '.'))
      ++depth;
    if (depth < 0) return true;
    path += length + (path[length] != 0);
  }
  return false;
}

/* A scheme is a letter, and more of them, digits, + - and . before a colon. */
static bool has_scheme(const char *uri) {
  size_t length = strspn(uri, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.");
  return length > 0 && isalpha((unsigned char)uri[0]) && uri[length] == ':';
}

/* The path of the name decoded, or with its slashes turned, or as the URI stands: the first that is
 * there, else the first. NULL without memory. */
static char *find_file(const char *beside, const char *uri, const char *name) {
  const char *const names[] = {name, name, uri};
  char *first = NULL;
  for (int k = 0; k < 3; ++k) {
    char *path = scene_beside(beside, names[k]);
    for (char *at = path ? path + strlen(path) - strlen(names[k]) : NULL; k == 1 && at && *at; ++at)
      if (*at == '\\') *at = '/';
    if (!path || access(path, F_OK) == 0) {
      free(first);
      return path;
    }
    if (k == 0)
      first = path;
    else
      free(path);
  }
  return first;
}

enum result gltf_uri_path(const char *beside, const char *uri, char **path, struct error *error) {
  enum result result = RESULT_OK;
  struct stat status;
  char *name = calloc(strlen(uri) + 1, 1);
  *path = NULL;
  if (!name) return result_no_memory(error);
  size_t length = decode_escapes(uri, name);
  if (has_scheme(uri))
    result = result_fail(error, RESULT_BAD,
                         "'%.200s' is not in the file's folder, and nothing else "
                         "is opened",
                         uri);
  else if (length == 0 || strlen(name) != length)
    result = result_fail(error, RESULT_BAD, "'%.200s' is no name of a file", uri);
  else if (leads_out(name))
    result = result_fail(error, RESULT_BAD,
                         "'%.200s' is outside the file's folder, and nothing "
                         "there is opened",
                         uri);
  else if (!(*path = find_file(beside, uri, name)))
    result = result_no_memory(error);
  else if (stat(*path, &status) != 0)
    result = result_fail(error, RESULT_IO, "%s: %s", *path, strerror(errno));
  else if (!S_ISREG(status.st_mode))
    result = result_fail(error, RESULT_BAD, "%s: is not a file", *path);
  free(name);
  if (result == RESULT_OK) return RESULT_OK;
  free(*path);
  *path = NULL;
  return result;
}
