#include "lamp/lamp_depend.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/output.h"

/* A name, quoted for a rule of GNU make's. An equals sign cannot be quoted and is put in by an
 * expansion. A percent sign is special in targets only. */
static void put_name(FILE *rule, const char *name, bool target) {
  if (name[0] == '~') fputs("./", rule);
  size_t backslashes = 0;
  for (const char *c = name;; ++c) {
    /* Those before a quoted blank or the end would quote; elsewhere they are themselves. */
    if (!*c || *c == ' ' || *c == '#')
      for (; backslashes; --backslashes) putc('\\', rule);
    if (!*c) return;
    backslashes = *c == '\\' ? backslashes + 1 : 0;
    if (*c == '$')
      fputs("$$", rule);
    else if (*c == '=')
      fputs("$(if ,,=)", rule);
    else
      fprintf(rule, "%s%c", strchr(target ? " #:*?[%" : " #:*?[", *c) ? "\\" : "", *c);
  }
}

static enum result check_name(const char *name, struct error *error) {
  char last = *name ? name[strlen(name) - 1] : 0;
  if (!name[strcspn(name, ";|\t\n")] && last != '&' && last != ')') return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "--depend: make cannot carry the name \"%s\", since it holds ; or | or a "
                     "tab, or ends with & or ); rename it",
                     name);
}

static const char *below(const char *folder, const char *path) {
  size_t length = strlen(folder);
  return !strncmp(path, folder, length) && path[length] == '/' ? path + length + 1 : path;
}

static enum result put_rule(FILE *rule, const struct lamp_reads *reads, const char *script,
                            const char *target, struct error *error) {
  char *folder = getcwd(NULL, 0);
  enum result result = folder ? check_name(target, error)
                              : result_fail(error, RESULT_IO, "the working folder is gone");
  put_name(rule, target, true);
  putc(':', rule);
  for (int n = 0; result == RESULT_OK && n < reads->count; ++n) {
    const char *name = below(folder, lamp_reads_path(reads, n));
    result = check_name(name, error);
    fputs(" \\\n  ", rule);
    put_name(rule, name, false);
  }
  putc('\n', rule);
  for (int n = 0; result == RESULT_OK && n < reads->count; ++n) {
    if (!strcmp(lamp_reads_path(reads, n), script)) continue;
    putc('\n', rule);
    put_name(rule, below(folder, lamp_reads_path(reads, n)), true);
    fputs(":\n", rule);
  }
  free(folder);
  return result;
}

static enum result check_path(const struct lamp_reads *reads, const char *target, const char *path,
                              struct error *error) {
  char *real = realpath(path, NULL);
  enum result result = RESULT_OK;
  if (!strcmp(path, target) && strcmp(path, "-") != 0)
    result = result_fail(error, RESULT_BAD, "--depend %s: is the slab; give another file", path);
  for (int n = 0; real && result == RESULT_OK && n < reads->count; ++n)
    if (!strcmp(lamp_reads_path(reads, n), real))
      result = result_fail(error, RESULT_BAD,
                           "--depend %s: is a file that the lamp script reads; give another", path);
  free(real);
  return result;
}

enum result lamp_depend(const struct lamp_reads *reads, const char *script, const char *target,
                        const char *path, bool trial, struct error *error) {
  char *text = NULL;
  size_t size = 0;
  struct output output = {0};
  enum result result = check_path(reads, target, path, error);
  FILE *rule = result != RESULT_OK ? NULL : open_memstream(&text, &size);
  if (rule) result = put_rule(rule, reads, script, target, error);
  bool whole = rule && fclose(rule) == 0 && text;
  if (!whole && result == RESULT_OK) result = result_no_memory(error);
  if (result == RESULT_OK) result = output_begin(&output, path, error);
  if (result == RESULT_OK && output_write(&output, text, size, 0) != 0)
    result = result_fail(error, RESULT_IO, "%s: cannot be written: %m", path);
  if (result == RESULT_OK && !trial) result = output_commit(&output, error);
  output_abandon(&output);
  free(text);
  return result;
}
