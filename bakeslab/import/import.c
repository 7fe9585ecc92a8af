#include "import/import.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/sdl.h"
#include "import/kind/import_provenance.h"
#include "import/photometric/import_photometry.h"
#include "import/pictures/import_pictures.h"
#include "import/rays/import_rays.h"

/* The first that knows a file has it: those that are sure by a magic word come first. */
static const struct import_kind *const kinds[] = {
    &import_tm25, &import_zemax, &import_ies, &import_eulumdat, &import_posed, &import_ray_text};
enum { KINDS = sizeof kinds / sizeof *kinds };

static enum result read_head(const char *path, char *head, size_t *size, struct error *error) {
  FILE *file = fopen(path, "rb");
  if (!file) return result_fail(error, RESULT_IO, "%s: cannot be read: %s", path, strerror(errno));
  *size = fread(head, 1, IMPORT_HEAD, file);
  head[*size] = 0;
  bool failed = ferror(file) != 0;
  int why = errno;
  fclose(file);
  if (failed) return result_fail(error, RESULT_IO, "%s: cannot be read: %s", path, strerror(why));
  if (*size == 0) return result_fail(error, RESULT_BAD, "%s: the file is empty", path);
  return RESULT_OK;
}

static enum result find_kind(const char *path, const struct import_kind **kind,
                             struct error *error) {
  size_t size = 0;
  char *head = malloc(IMPORT_HEAD + 1);
  if (!head) return result_no_memory(error);
  enum result result = read_head(path, head, &size, error);
  *kind = NULL;
  for (int k = 0; k < KINDS && result == RESULT_OK && !*kind; ++k)
    if (kinds[k]->is(head, size, path)) *kind = kinds[k];
  free(head);
  if (result == RESULT_OK && !*kind)
    result = result_fail(error, RESULT_BAD, "%s: is none of the files that can be read: %s", path,
                         IMPORT_KINDS);
  return result;
}

const struct import_kind *import_kind_of(const char *path) {
  const struct import_kind *kind;
  return find_kind(path, &kind, NULL) == RESULT_OK ? kind : NULL;
}

/* All files must be of one kind. */
static enum result find_common_kind(const struct import_wish *wish, const struct import_kind **kind,
                                    struct error *error) {
  enum result result = find_kind(wish->files[0], kind, error);
  for (int n = 1; n < wish->file_count && result == RESULT_OK; ++n) {
    const struct import_kind *other;
    result = find_kind(wish->files[n], &other, error);
    if (result == RESULT_OK && other != *kind)
      result = result_fail(error, RESULT_BAD,
                           "%s: is of the kind %s, but %s is %s: import them "
                           "one by one",
                           wish->files[n], other->name, wish->files[0], (*kind)->name);
  }
  return result;
}

/* Options that say nothing to a kind are refused. */
static enum result check_wish(const struct import_wish *wish, const struct import_kind *kind,
                              struct error *error) {
  const char *what = NULL;
  if (kind->family != IMPORT_PHOTOMETRIC && (wish->kelvin > 0 || wish->turn))
    what = "--kelvin and --turn are for photometric files";
  if (kind->family == IMPORT_PHOTOMETRIC && (wish->aperture_count > 0 || wish->box))
    what = "--center, --u, --v, --normal and --box are for ray files and pictures";
  if (kind->family == IMPORT_PICTURES && wish->box) what = "--box is for ray files";
  if (kind->family == IMPORT_PICTURES && (wish->lumens > 0 || wish->tolerance > 0))
    what = "--lumens and --tolerance are not for pictures";
  if (kind->family != IMPORT_PICTURES &&
      (wish->window[0] < wish->window[1] || wish->distance > 0 || wish->exposure > 0))
    what = "--window, --distance and --exposure are for pictures";
  if (kind != &import_posed &&
      (wish->vignetting[0] != 0 || wish->vignetting[1] != 0 || wish->vignetting[2] != 0))
    what = "--vignetting is for pictures with poses";
  if (!what) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s: %s; this one is %s", wish->files[0], what, kind->name);
}

/* The slabs' name: what is asked for, or the first file's without folder and ending. */
static void set_names(const struct import_wish *wish, struct import_light *light) {
  const char *from = wish->name ? wish->name : wish->files[0], *slash = strrchr(from, '/');
  char name[SLAB_NAME_SIZE], capitalised[SDL_IDENTIFIER_SIZE];
  from = slash ? slash + 1 : from;
  snprintf(name, sizeof name, "%.*s", (int)strcspn(from, "."), from);
  if (sdl_capitalise(name, capitalised, NULL) != RESULT_OK) snprintf(name, sizeof name, "lamp");
  for (int n = 0; n < light->count; ++n)
    snprintf(light->slabs[n].name, sizeof light->slabs[n].name, "%s", name);
}

enum result import_files(const struct import_wish *wish, const char *command,
                         struct import_light *light, struct error *error) {
  const struct import_kind *kind;
  *light = (struct import_light){0};
  enum result result = RESULT_OK;
  if (wish->views)
    kind = &import_views;
  else
    result = find_common_kind(wish, &kind, error);
  if (result == RESULT_OK) result = check_wish(wish, kind, error);
  if (result == RESULT_OK) result = kind->slabs(wish, light, error);
  if (result == RESULT_OK) {
    set_names(wish, light);
    result = import_provenance(wish, kind->name, command, light, error);
  }
  if (result != RESULT_OK) import_free(light);
  return result;
}

void import_free(struct import_light *light) {
  for (int n = 0; n < light->count; ++n) slab_free(&light->slabs[n]);
  free(light->slabs);
  *light = (struct import_light){0};
}
