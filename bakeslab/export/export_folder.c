#include "export/export_folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"

const char export_folder_mark[] = "provenance.json";

static bool is_empty(const char *path) {
  DIR *directory = opendir(path);
  int entries = 0;
  while (directory && entries < 3 && readdir(directory)) ++entries; /* . and .. */
  if (directory) closedir(directory);
  return directory && entries <= 2;
}

static bool is_export(const char *path) {
  char *text = files_read(path, export_folder_mark);
  bool ours = text && strstr(text, "\"bakeslab ") && strstr(text, "\"export\"");
  free(text);
  return ours;
}

/* Whether the target is there, and may go. */
static enum result check_target(struct export_folder *folder, bool force, struct error *error) {
  struct stat status;
  const char *slash = strrchr(folder->target, '/'), *name = slash ? slash + 1 : folder->target;
  if (!*name || !strcmp(name, ".") || !strcmp(name, ".."))
    return result_fail(error, RESULT_BAD, "\"%s\": is no name for a folder to be made",
                       folder->target);
  if (lstat(folder->target, &status) != 0) return RESULT_OK;
  if (!S_ISDIR(status.st_mode))
    return result_fail(error, RESULT_BAD, "%s: is there and is no folder; choose another name",
                       folder->target);
  if (!force)
    return result_fail(error, RESULT_BAD,
                       "%s: is there; choose another name, or replace it with --force",
                       folder->target);
  if (!is_empty(folder->target) && !is_export(folder->target))
    return result_fail(error, RESULT_BAD,
                       "%s: was not made by bakeslab export, so --force does not replace it; "
                       "choose another name",
                       folder->target);
  folder->replace = true;
  return RESULT_OK;
}

enum result export_folder_begin(struct export_folder *folder, const char *path, bool force,
                                struct error *error) {
  *folder = (struct export_folder){.target = strdup(path)};
  if (!folder->target) return result_no_memory(error);
  for (size_t end = strlen(path); end > 1 && path[end - 1] == '/';) folder->target[--end] = 0;
  enum result result = check_target(folder, force, error);
  if (result == RESULT_OK && asprintf(&folder->temporary, "%s.XXXXXX", folder->target) < 0) {
    folder->temporary = NULL;
    result = result_no_memory(error);
  }
  if (result == RESULT_OK && !mkdtemp(folder->temporary)) {
    result =
        result_fail(error, RESULT_IO, "%s: cannot make this folder: %s", path, strerror(errno));
    free(folder->temporary);
    folder->temporary = NULL;
  }
  if (result != RESULT_OK) {
    export_folder_abandon(folder);
    return result;
  }
  mode_t mask = umask(0);
  umask(mask);
  /* mkdtemp made it private; a file system without modes does not matter. */
  (void)!chmod(folder->temporary, 0777 & ~mask);
  return RESULT_OK;
}

enum result export_folder_commit(struct export_folder *folder, struct error *error) {
  /* Exchanged, the old folder is what export_folder_abandon removes. */
  unsigned flags = folder->replace ? RENAME_EXCHANGE : RENAME_NOREPLACE;
  int done = renameat2(AT_FDCWD, folder->temporary, AT_FDCWD, folder->target, flags);
  if (done != 0 && errno == EINVAL && !folder->replace) /* a file system without these flags */
    done = rename(folder->temporary, folder->target);
  if (done != 0)
    return result_fail(error, RESULT_IO, "%s: cannot be put in place: %s", folder->target,
                       strerror(errno));
  if (!folder->replace) {
    free(folder->temporary);
    folder->temporary = NULL;
  }
  export_folder_abandon(folder);
  return RESULT_OK;
}

void export_folder_abandon(struct export_folder *folder) {
  if (folder->temporary) files_remove_tree(folder->temporary);
  free(folder->temporary);
  free(folder->target);
  *folder = (struct export_folder){0};
}

FILE *export_folder_open(const char *folder, const char *stem, const char *ending,
                         struct error *error) {
  char *path = NULL;
  if (asprintf(&path, "%s/%s%s", folder, stem, ending) < 0) {
    result_no_memory(error);
    return NULL;
  }
  FILE *file = fopen(path, "wxe");
  if (!file)
    result_fail(error, errno == ENOMEM ? RESULT_MEMORY : RESULT_IO, "%s: cannot be written: %s",
                path, strerror(errno));
  free(path);
  return file;
}

enum result export_folder_close(FILE *file, const char *stem, const char *ending,
                                enum result result, struct error *error) {
  errno = 0;
  bool good = !ferror(file) && fflush(file) == 0 && (fsync(fileno(file)) == 0 || errno == EINVAL);
  int reason = errno;
  if (fclose(file) != 0 && good) {
    good = false;
    reason = errno;
  }
  if (result != RESULT_OK || good) return result;
  return result_fail(error, RESULT_IO, "%s%s: cannot be written: %s", stem, ending,
                     reason ? strerror(reason) : "the disk may be full");
}
