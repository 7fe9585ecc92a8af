/* test_scene_told.c - a glTF file's cameras, and what a scene tells of what it ignores. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "meshes.h"
#include "testing.h"

#define METAL "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0}}],"
#define LENSES                                                                                     \
  METAL "\"cameras\":[{\"name\":\"lens\",\"type\":\"perspective\",\"perspective\":{\"yfov\":"      \
        "0.9,\"aspectRatio\":1.6,\"znear\":1}},{\"type\":\"perspective\",\"perspective\":{"        \
        "\"yfov\":0.9,\"znear\":1}},{\"name\":\"plan\",\"type\":\"orthographic\","                 \
        "\"orthographic\":{\"xmag\":1,\"ymag\":1,\"zfar\":9,\"znear\":1}}],"

/* The camera of the node, which has a parent that is moved by (5, 0, 0). */
static struct camera find(const char *node, const char *name, double aspect) {
  struct scene scene = meshes_load(meshes_gltf("cameras.gltf", node, ",\"material\":0", LENSES),
                                   SCENE_SURFACES, false, NULL);
  struct camera camera;
  struct error error = {""};
  assert_int_equal(scene.camera_count, 1);
  if (scene_find_camera(&scene, "cameras.gltf", name, aspect, &camera, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  scene_free(&scene);
  return camera;
}

/* It looks from there that way, with that up. */
static void expect(const struct camera *camera, const double from[3], const double forward[3],
                   const double up[3]) {
  double axes[3][3];
  camera_axes(camera, axes[0], axes[1], axes[2]);
  for (int c = 0; c < 3; ++c) {
    assert_near(camera->from[c], from[c], 1e-6);
    assert_near(axes[0][c], forward[c], 1e-6);
    assert_near(axes[2][c], up[c], 1e-6);
  }
}

/* In the file it looks along -z with y up, right-handed; POV-Ray's z is the other way. */
TEST(cameras_are_mirrored_as_meshes_are) {
  struct camera camera = find(",\"camera\":0,\"translation\":[1,2,3]", "lens", 1);
  expect(&camera, (const double[]){6, 2, -3}, (const double[]){0, 0, 1}, (const double[]){0, 1, 0});
  /* A quarter turn about y: -z becomes -x. */
  camera =
      find(",\"camera\":0,\"name\":\"eye\",\"rotation\":[0,0.70710678,0,0.70710678]", "eye", 1);
  expect(&camera, (const double[]){5, 0, 0}, (const double[]){-1, 0, 0}, (const double[]){0, 1, 0});
  /* Down, with -z up, twice as large; by its matrix, column by column. */
  camera = find(",\"camera\":0,\"matrix\":[2,0,0,0,0,0,-2,0,0,2,0,0,0,3,0,1]", "lens", 1);
  expect(&camera, (const double[]){5, 3, 0}, (const double[]){0, -1, 0}, (const double[]){0, 0, 1});
}

/* tan(x/2) = 1.6 tan(y/2); without an aspect of its own it has the picture's. */
TEST(the_angle_is_horizontal) {
  struct camera camera = find(",\"camera\":0", "lens", 1);
  assert_near(camera.fov, 2 * atan(1.6 * tan(0.45)) * 180 / M_PI, 1e-9);
  camera = find(",\"camera\":1", "0", 1.25);
  assert_near(camera.fov, 2 * atan(1.25 * tan(0.45)) * 180 / M_PI, 1e-9);
}

TEST(other_cameras_are_refused) {
  static const struct {
    const char *node, *name, *piece;
  } cases[] = {{",\"camera\":0", "lense", "no camera 'lense', but 'lens'"},
               {",\"camera\":2", "plan", "orthographic"},
               {"", "lens", "none at all"}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    struct scene scene =
        meshes_load(meshes_gltf("cameras.gltf", cases[k].node, ",\"material\":0", LENSES),
                    SCENE_SURFACES, false, NULL);
    struct camera camera;
    struct error error = {""};
    assert_int_not_equal(scene_find_camera(&scene, "a.gltf", cases[k].name, 1, &camera, &error),
                         RESULT_OK);
    if (!strstr(error.text, cases[k].piece)) fail_msg("%s", error.text);
    scene_free(&scene);
  }
}

/* Loads a scene, which ignores that much of one kind, and nothing of others. */
static void ignores(const char *path, enum scene_ignored kind, const char *names) {
  struct scene scene = meshes_load(path, SCENE_SURFACES, false, NULL);
  for (int k = 0; k < SCENE_IGNORED; ++k) {
    const char *told = scene.ignored[k];
    if (k != (int)kind || !names) {
      assert_null(told);
    } else {
      assert_non_null(told);
      const char *end = strchr(told, ':');
      assert_non_null(end);
      assert_string_equal(end + 2, names);
    }
  }
  scene_free(&scene);
}

static const char *obj(const char *mtl) {
  meshes_write("told.mtl", mtl);
  return meshes_write("told.obj", "mtllib told.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\n"
                                  "usemtl a\nf 1//1 2//1 3//1\nusemtl b\nf 2//1 4//1 3//1\n");
}

TEST(materials_of_an_obj) {
#define BOTH(a, b)                                                                                 \
  obj("newmtl a\nKd 1 1 1\n" a "\nnewmtl b\nKd 1 1 1\n" b "\nnewmtl c\nKd 1 1 1\nd 0\n")
  ignores(BOTH("d 1\nTr 0", "map_Ka x.png"), SCENE_TRANSPARENCY, NULL);
  ignores(BOTH("d 0.4", ""), SCENE_TRANSPARENCY, "'a'");
  ignores(BOTH("", "Tr 0.2"), SCENE_TRANSPARENCY, "'b'");
  ignores(BOTH("d 0.5", "map_d x.png"), SCENE_TRANSPARENCY, "'a', 'b'");
  /* Tr the wrong way round, beside a d. */
  ignores(BOTH("d 1\nTr 1", "Tr 1\nd 1"), SCENE_TRANSPARENCY, NULL);
  ignores(BOTH("map_Bump x.png", "bump -bm 2 x.png"), SCENE_BUMPS, "'a', 'b'");
  ignores(BOTH("Ke 0 0 2", "Ke 0 0 0"), SCENE_EMISSION, "'a'");
}

TEST(materials_and_lights_of_a_gltf) {
#define GLTF(rest)                                                                                 \
  meshes_gltf(                                                                                     \
      "told.gltf", "", ",\"material\":0",                                                          \
      "\"materials\":[{\"name\":\"m\"," rest                                                       \
      "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[1,1,1,0.5]}}],")
  ignores(GLTF(""), SCENE_TRANSPARENCY, NULL);
  ignores(GLTF("\"alphaMode\":\"BLEND\","), SCENE_TRANSPARENCY, "'m'");
  ignores(GLTF("\"emissiveFactor\":[0,0.1,0],"), SCENE_EMISSION, "'m'");
  ignores(meshes_gltf("told.gltf",
                      ",\"name\":\"sun\",\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}",
                      ",\"material\":0",
                      METAL "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_"
                            "lights_punctual\":{\"lights\":[{\"type\":\"point\"}]}},"),
          SCENE_LIGHTS, "'sun'");
}

/* Many names end in dots, in a line of less than 1000 letters. */
TEST(a_line_has_an_end) {
  char mtl[20000] = "", mesh[20000];
  size_t at = 0, there;
  there =
      (size_t)snprintf(mesh, sizeof mesh, "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n");
  for (int k = 0; k < 200; ++k) {
    at += (size_t)snprintf(mtl + at, sizeof mtl - at,
                           "newmtl glass_number_%d\nKd 1 1 1\nd 0.%03d\n", k, k);
    there += (size_t)snprintf(mesh + there, sizeof mesh - there,
                              "usemtl glass_number_%d\nf 1//1 2//1 3//1\n", k);
  }
  meshes_write("many.mtl", mtl);
  struct scene scene = meshes_load(meshes_write("many.obj", mesh), SCENE_SURFACES, false, NULL);
  const char *told = scene.ignored[SCENE_TRANSPARENCY];
  assert_non_null(told);
  assert_true(strlen(told) < 600);
  assert_string_equal(told + strlen(told) - 5, ", ...");
  scene_free(&scene);
}

int main(void) {
  return testing_run(NULL, NULL);
}
