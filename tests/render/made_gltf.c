/* made_gltf.c - see made_gltf.h. */
#include "made_gltf.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "meshes.h"
#include "testing.h"

static void put(struct made_gltf *made, const void *bytes, size_t size) {
  assert_true(made->size + size <= sizeof made->bytes);
  memcpy(made->bytes + made->size, bytes, size);
  made->size += size;
}

/* Integers of less than four bytes in two's complement, least byte first. */
static void put_number(struct made_gltf *made, enum made_kind kind, double number) {
  float real = (float)number;
  uint32_t whole = (uint32_t)(int64_t)number;
  if (kind == MADE_FLOAT)
    put(made, &real, sizeof real);
  else
    put(made, &whole, kind == MADE_UNSIGNED_INT ? 4 : kind >= MADE_SHORT ? 2 : 1);
}

static void append(char *text, size_t room, const char *piece) {
  assert_true(strlen(text) + strlen(piece) < room);
  strcat(text, piece);
}

int made_accessor(struct made_gltf *made, enum made_kind kind, int width, size_t count,
                  const double *numbers, size_t gap, const char *more) {
  static const char blank[64];
  static const char *const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  char text[512], stride[64] = "";
  put(made, blank, (8 - made->size % 8) % 8);
  size_t begin = made->size, bytes = 0;
  put(made, blank, gap);
  for (size_t k = 0; k < count; ++k) {
    size_t before = made->size;
    for (int c = 0; c < width; ++c) put_number(made, kind, numbers[k * (size_t)width + (size_t)c]);
    put(made, blank, gap);
    bytes = made->size - before;
  }
  if (gap > 0) snprintf(stride, sizeof stride, ",\"byteStride\":%zu", bytes);
  snprintf(text, sizeof text, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu%s}",
           made->view_count ? "," : "", begin, made->size - begin, stride);
  append(made->views, sizeof made->views, text);
  snprintf(text, sizeof text,
           "%s{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,\"type\":"
           "\"%s\"%s}",
           made->accessor_count ? "," : "", made->view_count, gap, (int)kind, count,
           width == 16 ? "MAT4" : types[width], more);
  append(made->accessors, sizeof made->accessors, text);
  ++made->view_count;
  return made->accessor_count++;
}

static void put_chunk(FILE *file, const char *kind, const void *bytes, size_t size, char filler) {
  uint32_t length = (uint32_t)((size + 3) / 4 * 4);
  assert_int_equal(fwrite(&length, sizeof length, 1, file), 1);
  assert_int_equal(fwrite(kind, 4, 1, file), 1);
  assert_int_equal(fwrite(bytes, 1, size, file), size);
  for (; size % 4 != 0; ++size) assert_int_equal(fputc(filler, file), filler);
}

const char *made_bytes(const char *name, const void *bytes, size_t size) {
  const char *path = scratch(name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  assert_int_equal(fwrite(bytes, 1, size, file), size);
  assert_int_equal(fclose(file), 0);
  return path;
}

const char *made_write(const struct made_gltf *made, const char *name, const char *rest) {
  char text[16384], uri[64] = "";
  bool binary = strstr(name, ".glb") != NULL;
  if (!binary) {
    made_bytes("made.bin", made->bytes, made->size);
    snprintf(uri, sizeof uri, ",\"uri\":\"made.bin\"");
  }
  int length = snprintf(text, sizeof text,
                        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu%s}],"
                        "\"bufferViews\":[%s],\"accessors\":[%s]%s}",
                        made->size, uri, made->views, made->accessors, rest);
  assert_true((size_t)length < sizeof text);
  if (!binary) return meshes_write(name, text);
  const char *path = scratch(name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  uint32_t head[] = {
      2, (uint32_t)(12 + 8 + ((size_t)length + 3) / 4 * 4 + 8 + (made->size + 3) / 4 * 4)};
  assert_int_equal(fwrite("glTF", 4, 1, file), 1);
  assert_int_equal(fwrite(head, sizeof head, 1, file), 1);
  put_chunk(file, "JSON", text, (size_t)length, ' ');
  put_chunk(file, "BIN", made->bytes, made->size, 0);
  assert_int_equal(fclose(file), 0);
  return path;
}
