/* scene_ignore.c - what a mesh file asks for and is ignored, by name. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_load.h"

/* At most so many letters of names. */
enum { MOST_NAMES = 400 };

bool scene_ignore(struct scene_loading *loading, enum scene_ignored kind, const char *name) {
  static const char *const sentences[SCENE_IGNORED] = {
      [SCENE_TRANSPARENCY] = "transparency is ignored, surfaces are opaque:",
      [SCENE_MEDIA] =
          "media are ignored, light is neither dimmed nor scattered inside of surfaces:",
      [SCENE_BUMPS] = "bump and normal maps are ignored:",
      [SCENE_PICTURES] = "only the first picture of a texture's file is read:",
      [SCENE_COLOURS] = "colours of vertices are ignored:",
      [SCENE_EMISSION] = "emission is shown but lights nothing:",
      [SCENE_LIGHTS] = "lights of the file are ignored:",
      [SCENE_STATEMENTS] = "statements are ignored:",
      [SCENE_EDGES] = "textures are repeated beyond their edges, not clamped or mirrored:",
      [SCENE_LINES] = "points and lines are ignored:",
      [SCENE_ANIMATIONS] = "animations are ignored:",
      [SCENE_OTHERS] = "other scenes of the file are ignored:",
      [SCENE_EXTENSIONS] = "extensions are ignored:"};
  char **there = &loading->scene->ignored[kind], *made, *quoted;
  if (asprintf(&quoted, " '%s'", name) < 0) return false;
  bool known = *there && strstr(*there, quoted);
  size_t length = *there ? strlen(*there) : 0;
  bool full = length > MOST_NAMES;
  if (full && strcmp(*there + length - 4, " ...") == 0) known = true;
  int printed = known ? 0
                      : asprintf(&made, "%s%s%s", *there ? *there : sentences[kind],
                                 *there ? "," : "", full ? " ..." : quoted);
  free(quoted);
  if (printed < 0) return false;
  if (known) return true;
  free(*there);
  *there = made;
  return true;
}

bool scene_ignore_statement(struct scene_loading *loading, const char *keyword) {
  size_t length =
      strspn(keyword, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789");
  if (length == 0 || length > 32 || keyword[length]) return true;
  return scene_ignore(loading, SCENE_STATEMENTS, keyword);
}
