/* export_folder.h - a folder that appears whole or not at all: it is filled under a temporary
 * name beside the target, TARGET.unfinished-export.XXXXXX, and renamed when all of it is on disk. A
 * signal that ends the program removes it (temporary.h); one that was killed leaves it, and the
 * next export to the target removes it. */
#ifndef EXPORT_FOLDER_H
#define EXPORT_FOLDER_H

#include <stdbool.h>
#include <stdio.h>

#include "base/result.h"

/* The file that marks a folder as made by an export: only such a folder is ever replaced. */
extern const char export_folder_mark[];

struct export_folder {
  char *target;    /* owned */
  char *temporary; /* owned; NULL when there is nothing to remove */
  bool replace;    /* the target is there and goes away */
  int lock;        /* says to others that the temporary folder is in use */
};

/* Makes the temporary folder. Refuses a target that is there; with `force` one that is not an
 * earlier export or an empty folder. */
enum result export_folder_begin(struct export_folder *folder, const char *path, bool force,
                                struct error *error);

/* Gives the folder its name, in one step also where it replaces another. */
enum result export_folder_commit(struct export_folder *folder, struct error *error);

/* Removes what was not committed. Allowed on a zeroed folder, and after a commit. */
void export_folder_abandon(struct export_folder *folder);

/* A new file STEM ENDING in the folder, to be written; NULL with the reason in `error`. */
FILE *export_folder_open(const char *folder, const char *stem, const char *ending,
                         struct error *error);

/* Gets it to the disk. `result` is how writing went: the first failure stays. */
enum result export_folder_close(FILE *file, const char *stem, const char *ending,
                                enum result result, struct error *error);

#endif
