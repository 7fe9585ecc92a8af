/* scene_gltf_check.c - does a glTF file use what is not read? See scene_load.h. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_load.h"

/* Extensions that change what a surface looks like. A name in the text means that it is used:
 * exporters list what they use. */
enum result scene_gltf_check(struct scene_loading *loading, struct error *error) {
  static const char *const unread[] = {"KHR_materials_emissive_strength", "KHR_texture_transform",
                                       "KHR_materials_pbrSpecularGlossiness"};
  enum { OVERLAP = 64, CHUNK = 1 << 16 };
  bool found[sizeof unread / sizeof *unread] = {false};
  enum result result = RESULT_OK;
  char *text = malloc(OVERLAP + CHUNK);
  FILE *file = fopen(loading->path, "re");
  bool good = text && file;
  for (size_t kept = 0, got; good && (got = fread(text + kept, 1, CHUNK, file)) > 0;) {
    size_t size = kept + got;
    for (size_t k = 0; k < sizeof unread / sizeof *unread; ++k)
      found[k] |= memmem(text, size, unread[k], strlen(unread[k])) != NULL;
    kept = size < OVERLAP ? size : OVERLAP;
    memmove(text, text + size - kept, kept);
  }
  if (!good || ferror(file))
    result = result_fail(error, RESULT_IO, "%s: %s", loading->path, strerror(errno));
  for (size_t k = 0; k < sizeof unread / sizeof *unread && result == RESULT_OK; ++k)
    if (found[k]) result = scene_unread(loading, error, "%s: has %s", loading->path, unread[k]);
  free(text);
  if (file) fclose(file);
  return result;
}
