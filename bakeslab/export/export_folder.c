#include "export/export_folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"
#include "base/temporary.h"

const char export_folder_mark[] = "provenance.json";
static const char unfinished[] = ".unfinished-export";

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

/* What exports of the same target left that were killed: no process has it locked. */
static void remove_left(const char *target) {
  const char *slash = strrchr(target, '/'), *name = slash ? slash + 1 : target;
  char *parent = slash ? strndup(target, (size_t)(slash - target) + 1) : strdup(".");
  DIR *directory = parent ? opendir(parent) : NULL;
  size_t length = strlen(name), mark = strlen(unfinished);
  for (const struct dirent *entry; directory && (entry = readdir(directory));) {
    const char *after = entry->d_name + length;
    if (strncmp(entry->d_name, name, length) != 0 || strncmp(after, unfinished, mark) != 0 ||
        after[mark] != '.' || strlen(after) != mark + strlen(".XXXXXX"))
      continue;
    int lock =
        openat(dirfd(directory), entry->d_name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (lock < 0) continue;
    char *path = flock(lock, LOCK_EX | LOCK_NB) == 0 ? files_join(parent, entry->d_name) : NULL;
    if (path) files_remove_tree(path);
    free(path);
    close(lock);
  }
  if (directory) closedir(directory);
  free(parent);
}

static enum result make_temporary(struct export_folder *folder, struct error *error) {
  char *path = NULL;
  if (asprintf(&path, "%s%s", folder->target, unfinished) < 0) return result_no_memory(error);
  folder->temporary = temporary_folder(path);
  int why = errno;
  free(path);
  if (!folder->temporary && why == ENOMEM) return result_no_memory(error);
  if (!folder->temporary)
    return result_fail(error, RESULT_IO, "%s: cannot make this folder: %s", folder->target,
                       strerror(why));
  folder->lock = open(folder->temporary, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder->lock < 0)
    return result_fail(error, RESULT_IO, "%s: cannot be opened: %s", folder->temporary,
                       strerror(errno));
  flock(folder->lock, LOCK_SH); /* a file system without locks is fine */
  return RESULT_OK;
}

enum result export_folder_begin(struct export_folder *folder, const char *path, bool force,
                                struct error *error) {
  *folder = (struct export_folder){.target = strdup(path), .lock = -1};
  if (!folder->target) return result_no_memory(error);
  for (size_t end = strlen(path); end > 1 && path[end - 1] == '/';) folder->target[--end] = 0;
  enum result result = check_target(folder, force, error);
  if (result == RESULT_OK) {
    remove_left(folder->target);
    result = make_temporary(folder, error);
  }
  if (result != RESULT_OK) export_folder_abandon(folder);
  return result;
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
    temporary_keep(folder->temporary);
    folder->temporary = NULL;
  }
  export_folder_abandon(folder);
  return RESULT_OK;
}

void export_folder_abandon(struct export_folder *folder) {
  temporary_remove(folder->temporary);
  if (folder->target && folder->lock >= 0) close(folder->lock); /* 0 in a zeroed folder */
  free(folder->target);
  *folder = (struct export_folder){.lock = -1};
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
