/* test_textures.c - pictures on meshes: their files, beside a mesh or within it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_exr.h"
#include "meshes.h"
#include "testing.h"

static double decoded(double x) {
  return pow((x + 0.055) / 1.055, 2.4);
}

/* Writes a picture of 2 x 2: rows black red, green white, scaled; by oiiotool, whose name for
 * the format is the suffix. */
static void write_picture(const char *name, const char *options) {
  char command[1024], path[512], made[512];
  snprintf(path, sizeof path, "%s", scratch(name));
  struct picture picture = {.width = 2,
                            .height = 2,
                            .rgb =
                                (float[]){0, 0, 0, 0.5F, 0, 0, 0, 0.25F, 0, 0.75F, 0.75F, 0.75F}};
  const char *exr = scratch("picture.exr"), *dot = strrchr(name, '.');
  /* oiiotool would take some of the names for patterns */
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
TEST(test_textures) {
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
  const char *mesh =
      meshes_write("t.obj", "mtllib t.mtl\n" MESHES_CORNERS "vt 0 0\nvt 2 0\nvt 0 2\n"
                            "usemtl x\nf 1/1/1 3/3/1 2/2/1\n");
  char path[512], text[256];
  snprintf(path, sizeof path, "%s", mesh);
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    write_picture(cases[k].name, cases[k].options);
    snprintf(text, sizeof text, "newmtl x\nKd 1 1 0.5\nmap_Kd %s\n", cases[k].name);
    meshes_write("t.mtl", text);
    struct scene scene = meshes_load(path, SCENE_SURFACES, false, NULL);
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
  meshes_refused(
      meshes_write("nouv.obj", "mtllib t.mtl\n" MESHES_CORNERS "usemtl x\nf 1//1 2//1 3//1\n"),
      SCENE_SURFACES, false, "without texture coordinates");
}

/* A picture that is within the glTF file: one PNG pixel of 0.75. It says that it is linear, but
 * glTF's are sRGB whatever they say. */
TEST(test_embedded) {
  write_picture("dot.png", "--crop 1x1+1+1 --fullpixels --iscolorspace Linear -d uint8");
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
      meshes_load(meshes_gltf("e.gltf", "", ",\"material\":0", rest), SCENE_SURFACES, false, NULL);
  expect_texel(&scene, 0.5, 0.5, (double[]){decoded(0.75), decoded(0.75), decoded(0.75)});
  scene_free(&scene);
}

/* A mesh of MTL with the material x, and of glTF. */
static void expect_told(const char *picture, enum scene_ignored kind, bool told, bool in_gltf) {
  char text[1024];
  snprintf(text, sizeof text, "newmtl x\nmap_Kd %s\n", picture);
  meshes_write("told.mtl", text);
  snprintf(
      text, sizeof text,
      "\"materials\":[{\"name\":\"x\",\"alphaMode\":\"%s\",\"pbrMetallicRoughness\":{"
      "\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{\"source\":0}],"
      "\"images\":[{\"uri\":\"%s\"}],",
      in_gltf ? "MASK" : "OPAQUE", picture);
  for (int k = 0; k < 2; ++k) {
    const char *mesh = k ? meshes_gltf("told.gltf", "", ",\"material\":0", text)
                         : meshes_write("told.obj", "mtllib told.mtl\n" MESHES_CORNERS
                                                    "vt 0 0\nusemtl x\nf 1/1/1 3/1/1 2/1/1\n");
    struct scene scene = meshes_load(mesh, SCENE_SURFACES, false, NULL);
    for (int other = 0; other < SCENE_IGNORED; ++other)
      if (other == (int)kind && told && (k == 0 || in_gltf))
        assert_non_null(scene.ignored[other]);
      else
        assert_null(scene.ignored[other]);
    scene_free(&scene);
  }
}

/* Alpha in a texture's file, where it means something, and pictures after the first are told. */
TEST(what_is_in_the_file) {
  write_picture("alpha.png", "--mulc 0.5 --ch R,G,B,A=0.5 -d uint8");
  write_picture("opaque.png", "--ch R,G,B,A=1 -d uint8");
  write_picture("pages.tif", "-d uint8 --dup --siappend");
  expect_told("alpha.png", SCENE_TRANSPARENCY, true, true);
  expect_told("alpha.png", SCENE_TRANSPARENCY, true, false);
  expect_told("opaque.png", SCENE_TRANSPARENCY, false, true);
  expect_told("pages.tif", SCENE_PICTURES, true, true);
}

int main(void) {
  return testing_run(NULL, NULL);
}
