#include "export/export.h"

#include <string.h>

#include "base/output.h"
#include "base/sdl.h"
#include "export/export_cycles.h"
#include "export/export_folder.h"
#include "export/export_mitsuba.h"
#include "export/export_overlap.h"
#include "export/export_photometry.h"
#include "export/export_radiance.h"
#include "export/export_rays.h"

static const struct export_kind kinds[] = {
    {"radiance", NULL, export_radiance}, {"mitsuba", NULL, export_mitsuba},
    {"cycles", NULL, export_cycles},     {"ies", ".ies", export_ies},
    {"ldt", ".ldt", export_ldt},         {"tm25ray", ".tm25ray", export_tm25},
    {"rays", ".txt", export_rays},       {0}};

enum { LONGEST_NAME = 63 }; /* what Blender's data blocks hold */

const struct export_kind *export_kind_of(const char *name, const char *output) {
  size_t length = strlen(output);
  for (const struct export_kind *kind = kinds; kind->write; ++kind) {
    size_t ending = kind->ending ? strlen(kind->ending) : 0;
    if (name ? !strcmp(name, kind->name)
             : ending && length > ending && !strcmp(output + length - ending, kind->ending))
      return kind;
  }
  return NULL;
}

enum result export_check_name(const char *name, struct error *error) {
  static const char *const taken[] = {"example", "provenance"};
  for (int k = 0; k < 2; ++k)
    if (!strcasecmp(name, taken[k]))
      return result_fail(error, RESULT_BAD, "the name \"%s\" is that of a file beside the lamp's",
                         name);
  return sdl_check_identifier(name, LONGEST_NAME, error);
}

enum result export_check_output(const struct export_kind *kind, const char *output,
                                const char *slab, bool force, struct error *error) {
  if (kind->ending) return output_check(&output, 1, &slab, 1, error);
  struct export_folder trial = {0};
  enum result result = export_folder_begin(&trial, output, force, error);
  export_folder_abandon(&trial);
  return result;
}

enum result export_make(const struct export_kind *kind, const struct slab *slabs, int count,
                        const struct export_wish *wish, const char *output, bool force,
                        struct error *error) {
  if (kind->ending) return kind->write(slabs, count, wish, output, error);
  struct export_folder folder = {0};
  struct export_joined joined;
  enum result result = export_join(slabs, count, &joined, error);
  if (result == RESULT_OK) result = export_folder_begin(&folder, output, force, error);
  if (result == RESULT_OK)
    result = kind->write(joined.pages, joined.count, wish, folder.temporary, error);
  if (result == RESULT_OK) result = export_folder_commit(&folder, error);
  export_folder_abandon(&folder);
  export_joined_free(&joined);
  return result;
}
