/* import.h - light that was measured, or simulated elsewhere, becomes slabs: finds out by content
 * of which kind the files are, has them read, and records where the light comes from. */
#ifndef IMPORT_H
#define IMPORT_H

#include "import/kind/import_kind.h"

/* The kinds that are known by their content, as words for people. */
#define IMPORT_KINDS                                                                               \
  "IES LM-63, EULUMDAT, TM-25, Zemax binary source file, ray text, "                               \
  "transforms.json of pictures"

/* The kind of a file, by its content; NULL where it is none of them, or cannot be read. */
const struct import_kind *import_kind_of(const char *path);

/* Imports the files, all of one kind. `command` is what provenance says. Refuses a file of no kind,
 * and files of several. After a failure the light is empty. */
enum result import_files(const struct import_wish *wish, const char *command,
                         struct import_light *light, struct error *error);

void import_free(struct import_light *light); /* zeroed lights allowed */

#endif
