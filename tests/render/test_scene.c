/* test_scene.c - meshes of all three formats, what they say of materials, and what is refused. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/vector.h"
#include "meshes.h"
#include "testing.h"

static void expect_colour(const double rgb[3], double r, double g, double b) {
  assert_near(rgb[0], r, 1e-6);
  assert_near(rgb[1], g, 1e-6);
  assert_near(rgb[2], b, 1e-6);
}

/* Whether the corners of a triangle run around its normal. */
static bool winds_around(const struct scene *scene, size_t triangle, const double normal[3]) {
  const int *corner = scene->corners[triangle];
  double edge[2][3], across[3];
  for (int k = 0; k < 2; ++k)
    vector_subtract(scene->position[corner[k + 1]], scene->position[corner[0]], edge[k]);
  vector_cross(edge[0], edge[1], across);
  return vector_dot(across, normal) > 0;
}

/* Mirrored in z, wound so that the geometric normal points out where the file's did. */
TEST(test_obj) {
  meshes_write("a.mtl",
               "# made by hand\nnewmtl red paint\n  Kd .5 0.25 0\nKs 0.1 0.2 0.3\nNs 17\n"
               "illum 2\nnewmtl lamp\r\nKe 1 2 3\r\nnewmtl grey\nKd 0.5\nmap_Bump no.png\n");
  const char *path = meshes_write(
      "a.obj", "mtllib a.mtl\n" MESHES_CORNERS
               "vn 0 -3 1\no roof\nusemtl red paint\nf 1//2 2//2 3//2 4//2\no lamp\n"
               "usemtl lamp\nf 1//1 4//1 3//1\nusemtl grey\nf 1//1 4//1 3//1\nl 1 2\np 3\n");
  char note[256];
  struct scene scene = meshes_load(path, SCENE_SURFACES, false, note);
  assert_string_equal(note, "");
  assert_int_equal(scene.triangles, 4);
  const struct scene_material *red = &scene.materials[scene.material[0]];
  assert_string_equal(red->name, "red paint");
  expect_colour(red->diffuse, 0.5, 0.25, 0);
  expect_colour(red->specular, 0.1, 0.2, 0.3);
  expect_colour(red->emission, 0, 0, 0);
  assert_near(red->shininess, 17, 0); /* unscaled */
  assert_int_equal(red->texture, -1);
  const struct scene_material *lamp = &scene.materials[scene.material[2]];
  expect_colour(lamp->diffuse, 0, 0, 0);
  expect_colour(lamp->emission, 1, 2, 3);
  expect_colour(scene.materials[scene.material[3]].diffuse, 0.5, 0.5, 0.5);
  for (size_t t = 0; t < 4; ++t) {
    const double share[2] = {0.25, 0.5};
    double position[3], normal[3], geometric[3];
    scene_point(&scene, t, share, position, normal, geometric);
    assert_near(position[2], -3 * position[1], 1e-12); /* z = 3 y in the file */
    double side = t < 2 ? -1 : 1;
    expect_colour(normal, 0, side * 3 / sqrt(10), side / sqrt(10));
    expect_colour(geometric, 0, side * 3 / sqrt(10), side / sqrt(10));
    assert_true(winds_around(&scene, t, normal)); /* as the file's did */
  }
  scene_free(&scene);
  scene = meshes_load(path, SCENE_SHAPE, false, NULL);
  assert_int_equal(scene.triangles, 4);
  assert_null(scene.normal);
  assert_null(scene.materials);
  scene_free(&scene);
}

/* What is refused, and what a repair makes of it. */
TEST(test_obj_refused) {
  static const struct {
    const char *text, *piece;
    bool shape;       /* also refused where only the shape is wanted */
    const char *note; /* of the repair; NULL: none helps */
  } cases[] = {
      {MESHES_CORNERS "o bare\nf 1//1 2//1 3//1\n", "mesh 'bare' has no material", false,
       "materials made white: 1"},
      {"mtllib no.mtl\n" MESHES_CORNERS "usemtl x\nf 1//1 2//1 3//1\n",
       "no.mtl: No such file or directory; --repair makes its materials white", false,
       "materials made white: 1"},
      {"mtllib k.mtl\n" MESHES_CORNERS "usemtl y\nf 1//1 2//1 3//1\n", "'y' is in none", false,
       "materials made white: 1"},
      {"mtllib k.mtl\n" MESHES_CORNERS "usemtl x\no m\nf 1 2 3\n",
       "face of mesh 'm' has no normals", false, "meshes given flat normals: 1"},
      {"mtllib k.mtl\n" MESHES_CORNERS "vn 0 0 0\nusemtl x\no m\nf 1//2 2//2 3//2\n",
       "normal without direction", false, "meshes given flat normals: 1"},
      {"mtllib k.mtl\n" MESHES_CORNERS "usemtl empty\nf 1//1 2//1 3//1\n", "no Kd, map_Kd or Ke",
       false, "materials made white: 1"},
      {"mtllib k.mtl\n" MESHES_CORNERS "usemtl x\no m\nf 1//1 2//1 2//1\nf 1//1 2//1 3//1\n",
       ".obj:9: face of mesh 'm' has no area", true, "triangles without area dropped: 1"},
      {"mtllib k.mtl\n" MESHES_CORNERS
       "v 1 0 1e-9\nusemtl x\no m\nf 1//1 2//1 3//1\nf 1//1 2//1 5//1\n",
       ".obj:11: face of mesh 'm' has no area", true, "triangles without area dropped: 1"},
      {"mtllib k.mtl\n" MESHES_CORNERS "usemtl x\nf 1//1 2//1 2//1\n", "no area", true, NULL},
      {MESHES_CORNERS "v 1 nan 2\nf 1 2 3\n", ".obj:6: 'v 1 nan 2'", true, NULL},
      {MESHES_CORNERS "v 1 1e39 2\nf 1 2 3\n", "finite numbers", true, NULL},
      {MESHES_CORNERS "v 1 two 2\nf 1 2 3\n", "finite numbers", true, NULL},
      {MESHES_CORNERS "v 1 2 # 3\nf 1 2 3\n", "finite numbers", true, NULL},
      {MESHES_CORNERS "vn 1 inf 2\nf 1 2 3\n", "finite numbers", true, NULL},
      {"mtllib k.mtl\n" MESHES_CORNERS "usemtl x\nf 1 2 9\n",
       ".obj:8: face has a corner that is no vertex", true, NULL},
      {"v 0 0 0\nv 1 0 0\nv 0 1 1\n", "has no triangles", true, NULL},
      {"", "has no triangles", true, NULL},
  };
  meshes_write("k.mtl", "newmtl x\nKd 1 1 1\nnewmtl empty\nNs 3\n");
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    const char *path = meshes_write("b.obj", cases[k].text);
    char note[256];
    meshes_refused(path, SCENE_SURFACES, false, cases[k].piece);
    if (cases[k].shape) meshes_refused(path, SCENE_SHAPE, false, cases[k].piece);
    if (!cases[k].note) {
      meshes_refused(path, SCENE_SURFACES, true, "b.obj");
      continue;
    }
    struct scene scene = meshes_load(path, SCENE_SURFACES, true, note);
    assert_string_equal(note, cases[k].note);
    assert_int_equal(scene.triangles, 1);
    double third[2] = {1.0 / 3, 1.0 / 3}, rgb[3], position[3], normal[3], geometric[3];
    scene_diffuse(&scene, 0, third, rgb);
    expect_colour(rgb, 1, 1, 1);
    scene_point(&scene, 0, third, position, normal, geometric);
    assert_near(vector_length(normal), 1, 1e-12);
    scene_free(&scene);
  }
}

/* Repeated triangles: begun at another corner, turned over, of other vertices at the same points,
 * of another mesh; one without area; and one that shares only an edge. */
TEST(test_repeated) {
  const char *path = meshes_write(
      "r.obj",
      "mtllib k.mtl\n" MESHES_CORNERS "v -0 0 0\nv 2 0 0\nv 2 1 3\nv 0 0 2\nusemtl x\no m\n"
      "f 1//1 2//1 3//1\nf 2//1 3//1 1//1\nf 3//1 2//1 1//1\nf 1//1 1//1 2//1\n"
      "f 5//1 6//1 7//1\nf 1//1 2//1 8//1\nusemtl empty\no n\nf 1//1 2//1 3//1\n");
  meshes_write("k.mtl", "newmtl x\nKd 1 1 1\nnewmtl empty\nKd 0 0 0\n");
  for (int needs = SCENE_SHAPE; needs <= SCENE_SURFACES; ++needs) {
    char note[256];
    struct scene scene = meshes_load(path, (enum scene_needs)needs, true, note);
    assert_string_equal(note, "triangles without area dropped: 1; repeated triangles dropped: 4");
    assert_int_equal(scene.triangles, 2);
    double(*at)[3] = scene.position;
    assert_near(at[scene.corners[0][1]][1], 1, 0);
    assert_near(at[scene.corners[1][1]][2], -2, 0);
    if (needs == SCENE_SURFACES)
      for (int t = 0; t < 2; ++t) assert_string_equal(scene.materials[scene.material[t]].name, "x");
    scene_free(&scene);
  }
  struct scene whole = meshes_load(meshes_write("w.obj", MESHES_CORNERS "f 1 2 3\nf 1 2 3\n"),
                                   SCENE_SHAPE, false, NULL);
  assert_int_equal(whole.triangles, 2);
  scene_free(&whole);
}

#define FORTY "0123456789012345678901234567890123456789"
TEST(test_mtl_refused) {
  static const char *const cases[][2] = {
      {"newmtl x\nKd 1 1\n", "m.mtl:2: 'Kd 1 1'"},
      {"newmtl x\nKd spectral red.rfl\n", "'Kd spectral red.rfl'"},
      {"newmtl x\nKd 1 1 1\nKs 0 0 -1\n", ":3: 'Ks 0 0 -1'"},
      {"newmtl x\nKe 1 1 nan\n", "'Ke 1 1 nan'"},
      {"newmtl x\nNs -1\n", "'Ns -1'"},
      {"newmtl " FORTY FORTY FORTY "12345678\nKd 1 1 1\n", "needs a name of less than 128"},
      {"newmtl x\nnewmtl x\n", "two materials 'x'"},
      {"newmtl x\nmap_Kd\n", "name of a file"},
      {"newmtl x\nmap_Kd -s 2 2 2 a.png\n", "not supported; --repair"},
      {"newmtl x\nmap_Ks a.png\n", "map_Ks, which is not supported"},
      {"newmtl x\nmap_Kd none.png\n", "none.png: No such file"},
      {"newmtl x\nmap_Kd m.mtl\n", "m.mtl: is no image"},
  };
  char path[512];
  snprintf(path, sizeof path, "%s",
           meshes_write("m.obj",
                        "mtllib m.mtl\n" MESHES_CORNERS "vt 0 0\nusemtl x\nf 1/1/1 2/1/1 3/1/1\n"));
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    meshes_write("m.mtl", cases[k][0]);
    meshes_refused(path, SCENE_SURFACES, false, cases[k][1]);
  }
}

TEST(test_no_file) {
  meshes_refused(scratch("none.obj"), SCENE_SHAPE, true, "none.obj: No such file");
  const char *folder = scratch("folder.obj");
  assert_int_equal(mkdir(folder, 0700), 0);
  meshes_refused(folder, SCENE_SHAPE, true, "is not a file");
  rmdir(folder);
  meshes_refused(meshes_write("mesh.stl", "solid\n"), SCENE_SHAPE, true, "must end in .obj");
  meshes_refused(meshes_write("bad.gltf", "{\"asset\": "), SCENE_SHAPE, true, "cannot be read");
  meshes_refused(meshes_write("bad.ply", "ply\nformat ascii 1.0\nelement"), SCENE_SHAPE, true,
                 "bad.ply");
}

#define PLY                                                                                        \
  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                  \
  "property float z\n"
#define PLY_FACE "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

TEST(test_ply) {
  const char *path = meshes_write("a.ply", PLY "property float nx\nproperty float ny\n"
                                               "property float nz\n" PLY_FACE
                                               "0 0 5 0 0 2\n1 0 5 0 0 2\n0 1 5 0 0 2\n3 0 1 2\n");
  struct scene scene = meshes_load(path, SCENE_SURFACES, false, NULL);
  const double share[2] = {0.5, 0.25};
  double position[3], normal[3], geometric[3], rgb[3];
  scene_point(&scene, 0, share, position, normal, geometric);
  assert_near(position[2], -5, 0);
  expect_colour(normal, 0, 0, -1);
  expect_colour(geometric, 0, 0, -1);
  scene_diffuse(&scene, 0, share, rgb);
  expect_colour(rgb, 1, 1, 1);
  expect_colour(scene.materials[0].specular, 0, 0, 0);
  scene_free(&scene);
  path = meshes_write("b.ply", PLY PLY_FACE "0 0 5\n1 0 5\n0 1 5\n3 0 1 2\n");
  meshes_refused(path, SCENE_SURFACES, false, "has no normals");
  scene = meshes_load(path, SCENE_SURFACES, true, NULL);
  expect_colour(scene.normal[0], 0, 0, -1);
  scene_free(&scene);
  path = meshes_write("c.ply", PLY PLY_FACE "0 0 nan\n1 0 5\n0 1 5\n3 0 1 2\n");
  meshes_refused(path, SCENE_SHAPE, true, "face 1 has coordinates that are not finite");
  static const char *const broken[][2] = {
      {"0 0 0 0 0 0", "is cut off"},
      {"0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 3 face", "is cut off"},
  };
  for (size_t k = 0; k < 2; ++k) { /* a reader may read beyond the end */
    char text[1024];
    snprintf(text, sizeof text, "%s%s%s", PLY, PLY_FACE, broken[k][0]);
    char binary[1024];
    const char *at = strstr(text, "ascii");
    snprintf(binary, sizeof binary, "%.*sbinary_little_endian%s", (int)(at - text), text,
             at + strlen("ascii"));
    meshes_refused(meshes_write("e.ply", binary), SCENE_SHAPE, true, broken[k][1]);
  }
  path = meshes_write("d.ply", PLY PLY_FACE "0 0 0\n1 0 5\n0 1 5\n3 0 1 7\n");
  meshes_refused(path, SCENE_SHAPE, true, "face 1 has a corner that is no vertex");
}

#define METAL                                                                                      \
  "\"materials\":[{\"name\":\"metal\",\"pbrMetallicRoughness\":{\"baseColorFactor\":"              \
  "[0.5,0.25,1,1],\"metallicFactor\":0.25,\"roughnessFactor\":0.5},\"emissiveFactor\":[1,0.5,0]}]" \
  ","

/* Node transforms, mirroring ones too, and materials. */
TEST(test_gltf) {
  static const char *const scales[] = {"1,2,4", "1,2,-4"};
  for (int k = 0; k < 2; ++k) {
    char node[64];
    snprintf(node, sizeof node, ",\"scale\":[%s]", scales[k]);
    struct scene scene = meshes_load(meshes_gltf("a.gltf", node, ",\"material\":0", METAL),
                                     SCENE_SURFACES, false, NULL);
    assert_int_equal(scene.triangles, 1);
    const double share[2] = {0, 1};
    double position[3], normal[3], geometric[3];
    scene_point(&scene, 0, share, position, normal, geometric);
    /* which corner comes second depends on the mirroring */
    assert_near(position[0] + position[1], scene.corners[0][2] == 2 ? 7 : 6, 1e-6);
    expect_colour(normal, 0, 0, k ? 1 : -1);
    assert_true(winds_around(&scene, 0, normal));
    const struct scene_material *metal = &scene.materials[scene.material[0]];
    assert_string_equal(metal->name, "metal");
    expect_colour(metal->diffuse, 0.375, 0.1875, 0.75);
    expect_colour(metal->emission, 1, 0.5, 0);
    assert_near(metal->shininess, 30, 1e-4); /* 2/0.5^4 - 2 */
    expect_colour(metal->specular, (0.03 + 0.125) * 4, (0.03 + 0.0625) * 4, (0.03 + 0.25) * 4);
    scene_free(&scene);
  }
  const char *path = meshes_gltf("b.gltf", "", "", METAL);
  meshes_refused(path, SCENE_SURFACES, false, "mesh 'tri' has no material");
  struct scene scene = meshes_load(path, SCENE_SURFACES, true, NULL);
  expect_colour(scene.materials[scene.material[0]].diffuse, 1, 1, 1);
  scene_free(&scene);
  meshes_refused(meshes_gltf("d.gltf", ",\"scale\":[1,0,1]", ",\"material\":0", METAL), SCENE_SHAPE,
                 false, "no area");
}

int main(void) {
  return testing_run(NULL, NULL);
}
