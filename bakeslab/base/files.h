/* files.h - reading, writing and removing small files and folders. */
#ifndef FILES_H
#define FILES_H

#include "base/result.h"

/* Joins a folder and a name into a new string, or NULL; the caller frees it. */
char *files_join(const char *directory, const char *name);

/* The path of something that is there, relative to the folder above the running program's, built
 * or installed: bin/bakeslab, lib/canned/, share/canned/. NULL where it is not; the caller frees
 * it. */
char *files_beside_program(const char *name);

/* The text of directory/name with a 0 at its end; the caller frees it. NULL with errno set
 * where it cannot be read. */
char *files_read(const char *directory, const char *name);

/* Writes a text and checks that it got to the disk. */
enum result files_write(const char *directory, const char *name, const char *text,
                        struct error *error);

/* Standard input, which cannot be sought in, as an unnamed file: its descriptor, at the start, or
 * -1 with errno set. */
int files_spool_stdin(void);

/* Makes a folder; one that is there already is fine. */
enum result files_make_directory(const char *path, struct error *error);

/* Removes a folder and all that is in it, without following links. Failures are ignored.
 * Needs no memory. */
void files_remove_tree(const char *path);

#endif
