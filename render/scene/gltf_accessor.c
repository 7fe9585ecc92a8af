/* gltf_accessor.c - numbers of an accessor, see gltf.h. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "scene/gltf.h"

enum { BYTE = 5120, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, UNSIGNED_INT = 5125, FLOAT };

/* Elements as they are written: element k begins k strides on. Owned. */
struct run {
  struct gltf_bytes bytes;
  size_t stride;
};

/* How an element is written. */
struct element {
  int kind, width;
  bool normalised;
};

/* The componentType; 0: none that there is. */
static int find_kind(const json_t *owner) {
  const json_t *kind = json_object_get(owner, "componentType");
  json_int_t value = json_is_integer(kind) ? json_integer_value(kind) : 0;
  return value >= BYTE && value <= FLOAT ? (int)value : 0;
}

/* Bytes of a number; 0: of no kind that there is. */
static size_t number_size(int kind) {
  if (kind == BYTE || kind == UNSIGNED_BYTE) return 1;
  if (kind == SHORT || kind == UNSIGNED_SHORT) return 2;
  return kind == UNSIGNED_INT || kind == FLOAT ? 4 : 0;
}

/* Numbers are little-endian, as this machine's. */
static double read_number(const unsigned char *at, int kind) {
  int16_t signed_short;
  uint16_t unsigned_short;
  uint32_t unsigned_int;
  float number;
  switch (kind) {
  case BYTE:
    return (int8_t)*at;
  case UNSIGNED_BYTE:
    return *at;
  case SHORT:
    memcpy(&signed_short, at, sizeof signed_short);
    return signed_short;
  case UNSIGNED_SHORT:
    memcpy(&unsigned_short, at, sizeof unsigned_short);
    return unsigned_short;
  case UNSIGNED_INT:
    memcpy(&unsigned_int, at, sizeof unsigned_int);
    return unsigned_int;
  default:
    memcpy(&number, at, sizeof number);
    return (double)number;
  }
}

/* Normalised: the largest integer is 1, the least of a signed kind -1 (3.6.2.2). */
static double read_component(const unsigned char *at, const struct element *element) {
  double number = read_number(at, element->kind);
  if (!element->normalised) return number;
  double most = element->kind == BYTE             ? INT8_MAX
                : element->kind == UNSIGNED_BYTE  ? UINT8_MAX
                : element->kind == SHORT          ? INT16_MAX
                : element->kind == UNSIGNED_SHORT ? UINT16_MAX
                                                  : 1;
  return number / most < -1 ? -1 : number / most;
}

static void read_element(const unsigned char *at, const struct element *element, double *out) {
  size_t size = number_size(element->kind);
  for (int k = 0; k < element->width; ++k) out[k] = read_component(at + (size_t)k * size, element);
}

/* Reads `count` elements of `size` bytes, which a bufferView must hold. */
static enum result read_run(struct gltf *gltf, const json_t *owner, size_t count, size_t size,
                            struct run *run, struct error *error) {
  struct gltf_view view;
  size_t offset;
  enum result result = gltf_view(gltf, json_object_get(owner, "bufferView"), &view, error);
  if (result == RESULT_OK) result = gltf_size(owner, "byteOffset", &offset, error);
  if (result != RESULT_OK) return result;
  run->stride = view.stride ? view.stride : size;
  if (run->stride < size || run->stride == 0)
    return result_fail(error, RESULT_BAD, "has elements of %zu bytes, and byteStride %zu", size,
                       run->stride);
  if (offset > view.size || size > view.size - offset ||
      count - 1 > (view.size - offset - size) / run->stride)
    return result_fail(error, RESULT_BAD, "has more elements than its bufferView of %zu bytes",
                       view.size);
  return gltf_view_read(gltf, &view, offset, (count - 1) * run->stride + size, &run->bytes, error);
}

/* Elements that are other than the bufferView's (3.6.2.3). */
static enum result read_sparse(struct gltf *gltf, const json_t *sparse,
                               const struct element *element, struct gltf_numbers *numbers,
                               struct error *error) {
  const json_t *indices = json_object_get(sparse, "indices");
  const json_t *values = json_object_get(sparse, "values");
  struct element index = {.kind = find_kind(indices), .width = 1};
  size_t width = (size_t)element->width, count;
  struct run where = {0}, what = {0};
  enum result result = gltf_size(sparse, "count", &count, error);
  if (result != RESULT_OK || count == 0) return result;
  if (index.kind != UNSIGNED_BYTE && index.kind != UNSIGNED_SHORT && index.kind != UNSIGNED_INT)
    return result_fail(error, RESULT_BAD, "has sparse indices that are no unsigned integers");
  result = read_run(gltf, indices, count, number_size(index.kind), &where, error);
  if (result == RESULT_OK)
    result = read_run(gltf, values, count, width * number_size(element->kind), &what, error);
  for (size_t k = 0; k < count && result == RESULT_OK; ++k) {
    double number = read_component(where.bytes.at + k * where.stride, &index);
    if (number < (double)numbers->count)
      read_element(what.bytes.at + k * what.stride, element, numbers->at + (size_t)number * width);
    else
      result = result_fail(error, RESULT_BAD, "has the sparse index %.0f, and %zu elements", number,
                           numbers->count);
  }
  free(where.bytes.at);
  free(what.bytes.at);
  return result;
}

static int find_width(const json_t *accessor) {
  static const struct {
    const char *name;
    int width;
  } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const char *type = json_string_value(json_object_get(accessor, "type"));
  for (size_t k = 0; type && k < sizeof types / sizeof *types; ++k)
    if (strcmp(type, types[k].name) == 0) return types[k].width;
  return 0;
}

/* What elements it has, and whether they are those that are wanted. */
static enum result find_element(const json_t *accessor, const struct gltf_wanted *wanted,
                                struct element *element, size_t *count, struct error *error) {
  *element = (struct element){.kind = find_kind(accessor),
                              .width = find_width(accessor),
                              .normalised = json_is_true(json_object_get(accessor, "normalized"))};
  int kind = element->kind;
  bool whole = kind == UNSIGNED_BYTE || kind == UNSIGNED_SHORT || kind == UNSIGNED_INT;
  enum result result = gltf_size(accessor, "count", count, error);
  if (result != RESULT_OK) return result;
  if (number_size(kind) == 0 || (wanted->whole && (!whole || element->normalised)) ||
      (!wanted->whole && kind == UNSIGNED_INT))
    return result_fail(error, RESULT_BAD, "has the componentType %d%s, which is not read there",
                       kind, element->normalised ? ", normalized" : "");
  if (element->width < wanted->least || element->width > wanted->most)
    return result_fail(error, RESULT_BAD, "has elements of %d numbers, and should have %d",
                       element->width, wanted->least);
  if (*count == 0 || *count > INT_MAX || (wanted->count > 0 && *count != wanted->count))
    return result_fail(error, RESULT_BAD, "has %zu elements, and should have %zu", *count,
                       wanted->count > 0 ? wanted->count : 1);
  return RESULT_OK;
}

/* Without a bufferView all elements are 0, but for the sparse ones; how many they are must be known
 * from elsewhere then, so that no file takes memory that it has no bytes for. */
static enum result read_all(struct gltf *gltf, const json_t *accessor,
                            const struct gltf_wanted *wanted, struct gltf_numbers *numbers,
                            struct error *error) {
  const json_t *sparse = json_object_get(accessor, "sparse");
  bool there = json_object_get(accessor, "bufferView") != NULL;
  struct element element;
  struct run run = {0};
  enum result result = find_element(accessor, wanted, &element, &numbers->count, error);
  size_t width = (size_t)element.width;
  if (result == RESULT_OK && there)
    result =
        read_run(gltf, accessor, numbers->count, width * number_size(element.kind), &run, error);
  if (result == RESULT_OK && !there && (wanted->count == 0 || !sparse))
    result = result_fail(error, RESULT_BAD, "has no bufferView");
  if (result != RESULT_OK) return result;
  numbers->width = element.width;
  if (scene_fits(numbers->count, width * sizeof *numbers->at))
    numbers->at = calloc(numbers->count, width * sizeof *numbers->at);
  for (size_t k = 0; k < numbers->count && there && numbers->at; ++k)
    read_element(run.bytes.at + k * run.stride, &element, numbers->at + k * width);
  free(run.bytes.at);
  if (!numbers->at) return result_no_memory(error);
  return sparse ? read_sparse(gltf, sparse, &element, numbers, error) : RESULT_OK;
}

enum result gltf_read(struct gltf *gltf, const json_t *number, const struct gltf_wanted *wanted,
                      struct gltf_numbers *numbers, struct error *error) {
  const json_t *accessor;
  *numbers = (struct gltf_numbers){0};
  enum result result = gltf_item(gltf, "accessors", number, &accessor, error);
  if (result != RESULT_OK) return result;
  result = read_all(gltf, accessor, wanted, numbers, error);
  if (result == RESULT_OK) return RESULT_OK;
  free(numbers->at);
  *numbers = (struct gltf_numbers){0};
  return result_at(result, error, "accessor %lld", (long long)json_integer_value(number));
}
