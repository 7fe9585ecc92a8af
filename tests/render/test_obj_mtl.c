/* test_obj_mtl.c - OBJ, MTL and PLY files as programs and people write them: each says the same
 * as a plain one, or is refused by name. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "meshes.h"
#include "testing.h"

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n"
#define RED "newmtl red\nKd 0.5 0.25 0.125\n"

/* The materials of the mesh's triangles are red, and there are that many triangles. */
static void is_red(const char *mesh, size_t triangles, bool repair, const char *said) {
  char note[256];
  struct scene scene = meshes_load(mesh, SCENE_SURFACES, repair, note);
  assert_int_equal(scene.triangles, triangles);
  assert_string_equal(note, said);
  for (size_t t = 0; t < triangles; ++t) {
    const struct scene_material *red = &scene.materials[scene.material[t]];
    assert_string_equal(red->name, "red");
    for (int c = 0; c < 3; ++c) assert_near(red->diffuse[c], 0.5 / (1 << c), 0);
    assert_int_equal(red->texture, -1);
    assert_near(scene.normal[scene.corners[t][0]][2], -1, 0);
  }
  scene_free(&scene);
}

TEST(one_mesh_in_many_words) {
  static const char *const meshes[] = {
      "mtllib m.mtl\n" SQUARE "usemtl red\nf 1//1 2//1 3//1 4//1\n",
      "\xef\xbb\xbfmtllib m.mtl\n" SQUARE "usemtl red\nf 1//1 2//1 3//1 4//1",
      "MTLLIB m.mtl\nV 0 0 0\nV 1 0 0\nVn 0 0 1\nv 1 1 0\nv 0 1 0\nUseMtl red\nF -4//-1 2//1 -2//1 "
      "4//1",
      "mtllib \\\r\n m.mtl\r\n" SQUARE "\tusemtl  red \r\nf 1//1 2//1 3//1\\\r\n 4//1 # end\r\n",
      "mtllib m.mtl\rv 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rvn 0 0 1\rusemtl red\rf 1//1 2//1 3//1 "
      "4//1",
      "usemtl red\nf 1//1 2//1 3//1 4//1\n" SQUARE "mtllib m.mtl\n",
      "mtllib m.mtl\nmtllib m.mtl\n" SQUARE "usemtl red\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n",
      "mtllib blue.mtl  m.mtl\n" SQUARE "usemtl red\nf 1/1/1 2/1/1 3/1/1 4/1/1\nvt 0.5\n",
      "mtllib two words.mtl\n" SQUARE "usemtl red\nfo 1//1 2//1 3//1 4//1\n",
      "mtllib folder\\m.mtl\n" SQUARE "usemtl red\ng a\ns 1\nf 1//1 2//1 3//1 4//1\n",
  };
  char path[512];
  snprintf(path, sizeof path, "%s", scratch("folder"));
  mkdir(path, 0700);
  meshes_write("m.mtl", RED);
  meshes_write("two words.mtl", RED);
  meshes_write("folder/m.mtl", RED);
  meshes_write("blue.mtl", "newmtl blue\nKd 0 0 1\n");
  for (size_t k = 0; k < sizeof meshes / sizeof *meshes; ++k)
    is_red(meshes_write("m.obj", meshes[k]), 2, false, "");
  unlink(scratch("folder/m.mtl"));
  rmdir(path);
}

static const char *with(const char *mtl) {
  meshes_write("m.mtl", mtl);
  return meshes_write("m.obj", "mtllib m.mtl\n" SQUARE "usemtl red\nf 1//1 2//1 3//1 4//1\n");
}

TEST(one_material_in_many_words) {
  static const char *const files[] = {
      "\xef\xbb\xbf" RED,
      "NEWMTL red\r\nKD 0.5 .25 0.125 # paint\r\n",
      "newmtl red\nadobe_thing 3\naniso 0\nanisor 0.2\nPr 0.5\nKd 5e-1 25e-2 0.125\na b c\n",
      "Kd 1 1 1\nnewmtl red\n\tKd\t0.5\t0.25\t0.125\nillum 2\nd 1\nTf 1 1 1\nNi 1.45\n",
      "newmtl white\nKd 1 1 1\n" RED "newmtl black\nKd 0\n",
  };
  for (size_t k = 0; k < sizeof files / sizeof *files; ++k) is_red(with(files[k]), 2, false, "");
}

/* Materials without a name, which old versions of Blender write. */
TEST(no_name) {
  meshes_write("m.mtl",
               "# Blender MTL File: 'None'\nnewmtl\nKd 0.5 0.25 0.125\nnewmtl x\nKd 0 0 1\n");
  struct scene scene =
      meshes_load(meshes_write("m.obj", "mtllib m.mtl\n" SQUARE "usemtl \nf 1//1 2//1 3//1 4//1\n"),
                  SCENE_SURFACES, false, NULL);
  assert_near(scene.materials[scene.material[0]].diffuse[1], 0.25, 0);
  scene_free(&scene);
}

/* What is not supported matters only where a face has the material. */
TEST(unused_materials) {
  static const char *const others[] = {"map_Ks x.png", "map_Kd -o 1 x.png", "map_Kd none.png"};
  char mtl[256];
  for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
    snprintf(mtl, sizeof mtl, "newmtl other\n%s\nmap_Ke x.png\n" RED, others[k]);
    is_red(with(mtl), 2, false, "");
    is_red(with(mtl), 2, true, "");
  }
  meshes_write("m.mtl", RED "map_Ke x.png\nmap_Kd -o 1 m.mtl\nmap_Ks x.png\n");
  const char *mesh =
      meshes_write("m.obj", "mtllib m.mtl\nusemtl red\n" SQUARE "f 1//1 2//1 3//1\n");
  meshes_refused(mesh, SCENE_SURFACES, false, "m.mtl:3: map_Ke, which is not supported");
  is_red(
      mesh, 1, true,
      "textures that cannot be read left out: 1; unsupported properties of materials ignored: 3");
}

/* What the message blames, --repair gets past. */
TEST(repairs) {
  static const char *const cases[][3] = {
      {RED "Ks 1 1 1\nnewmtl red\nKd 1 1 1\n",
       "m.mtl:4: there are two materials 'red'; --repair takes the first",
       "materials declared twice taken as first declared: 1"},
      {RED "map_Kd none.png\n", "none.png: No such file or directory; --repair does without it",
       "textures that cannot be read left out: 1"},
      {RED "map_kd m.mtl\n", "m.mtl: is no image", "textures that cannot be read left out: 1"},
      {RED "map_ks x.png\n", "m.mtl:3: map_ks, which is not supported; --repair ignores it",
       "unsupported properties of materials ignored: 1"},
  };
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    meshes_write("m.mtl", cases[k][0]);
    const char *mesh =
        meshes_write("m.obj", "mtllib m.mtl\nvt 0 0\n" SQUARE "usemtl red\nf 1/1/1 2/1/1 3/1/1\n");
    meshes_refused(mesh, SCENE_SURFACES, false, cases[k][1]);
    is_red(mesh, 1, true, cases[k][2]);
  }
}

/* Normals and texture coordinates that are not there matter only to surfaces. */
TEST(missing_normals) {
  static const char *const faces[] = {"f 1//1 2//2 3//1\n", "f 1/1/1 2/2/1 3/1/1\n"};
  meshes_write("m.mtl", RED);
  for (int k = 0; k < 2; ++k) {
    char text[512];
    snprintf(text, sizeof text, "mtllib m.mtl\nvt 0 0\n" SQUARE "usemtl red\n%s", faces[k]);
    const char *mesh = meshes_write("m.obj", text);
    meshes_refused(mesh, SCENE_SURFACES, false,
                   "m.obj:9: face has a corner whose normal or texture coordinates are not there; "
                   "--repair ignores them");
    is_red(mesh, 1, true,
           k ? "faces taken to have no such normals or texture coordinates: 1"
             : "meshes given flat normals: 1; faces taken to have no such normals or texture "
               "coordinates: 1");
    struct scene scene = meshes_load(mesh, SCENE_SHAPE, false, NULL);
    assert_int_equal(scene.triangles, 1);
    scene_free(&scene);
  }
}

/* Options of a texture that change nothing, or are refused by name. */
TEST(options_of_textures) {
  static const char *const same[] = {"-s 1 1 1", "-S 1", "-o 0 0", "-clamp off -blendu on",
                                     "-mm 0 1 -texres 512 -imfchan l -bm 0.5 -boost 2 -t 0"};
  static const char *const others[][2] = {
      {"-s 2 2", "-s"},     {"-o 0 0.5", "-o"},   {"-clamp on", "-clamp"}, {"-mm 0 2", "-mm"},
      {"-t 0.1 0 0", "-t"}, {"-what x", "-what"}, {"-bm 1 -s 1 -3", "-s"}};
  char mtl[256], piece[128];
  for (size_t k = 0; k < sizeof same / sizeof *same; ++k) {
    snprintf(mtl, sizeof mtl, RED "map_Kd %s no such.png\n", same[k]);
    meshes_refused(with(mtl), SCENE_SURFACES, false, "/no such.png: No such file");
  }
  for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
    snprintf(mtl, sizeof mtl, RED "map_Kd %s no such.png\n", others[k][0]);
    snprintf(piece, sizeof piece, "m.mtl:3: map_Kd has the option %s, which is not supported",
             others[k][1]);
    meshes_refused(with(mtl), SCENE_SURFACES, false, piece);
    is_red(with(mtl), 2, true,
           "textures that cannot be read left out: 1; unsupported properties of materials ignored: "
           "1");
  }
}

static void ignores(const char *mesh, enum scene_ignored kind, const char *said) {
  struct scene scene = meshes_load(mesh, SCENE_SURFACES, false, NULL);
  assert_non_null(scene.ignored[kind]);
  assert_string_equal(scene.ignored[kind], said);
  scene_free(&scene);
}

#define PLY(format, more) "ply\nformat " format " 1.0\nelement vertex 4\n" more
#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define UP "property float nx\nproperty float ny\nproperty float nz\n"
#define FACE "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
#define CORNERS "0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n"

TEST(what_is_ignored) {
  ignores(with(RED "Pm 0.5\nPr 1\nfancy 3\nKd 1 0 0\nPm 1\nPs 0\n"), SCENE_STATEMENTS,
          "statements are ignored: 'Pm', 'fancy'");
  meshes_write("m.mtl", RED);
  ignores(meshes_write("m.obj", "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 1 1 1\nvn 0 0 "
                                "1\nusemtl red\nf 1//1 2//1 3//1\n"),
          SCENE_COLOURS, "colours of vertices are ignored: 'm.obj'");
  ignores(meshes_write("m.obj", "mtllib m.mtl\nv 0 0 0 1\nv 1 0 0 0.5\nv 1 1 0 1\nvn 0 0 1\n"
                                "usemtl red\nsurf 1 2\nf 1//1 2//1 3//1\nl 1 2\np 1\ns off\n"),
          SCENE_STATEMENTS, "statements are ignored: 'w', 'surf'");
  ignores(
      meshes_write(
          "c.ply",
          PLY("ascii", XYZ UP
              "property uchar red\n" FACE) "0 0 0 0 0 1 9\n1 0 0 "
                                           "0 0 1 9\n1 1 0 0 0 1 9\n0 1 0 0 0 1 9\n4 0 1 2 3\n"),
      SCENE_COLOURS, "colours of vertices are ignored: 'vertex'");
}

/* Strips turn every other triangle over; -1 begins a new one. */
TEST(strips) {
  const char *path = meshes_write(
      "s.ply",
      PLY("ascii", XYZ UP "element tristrips 1\nproperty list int int vertex_indices\n"
                          "end_header\n") "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n1 1 0 0 0 1\n"
                                          "11 0 1 2 3 -1 0 0 1 3 -1 2\n");
  struct scene scene = meshes_load(path, SCENE_SURFACES, false, NULL);
  assert_int_equal(scene.triangles, 3);
  for (size_t t = 0; t < 3; ++t) {
    double normal[3];
    scene_geometric(&scene, t, normal);
    assert_near(normal[2], t < 2 ? -1 : 1, 0); /* 0 0 1 3 begins turned over */
  }
  scene_free(&scene);
}

/* Faces may come before the vertices. */
#define EARLY(format)                                                                              \
  "ply\nformat " format " 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement "   \
  "vertex 4\n" XYZ UP "end_header\n"
TEST(faces_before_vertices) {
  static const char faces[] = "\3\0\0\0\0\1\0\0\0\2\0\0\0\4\0\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0";
  static const float corners[] = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1,
                                  1, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1};
  FILE *file = fopen(scratch("early.ply"), "w");
  assert_non_null(file);
  fputs(EARLY("binary_little_endian"), file);
  fwrite(faces, sizeof faces - 1, 1, file);
  fwrite(corners, sizeof corners, 1, file);
  assert_int_equal(fclose(file), 0);
  for (int binary = 0; binary < 2; ++binary) {
    const char *path = binary ? scratch("early.ply")
                              : meshes_write("e.ply", EARLY("ascii") "3 0 1 2 4 0 1 2 3\n" CORNERS);
    struct scene scene = meshes_load(path, SCENE_SURFACES, false, NULL);
    assert_int_equal(scene.triangles, 3);
    for (int k = 0; k < 3; ++k) assert_near(scene.position[scene.corners[0][k]][0], k != 0, 0);
    scene_free(&scene);
  }
}

TEST(bad_ply) {
  static const char *const cases[][2] = {
      {"", "does not begin with ply"},
      {"PLY\n", "does not begin with ply"},
      {"ply\nformat ascii 1.0\n", "its header has no end"},
      {PLY("ebcdic", "end_header\n"), "its header says 'format ebcdic 1.0'"},
      {PLY("ascii", "property vector x\n"), "its header says 'property vector x'"},
      {PLY("ascii", "property list float int a\n"), "its header says 'property list float int a'"},
      {PLY("ascii", "end_header\n"), "element 'vertex' has no properties"},
      {PLY("ascii", "property float x\n" FACE), "vertices have no x, y, z"},
      {PLY("ascii", XYZ FACE) "0 0 0\n1 0 0\n1 1 0\n0 1", "is cut off: element 'vertex' 4 of 4"},
      {PLY("ascii", XYZ FACE) "0 0 0\n1 0 O\n", "'vertex' 2 has something that is no number"},
      {PLY("ascii", XYZ UP FACE) CORNERS "4 0 1 2", "is cut off: element 'face' 1 of 1"},
      {PLY("ascii", XYZ UP FACE) CORNERS "4 0 1 2 4", "face 1 has a corner that is no vertex"},
      {PLY("ascii", XYZ UP FACE) CORNERS "4 0 1 2 -1", "face 1 has a corner that is no vertex"},
      {PLY("ascii", XYZ UP FACE) CORNERS "3 0 1 0.5", "face 1 has a corner that is no vertex"},
      {PLY("ascii", XYZ UP FACE) CORNERS "3 0 1 4e9", "face 1 has a corner that is no vertex"},
      {PLY("ascii", XYZ UP FACE) CORNERS "-1 0 1 2", "something that is no number"},
      {PLY("ascii", XYZ UP FACE) CORNERS "0", "face 1 has less than three corners"},
      {PLY("ascii", XYZ UP FACE) CORNERS "2 0 1", "face 1 has less than three corners"},
      {PLY("ascii", XYZ UP FACE) CORNERS "4 0 2 1 3", "face 1 has no area"},
      {PLY("ascii", XYZ UP FACE) CORNERS "5 0 2 1 3 3", "face 1 has no area"},
      {"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
       "end_header\n3 0 1 2\n",
       "face 1 has a corner that is no vertex"},
      {EARLY("ascii") "3 0 1 2 3 0 2 4\n" CORNERS, "face 2 has a corner that is no vertex"},
      {PLY("ascii", XYZ "element face 1\nproperty int a\nend_header\n") "0 0 0 1 0 0 1 1 0 0 1 0 1",
       "no list vertex_indices"},
      {PLY("binary_little_endian", XYZ FACE) "0123", "is cut off: element 'vertex' 1 of 4"},
  };
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    meshes_refused(meshes_write("bad.ply", cases[k][0]), SCENE_SURFACES, false, cases[k][1]);
}

TEST(bad_obj) {
  static const char *const cases[][2] = {
      {SQUARE "f 1 2 0\n", ":6: face has a corner that is no vertex"},
      {SQUARE "f 1 2 -5\n", ":6: face has a corner that is no vertex"},
      {SQUARE "f 1 2 99999999999999999999\n", ":6: face has a corner that is no vertex"},
      {SQUARE "o m\nf 1 2 x\n", ":7: face of mesh 'm' has a corner that is no number"},
      {SQUARE "f 1 2 3.5\n", "has a corner that is no number"},
      {SQUARE "f 1/1/1/1 2 3\n", "has a corner that is no number"},
      {SQUARE "f\n", "has less than three corners"},
      {SQUARE "f 1 2\n", "has less than three corners"},
      {SQUARE "f 1 3 2 4\n", "has no area"},
      {SQUARE "v 1 2\n", ":6: 'v 1 2' is not a line of finite numbers"},
  };
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    meshes_refused(meshes_write("bad.obj", cases[k][0]), SCENE_SHAPE, false, cases[k][1]);
  FILE *file = fopen(scratch("zero.obj"), "w");
  assert_non_null(file);
  for (int k = 0; k < 100; ++k) putc(0, file);
  assert_int_equal(fclose(file), 0);
  meshes_refused(scratch("zero.obj"), SCENE_SHAPE, false, "zero.obj: is no text");
}

int main(void) {
  return testing_run(NULL, NULL);
}
