/* test_gltf_refused.c - what glTF files ask for that is not done, name outside their folder, or
 * have wrong: one line that says it. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "made_gltf.h"
#include "meshes.h"
#include "testing.h"

#define SCENE MADE_SCENE ",\"nodes\":[{\"mesh\":0}]"

/* One triangle: positions, normals, indices. */
static struct made_gltf triangle(void) {
  static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, up[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  static const double order[] = {0, 1, 2};
  struct made_gltf made = {0};
  made_accessor(&made, MADE_FLOAT, 3, 3, corners, 0, "");
  made_accessor(&made, MADE_FLOAT, 3, 3, up, 0, "");
  made_accessor(&made, MADE_UNSIGNED_SHORT, 1, 3, order, 0, "");
  return made;
}

#define MESH MADE_MESH("\"POSITION\":0,\"NORMAL\":1", ",\"indices\":2")

static char *read_whole(const char *path, size_t *size) {
  static char bytes[65536];
  FILE *file = fopen(path, "r");
  assert_non_null(file);
  *size = fread(bytes, 1, sizeof bytes - 1, file);
  bytes[*size] = 0;
  fclose(file);
  return bytes;
}

/* The text of a file that is right, with `from` replaced by `to`. */
static const char *changed(const char *name, const char *rest, const char *from, const char *to) {
  static char text[65536];
  struct made_gltf made = triangle();
  size_t size;
  const char *whole = read_whole(made_write(&made, "whole.gltf", rest), &size);
  const char *at = strstr(whole, from);
  if (!at) fail_msg("no %s", from);
  snprintf(text, sizeof text, "%.*s%s%s", (int)(at - whole), whole, to, at + strlen(from));
  return meshes_write(name, text);
}

/* What is required and not done is refused; --repair goes on without it. What is used is told. */
TEST(extensions) {
  static const char *const required[] = {"KHR_materials_clearcoat", "KHR_texture_basisu",
                                         "KHR_lights_punctual", "KHR_draco_mesh_compression",
                                         "ACME_something"};
  char rest[4096];
  struct made_gltf made = triangle();
  for (size_t k = 0; k < sizeof required / sizeof *required; ++k) {
    snprintf(rest, sizeof rest,
             SCENE MESH ",\"extensionsRequired\":[\"KHR_mesh_quantization\",\"%s\"]", required[k]);
    const char *path = made_write(&made, "required.glb", rest);
    char piece[128];
    snprintf(piece, sizeof piece, "requires %s, which is not supported", required[k]);
    meshes_refused(path, SCENE_SURFACES, false, piece);
    if (k >= 3) meshes_refused(path, SCENE_SHAPE, false, piece);
    struct scene scene = meshes_load(path, SCENE_SURFACES, true, NULL);
    scene_free(&scene);
    if (k >= 3) continue;
    scene = meshes_load(path, SCENE_SHAPE, false, NULL); /* a shape is the same without */
    scene_free(&scene);
  }
  struct scene scene = meshes_load(
      made_write(&made, "used.gltf",
                 SCENE MESH ",\"extensionsUsed\":[\"KHR_materials_clearcoat\",\"KHR_texture_"
                            "transform\",\"ACME_x\"],\"animations\":[{\"name\":\"turn\"},{}]"),
      SCENE_SURFACES, false, NULL);
  assert_string_equal(scene.ignored[SCENE_EXTENSIONS],
                      "extensions are ignored: 'KHR_materials_clearcoat', 'ACME_x'");
  assert_string_equal(scene.ignored[SCENE_ANIMATIONS], "animations are ignored: 'turn', '1'");
  scene_free(&scene);
}

/* Media inside of surfaces are told, where there are any. */
TEST(media) {
  static const char *const volumes[] = {"\"KHR_materials_volume\":{\"thicknessFactor\":1}",
                                        "\"KHR_materials_volume_scatter\":{}",
                                        "\"KHR_materials_volume\":{}"};
  for (int k = 0; k < 3; ++k) {
    char to[256];
    snprintf(to, sizeof to, ",1]},\"name\":\"milk\",\"extensions\":{%s}}", volumes[k]);
    struct scene scene = meshes_load(
        changed("milk.gltf", SCENE MESH ",\"extensionsUsed\":[\"KHR_materials_volume\"]", ",1]}}",
                to),
        SCENE_SURFACES, false, NULL);
    if (k < 2)
      assert_string_equal(
          scene.ignored[SCENE_MEDIA],
          "media are ignored, light is neither dimmed nor scattered inside of surfaces: 'milk'");
    else
      assert_null(scene.ignored[SCENE_MEDIA]);
    assert_null(scene.ignored[SCENE_EXTENSIONS]);
    scene_free(&scene);
  }
}

/* Data that only an extension gives is refused by its name, required or not. */
TEST(compressed) {
  static const struct {
    const char *from, *to, *piece;
  } cases[] = {
      {"\"bufferView\":0,\"byteOffset\":0,", "", "accessor 0: has no bufferView"},
      {"\"uri\":\"made.bin\"", "\"extensions\":{\"EXT_meshopt_compression\":{\"fallback\":true}}",
       "only by EXT_meshopt_compression"},
      {"\"uri\":\"made.bin\"", "\"name\":\"x\"", "buffer 0: has no bytes"},
      {"\"metallicFactor\":0", "\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}",
       "a texture is there only by KHR_texture_basisu"},
  };
#define TEXTURES                                                                                   \
  ",\"textures\":[{\"extensions\":{\"KHR_texture_basisu\":{\"source\":0}}}],\"images\":[{\"uri\":" \
  "\"a.ktx2\"}]"
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    meshes_refused(changed("packed.gltf", SCENE MESH TEXTURES, cases[k].from, cases[k].to),
                   SCENE_SURFACES, false, cases[k].piece);
  struct made_gltf made = triangle();
  const char *path = made_write(
      &made, "draco.gltf",
      SCENE MADE_MESH("\"POSITION\":0",
                      ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0}}"));
  struct scene scene = meshes_load(path, SCENE_SHAPE, false, NULL); /* it has the numbers, too */
  scene_free(&scene);
  size_t size;
  char *text = read_whole(path, &size);
  memset(strstr(text, "\"bufferView\":0,\"byteOffset\""), ' ', strlen("\"bufferView\":0,"));
  meshes_refused(meshes_write("draco2.gltf", text), SCENE_SHAPE, true,
                 "mesh 'm': is compressed by KHR_draco_mesh_compression");
}

/* Names of files within the folder, decoded; and those that are not opened. */
TEST(uris) {
  static const struct {
    const char *uri, *file;
  } there[] = {{"my%20bytes%2Ebin", "my bytes.bin"},
               {"%C3%A9t%c3%a9.bin", "\303\251t\303\251.bin"},
               {"\303\251.bin", "\303\251.bin"},
               {"100%25.bin", "100%.bin"},
               {"100%.bin", "100%.bin"},
               {"a%20b.bin", "a%20b.bin"}, /* as programs write it that don't know better */
               {"./within/../within/%41.bin", "within/A.bin"},
               {"within\\\\B.bin", "within/B.bin"},
               {"a%3Ab.bin", "a:b.bin"}};
  static const struct {
    const char *uri, *piece;
  } away[] = {{"../made.bin", "is outside the file's folder"},
              {"%2e%2e/made.bin", "is outside the file's folder"},
              {"within/../../made.bin", "is outside the file's folder"},
              {"..%5Cmade.bin", "is outside the file's folder"},
              {"/dev/zero", "is outside the file's folder"},
              {"%2fdev%2fzero", "is outside the file's folder"},
              {"file:///dev/zero", "is not in the file's folder"},
              {"HTTP://example.org/made.bin", "is not in the file's folder"},
              {"", "is no name of a file"},
              {"a%00b", "is no name of a file"},
              {"none%20here.bin", "none here.bin: No such file"},
              {"fifo", "fifo: is not a file"},
              {"within", "within: is not a file"},
              {"zero", "zero: is not a file"},
              {"data:;base64", "without a comma"},
              {"data:;base64,AA*A", "is not base64"},
              {"data:,AAAA", "has 4 bytes, and should have"}};
  char text[256];
  mkdir(scratch("within"), 0700);
  mkfifo(scratch("fifo"), 0600);
  assert_int_equal(symlink("/dev/zero", scratch("zero")), 0);
  for (size_t k = 0; k < sizeof there / sizeof *there; ++k) {
    snprintf(text, sizeof text, "\"uri\":\"%s\"", there[k].uri);
    const char *path = changed("uri.gltf", SCENE MESH, "\"uri\":\"made.bin\"", text);
    char made[512];
    snprintf(made, sizeof made, "%s", scratch("made.bin"));
    assert_int_equal(rename(made, scratch(there[k].file)), 0);
    struct scene scene = meshes_load(path, SCENE_SHAPE, false, NULL);
    assert_int_equal(scene.triangles, 1);
    scene_free(&scene);
    remove(scratch(there[k].file));
  }
  for (size_t k = 0; k < sizeof away / sizeof *away; ++k) {
    snprintf(text, sizeof text, "\"uri\":\"%s\"", away[k].uri);
    meshes_refused(changed("uri.gltf", SCENE MESH, "\"uri\":\"made.bin\"", text), SCENE_SHAPE, true,
                   away[k].piece);
  }
  remove(scratch("fifo"));
  remove(scratch("zero"));
  rmdir(scratch("within"));
}

/* Bytes within the text, of any media type and in either coding. */
TEST(data_uris) {
  static const char *const heads[] = {"data:application/octet-stream;base64,",
                                      "data:application/gltf-buffer;base64,", "data:;base64,",
                                      "DATA:text/plain;charset=UTF-8;BASE64,", "data:,"};
  struct made_gltf made = triangle();
  for (size_t k = 0; k < sizeof heads / sizeof *heads; ++k) {
    char uri[8192] = "", text[8300], command[1024];
    if (k < 4) {
      made_write(&made, "whole.gltf", SCENE MESH);
      snprintf(command, sizeof command, "base64 -w0 '%s'", scratch("made.bin"));
      FILE *pipe = popen(command, "r");
      assert_non_null(pipe);
      assert_non_null(fgets(uri, sizeof uri, pipe));
      pclose(pipe);
    }
    for (size_t n = 0; n < made.size && k == 4; ++n)
      snprintf(uri + 3 * n, 4, "%%%02x", made.bytes[n]);
    snprintf(text, sizeof text, "\"uri\":\"%s%s\"", heads[k], uri);
    struct scene scene = meshes_load(changed("data.gltf", SCENE MESH, "\"uri\":\"made.bin\"", text),
                                     SCENE_SURFACES, false, NULL);
    assert_near(scene.position[1][0], 1, 0);
    scene_free(&scene);
  }
}

/* Each number that is wrong, by the name of what has it. */
TEST(wrong_numbers) {
  static const struct {
    const char *from, *to, *piece;
  } cases[] = {
      {"\"byteLength\":86", "\"byteLength\":87", "made.bin: has 86 bytes, and should have 87"},
      {"\"byteLength\":86", "\"byteLength\":-1", "byteLength is not a whole number"},
      {"\"byteLength\":86", "\"byteLength\":4000000000000", "made.bin: has 86 bytes"},
      {"\"byteLength\":36", "\"byteLength\":35", "accessor 0: has more elements than its"},
      {"\"byteLength\":36", "\"byteLength\":1000", "bufferView 0: ends outside its buffer 0"},
      {"\"byteOffset\":0,\"byteLength\":36", "\"byteOffset\":9223372036854775807,\"byteLength\":36",
       "ends outside its buffer"},
      {"\"byteLength\":36", "\"byteLength\":36,\"byteStride\":8", "byteStride 8"},
      {"\"byteLength\":36", "\"byteLength\":36,\"byteStride\":9223372036854775807",
       "has more elements"},
      {"\"buffer\":0", "\"buffer\":1", "asks for number 1 of its 1 buffers"},
      {"\"bufferView\":0", "\"bufferView\":3", "asks for number 3 of its 3 bufferViews"},
      {"\"bufferView\":0", "\"bufferView\":\"0\"", "which of its bufferViews"},
      {"\"componentType\":5126", "\"componentType\":5130", "has the componentType 0"},
      {"\"componentType\":5126", "\"componentType\":5125", "has the componentType 5125"},
      {"\"count\":3", "\"count\":0", "accessor 0: has 0 elements"},
      {"\"count\":3", "\"count\":4", "accessor 0: has more elements"},
      {"\"count\":3", "\"count\":4000000000000000000", "accessor 0: has 4000000000000000000"},
      {"\"count\":3", "\"count\":2", "mesh 'm': NORMAL: accessor 1: has 3 elements, and should"},
      {"\"type\":\"VEC3\"", "\"type\":\"VEC2\"", "has elements of 2 numbers"},
      {"\"type\":\"VEC3\"", "\"type\":\"MAT3\"", "has elements of 0 numbers"},
      {"\"POSITION\":0", "\"POSITION\":-1", "asks for number -1 of its 3 accessors"},
      {"\"POSITION\":0,", "", "mesh 'm' has no POSITION"},
      {"\"indices\":2", "\"indices\":0", "indices: accessor 0: has the componentType 5126"},
      {"\"indices\":2", "\"indices\":2,\"mode\":7", "has the mode 7"},
      {"\"material\":0", "\"material\":1", "mesh 'm': asks for number 1 of its 1 materials"},
      {"\"mesh\":0", "\"mesh\":0,\"children\":[0]", "has node 0 twice in one scene"},
      {"\"nodes\":[0]", "\"nodes\":[0,0]", "has node 0 twice in one scene"},
      {"\"nodes\":[0]", "\"nodes\":[1]", "asks for number 1 of its 1 nodes"},
      {"\"scenes\"", "\"scene\":1,\"scenes\"", "asks for number 1 of its 1 scenes"},
      {"\"scenes\"", "\"places\"", "has no scene"},
      {"\"version\":\"2.0\"", "\"version\":\"1.0\"", "version '1.0', and only 2.0"},
      {"\"version\":\"2.0\"", "\"version\":\"2.7\",\"minVersion\":\"2.1\"", "version '2.1'"},
      {"\"version\":\"2.0\"", "", "does not say which version"},
      {"{\"asset\"", "[{\"asset\"", "is no glTF"},
      {"}]}]}", "}]}]", "cannot be read as a mesh: malformed JSON"},
  };
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    meshes_refused(changed("wrong.gltf", SCENE MESH, cases[k].from, cases[k].to), SCENE_SURFACES,
                   false, cases[k].piece);
  static const double order[] = {0, 1, 3}, few[] = {0, 1};
  struct made_gltf made = triangle();
  made_accessor(&made, MADE_UNSIGNED_BYTE, 1, 3, order, 0, "");
  made_accessor(&made, MADE_UNSIGNED_BYTE, 1, 2, few, 0, "");
  meshes_refused(
      made_write(&made, "outside.glb", SCENE MADE_MESH("\"POSITION\":0", ",\"indices\":3")),
      SCENE_SHAPE, true, "mesh 'm': triangle 1 has a corner that is no vertex");
  meshes_refused(made_write(&made, "few.glb", SCENE MADE_MESH("\"POSITION\":0", ",\"indices\":4")),
                 SCENE_SHAPE, false,
                 "mesh 'm' has 2 corners, which is no whole number of triangles");
}

/* A text of little values would take fifty times its size. */
TEST(too_many_values) {
  static const char *const values[] = {"0,", "[],", "{},", "{\"a\":0},", "[[0]],"};
  static const char start[] = "{\"asset\":{\"version\":\"2.0\"},\"extras\":[";
  enum { SIZE = 24 << 20 };
  char *text = malloc(SIZE + 64);
  assert_non_null(text);
  for (size_t k = 0; k < sizeof values / sizeof *values; ++k) {
    size_t length = strlen(values[k]), at = sizeof start - 1;
    memcpy(text, start, at);
    for (; at < SIZE; at += length) memcpy(text + at, values[k], length);
    strcpy(text + at, "0]}");
    meshes_refused(meshes_write("many.gltf", text), SCENE_SHAPE, false, "too many values");
  }
  unlink(scratch("many.gltf"));
  free(text);
}

/* Points and lines are told, and are no triangles. */
TEST(points_and_lines) {
  struct made_gltf made = triangle();
  meshes_refused(made_write(&made, "lines.gltf", SCENE MADE_MESH("\"POSITION\":0", ",\"mode\":1")),
                 SCENE_SURFACES, false, "has no triangles");
  struct scene scene = meshes_load(
      made_write(&made, "both.gltf",
                 SCENE ",\"meshes\":[{\"name\":\"m\",\"primitives\":[{\"attributes\":{\"POSITION\":"
                       "0,\"NORMAL\":1},\"material\":0},{\"attributes\":{\"POSITION\":0},\"mode\":"
                       "0}]}]"),
      SCENE_SURFACES, false, NULL);
  assert_int_equal(scene.triangles, 1);
  assert_string_equal(scene.ignored[SCENE_LINES], "points and lines are ignored: 'm-1'");
  scene_free(&scene);
}

/* A .glb cut off anywhere, and with wrong words at its head and before its chunks. */
TEST(damaged_glb) {
  struct made_gltf made = triangle();
  char path[512];
  size_t size;
  snprintf(path, sizeof path, "%s", made_write(&made, "whole.glb", SCENE MESH));
  char *bytes = read_whole(path, &size), kept[4];
  for (size_t cut = 0; cut < size; cut += cut < 64 ? 1 : 31)
    meshes_refused(made_bytes("cut.glb", bytes, cut), SCENE_SURFACES, true, "cut.glb: ");
  uint32_t first;
  memcpy(&first, bytes + 12, sizeof first);
  static const uint32_t wrong[] = {0, 1, 3, 0x7fffffff, 0xfffffff0, 0xffffffff};
  const size_t places[] = {4, 8, 12, 16, 20 + first};
  for (size_t p = 0; p < sizeof places / sizeof *places; ++p)
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
      memcpy(kept, bytes + places[p], sizeof kept);
      memcpy(bytes + places[p], &wrong[k], sizeof kept);
      meshes_refused(made_bytes("words.glb", bytes, size), SCENE_SURFACES, true, "words.glb: ");
      memcpy(bytes + places[p], kept, sizeof kept);
    }
}

/* A texture that cannot be had is named; --repair goes on without it. */
TEST(textures) {
  static const char *const uris[] = {"none.png", "../a.png", "made.bin"};
  for (int k = 0; k < 3; ++k) {
    char text[512];
    snprintf(text, sizeof text,
             SCENE MESH ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"%s\"}]", uris[k]);
    const char *path = changed("texture.gltf", text, "\"metallicFactor\":0",
                               "\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}");
    meshes_refused(path, SCENE_SURFACES, false, "; --repair does without it");
    meshes_refused(path, SCENE_SURFACES, false, uris[k]);
    char note[256];
    struct scene scene = meshes_load(path, SCENE_SURFACES, true, note);
    assert_string_equal(note, "textures that cannot be read left out: 1");
    assert_int_equal(scene.texture_count, 0);
    scene_free(&scene);
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
