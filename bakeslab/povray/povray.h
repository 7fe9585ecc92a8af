/* povray.h - runs the stock POV-Ray, one process a folder, and reads what it
 * left there.
 *
 * A folder holds scene.pov, written by the caller, and gets render.ini, log and
 * the frames: frame.exr, or frame1.exr ... (zero-padded) for an animation. The
 * process runs in the folder with one worker thread, which makes its pixels
 * repeatable; `cd FOLDER && povray render.ini` does it once more. Names inside
 * are relative and ASCII, since POV-Ray drops other characters from paths: files
 * from elsewhere come in by symbolic links.
 *
 * No settings of the user's reach it, but the system's povray.ini, which says where its own
 * includes are. It gets 8 GiB of memory (less on a small machine), and files of 256 MiB.
 *
 * POV-Ray's exit status alone is not trusted: frames are decoded before use. */
#ifndef POVRAY_H
#define POVRAY_H

#include <signal.h>
#include <stdbool.h>
#include <sys/types.h>

#include "base/picture.h"
#include "base/result.h"

struct povray {
  char program[4096];
  char version[64]; /* such as "3.7.0.10.unofficial" */
  bool sandbox;     /* set by the caller: runs it in one (sandbox.h) */
};

enum { POVRAY_ENVIRONMENT = 6 };

struct povray_job {
  const char *directory;
  int width, height;
  int frames;                        /* 1: a still */
  const char *const *library;        /* Library_Path entries, NULL-terminated */
  const char *const *environment;    /* as in struct process (base/process.h), at most
                                        POVRAY_ENVIRONMENT words; or NULL */
  const volatile sig_atomic_t *stop; /* set by a signal handler: povray_run ends; or NULL */
};

/* Asks the program for its version (`stop` as in struct povray_job); refuses what is not
 * POV-Ray 3.7 or 3.8. */
enum result povray_find(const char *program, const volatile sig_atomic_t *stop,
                        struct povray *povray, struct error *error);

/* Writes render.ini and starts the process. It dies with its parent. */
enum result povray_start(const struct povray *povray, const struct povray_job *job, pid_t *pid,
                         struct error *error);

/* Ends a process, and what a wrapper has started. To be waited for. */
void povray_kill(pid_t pid);

/* Judges a process that has ended with `status` (of waitpid): RESULT_OK, or
 * POV-Ray's own error line, in which "scene.pov" and link names are kept. */
enum result povray_finish(const struct povray_job *job, int status, struct error *error);

/* Whether a job that failed had not begun, and may be started again: `times` counts how often, and
 * there is an end to it. */
bool povray_is_late(const struct povray_job *job, int *times);

/* Runs a job and waits for it. */
enum result povray_run(const struct povray *povray, const struct povray_job *job,
                       struct error *error);

/* Part of a running job that is rendered, by its log. */
double povray_progress(const struct povray_job *job);

/* Reads a frame (0-based) and checks its size. The caller frees the picture. */
enum result povray_read_frame(const struct povray_job *job, int frame, struct picture *picture,
                              struct error *error);

#endif
