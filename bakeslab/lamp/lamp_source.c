/* lamp_source.c - finding a lamp script and all that POV-Ray needs with it. */
#include <errno.h>
#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"
#include "lamp/lamp.h"

const char *const lamp_without_highlights[] = {"LD_PRELOAD", LAMP_PRELOAD, "CANNED_MATT", "1",
                                               NULL};

enum result lamp_source_open(const char *script, const char *const *libraries,
                             struct lamp_source *source, struct error *error) {
  *source = (struct lamp_source){.script = script};
  struct stat status;
  source->path = realpath(script, NULL);
  if (!source->path || stat(source->path, &status) != 0)
    return result_fail(error, RESULT_IO, "%s: %s", script, strerror(errno));
  if (!S_ISREG(status.st_mode))
    return result_fail(error, RESULT_BAD, "%s: is not a file; give a lamp script", script);
  if (access(source->path, R_OK) != 0)
    return result_fail(error, RESULT_IO, "%s: %s", script, strerror(errno));
  char *copy = strdup(source->path);
  source->folder = copy ? strdup(dirname(copy)) : NULL;
  free(copy);
  if (!source->folder) return result_no_memory(error);
  source->include_pov = files_beside_program("share/canned/include-pov");
  source->reads = files_beside_program("lib/canned/reads.so");
  if (!source->include_pov || !source->reads)
    return result_fail(
        error, RESULT_IO,
        "share/canned/include-pov and lib/canned/reads.so are not where bakeslab was "
        "installed; run `make` or `make install` again");
  int n = 0;
  for (; libraries && *libraries; ++libraries) {
    if (n == LAMP_MAX_LIBRARIES)
      return result_fail(error, RESULT_BAD, "more than %d -L folders", LAMP_MAX_LIBRARIES);
    source->libraries[n] = realpath(*libraries, NULL);
    if (!source->libraries[n++])
      return result_fail(error, RESULT_IO, "-L %s: %s", *libraries, strerror(errno));
  }
  return RESULT_OK;
}

void lamp_source_free(struct lamp_source *source) {
  free(source->path);
  free(source->folder);
  free(source->include_pov);
  free(source->reads);
  for (int n = 0; n < LAMP_MAX_LIBRARIES; ++n) free(source->libraries[n]);
  *source = (struct lamp_source){0};
}

/* Links in a scene's folder, where POV-Ray looks for includes before it looks anywhere
 * else: names that no script includes. */
static const char script_link[] = LAMP_SCRIPT, folder_link[] = "canned-folder",
                  canned_link[] = "canned-include", reads_link[] = LAMP_READS;

static const char *library_link(int n, char name[LAMP_LINK_SIZE]) {
  snprintf(name, LAMP_LINK_SIZE, "library%d", n);
  return name;
}

static enum result make_link(const char *directory, const char *name, const char *target,
                             struct error *error) {
  char *path = files_join(directory, name);
  if (!path) return result_no_memory(error);
  enum result result = RESULT_OK;
  if (symlink(target, path) != 0)
    result = result_fail(error, RESULT_IO, "%s: cannot make this link: %s", path, strerror(errno));
  free(path);
  return result;
}

enum result lamp_source_link(const struct lamp_source *source, const char *directory,
                             struct error *error) {
  enum result result = files_make_directory(directory, error);
  if (result == RESULT_OK) result = make_link(directory, script_link, source->path, error);
  if (result == RESULT_OK) result = make_link(directory, folder_link, source->folder, error);
  if (result == RESULT_OK) result = make_link(directory, canned_link, source->include_pov, error);
  if (result == RESULT_OK) result = make_link(directory, reads_link, source->reads, error);
  char name[LAMP_LINK_SIZE];
  for (int n = 0; result == RESULT_OK && source->libraries[n]; ++n)
    result = make_link(directory, library_link(n, name), source->libraries[n], error);
  return result;
}

void lamp_source_library(const struct lamp_source *source, struct lamp_library *library) {
  *library = (struct lamp_library){.paths = {folder_link, canned_link}};
  for (int n = 0; source->libraries[n]; ++n)
    library->paths[n + 2] = library_link(n, library->names[n]);
}

/* Replaces each `from` in the text by `to`, as far as there is room. */
static void replace(char *text, size_t size, const char *from, const char *to) {
  size_t removed = strlen(from), added = strlen(to);
  for (char *at = text; (at = strstr(at, from)); at += added) {
    size_t rest = strlen(at + removed) + 1;
    if ((size_t)(at - text) + added + rest > size) return;
    memmove(at + added, at + removed, rest);
    memcpy(at, to, added);
  }
}

/* What a script leaves open, POV-Ray misses in the scene that includes it, or in what that calls:
 * at the script's end. */
static void replace_end(char *text, size_t size, const char *place, const char *script) {
  char end[64], told[PATH_MAX + 32];
  char *at = strstr(text, place), *rest = at ? strchr(at, ':') : NULL;
  if (!rest || rest - at >= (long)sizeof end) return;
  snprintf(end, sizeof end, "%.*s", (int)(rest - at), at);
  snprintf(told, sizeof told, "At the end of '%s'", script);
  replace(text, size, end, told);
}

void lamp_source_rename(const struct lamp_source *source, struct error *error) {
  char quoted[PATH_MAX + 8];
  snprintf(quoted, sizeof quoted, "'%s'", source->script);
  replace(error->text, sizeof error->text, "'" LAMP_SCRIPT "'", quoted);
  snprintf(quoted, sizeof quoted, "'%s/", source->folder);
  replace(error->text, sizeof error->text, "'canned-folder/", quoted);
  replace_end(error->text, sizeof error->text, "File 'scene.pov' line ", source->script);
  replace_end(error->text, sizeof error->text, "File 'canned-include/canned_bake.inc' line ",
              source->script);
}
