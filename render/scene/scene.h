/* scene.h - a mesh scene in POV-Ray's coordinates: left-handed, y up.
 *
 * OBJ+MTL (scene_obj.c, scene_mtl.h), PLY (scene_ply.c) and glTF 2.0 (.gltf, .glb; gltf.h) in
 * double precision; x and y are kept and z is mirrored, as is usual when such meshes are brought to
 * POV-Ray. Triangles are wound so that edge01 x edge02, by components, points out where the file's
 * did. Node transforms are applied; faces of any shape are triangulated (scene_faces.h); lines and
 * points are left out.
 *
 * Materials: diffuse is the reflectance (OBJ's Kd, glTF's base colour times 1 - metallic):
 * a surface shows diffuse E/pi. specular and shininess mean what OBJ's Ks and Ns and
 * POV-Ray's `specular Ks roughness 1/Ns` mean: light of radiance L from the solid angle
 * d omega adds Ks L (N.H)^Ns d omega / pi, H halfway between light and eye, without a cosine.
 * glTF: Ns = 2/roughness^4 - 2 within 1..10000, Ks = (0.04 (1 - metallic) + base metallic)
 * (Ns + 2)/8, so that a highlight seen along the normal reflects no more than the Fresnel
 * reflectance there. PLY knows no materials: its surfaces are white, its colours unread.
 *
 * All surfaces are opaque and two-sided; illumination models, ambient colours and occlusion maps
 * are not read. Transparency, bump and normal maps, lights, PLY's and OBJ's colours of vertices,
 * statements of OBJ and MTL files that nobody knows and glTF's extensions, animations, other
 * scenes, points and lines and the pictures of a texture's file but the first are ignored, and told
 * in scene.ignored; so are glTF's textures that should end at their edges, and emission, which is
 * shown but lights nothing. Anything else that would change the picture is refused (or ignored,
 * with `repair`): other textures than those of the diffuse colour, options of map_Kd, extensions
 * that a glTF file requires, its colours of vertices (unless they are white), textures that it has
 * not. */
#ifndef SCENE_H
#define SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/picture.h"
#include "base/result.h"
#include "scene/camera.h"

struct scene_material {
  char name[128];
  double diffuse[3];
  double specular[3];
  double shininess;   /* 0: no highlight */
  double emission[3]; /* radiance */
  int texture;        /* that multiplies diffuse; -1: none */
};

struct scene_texture {
  char *path;             /* as the mesh names it, made relative to its folder; owned.
                             "FILE: image N" for those within a glTF file */
  bool transparent;       /* is its alpha below 1 anywhere? */
  struct picture picture; /* linear RGB, row 0 at the top; owned */
};

/* A camera of a glTF file, in POV-Ray's coordinates. */
struct scene_camera {
  char name[128];       /* of its node, of the camera, or its number */
  char other_name[128]; /* of the camera; may be empty */
  bool perspective;
  double from[3], forward[3], up[3]; /* directions of any length */
  double vertical;                   /* angle, degrees */
  double aspect;                     /* width over height; 0: the picture's */
};

/* What a file asks for that changes nothing in the picture, or not all that it should. */
enum scene_ignored {
  SCENE_TRANSPARENCY,
  SCENE_MEDIA, /* inside of surfaces */
  SCENE_BUMPS,
  SCENE_PICTURES, /* of a texture's file, beyond the first */
  SCENE_COLOURS,
  SCENE_EMISSION,
  SCENE_LIGHTS,
  SCENE_STATEMENTS, /* of OBJ and MTL files */
  SCENE_EDGES,
  SCENE_LINES,
  SCENE_ANIMATIONS,
  SCENE_OTHERS,
  SCENE_EXTENSIONS,
  SCENE_IGNORED
};

struct scene {
  size_t vertices, triangles;
  double (*position)[3]; /* [vertices] */
  double (*normal)[3];   /* [vertices], unit */
  double (*uv)[2];       /* [vertices], v up; 0 where a mesh has none */
  int (*corners)[3];     /* [triangles]: vertices */
  int *material;         /* [triangles] */
  int material_count, texture_count;
  struct scene_material *materials;
  struct scene_texture *textures;
  int camera_count;
  struct scene_camera *cameras;
  bool metres;                  /* are its units, as glTF says; else they are not known */
  char *ignored[SCENE_IGNORED]; /* a sentence that names what; NULL: nothing; owned */
};

enum scene_needs {
  SCENE_SHAPE,   /* only what casts shadows: positions and triangles */
  SCENE_SURFACES /* normals, materials and textures too */
};

/* Refuses, naming the file and the line, the face or the mesh: NaN, corners that are no vertex,
 * triangles without area (a height below single precision), faces that cross themselves and, for
 * SCENE_SURFACES, meshes without normals or materials, materials that are declared twice, and
 * textures that cannot be read. With `repair` it drops such triangles and faces and those that
 * repeat another one, gives flat normals and a white material instead, takes the first of two
 * materials, and does without such textures (NaN and corners that are no vertex are still
 * refused). It says in `note` what it did, and where single precision would have moved corners, or
 * leaves it empty.
 *
 * For SCENE_SHAPE, normal, uv, material, materials and textures are NULL.
 * Textures are read by slab_image.h, in the colours that they say; those of glTF are sRGB, whatever
 * they say, as its specification asks. */
enum result scene_load(const char *path, enum scene_needs needs, bool repair, struct scene *scene,
                       char note[256], struct error *error);
void scene_free(struct scene *scene); /* zeroed scene allowed */

/* The file's own camera, by the name of its node or its own, looking at the middle of the scene;
 * `aspect` is the picture's. Refuses, naming those that there are. */
enum result scene_find_camera(const struct scene *scene, const char *path, const char *name,
                              double aspect, struct camera *camera, struct error *error);

/* Their names, in quotes; returns `names`. */
const char *scene_camera_names(const struct scene *scene, size_t room, char *names);

/* Does it have a highlight? */
bool scene_glossy(const struct scene_material *material);

/* The box around all vertices. */
void scene_box(const struct scene *scene, double low[3], double high[3]);

/* The diffuse reflectance of a point of a triangle: the material's, times its texture
 * (bilinear, repeated) at barycentric `share`. */
void scene_diffuse(const struct scene *scene, size_t triangle, const double share[2],
                   double rgb[3]);

/* The unit normal of a triangle by its corners. */
void scene_geometric(const struct scene *scene, size_t triangle, double normal[3]);

/* The interpolated unit normal and the position there; the geometric normal is by the
 * triangle's corners, on the side of the interpolated one. */
void scene_point(const struct scene *scene, size_t triangle, const double share[2],
                 double position[3], double normal[3], double geometric[3]);

#endif
