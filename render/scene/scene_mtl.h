/* scene_mtl.h - the materials of MTL files.
 *
 * Keywords and options are read in any case. Kd, Ks, Ke (a number for all channels, or three), Ns
 * and map_Kd are what scene.h says; d, Tr and map_d, bump and normal maps, and statements that
 * nobody knows are noted as ignored. Options of map_Kd that change nothing here are read over
 * (-blendu, -blendv, -boost, -texres, -type, -cc, -bm, -imfchan, -colorspace, and others with
 * the values that they have by themselves). A face whose material has others, map_Ks, map_Ke or
 * map_Ns is refused, by their name. */
#ifndef SCENE_MTL_H
#define SCENE_MTL_H

#include "scene/scene_load.h"

struct scene_mtl {
  struct scene_material material;
  int library;
  bool has_diffuse, has_texture;
  bool transparent, see_through, bumps; /* d or Tr, map_d, bump maps: ignored */
  bool has_opacity;                     /* d, which decides whatever Tr says */
  char texture[1024];                   /* as the file names it */
  size_t unread, unread_line;           /* what is not supported: how much, the first one's line */
  char unread_what[64];                 /* and what it is */
};

/* What MTL files declare. */
struct scene_mtls {
  struct scene_loading *loading;
  struct scene_mtl *mtl; /* [count]; owned */
  int count, room;
  char **library; /* [libraries]: paths; owned */
  int libraries, library_room;
  bool skips; /* a material that is there already */
};

/* Reads the files that an mtllib line names: the whole line is one name or, where there is no
 * such file, each word. A file is read once. Of a material in two files the first one counts; two
 * in one file are refused, unless `repair` takes the first. `repair` does without files that
 * cannot be opened. */
enum result scene_mtl_read(struct scene_mtls *mtls, const char *names, struct error *error);

/* The material of that name, or NULL. Some programs write one without: "". */
const struct scene_mtl *scene_mtl_find(const struct scene_mtls *mtls, const char *name);

/* Makes it a material of the scene, and reads its texture. Refuses what is not supported, which
 * `repair` ignores, one without a colour, which `repair` makes white, and a texture that cannot be
 * read, without which `repair` does. */
enum result scene_mtl_use(struct scene_mtls *mtls, const struct scene_mtl *mtl,
                          struct scene_material *material, struct error *error);

void scene_mtl_free(struct scene_mtls *mtls);

#endif
