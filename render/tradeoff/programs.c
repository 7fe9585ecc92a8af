/* programs.c - one at a time: what the children of this process have used before and after is
 * what one of them used. What a program says goes to a file: POV-Ray says more than a pipe holds,
 * and its error comes last. */
#include "tradeoff/programs.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/files.h"
#include "base/process.h"

static const char log_name[] = "said";

static char *beside(const char *place, const char *name) {
  char *path = files_beside_program(place);
  return path ? path : strdup(name);
}

enum result programs_begin(const volatile sig_atomic_t *stop, struct programs *programs,
                           struct error *error) {
  const char *temporary = getenv("TMPDIR");
  *programs = (struct programs){.povray = "povray", .stop = stop};
  programs->bakeslab = beside("bin/bakeslab", "bakeslab");
  programs->renderslab = beside("bin/renderslab", "renderslab");
  if (!programs->bakeslab || !programs->renderslab) return result_no_memory(error);
  if (!temporary || strlen(temporary) > sizeof programs->folder - 20) temporary = "/tmp";
  char folder[sizeof programs->folder];
  snprintf(folder, sizeof folder, "%s/renderslab-XXXXXX", temporary);
  if (!mkdtemp(folder))
    return result_fail(error, RESULT_IO, "%s: a folder for pictures: %s", temporary,
                       strerror(errno));
  memcpy(programs->folder, folder, sizeof folder);
  return RESULT_OK;
}

void programs_end(struct programs *programs) {
  if (*programs->folder) files_remove_tree(programs->folder);
  free(programs->bakeslab);
  free(programs->renderslab);
  *programs = (struct programs){0};
}

char *programs_file(const struct programs *programs, const char *name) {
  return files_join(programs->folder, name);
}

static double seconds(struct timeval time) {
  return (double)time.tv_sec + 1e-6 * (double)time.tv_usec;
}

static double used_by_children(void) {
  struct rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/* The line that tells the error, or else the last with words. */
static const char *telling_line(char *said) {
  const char *last = "";
  for (char *line = said, *rest = NULL; (line = strtok_r(line, "\n", &rest)); line = NULL) {
    line += strspn(line, " \t\r");
    if (strstr(line, "Error")) return line;
    if (*line) last = line;
  }
  return last;
}

enum result programs_run(const struct programs *programs, const char *const *words, double *cpu,
                         struct error *error) {
  char *path = programs_file(programs, log_name);
  if (!path) return result_no_memory(error);
  int log = open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  free(path);
  if (log < 0) return result_fail(error, RESULT_IO, "%s: %s", programs->folder, strerror(errno));
  struct process process = {.words = words,
                            .in = PROCESS_NOTHING,
                            .out = log,
                            .errors = log,
                            .stop = programs->stop,
                            .said_end = -1};
  double before = used_by_children();
  enum result result = process_run(&process, error);
  close(log);
  *cpu += used_by_children() - before;
  if (result != RESULT_IO) return result;
  char *said = files_read(programs->folder, log_name);
  const char *line = said ? telling_line(said) : "";
  if (process.exit == PROCESS_MISSING)
    result_fail(error, RESULT_IO, "%s cannot be run; is it installed?", words[0]);
  else if (*line && process.exit < PROCESS_SIGNAL)
    result_fail(error, RESULT_IO, "%.900s", line);
  free(said);
  return result;
}
