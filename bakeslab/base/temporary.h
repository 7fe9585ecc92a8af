/* temporary.h - files and folders under a temporary name, which do not stay where a signal ends
 * the program. All functions but the last are for one thread at a time. */
#ifndef TEMPORARY_H
#define TEMPORARY_H

/* A new file, or folder, PATH.XXXXXX with the modes that the user's umask leaves: its name, or NULL
 * with errno set. `fd`: open for reading and writing. The name goes to one of the two below. */
char *temporary_file(const char *path, int *fd);
char *temporary_folder(const char *path);

/* Frees the name of what has its real name now, and stays. NULL does nothing. */
void temporary_keep(char *name);

/* Removes it, and all that is in a folder, and frees the name. NULL does nothing. */
void temporary_remove(char *name);

/* From now on SIGINT, SIGTERM and SIGHUP, unless they are ignored, remove all of them before they
 * end the program. */
void temporary_mind_signals(void);

#endif
