/* gltf_file.c - a glTF file's JSON text and its buffers, see gltf.h. */
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene/gltf.h"

/* A larger text is a mistake, or meant to fill the memory; and so is one of more values than need
 * 1 GiB: of 100 bytes for each bracket, colon and comma, and again for each object (jansson 2.14
 * takes 9/10 of that or less). */
enum { MOST_TEXT = 256 << 20, MOST_MARKS = (1 << 30) / 100 };

/* Words of a .glb: magic, version, length; length and kind of the first chunk. */
enum { GLB_MAGIC = 0x46546c67, GLB_JSON = 0x4e4f534a, GLB_BINARY = 0x004e4942 };

enum result gltf_item(const struct gltf *gltf, const char *list, const json_t *number,
                      const json_t **item, struct error *error) {
  const json_t *all = json_object_get(gltf->root, list);
  json_int_t k = json_is_integer(number) ? json_integer_value(number) : -1;
  size_t count = json_array_size(all);
  *item = k < 0 ? NULL : json_array_get(all, (size_t)k);
  if (json_is_object(*item)) return RESULT_OK;
  if (json_is_integer(number))
    return result_fail(error, RESULT_BAD, "asks for number %lld of its %zu %s", (long long)k, count,
                       list);
  return result_fail(error, RESULT_BAD, "does not say by a number which of its %s it means", list);
}

enum result gltf_size(const json_t *owner, const char *key, size_t *size, struct error *error) {
  const json_t *value = json_object_get(owner, key);
  *size = 0;
  if (!value) return RESULT_OK;
  if (!json_is_integer(value) || json_integer_value(value) < 0)
    return result_fail(error, RESULT_BAD, "%s is not a whole number from 0 on", key);
  *size = (size_t)json_integer_value(value);
  return RESULT_OK;
}

bool gltf_array(const json_t *owner, const char *key, size_t count, double *numbers) {
  const json_t *array = json_object_get(owner, key);
  if (json_array_size(array) != count) return false;
  for (size_t k = 0; k < count; ++k) numbers[k] = json_number_value(json_array_get(array, k));
  return true;
}

double gltf_number(const json_t *owner, const char *key, double other) {
  const json_t *value = json_object_get(owner, key);
  return json_is_number(value) ? json_number_value(value) : other;
}

const json_t *gltf_extension(const json_t *owner, const char *name) {
  return json_object_get(json_object_get(owner, "extensions"), name);
}

/* Where the JSON text and the binary chunk of a .glb are. */
static enum result find_chunks(struct gltf *gltf, const uint32_t head[5], size_t size,
                               size_t *text_size, struct error *error) {
  size_t length = head[2];
  if (head[1] != 2)
    return result_fail(error, RESULT_BAD, "is a .glb of version %u, and only 2 can be read",
                       head[1]);
  if (length > size)
    return result_fail(error, RESULT_BAD, "is cut off: it says that it has %zu bytes, and has %zu",
                       length, size);
  if (length < 20 || head[3] > length - 20 || head[4] != GLB_JSON)
    return result_fail(error, RESULT_BAD,
                       "is a damaged .glb: its first chunk is not JSON text "
                       "within the file");
  *text_size = head[3];
  size_t at = 20 + *text_size;
  uint32_t chunk[2]; /* length, kind; what may follow it is none of glTF 2.0's */
  if (at == length) return RESULT_OK;
  if (length - at < sizeof chunk || fseek(gltf->file, (long)at, SEEK_SET) != 0 ||
      fread(chunk, sizeof chunk, 1, gltf->file) != 1 || chunk[0] > length - at - sizeof chunk)
    return result_fail(error, RESULT_BAD,
                       "is a damaged .glb: the chunk at byte %zu is longer than the file", at);
  if (chunk[1] == GLB_BINARY) {
    gltf->chunk = at + sizeof chunk;
    gltf->chunk_size = chunk[0];
  }
  return RESULT_OK;
}

/* Bytes of an open file from `from` on; one more, 0, stands behind them. */
static enum result read_bytes(FILE *file, size_t from, size_t size, struct gltf_bytes *bytes,
                              struct error *error) {
  bytes->at = malloc(size + 1);
  if (!bytes->at) return result_no_memory(error);
  bytes->at[size] = 0;
  bytes->size = size;
  errno = 0;
  if (fseek(file, (long)from, SEEK_SET) == 0 && fread(bytes->at, 1, size, file) == size)
    return RESULT_OK;
  free(bytes->at);
  *bytes = (struct gltf_bytes){0};
  return result_fail(error, RESULT_IO, "cannot be read: %s",
                     errno ? strerror(errno) : "it became shorter");
}

static size_t count_marks(const char *text) {
  size_t marks = 0;
  for (bool quoted = false; *text; ++text) {
    if (*text == '"') quoted = !quoted;
    if (quoted && *text == '\\' && text[1]) ++text;
    if (!quoted && strchr("{[:,", *text)) marks += *text == '{' ? 2 : 1;
  }
  return marks;
}

static enum result parse(struct gltf *gltf, const char *text, struct error *error) {
  static const char mark[] = "\xef\xbb\xbf"; /* some editors write it before UTF-8 */
  if (strncmp(text, mark, 3) == 0) text += 3;
  if (text[strspn(text, " \t\r\n")] != '{')
    return result_fail(error, RESULT_BAD, "is no glTF, which begins with '{' or 'glTF'");
  if (count_marks(text) > MOST_MARKS)
    return result_fail(error, RESULT_BAD,
                       "has a JSON text of too many values: they need more than 1 GiB of memory");
  enum result result = json_read(text, JSON_ALLOW_NUL, &gltf->root, error);
  if (result != RESULT_OK) return result_at(result, error, "cannot be read as a mesh");
  const json_t *asset = json_object_get(gltf->root, "asset");
  const char *version = json_string_value(json_object_get(asset, "version"));
  const char *least = json_string_value(json_object_get(asset, "minVersion"));
  if (least) version = least;
  if (!version) return result_fail(error, RESULT_BAD, "does not say which version of glTF it is");
  if (strncmp(version, "2.", 2) != 0 || (least && strcmp(least, "2.0") != 0))
    return result_fail(error, RESULT_BAD, "is glTF of version '%s', and only 2.0 can be read",
                       version);
  return RESULT_OK;
}

enum result gltf_open(struct gltf *gltf, struct error *error) {
  struct stat status = {0};
  struct gltf_bytes text = {0};
  uint32_t head[5] = {0};
  gltf->file = fopen(gltf->loading->path, "re");
  if (!gltf->file || fstat(fileno(gltf->file), &status) != 0)
    return result_fail(error, RESULT_IO, "%s", strerror(errno));
  size_t size = (size_t)status.st_size, text_size = size, from = 0;
  enum result result = RESULT_OK;
  if (fread(head, 1, sizeof head, gltf->file) >= 12 && head[0] == GLB_MAGIC) {
    from = sizeof head;
    result = find_chunks(gltf, head, size, &text_size, error);
  }
  if (result == RESULT_OK && text_size > MOST_TEXT)
    result = result_fail(error, RESULT_BAD,
                         "has a JSON text of %zu bytes, and at most %d are read; "
                         "keep the buffers in a file of their own",
                         text_size, MOST_TEXT);
  if (result == RESULT_OK) result = read_bytes(gltf->file, from, text_size, &text, error);
  if (result == RESULT_OK) result = parse(gltf, (const char *)text.at, error);
  free(text.at);
  if (result != RESULT_OK) return result;
  gltf->buffer_count = json_array_size(json_object_get(gltf->root, "buffers"));
  gltf->buffers = calloc(gltf->buffer_count + 1, sizeof *gltf->buffers);
  return gltf->buffers ? RESULT_OK : result_no_memory(error);
}

void gltf_close(struct gltf *gltf) {
  for (size_t k = 0; k < gltf->buffer_count && gltf->buffers; ++k) free(gltf->buffers[k].at);
  free(gltf->buffers);
  free(gltf->places);
  free(gltf->order);
  free(gltf->seen);
  free(gltf->looks);
  json_decref(gltf->root);
  if (gltf->file) fclose(gltf->file);
}

/* A part of a file beside the scene's, which must have `wanted` bytes in all. */
static enum result read_beside(struct gltf *gltf, const char *uri, size_t wanted,
                               const struct gltf_view *part, struct gltf_bytes *bytes,
                               struct error *error) {
  char *path = NULL;
  struct stat status;
  enum result result = gltf_uri_path(gltf->loading->path, uri, &path, error);
  if (result != RESULT_OK) return result;
  int handle = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  FILE *file = handle < 0 ? NULL : fdopen(handle, "r");
  if (!file || fstat(handle, &status) != 0)
    result = result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  else if (!S_ISREG(status.st_mode))
    result = result_fail(error, RESULT_BAD, "%s: is not a file", path);
  else if ((size_t)status.st_size < wanted)
    result = result_fail(error, RESULT_BAD, "%s: has %zu bytes, and should have %zu", path,
                         (size_t)status.st_size, wanted);
  if (result == RESULT_OK)
    result = result_at(read_bytes(file, part->from, part->size, bytes, error), error, "%s", path);
  if (file)
    fclose(file);
  else if (handle >= 0)
    close(handle);
  free(path);
  return result;
}

/* A buffer without a URI is the binary chunk, or what an extension says. */
static enum result read_chunk(struct gltf *gltf, const json_t *buffer, size_t wanted,
                              const struct gltf_view *part, struct gltf_bytes *bytes,
                              struct error *error) {
  const char *extension =
      json_object_iter_key(json_object_iter(json_object_get(buffer, "extensions")));
  if (part->buffer == 0 && gltf->chunk != 0) {
    if (gltf->chunk_size >= wanted)
      return read_bytes(gltf->file, gltf->chunk + part->from, part->size, bytes, error);
    return result_fail(error, RESULT_BAD, "has %zu bytes, and should have %zu", gltf->chunk_size,
                       wanted);
  }
  if (extension)
    return result_fail(error, RESULT_BAD, "is there only by %s, which is not supported", extension);
  return result_fail(error, RESULT_BAD, "has no bytes");
}

/* Bytes within the JSON text are decoded once. */
static enum result read_text(struct gltf *gltf, const char *uri, size_t wanted,
                             const struct gltf_view *part, struct gltf_bytes *bytes,
                             struct error *error) {
  struct gltf_bytes *all = &gltf->buffers[part->buffer];
  if (!all->at) {
    enum result result = gltf_uri_bytes(uri, all, error);
    if (result != RESULT_OK) return result;
  }
  if (all->size < wanted)
    return result_fail(error, RESULT_BAD, "has %zu bytes, and should have %zu", all->size, wanted);
  bytes->at = malloc(part->size + 1);
  if (!bytes->at) return result_no_memory(error);
  memcpy(bytes->at, all->at + part->from, part->size);
  bytes->size = part->size;
  return RESULT_OK;
}

enum result gltf_view_read(struct gltf *gltf, const struct gltf_view *view, size_t from,
                           size_t size, struct gltf_bytes *bytes, struct error *error) {
  const json_t *buffer = json_array_get(json_object_get(gltf->root, "buffers"), view->buffer);
  const char *uri = json_string_value(json_object_get(buffer, "uri"));
  const struct gltf_view part = {view->buffer, view->from + from, size, 0};
  size_t wanted;
  *bytes = (struct gltf_bytes){0};
  enum result result = gltf_size(buffer, "byteLength", &wanted, error);
  if (result != RESULT_OK) return result;
  if (!uri)
    result = read_chunk(gltf, buffer, wanted, &part, bytes, error);
  else if (gltf_uri_is_data(uri))
    result = read_text(gltf, uri, wanted, &part, bytes, error);
  else
    result = read_beside(gltf, uri, wanted, &part, bytes, error);
  return result_at(result, error, "buffer %zu", view->buffer);
}

static enum result find_view(struct gltf *gltf, const json_t *number, struct gltf_view *found,
                             struct error *error) {
  const json_t *view, *buffer;
  size_t all;
  enum result result = gltf_item(gltf, "bufferViews", number, &view, error);
  if (result != RESULT_OK) return result;
  const json_t *of = json_object_get(view, "buffer");
  result = gltf_item(gltf, "buffers", of, &buffer, error);
  if (result == RESULT_OK) result = gltf_size(buffer, "byteLength", &all, error);
  if (result == RESULT_OK) result = gltf_size(view, "byteOffset", &found->from, error);
  if (result == RESULT_OK) result = gltf_size(view, "byteLength", &found->size, error);
  if (result == RESULT_OK) result = gltf_size(view, "byteStride", &found->stride, error);
  if (result != RESULT_OK) return result;
  found->buffer = (size_t)json_integer_value(of);
  if (found->from > all || found->size > all - found->from)
    return result_fail(error, RESULT_BAD, "ends outside its buffer %zu, which has %zu bytes",
                       found->buffer, all);
  return RESULT_OK;
}

enum result gltf_view(struct gltf *gltf, const json_t *number, struct gltf_view *view,
                      struct error *error) {
  *view = (struct gltf_view){0};
  return result_at(find_view(gltf, number, view, error), error, "bufferView %lld",
                   (long long)json_integer_value(number));
}
