/* test_scene.c - meshes of all three formats, what they say of materials, and what is refused. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/vector.h"
#include "file/slab_exr.h"
#include "helpers.h"
#include "scene/scene.h"

static const char *write_text(const char *name, const char *text) {
  const char *path = scratch(name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  assert_true(fputs(text, file) >= 0);
  assert_int_equal(fclose(file), 0);
  return path;
}

static struct scene load(const char *path, enum scene_needs needs, bool repair, char note[256]) {
  struct scene scene;
  struct error error = {""};
  if (scene_load(path, needs, repair, &scene, note, &error)) fail_msg("%s", error.text);
  return scene;
}

/* The message starts with the file's name and holds the piece. */
static void refused(const char *path, enum scene_needs needs, bool repair, const char *piece) {
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

static void expect(const double *x, int count, ...) {
  va_list arguments;
  va_start(arguments, count);
  for (int k = 0; k < count; ++k) assert_near(x[k], va_arg(arguments, double), 1e-6);
  va_end(arguments);
}

static void expect_colour(const double rgb[3], double r, double g, double b) {
  expect(rgb, 3, r, g, b);
}

static double mean(const double x[3]) {
  return (x[0] + x[1] + x[2]) / 3;
}

#define CORNERS "v 0 0 0\nv 2 0 0\nv 2 1 3\nv 0 1 3\nvn 0 3 -1\n"

/* Mirrored in z, wound so that the geometric normal points out where the file's did. */
static void test_obj(void **state) {
  (void)state;
  write_text("a.mtl", "# made by hand\nnewmtl red paint\n  Kd .5 0.25 0\nKs 0.1 0.2 0.3\nNs 17\n"
                      "illum 2\nnewmtl lamp\r\nKe 1 2 3\r\nnewmtl grey\nKd 0.5\nmap_Bump no.png\n");
  const char *path = write_text(
      "a.obj", "mtllib a.mtl\n" CORNERS
               "vn 0 -3 1\no roof\nusemtl red paint\nf 1//2 2//2 3//2 4//2\no lamp\n"
               "usemtl lamp\nf 1//1 4//1 3//1\nusemtl grey\nf 1//1 4//1 3//1\nl 1 2\np 3\n");
  char note[256];
  struct scene scene = load(path, SCENE_SURFACES, false, note);
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
    double position[3], normal[3], geometric[3], edge[2][3], across[3];
    scene_point(&scene, t, share, position, normal, geometric);
    assert_near(position[2], -3 * position[1], 1e-12); /* z = 3 y in the file */
    double side = t < 2 ? -1 : 1;
    expect_colour(normal, 0, side * 3 / sqrt(10), side / sqrt(10));
    expect_colour(geometric, 0, side * 3 / sqrt(10), side / sqrt(10));
    for (int k = 0; k < 2; ++k)
      vector_subtract(scene.position[scene.corners[t][k + 1]], scene.position[scene.corners[t][0]],
                      edge[k]);
    vector_cross(edge[0], edge[1], across);
    assert_true(vector_dot(across, normal) > 0); /* as the file's winding was */
  }
  scene_free(&scene);
  scene = load(path, SCENE_SHAPE, false, note);
  assert_int_equal(scene.triangles, 4);
  assert_null(scene.normal);
  assert_null(scene.materials);
  scene_free(&scene);
}

/* What is refused, and what a repair makes of it. */
static void test_obj_refused(void **state) {
  (void)state;
  static const struct {
    const char *text, *piece;
    bool shape;       /* also refused where only the shape is wanted */
    const char *note; /* of the repair; NULL: none helps */
  } cases[] = {
      {CORNERS "o bare\nf 1//1 2//1 3//1\n", "mesh 'bare' has no material", false,
       "materials made white: 1"},
      {"mtllib no.mtl\n" CORNERS "usemtl x\nf 1//1 2//1 3//1\n", "1: mtllib", false,
       "materials made white: 1"},
      {"mtllib k.mtl\n" CORNERS "usemtl y\nf 1//1 2//1 3//1\n", "'y' is in none", false,
       "materials made white: 1"},
      {"mtllib k.mtl\n" CORNERS "usemtl x\no m\nf 1 2 3\n", "mesh 'm' has no normals", false,
       "meshes given flat normals: 1"},
      {"mtllib k.mtl\n" CORNERS "vn 0 0 0\nusemtl x\no m\nf 1//2 2//2 3//2\n",
       "normal without direction", false, "meshes given flat normals: 1"},
      {"mtllib k.mtl\n" CORNERS "usemtl empty\nf 1//1 2//1 3//1\n", "no Kd, map_Kd or Ke", false,
       "materials made white: 1"},
      {"mtllib k.mtl\n" CORNERS "usemtl x\no m\nf 1//1 2//1 2//1\nf 1//1 2//1 3//1\n",
       "mesh 'm': triangle 1 has no area", true, "triangles without area dropped: 1"},
      {"mtllib k.mtl\n" CORNERS "v 1 0 1e-9\nusemtl x\no m\nf 1//1 2//1 3//1\nf 1//1 2//1 5//1\n",
       "mesh 'm': triangle 2 has no area", true, "triangles without area dropped: 1"},
      {"mtllib k.mtl\n" CORNERS "usemtl x\nf 1//1 2//1 2//1\n", "no area", true, NULL},
      {CORNERS "v 1 nan 2\nf 1 2 3\n", ".obj:6: 'v 1 nan 2'", true, NULL},
      {CORNERS "v 1 1e39 2\nf 1 2 3\n", "finite numbers", true, NULL},
      {CORNERS "v 1 two 2\nf 1 2 3\n", "finite numbers", true, NULL},
      {CORNERS "v 1 2 # 3\nf 1 2 3\n", "finite numbers", true, NULL},
      {CORNERS "vn 1 inf 2\nf 1 2 3\n", "finite numbers", true, NULL},
      {CORNERS "f 1 2 9\n", "cannot be read as a mesh", true, NULL},
      {"v 0 0 0\nv 1 0 0\nv 0 1 1\n", "has no triangles", true, NULL},
      {"", "cannot be read as a mesh", true, NULL},
  };
  write_text("k.mtl", "newmtl x\nKd 1 1 1\nnewmtl empty\nNs 3\n");
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    const char *path = write_text("b.obj", cases[k].text);
    char note[256];
    refused(path, SCENE_SURFACES, false, cases[k].piece);
    if (cases[k].shape) refused(path, SCENE_SHAPE, false, cases[k].piece);
    if (!cases[k].note) {
      refused(path, SCENE_SURFACES, true, "b.obj");
      continue;
    }
    struct scene scene = load(path, SCENE_SURFACES, true, note);
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
static void test_repeated(void **state) {
  (void)state;
  const char *path = write_text(
      "r.obj", "mtllib k.mtl\n" CORNERS "v -0 0 0\nv 2 0 0\nv 2 1 3\nv 0 0 2\nusemtl x\no m\n"
               "f 1//1 2//1 3//1\nf 2//1 3//1 1//1\nf 3//1 2//1 1//1\nf 1//1 1//1 2//1\n"
               "f 5//1 6//1 7//1\nf 1//1 2//1 8//1\nusemtl empty\no n\nf 1//1 2//1 3//1\n");
  write_text("k.mtl", "newmtl x\nKd 1 1 1\nnewmtl empty\nKd 0 0 0\n");
  for (int needs = SCENE_SHAPE; needs <= SCENE_SURFACES; ++needs) {
    char note[256];
    struct scene scene = load(path, (enum scene_needs)needs, true, note);
    assert_string_equal(note, "triangles without area dropped: 1; repeated triangles dropped: 4");
    assert_int_equal(scene.triangles, 2);
    double(*at)[3] = scene.position;
    assert_near(at[scene.corners[0][1]][1], 1, 0);
    assert_near(at[scene.corners[1][1]][2], -2, 0);
    if (needs == SCENE_SURFACES)
      for (int t = 0; t < 2; ++t) assert_string_equal(scene.materials[scene.material[t]].name, "x");
    scene_free(&scene);
  }
  struct scene whole =
      load(write_text("w.obj", CORNERS "f 1 2 3\nf 1 2 3\n"), SCENE_SHAPE, false, (char[256]){""});
  assert_int_equal(whole.triangles, 2);
  scene_free(&whole);
}

static void test_mtl_refused(void **state) {
  (void)state;
  static const char *const cases[][2] = {
      {"newmtl x\nKd 1 1\n", "m.mtl:2: 'Kd 1 1'"},
      {"newmtl x\nKd spectral red.rfl\n", "'Kd spectral red.rfl'"},
      {"newmtl x\nKd 1 1 1\nKs 0 0 -1\n", ":3: 'Ks 0 0 -1'"},
      {"newmtl x\nKe 1 1 nan\n", "'Ke 1 1 nan'"},
      {"newmtl x\nNs -1\n", "'Ns -1'"},
      {"newmtl\nKd 1 1 1\n", "needs a name"},
      {"newmtl x\nnewmtl x\n", "two materials 'x'"},
      {"newmtl x\nmap_Kd\n", "name of a file"},
      {"newmtl x\nmap_Kd -s 2 2 2 a.png\n", "not supported; --repair"},
      {"newmtl x\nmap_Ks a.png\n", "map_Ks, which is not supported"},
      {"newmtl x\nmap_Kd none.png\n", "none.png: No such file"},
      {"newmtl x\nmap_Kd m.mtl\n", "m.mtl: is no image"},
  };
  char path[512];
  snprintf(path, sizeof path, "%s",
           write_text("m.obj", "mtllib m.mtl\n" CORNERS "vt 0 0\nusemtl x\nf 1/1/1 2/1/1 3/1/1\n"));
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    write_text("m.mtl", cases[k][0]);
    refused(path, SCENE_SURFACES, false, cases[k][1]);
  }
}

static void test_no_file(void **state) {
  (void)state;
  refused(scratch("none.obj"), SCENE_SHAPE, true, "none.obj: No such file");
  const char *folder = scratch("folder.obj");
  assert_int_equal(mkdir(folder, 0700), 0);
  refused(folder, SCENE_SHAPE, true, "is not a file");
  rmdir(folder);
  refused(write_text("mesh.stl", "solid\n"), SCENE_SHAPE, true, "must end in .obj");
  refused(write_text("bad.gltf", "{\"asset\": "), SCENE_SHAPE, true, "cannot be read");
  refused(write_text("bad.ply", "ply\nformat ascii 1.0\nelement"), SCENE_SHAPE, true, "bad.ply");
}

#define PLY                                                                                        \
  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                  \
  "property float z\n"
#define PLY_FACE "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

static void test_ply(void **state) {
  (void)state;
  char note[256];
  const char *path = write_text("a.ply", PLY "property float nx\nproperty float ny\n"
                                             "property float nz\n" PLY_FACE
                                             "0 0 5 0 0 2\n1 0 5 0 0 2\n0 1 5 0 0 2\n3 0 1 2\n");
  struct scene scene = load(path, SCENE_SURFACES, false, note);
  const double share[2] = {0.5, 0.25};
  double position[3], normal[3], geometric[3], rgb[3];
  scene_point(&scene, 0, share, position, normal, geometric);
  assert_near(position[2], -5, 0);
  expect_colour(normal, 0, 0, -1);
  expect_colour(geometric, 0, 0, -1);
  scene_diffuse(&scene, 0, share, rgb);
  expect_colour(rgb, 1, 1, 1);
  assert_near(mean(scene.materials[0].specular), 0, 0);
  scene_free(&scene);
  path = write_text("b.ply", PLY PLY_FACE "0 0 5\n1 0 5\n0 1 5\n3 0 1 2\n");
  refused(path, SCENE_SURFACES, false, "has no normals");
  scene = load(path, SCENE_SURFACES, true, note);
  expect_colour(scene.normal[0], 0, 0, -1);
  scene_free(&scene);
  path = write_text("c.ply", PLY PLY_FACE "0 0 nan\n1 0 5\n0 1 5\n3 0 1 2\n");
  refused(path, SCENE_SHAPE, true, "triangle 1 has coordinates that are not finite");
  static const char *const broken[][2] = {
      {"0 0 0 0 0 0", "is cut off"},
      {"0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 3 face", "is cut off"},
  };
  for (size_t k = 0; k < 2; ++k) { /* assimp would read beyond the end */
    char text[1024];
    snprintf(text, sizeof text, "%s%s%s", PLY, PLY_FACE, broken[k][0]);
    char binary[1024];
    const char *at = strstr(text, "ascii");
    snprintf(binary, sizeof binary, "%.*sbinary_little_endian%s", (int)(at - text), text,
             at + strlen("ascii"));
    refused(write_text("e.ply", binary), SCENE_SHAPE, true, broken[k][1]);
  }
  path = write_text("d.ply", PLY PLY_FACE "0 0 0\n1 0 5\n0 1 5\n3 0 1 7\n");
  refused(path, SCENE_SHAPE, true, "d.ply");
}

/* One triangle (0,0,0) (1,0,0) (0,1,0), normals z, uv (0,0) (1,0) (0,1) from the top. */
static const char *write_gltf(const char *name, const char *node, const char *primitive,
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
  return write_text(name, text);
}

#define METAL                                                                                      \
  "\"materials\":[{\"name\":\"metal\",\"pbrMetallicRoughness\":{\"baseColorFactor\":"              \
  "[0.5,0.25,1,1],\"metallicFactor\":0.25,\"roughnessFactor\":0.5},\"emissiveFactor\":[1,0.5,0]}]" \
  ","

/* Node transforms, mirroring ones too, and materials. */
static void test_gltf(void **state) {
  (void)state;
  char note[256];
  static const char *const scales[] = {"1,2,4", "1,2,-4"};
  for (int k = 0; k < 2; ++k) {
    char node[64];
    snprintf(node, sizeof node, ",\"scale\":[%s]", scales[k]);
    struct scene scene =
        load(write_gltf("a.gltf", node, ",\"material\":0", METAL), SCENE_SURFACES, false, note);
    assert_int_equal(scene.triangles, 1);
    const double share[2] = {0, 1};
    double position[3], normal[3], geometric[3], edge[2][3], across[3];
    scene_point(&scene, 0, share, position, normal, geometric);
    /* which corner comes second depends on the mirroring */
    assert_near(position[0] + position[1], scene.corners[0][2] == 2 ? 7 : 6, 1e-6);
    expect_colour(normal, 0, 0, k ? 1 : -1);
    for (int e = 0; e < 2; ++e)
      vector_subtract(scene.position[scene.corners[0][e + 1]], scene.position[scene.corners[0][0]],
                      edge[e]);
    vector_cross(edge[0], edge[1], across);
    assert_true(vector_dot(across, normal) > 0);
    const struct scene_material *metal = &scene.materials[scene.material[0]];
    assert_string_equal(metal->name, "metal");
    expect_colour(metal->diffuse, 0.375, 0.1875, 0.75);
    expect_colour(metal->emission, 1, 0.5, 0);
    assert_near(metal->shininess, 30, 1e-4); /* 2/0.5^4 - 2 */
    expect_colour(metal->specular, (0.03 + 0.125) * 4, (0.03 + 0.0625) * 4, (0.03 + 0.25) * 4);
    scene_free(&scene);
  }
  const char *path = write_gltf("b.gltf", "", "", METAL);
  refused(path, SCENE_SURFACES, false, "mesh 'tri' has no material");
  struct scene scene = load(path, SCENE_SURFACES, true, note);
  expect_colour(scene.materials[scene.material[0]].diffuse, 1, 1, 1);
  scene_free(&scene);
  path = write_gltf("c.gltf", "", ",\"material\":0",
                    "\"extensionsUsed\":[\"KHR_materials_emissive_strength\"]," METAL);
  refused(path, SCENE_SURFACES, false, "KHR_materials_emissive_strength, which is not supported");
  scene = load(path, SCENE_SURFACES, true, note);
  assert_string_equal(note, "unsupported properties of materials ignored: 1");
  scene_free(&scene);
  refused(write_gltf("d.gltf", ",\"scale\":[1,0,1]", ",\"material\":0", METAL), SCENE_SHAPE, false,
          "no area");
}

static double decoded(double x) {
  return pow((x + 0.055) / 1.055, 2.4);
}

/* Writes a picture of 2 x 2: rows black red, green white, scaled; by oiiotool, whose name for
 * the format is the suffix. */
static void write_picture(const char *name, const char *options) {
  char command[1024];
  char path[512];
  snprintf(path, sizeof path, "%s", scratch(name));
  struct picture picture = {.width = 2,
                            .height = 2,
                            .rgb =
                                (float[]){0, 0, 0, 0.5F, 0, 0, 0, 0.25F, 0, 0.75F, 0.75F, 0.75F}};
  const char *exr = scratch("picture.exr"), *dot = strrchr(name, '.');
  char made[512]; /* oiiotool would take some of the names for patterns */
  snprintf(made, sizeof made, "%s%s", scratch("made"), dot);
  assert_int_equal(slab_exr_write(exr, &picture, 0, NULL, NULL), RESULT_OK);
  snprintf(command, sizeof command, "oiiotool '%s' --iscolorspace sRGB %s -o '%s'", exr, options,
           made);
  assert_int_equal(system(command), 0);
  assert_int_equal(rename(made, path), 0);
}

static void expect_texel(const struct scene *scene, double u, double v, const double rgb[3]) {
  double found[3];
  const double share[2] = {u / 2, v / 2}; /* uv goes from 0 to 2 */
  scene_diffuse(scene, 0, share, found);
  for (int c = 0; c < 3; ++c) assert_near(found[c], rgb[c], 0.002);
}

/* 8 and 16 bit files are sRGB unless they say otherwise, floating-point ones linear; alpha does not
 * matter; grey is grey; row 0 is at v = 1; the picture is repeated, and bilinear between middles.
 */
static void test_textures(void **state) {
  (void)state;
  static const struct {
    const char *name, *options;
    bool encoded, grey;
  } cases[] = {
      {"t.png", "-d uint8", true, false},
      {"t 16#1%d.png", "-d uint16", true, false},
      {"alpha.png", "--mulc 0.5 --ch R,G,B,A=0.5 -d uint8", true, false},
      {"t.exr", "-d half", false, false},
      {"t.tif", "-d uint8", true, false},
      {"float.tif", "-d float", false, false},
      {"t.bmp", "-d uint8", true, false},
      {"linear.png", "--iscolorspace Linear -d uint8", false, false},
      {"grey.png", "--ch R -d uint8", true, true},
      {"greya.png", "--mulc 0.5 --ch R,A=0.5 --chnames Y,A -d uint8", true, true},
  };
  const char *mesh = write_text("t.obj", "mtllib t.mtl\n" CORNERS "vt 0 0\nvt 2 0\nvt 0 2\n"
                                         "usemtl x\nf 1/1/1 3/3/1 2/2/1\n");
  char path[512], text[256], note[256];
  snprintf(path, sizeof path, "%s", mesh);
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    write_picture(cases[k].name, cases[k].options);
    snprintf(text, sizeof text, "newmtl x\nKd 1 1 0.5\nmap_Kd %s\n", cases[k].name);
    write_text("t.mtl", text);
    struct scene scene = load(path, SCENE_SURFACES, false, note);
    double half = cases[k].encoded ? decoded(0.5) : 0.5;
    double quarter = cases[k].encoded ? decoded(0.25) : 0.25;
    double white = cases[k].encoded ? decoded(0.75) : 0.75;
    if (cases[k].grey) {
      expect_texel(&scene, 0.75, 0.75, (double[]){half, half, half / 2});
      expect_texel(&scene, 0.25, 0.25, (double[]){0, 0, 0});
    } else {
      expect_texel(&scene, 0.25, 0.75, (double[]){0, 0, 0});
      expect_texel(&scene, 0.75, 0.75, (double[]){half, 0, 0});
      expect_texel(&scene, 0.25, 0.25, (double[]){0, quarter, 0});
      expect_texel(&scene, 0.75, 0.25, (double[]){white, white, white / 2});
      expect_texel(&scene, 0.25, 1.25, (double[]){0, quarter, 0});
      expect_texel(&scene, 0.5, 0.75, (double[]){half / 2, 0, 0});
      expect_texel(&scene, 1, 0.75, (double[]){half / 2, 0, 0});
    }
    scene_free(&scene);
  }
  refused(write_text("nouv.obj", "mtllib t.mtl\n" CORNERS "usemtl x\nf 1//1 2//1 3//1\n"),
          SCENE_SURFACES, false, "without texture coordinates");
}

/* A picture that is within the glTF file: one white PNG pixel of 188/255. */
static void test_embedded(void **state) {
  (void)state;
  char note[256];
  write_picture("dot.png", "--crop 1x1+1+1 --fullpixels -d uint8");
  char command[1024], rest[2048], code[1024] = "";
  snprintf(command, sizeof command, "base64 -w0 '%s'", scratch("dot.png"));
  FILE *pipe = popen(command, "r");
  assert_non_null(pipe);
  assert_non_null(fgets(code, sizeof code, pipe));
  pclose(pipe);
  snprintf(rest, sizeof rest,
           "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":"
           "{\"index\":0}}}],\"textures\":[{\"source\":0}],\"images\":[{\"uri\":"
           "\"data:image/png;base64,%s\"}],",
           code);
  struct scene scene =
      load(write_gltf("e.gltf", "", ",\"material\":0", rest), SCENE_SURFACES, false, note);
  expect_texel(&scene, 0.5, 0.5, (double[]){decoded(0.75), decoded(0.75), decoded(0.75)});
  scene_free(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_obj),      cmocka_unit_test(test_obj_refused),
      cmocka_unit_test(test_repeated), cmocka_unit_test(test_mtl_refused),
      cmocka_unit_test(test_no_file),  cmocka_unit_test(test_ply),
      cmocka_unit_test(test_gltf),     cmocka_unit_test(test_textures),
      cmocka_unit_test(test_embedded),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
