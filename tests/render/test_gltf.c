/* test_gltf.c - what glTF files hold, whatever the kind of its numbers: against the formulas of the
 * specification, worked out here. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "made_gltf.h"
#include "meshes.h"
#include "testing.h"

#define ONE_NODE ",\"nodes\":[{\"mesh\":0}]"
#define POSITIONS MADE_SCENE ONE_NODE MADE_MESH("\"POSITION\":0,\"NORMAL\":1", "")

static double largest(enum made_kind kind) {
  switch (kind) {
  case MADE_BYTE:
    return 127;
  case MADE_UNSIGNED_BYTE:
    return 255;
  case MADE_SHORT:
    return 32767;
  case MADE_UNSIGNED_SHORT:
    return 65535;
  default:
    return 1;
  }
}

static void expect_vector(const double found[3], double x, double y, double z) {
  assert_near(found[0], x, 1e-12);
  assert_near(found[1], y, 1e-12);
  assert_near(found[2], z, 1e-12);
}

/* Positions of every kind, normalised or not, close together or not, in either container. z is
 * mirrored. */
TEST(positions_of_any_kind) {
  static const enum made_kind kinds[] = {MADE_BYTE, MADE_UNSIGNED_BYTE, MADE_SHORT,
                                         MADE_UNSIGNED_SHORT, MADE_FLOAT};
  static const double up[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  for (int k = 0; k < 5 * 8; ++k) {
    enum made_kind kind = kinds[k / 8];
    bool normalised = k & 1, binary = k & 4;
    double most = largest(kind), low = kind == MADE_BYTE || kind == MADE_SHORT ? -most : 0;
    const double numbers[] = {low, 0, 3, most, 1, 3, 2, most, 3};
    struct made_gltf made = {0};
    made_accessor(&made, kind, 3, 3, numbers, k & 2 ? 4 : 0,
                  normalised ? ",\"normalized\":true" : "");
    made_accessor(&made, MADE_FLOAT, 3, 3, up, 0, "");
    struct scene scene = meshes_load(made_write(&made, binary ? "p.glb" : "p.gltf", POSITIONS),
                                     SCENE_SURFACES, false, NULL);
    double unit = normalised ? 1 / most : 1;
    assert_int_equal(scene.triangles, 1);
    expect_vector(scene.position[0], low * unit, 0, -3 * unit);
    expect_vector(scene.position[1], most * unit, unit, -3 * unit);
    expect_vector(scene.position[2], 2 * unit, most * unit, -3 * unit);
    scene_free(&scene);
  }
}

/* -128 and -127 of a normalised BYTE are both -1, and a normal is as long as a unit. */
TEST(normals_of_any_kind) {
  static const enum made_kind kinds[] = {MADE_BYTE, MADE_SHORT};
  static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  for (int k = 0; k < 2; ++k) {
    double most = largest(kinds[k]);
    const double numbers[] = {0, 0, most, -most - 1, 0, most, 0, 60, 80};
    struct made_gltf made = {0};
    made_accessor(&made, MADE_FLOAT, 3, 3, corners, 0, "");
    made_accessor(&made, kinds[k], 3, 3, numbers, 1, ",\"normalized\":true");
    struct scene scene =
        meshes_load(made_write(&made, "n.gltf", POSITIONS), SCENE_SURFACES, false, NULL);
    expect_vector(scene.normal[0], 0, 0, -1);
    expect_vector(scene.normal[1], -sqrt(0.5), 0, -sqrt(0.5));
    expect_vector(scene.normal[2], 0, 0.6, -0.8);
    scene_free(&scene);
  }
}

/* Elements that are listed replace those of the bufferView. */
TEST(sparse) {
  static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, which[] = {0, 2};
  static const double others[] = {-1, 0, 5, 0, 7, 5}, up[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  struct made_gltf made = {0};
  made_accessor(&made, MADE_FLOAT, 3, 3, corners, 0,
                ",\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":2,\"componentType\":5121},"
                "\"values\":{\"bufferView\":3}}");
  made_accessor(&made, MADE_FLOAT, 3, 3, up, 0, "");
  made_accessor(&made, MADE_UNSIGNED_BYTE, 1, 2, which, 0, "");
  made_accessor(&made, MADE_FLOAT, 3, 2, others, 0, "");
  struct scene scene =
      meshes_load(made_write(&made, "s.gltf", POSITIONS), SCENE_SURFACES, false, NULL);
  expect_vector(scene.position[0], -1, 0, -5);
  expect_vector(scene.position[1], 1, 0, 0);
  expect_vector(scene.position[2], 0, 7, -5);
  scene_free(&scene);
}

static double area_of(const struct scene *scene) {
  double area = 0;
  for (size_t t = 0; t < scene->triangles; ++t) {
    double edge[2][3], across[3];
    for (int k = 0; k < 2; ++k)
      vector_subtract(scene->position[scene->corners[t][k + 1]],
                      scene->position[scene->corners[t][0]], edge[k]);
    vector_cross(edge[0], edge[1], across);
    assert_true(across[2] < 0); /* all show their front to the file's +z */
    area += vector_length(across) / 2;
  }
  return area;
}

/* The same 3 x 2 rectangle by triangles, a strip and a fan, with indices of each kind, or none. */
TEST(triangles_strips_and_fans) {
  static const enum made_kind kinds[] = {MADE_UNSIGNED_BYTE, MADE_UNSIGNED_SHORT,
                                         MADE_UNSIGNED_INT};
  static const struct {
    int mode;
    size_t count;
    double order[8];
  } shapes[] = {{4, 6, {0, 1, 2, 2, 1, 3}},
                {5, 4, {0, 1, 2, 3}},
                {5, 7, {0, 1, 2, 2, 2, 1, 3}}, /* two triangles, joined by three without area */
                {6, 4, {0, 1, 3, 2}}};
  static const double corners[] = {0, 0, 1, 3, 0, 1, 0, 2, 1, 3, 2, 1};
  static const double up[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  for (int k = 0; k < 4 * 4; ++k) {
    struct made_gltf made = {0};
    char rest[1024], indices[64] = "";
    double taken[3 * 8];
    size_t count = shapes[k / 4].count;
    for (size_t n = 0; n < count; ++n)
      memcpy(taken + 3 * n, corners + 3 * (int)shapes[k / 4].order[n], 3 * sizeof *taken);
    bool bare = k % 4 == 3;
    if (bare && count > 6) continue; /* its seams have no corner twice then */
    double ups[3 * 8];
    for (size_t n = 0; n < 8; ++n) memcpy(ups + 3 * n, up, 3 * sizeof *up);
    made_accessor(&made, MADE_FLOAT, 3, bare ? count : 4, bare ? taken : corners, 0, "");
    made_accessor(&made, MADE_FLOAT, 3, bare ? count : 4, ups, 0, "");
    if (!bare) made_accessor(&made, kinds[k % 4], 1, count, shapes[k / 4].order, 0, "");
    if (!bare) snprintf(indices, sizeof indices, ",\"indices\":2");
    snprintf(rest, sizeof rest,
             MADE_SCENE ONE_NODE MADE_MESH("\"POSITION\":0,\"NORMAL\":1", "%s,\"mode\":%d"),
             indices, shapes[k / 4].mode);
    struct scene scene = meshes_load(made_write(&made, "t.glb", rest), SCENE_SURFACES, false, NULL);
    assert_int_equal(scene.triangles, 2);
    assert_near(area_of(&scene), 6, 1e-12);
    scene_free(&scene);
  }
}

/* A tree of nodes: turned, scaled and moved by its parts, and by a matrix, in double precision. */
TEST(nodes) {
  static const double corners[] = {1, 2, 3, 2, 2, 3, 1, 3, 3};
  static const double up[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  struct made_gltf made = {0};
  made_accessor(&made, MADE_FLOAT, 3, 3, corners, 0, "");
  made_accessor(&made, MADE_FLOAT, 3, 3, up, 0, "");
  struct scene scene = meshes_load(
      made_write(&made, "tree.gltf",
                 MADE_SCENE MADE_MESH(
                     "\"POSITION\":0,\"NORMAL\":1",
                     "") ",\"nodes\":[{\"children\":[1],\"matrix\":[0,1,0,0,-1,0,0,0,0,0,1,0,"
                         "400000.015625,0,0,1]},{\"mesh\":0,\"translation\":[10,20,30],\"scale\":"
                         "[2,3,4]}]"),
      SCENE_SURFACES, false, NULL);
  /* (1,2,3) is (12,26,42), then (-26,12,42) and moved. */
  expect_vector(scene.position[0], 400000.015625 - 26, 12, -42);
  expect_vector(scene.position[1], 400000.015625 - 26, 14, -42);
  expect_vector(scene.normal[0], 0, 0, -1);
  scene_free(&scene);
}

/* A morph target with a weight; one without; and the weights of the node come first. */
TEST(morph_targets) {
  static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, up[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  static const double moves[] = {0, 0, 0, 2, 0, 0, 0, 0, 8}, no[] = {9, 9, 9, 9, 9, 9, 9, 9, 9};
  struct made_gltf made = {0};
  made_accessor(&made, MADE_FLOAT, 3, 3, corners, 0, "");
  made_accessor(&made, MADE_FLOAT, 3, 3, up, 0, "");
  made_accessor(&made, MADE_FLOAT, 3, 3, moves, 0, "");
  made_accessor(&made, MADE_FLOAT, 3, 3, no, 0, "");
#define MORPHS                                                                                     \
  MADE_MESH("\"POSITION\":0,\"NORMAL\":1", ",\"targets\":[{\"POSITION\":3},{\"POSITION\":2}]")
  struct scene scene =
      meshes_load(made_write(&made, "morph.gltf",
                             MADE_SCENE MORPHS ",\"nodes\":[{\"mesh\":0,\"weights\":[0,0.25]}]"),
                  SCENE_SURFACES, false, NULL);
  expect_vector(scene.position[0], 0, 0, 0);
  expect_vector(scene.position[1], 1.5, 0, 0);
  expect_vector(scene.position[2], 0, 1, -2);
  scene_free(&scene);
}

/* Two joints, of which the second is turned by a quarter about z and moved by 5 in x; the node of
 * the mesh does not matter. A vertex between both is half way. */
TEST(skins) {
  static const double corners[] = {1, 0, 0, 1, 1, 0, 1, 2, 2}, up[] = {0, 0, 1, 0, 0, 1, 1, 0, 0};
  static const double joints[] = {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0};
  static const double weights[] = {255, 0, 0, 0, 51, 204, 0, 0, 255, 0, 0, 0};
  static const double bound[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1};
  struct made_gltf made = {0};
  made_accessor(&made, MADE_FLOAT, 3, 3, corners, 0, "");
  made_accessor(&made, MADE_FLOAT, 3, 3, up, 0, "");
  made_accessor(&made, MADE_UNSIGNED_SHORT, 4, 3, joints, 0, "");
  made_accessor(&made, MADE_UNSIGNED_BYTE, 4, 3, weights, 0, ",\"normalized\":true");
  made_accessor(&made, MADE_FLOAT, 16, 2, bound, 0, "");
  struct scene scene = meshes_load(
      made_write(&made, "skin.gltf",
                 ",\"scenes\":[{\"nodes\":[0,1]}],\"materials\":[{\"pbrMetallicRoughness\":{"
                 "\"metallicFactor\":0}}],\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":4}]"
                 ",\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[99,9,9]},{\"children\":[2]},"
                 "{\"matrix\":[0,1,0,0,-1,0,0,0,0,0,1,0,5,0,0,1]}]" MADE_MESH(
                     "\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":2,\"WEIGHTS_0\":3", "")),
      SCENE_SURFACES, false, NULL);
  expect_vector(scene.position[0], 1, 0, 0);
  /* (1,1,0): 0.2 of itself, and 0.8 of (0,1,0) turned, (-1,0,0), and moved, (4,0,0) */
  expect_vector(scene.position[1], 0.2 + 0.8 * 4, 0.2, 0);
  /* (1,2,2): (0,2,2) turned is (-2,0,2), moved (3,0,2); its normal x becomes y */
  expect_vector(scene.position[2], 3, 0, -2);
  expect_vector(scene.normal[2], 0, 1, 0);
  scene_free(&scene);
}

/* Texture coordinates of any kind; KHR_texture_transform scales, turns and moves them, v down. */
TEST(texture_coordinates) {
  static const enum made_kind kinds[] = {MADE_FLOAT, MADE_UNSIGNED_BYTE, MADE_UNSIGNED_SHORT};
  static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, up[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  static const char *const transforms[] = {
      "", ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.25,1],\"rotation\":"
          "1.5707963267948966,\"scale\":[0.5,4]}}"};
  meshes_write("dot.pgm", "P2 1 1 255 255\n");
  for (int k = 0; k < 3 * 2; ++k) {
    double most = largest(kinds[k / 2]);
    const double numbers[] = {0, 0, most, 0, 0, most};
    char rest[2048];
    struct made_gltf made = {0};
    made_accessor(&made, MADE_FLOAT, 3, 3, corners, 0, "");
    made_accessor(&made, MADE_FLOAT, 3, 3, up, 0, "");
    made_accessor(&made, kinds[k / 2], 2, 3, numbers, 4, ",\"normalized\":true");
    snprintf(rest, sizeof rest,
             ",\"scenes\":[{\"nodes\":[0]}]" ONE_NODE MADE_MESH(
                 "\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_3\":2",
                 "") ",\"images\":[{\"uri\":\"dot.pgm\"}],\"textures\":[{\"source\":0}],"
                     "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
                     "\"baseColorTexture\":{\"index\":0,\"texCoord\":3%s}}}]",
             transforms[k % 2]);
    struct scene scene =
        meshes_load(made_write(&made, "uv.glb", rest), SCENE_SURFACES, false, NULL);
    /* v up. A quarter turn counter-clockwise, seen with v down, leads u to -v and v to u. */
    static const double expected[2][3][2] = {{{0, 1}, {1, 1}, {0, 0}},
                                             {{0.25, 0}, {0.25, 0.5}, {4.25, 0}}};
    for (int n = 0; n < 3; ++n)
      for (int c = 0; c < 2; ++c) assert_near(scene.uv[n][c], expected[k % 2][n][c], 1e-12);
    scene_free(&scene);
  }
}

/* Both of glTF's models, and an emission with its strength. */
TEST(materials) {
  struct scene scene = meshes_load(
      meshes_gltf("spec.gltf", "", ",\"material\":0",
                  "\"materials\":[{\"emissiveFactor\":[1,0.5,0],\"extensions\":{"
                  "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":6},"
                  "\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor\":[0.5,0.25,1,1],"
                  "\"specularFactor\":[0.2,0.1,0],\"glossinessFactor\":0.5}}}],"
                  "\"extensionsRequired\":[\"KHR_materials_pbrSpecularGlossiness\"],"),
      SCENE_SURFACES, false, NULL);
  const struct scene_material *made = &scene.materials[scene.material[0]];
  expect_vector(made->diffuse, 0.8 * 0.5, 0.8 * 0.25, 0.8);
  expect_vector(made->specular, 0.2 * 4, 0.1 * 4, 0); /* (2/0.5^4 - 2 + 2)/8 */
  expect_vector(made->emission, 6, 3, 0);
  assert_near(made->shininess, 30, 1e-12);
  scene_free(&scene);
}

int main(void) {
  return testing_run(NULL, NULL);
}
