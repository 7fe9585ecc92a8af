/* meshes.c - see meshes.h. */
#include "meshes.h"

#include <stdio.h>
#include <string.h>

#include "testing.h"

const char *meshes_write(const char *name, const char *text) {
  const char *path = scratch(name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  assert_true(fputs(text, file) >= 0);
  assert_int_equal(fclose(file), 0);
  return path;
}

struct scene meshes_load(const char *path, enum scene_needs needs, bool repair, char note[256]) {
  struct scene scene;
  struct error error = {""};
  char own[256] = "";
  if (scene_load(path, needs, repair, &scene, note ? note : own, &error))
    fail_msg("%s", error.text);
  return scene;
}

void meshes_refused(const char *path, enum scene_needs needs, bool repair, const char *piece) {
  struct scene scene;
  struct error error = {""};
  char note[256] = "x";
  if (!scene_load(path, needs, repair, &scene, note, &error)) fail_msg("%s: not refused", path);
  if (!strstr(error.text, piece) || strchr(error.text, '\n'))
    fail_msg("'%s' does not hold '%s'", error.text, piece);
  assert_int_equal(scene.triangles, 0);
  assert_null(scene.position);
  assert_string_equal(note, "");
}

const char *meshes_gltf(const char *name, const char *node, const char *primitive,
                        const char *rest) {
  char text[4096];
  snprintf(text, sizeof text,
           "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
           "\"nodes\":[{\"children\":[1],\"translation\":[5,0,0]},{\"mesh\":0%s}],"
           "\"meshes\":[{\"name\":\"tri\",\"primitives\":[{\"attributes\":{\"POSITION\":0,"
           "\"NORMAL\":1,\"TEXCOORD_0\":2},\"indices\":3%s}]}],%s"
           "\"buffers\":[{\"byteLength\":102,\"uri\":\"data:application/octet-stream;base64,"
           "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"
           "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAABAAIA\"}],"
           "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36},"
           "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":36},"
           "{\"buffer\":0,\"byteOffset\":72,\"byteLength\":24},"
           "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":6}],"
           "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
           "\"min\":[0,0,0],\"max\":[1,1,0]},{\"bufferView\":1,\"componentType\":5126,\"count\":3,"
           "\"type\":\"VEC3\"},{\"bufferView\":2,\"componentType\":5126,\"count\":3,"
           "\"type\":\"VEC2\"},{\"bufferView\":3,\"componentType\":5123,\"count\":3,"
           "\"type\":\"SCALAR\"}]}",
           node, primitive, rest);
  return meshes_write(name, text);
}
