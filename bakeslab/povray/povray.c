#include "povray/povray.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/files.h"
#include "base/process.h"
#include "file/slab_exr.h"
#include "povray/povray_log.h"
#include "povray/sandbox.h"

enum { STARTS = 3 }; /* of a POV-Ray whose threads start late (povray_log.h) */

/* Runs `program --version`; what it says is left in process->said. */
static enum result ask_version(const char *program, struct process *process, struct error *error) {
  const char *const words[] = {program, "--version", NULL};
  process->words = words;
  process->in = PROCESS_NOTHING;
  process->out = process->errors = PROCESS_SAID;
  enum result result = RESULT_IO;
  for (int k = 0; k < STARTS && result == RESULT_IO && process->exit != PROCESS_MISSING; ++k)
    result = process_run(process, error);
  process->words = NULL;
  return result;
}

enum result povray_find(const char *program, const volatile sig_atomic_t *stop,
                        struct povray *povray, struct error *error) {
  static const char product[] = "POV-Ray ";
  *povray = (struct povray){0};
  if (strlen(program) >= sizeof povray->program)
    return result_fail(error, RESULT_BAD, "%s: path too long", program);
  strcpy(povray->program, program);
  /* A path from here is none from the folders where POV-Ray is to run. */
  char *path = strchr(program, '/') ? realpath(program, NULL) : NULL;
  if (path && strlen(path) < sizeof povray->program) strcpy(povray->program, path);
  free(path);
  struct process process = {.stop = stop};
  struct error why;
  enum result result = ask_version(program, &process, &why);
  if (result == RESULT_STOPPED)
    return result_fail(error, result, "interrupted while %s was asked for its version", program);
  if (result != RESULT_OK && process.exit == PROCESS_MISSING)
    return result_fail(error, RESULT_IO,
                       "%s; install POV-Ray 3.7 (Debian: apt install povray) or name it with "
                       "--povray",
                       why.text);
  const char *at = strstr(process.said, "POV-Ray 3.");
  if (!at)
    return result_fail(error, RESULT_BAD,
                       "%s: does not say that it is POV-Ray 3.7%s%s%s; name another with --povray",
                       program, result != RESULT_OK ? " (" : "",
                       result != RESULT_OK ? why.text : "", result != RESULT_OK ? ")" : "");
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

/* What there is of memory and of file size for a POV-Ray, in bytes: far above the needs of a lamp,
 * so that one out of control ends before the machine is short. */
static size_t at_most(__rlimit_resource_t what, size_t most) {
  struct rlimit own;
  return getrlimit(what, &own) == 0 && own.rlim_max < most ? own.rlim_max : most;
}

static size_t most_written(void) {
  return at_most(RLIMIT_FSIZE, (size_t)256 << 20);
}

static size_t most_memory(void) {
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
  return 0; /* a stand-in for POV-Ray built like this maps terabytes */
#else
  size_t most = at_most(RLIMIT_AS, (size_t)8 << 30);
  size_t machine = (size_t)sysconf(_SC_PHYS_PAGES) / 4 * 3 * (size_t)sysconf(_SC_PAGE_SIZE);
  return machine < most ? machine : most;
#endif
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
          "Start_Column=1\nEnd_Column=%d\nStart_Row=1\nEnd_Row=%d\n"
          "Initial_Frame=1\nFinal_Frame=%d\nInitial_Clock=0\nFinal_Clock=0\n",
          job->width, job->height, job->width, job->height, job->frames);
  fputs("Display=off\nPause_When_Done=off\nVerbose=on\nAntialias=off\nQuality=9\nOutput_Alpha=off\n"
        "Grayscale_Output=off\n"
        "Debug_Console=off\nWork_Threads=1\nContinue_Trace=off\nRemove_Bounds=on\nBounding=on\n",
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
  /* Without them POV-Ray reads no povray.ini and povray.conf but the system's. */
  const char *environment[POVRAY_ENVIRONMENT + 5] = {"HOME", "", "POVINI", ""};
  for (int n = 0; job->environment && job->environment[n]; ++n)
    environment[4 + n] = job->environment[n];
  struct process process = {.words = program,
                            .environment = environment,
                            .folder = folder,
                            .in = PROCESS_NOTHING,
                            .most_memory = most_memory(),
                            .most_written = most_written()};
  if (povray->sandbox) {
    sandbox_command(program, folder, environment, words);
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

void povray_kill(pid_t pid) {
  process_kill(pid);
}

static enum result report_log(const struct povray_job *job, struct error *error) {
  char reason[900];
  povray_log_reason(job->directory, reason, sizeof reason);
  if (!reason[0])
    return result_fail(error, RESULT_IO, "POV-Ray failed without a message; its log is %s/log",
                       job->directory);
  /* Without memory the parser says so, or nothing but that it cannot parse. */
  if (strstr(reason, "std::bad_alloc") ||
      !strncmp(reason, "Fatal error in parser: Cannot parse", 35))
    return result_fail(error, RESULT_BAD, "POV-Ray needs more than %.2g GiB of memory (%s)",
                       (double)most_memory() / 0x1p30, reason);
  return result_fail(error, RESULT_BAD, "POV-Ray: %s", reason);
}

enum result povray_finish(const struct povray_job *job, int status, struct error *error) {
  int end = process_exit(status), number = end - PROCESS_SIGNAL;
  if (number == SIGXFSZ)
    return result_fail(error, RESULT_BAD,
                       "POV-Ray wrote a file of more than %zu MiB; does the script print or write "
                       "without end?",
                       most_written() >> 20);
  if (number > 0)
    return result_fail(error, RESULT_IO,
                       "POV-Ray was killed by signal %d (%s); was memory or disk short?", number,
                       strsignal(number));
  if (end == 2) return result_fail(error, RESULT_STOPPED, "POV-Ray was interrupted");
  return end == 0 ? RESULT_OK : report_log(job, error);
}

bool povray_is_late(const struct povray_job *job, int *times) {
  return ++*times < STARTS && povray_log_is_late(job->directory);
}

enum result povray_run(const struct povray *povray, const struct povray_job *job,
                       struct error *error) {
  for (int times = 0;;) {
    pid_t pid;
    int status = 0;
    enum result result = povray_start(povray, job, &pid, error);
    if (result == RESULT_OK) result = process_await(pid, job->stop, &status, error);
    if (result != RESULT_OK) return result;
    result = povray_finish(job, status, error);
    if (result != RESULT_BAD || !povray_is_late(job, &times)) return result;
  }
}

double povray_progress(const struct povray_job *job) {
  return povray_log_progress(job->directory, job->frames > 1);
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
