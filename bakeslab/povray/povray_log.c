#include "povray/povray_log.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/files.h"

enum { LINE = 1024 };

static FILE *open_log(const char *directory) {
  char *path = files_join(directory, "log");
  FILE *log = path ? fopen(path, "re") : NULL;
  free(path);
  return log;
}

/* What is known of the reason so far. Each text is a message: a line of the log, joined with its
 * continuations. */
struct reason {
  char error[LINE];     /* the parser's last error */
  char announced[LINE]; /* the first of the latest "Possible Parse Errors", which come before a
                           fatal error that has no place of its own */
  char fatal[LINE];
  char problem[LINE]; /* "Problem with option setting" and all that follows: where and what */
  char last[LINE];
};

static void judge(struct reason *reason, const char *message) {
  static const char possible[] = "Possible Parse Error: ";
  if (!message[strspn(message, " \r")] || !strncmp(message, "Render failed", 13) ||
      !strncmp(message, "povray: ", 8))
    return;
  const char *at = strstr(message, possible);
  if (at) {
    if (!reason->announced[0])
      snprintf(reason->announced, LINE, "%.*s%s", (int)(at - message), message,
               at + strlen(possible));
    return;
  }
  size_t used = strlen(reason->problem);
  if (used)
    snprintf(reason->problem + used, LINE - used, ": %s", message);
  else if (strstr(message, "Parse Error:"))
    strcpy(reason->error, message);
  else if (!strncmp(message, "Fatal error", 11))
    strcpy(reason->fatal, message);
  else if (!strncmp(message, "Problem with ", 13))
    strcpy(reason->problem, message);
  else
    reason->announced[0] = 0;
  strcpy(reason->last, message);
}

/* Appends a line of the log; POV-Ray wraps its messages at 80 columns. */
static void join(char *message, const char *line) {
  size_t used = strlen(message);
  if (used && message[used - 1] == ' ') line += strspn(line, " ");
  snprintf(message + used, LINE - used, "%.*s", (int)strcspn(line, "\n"), line);
}

void povray_log_reason(const char *directory, char *text, size_t size) {
  FILE *log = open_log(directory);
  struct reason reason = {0};
  char line[LINE], message[LINE] = "";
  while (log && fgets(line, sizeof line, log)) {
    if (*line != ' ') { /* no continuation */
      judge(&reason, message);
      message[0] = 0;
    }
    join(message, line);
  }
  judge(&reason, message);
  if (log) fclose(log);
  if (reason.error[0])
    snprintf(text, size, "%s", reason.error);
  else if (reason.fatal[0])
    snprintf(text, size, "%s%s%s", reason.announced, reason.announced[0] ? " " : "", reason.fatal);
  else
    snprintf(text, size, "%s", reason.problem[0] ? reason.problem : reason.last);
}

bool povray_log_is_late(const char *directory) {
  char reason[LINE];
  povray_log_reason(directory, reason, sizeof reason);
  return strcmp(reason, "Timed out waiting for worker thread startup") == 0;
}

double povray_statistic(const char *directory, const char *label) {
  FILE *log = open_log(directory);
  char line[LINE];
  double value = -1;
  while (log && value < 0 && fgets(line, sizeof line, log)) {
    const char *at = strstr(line, label);
    if (at) sscanf(at + strlen(label), "%lf", &value);
  }
  if (log) fclose(log);
  return value;
}

double povray_log_cpu(const char *directory) {
  FILE *log = open_log(directory);
  char line[LINE];
  double sum = 0, value;
  while (log && fgets(line, sizeof line, log)) {
    const char *at = strstr(line, " thread(s) with ");
    if (at && sscanf(at, " thread(s) with %lf CPU-seconds", &value) == 1) sum += value;
  }
  if (log) fclose(log);
  return sum;
}

double povray_log_progress(const char *directory, bool animation) {
  char tail[2048];
  char *path = files_join(directory, "log");
  int file = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
  free(path);
  if (file < 0) return 0;
  off_t end = lseek(file, 0, SEEK_END);
  off_t from = end > (off_t)sizeof tail - 1 ? end - (off_t)sizeof tail + 1 : 0;
  ssize_t n = pread(file, tail, sizeof tail - 1, from);
  close(file);
  if (n <= 0) return 0;
  tail[n] = 0;
  /* An animation is done when it ends. */
  const char *format = animation ? "Rendering frame %lf of %lf" : "Rendered %lf of %lf";
  double done = 0, all = 0, part = 0;
  for (const char *at = tail; (at = strstr(at, "Render")); ++at)
    if (sscanf(at, format, &done, &all) == 2 && all > 0) part = (animation ? done - 1 : done) / all;
  return part;
}
