/* import_provenance.h - what an imported slab says of where its light comes from: the keys
 * "samples_are" and "provenance" of each page, the latter with
 *   "import": {"source", "kind", "assumptions", "flux_in", "flux_out", "error", "error_is"}
 * (struct import_story), and, where they are known, "noise": {"sample", "flux"}, which
 * slab_json_sampling hands to all that tell a slab's error. */
#ifndef IMPORT_PROVENANCE_H
#define IMPORT_PROVENANCE_H

#include "import/kind/import_kind.h"

enum result import_provenance(const struct import_wish *wish, const char *kind, const char *command,
                              struct import_light *light, struct error *error);

#endif
