#include "povray/povray.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/files.h"
#include "base/process.h"
#include "file/slab_exr.h"
#include "povray/sandbox.h"

enum result povray_find(const char *program, struct povray *povray, struct error *error) {
  static const char product[] = "POV-Ray ";
  *povray = (struct povray){0};
  if (strlen(program) >= sizeof povray->program)
    return result_fail(error, RESULT_BAD, "%s: path too long", program);
  strcpy(povray->program, program);
  /* A path from here is none from the folders where POV-Ray is to run. */
  char *path = strchr(program, '/') ? realpath(program, NULL) : NULL;
  if (path && strlen(path) < sizeof povray->program) strcpy(povray->program, path);
  free(path);
  const char *const words[] = {program, "--version", NULL};
  struct process process = {
      .words = words, .in = PROCESS_NOTHING, .out = PROCESS_SAID, .errors = PROCESS_SAID};
  struct error why;
  if (process_run(&process, &why) != RESULT_OK && process.exit == PROCESS_MISSING)
    return result_fail(error, RESULT_IO,
                       "%s; install POV-Ray 3.7 (Debian: apt install povray) or name it with "
                       "--povray",
                       why.text);
  const char *at = strstr(process.said, "POV-Ray 3.");
  if (!at)
    return result_fail(error, RESULT_BAD,
                       "%s: does not say that it is POV-Ray 3.7; name another with --povray",
                       program);
  at += sizeof product - 1;
  snprintf(povray->version, sizeof povray->version, "%.*s", (int)strcspn(at, " \n"), at);
  if (strncmp(povray->version, "3.7", 3) != 0 && strncmp(povray->version, "3.8", 3) != 0)
    return result_fail(
        error, RESULT_BAD,
        "%s: is POV-Ray %s, and only 3.7 and 3.8 are known to give the radiance that "
        "a bake needs; name another with --povray",
        program, povray->version);
  return RESULT_OK;
}

static enum result write_ini(const struct povray_job *job, struct error *error) {
  char *text = NULL;
  size_t size = 0;
  FILE *ini = open_memstream(&text, &size);
  if (!ini) return result_no_memory(error);
  fprintf(ini,
          "; Written by bakeslab. Again: povray render.ini\n"
          "Input_File_Name=scene.pov\nOutput_File_Name=frame.exr\nOutput_File_Type=E\n"
          "Output_to_File=on\nWidth=%d\nHeight=%d\n"
          "Start_Column=1\nEnd_Column=%d\nStart_Row=1\nEnd_Row=%d\n",
          job->width, job->height, job->width, job->height);
  if (job->frames > 1) /* of one lamp: its clock stands still */
    fprintf(ini, "Initial_Frame=1\nFinal_Frame=%d\nInitial_Clock=0\nFinal_Clock=0\n", job->frames);
  fputs("Display=off\nPause_When_Done=off\nVerbose=on\nAntialias=off\nQuality=9\nOutput_Alpha=off\n"
        "Work_Threads=1\nContinue_Trace=off\nRemove_Bounds=on\nBounding=on\n",
        ini);
  for (const char *const *path = job->library; path && *path; ++path)
    fprintf(ini, "Library_Path=\"%s\"\n", *path);
  if (fclose(ini) != 0 || !text) {
    free(text);
    return result_no_memory(error);
  }
  enum result result = files_write(job->directory, "render.ini", text, error);
  free(text);
  return result;
}

enum result povray_start(const struct povray *povray, const struct povray_job *job, pid_t *pid,
                         struct error *error) {
  const char *const program[] = {povray->program, "render.ini", NULL};
  const char *words[SANDBOX_WORDS];
  enum result result = write_ini(job, error);
  if (result != RESULT_OK) return result;
  char *folder = realpath(job->directory, NULL);
  if (!folder) return result_fail(error, RESULT_IO, "%s: %s", job->directory, strerror(errno));
  struct process process = {
      .words = program, .environment = job->environment, .folder = folder, .in = PROCESS_NOTHING};
  if (povray->sandbox) {
    sandbox_command(program, folder, job->environment, words);
    process.words = words;
    process.environment = NULL; /* not for bwrap itself */
  }
  char *path = files_join(folder, "log");
  int log = path ? open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
  if (log < 0) result = result_fail(error, RESULT_IO, "%s/log: %s", folder, strerror(errno));
  process.out = process.errors = log;
  if (result == RESULT_OK) result = process_start(&process, error);
  if (log >= 0) close(log);
  free(path);
  free(folder);
  *pid = process.pid;
  return result;
}

/* POV-Ray wraps its messages at 80 columns and continues them on lines that
 * start with a blank: joins the line at `at` with its continuations. */
static void join_message(const char *at, char *out, size_t size) {
  size_t n = 0;
  while (*at && n + 1 < size) {
    if (*at == '\n') {
      if (at[1] != ' ') break;
      ++at;
      if (n && out[n - 1] == ' ') continue;
    }
    out[n++] = *at++;
  }
  out[n] = 0;
}

static enum result report_log(const struct povray_job *job, struct error *error) {
  static const char *const marks[] = {"Parse Error:", "Fatal error", "Error:", "error:", "annot "};
  char *log = files_read(job->directory, "log");
  char message[768] = "";
  for (size_t k = 0; log && !message[0] && k < sizeof marks / sizeof *marks; ++k) {
    const char *at = log;
    /* "Possible Parse Error" only announces the real one. */
    while ((at = strstr(at, marks[k])) && at - log >= 9 && !strncmp(at - 9, "Possible ", 9)) ++at;
    if (!at) continue;
    /* The message starts where its first line, not a continuation, starts. */
    while (at > log && !(at[-1] == '\n' && *at != ' ')) --at;
    join_message(at, message, sizeof message);
  }
  free(log);
  if (!message[0])
    return result_fail(error, RESULT_IO, "POV-Ray failed without a message; its log is %s/log",
                       job->directory);
  return result_fail(error, RESULT_BAD, "POV-Ray: %s", message);
}

enum result povray_finish(const struct povray_job *job, int status, struct error *error) {
  int end = process_exit(status), number = end - PROCESS_SIGNAL;
  if (number > 0)
    return result_fail(error, RESULT_IO,
                       "POV-Ray was killed by signal %d (%s); was memory or disk short?", number,
                       strsignal(number));
  if (end == 2) return result_fail(error, RESULT_STOPPED, "POV-Ray was interrupted");
  return end == 0 ? RESULT_OK : report_log(job, error);
}

enum result povray_run(const struct povray *povray, const struct povray_job *job,
                       struct error *error) {
  pid_t pid, ended;
  enum result result = povray_start(povray, job, &pid, error);
  if (result != RESULT_OK) return result;
  int status = 0;
  bool stopped = false;
  while ((ended = waitpid(pid, &status, WNOHANG)) != pid) {
    if (ended < 0 && errno != EINTR)
      return result_fail(error, RESULT_IO, "waitpid: %s", strerror(errno));
    if (job->stop && *job->stop && !stopped) {
      stopped = true;
      kill(pid, SIGKILL);
    }
    nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
  }
  if (stopped) return result_fail(error, RESULT_STOPPED, "interrupted");
  return povray_finish(job, status, error);
}

double povray_progress(const struct povray_job *job) {
  char path[4200], tail[2048];
  snprintf(path, sizeof path, "%s/log", job->directory);
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  off_t end = lseek(file, 0, SEEK_END);
  off_t from = end > (off_t)sizeof tail - 1 ? end - (off_t)sizeof tail + 1 : 0;
  ssize_t n = pread(file, tail, sizeof tail - 1, from);
  close(file);
  if (n <= 0) return 0;
  tail[n] = 0;
  /* A still counts pixels; an animation counts frames and is done when it ends. */
  const char *format = job->frames > 1 ? "Rendering frame %lf of %lf" : "Rendered %lf of %lf";
  double done = 0, all = 0, part = 0;
  for (const char *at = tail; (at = strstr(at, "Render")); ++at)
    if (sscanf(at, format, &done, &all) == 2 && all > 0)
      part = (job->frames > 1 ? done - 1 : done) / all;
  return part;
}

double povray_statistic(const char *directory, const char *label) {
  char *log = files_read(directory, "log");
  const char *at = log ? strstr(log, label) : NULL;
  double value = at ? strtod(at + strlen(label), NULL) : -1;
  free(log);
  return value;
}

enum result povray_read_frame(const struct povray_job *job, int frame, struct picture *picture,
                              struct error *error) {
  char path[4200];
  if (job->frames > 1) {
    int digits = snprintf(NULL, 0, "%d", job->frames);
    snprintf(path, sizeof path, "%s/frame%0*d.exr", job->directory, digits, frame + 1);
  } else {
    snprintf(path, sizeof path, "%s/frame.exr", job->directory);
  }
  enum result result = slab_exr_read(path, picture, error);
  if (result != RESULT_OK) return result;
  if (picture->width == job->width && picture->height == job->height) return RESULT_OK;
  picture_free(picture);
  return result_fail(error, RESULT_BAD, "%s: is not the %d x %d picture that was asked for", path,
                     job->width, job->height);
}
