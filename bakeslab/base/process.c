/* process.c - see process.h. */
#include "base/process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* Makes `wanted` the standard stream `number`. */
static bool put_stream(int wanted, int said, int number) {
  int from = wanted == PROCESS_SAID ? said : wanted;
  if (wanted == PROCESS_NOTHING) from = open("/dev/null", O_RDWR | O_CLOEXEC);
  return from >= 0 && (from == number ? fcntl(from, F_SETFD, 0) : dup2(from, number)) >= 0;
}

/* In the child. Returns, with errno, only where the program cannot be run. */
static void become(const struct process *process, int said, pid_t parent) {
  const char *const *words = process->words, *const *variable = process->environment;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);
  setpgid(0, 0);
  signal(SIGPIPE, SIG_DFL);
  for (; variable && *variable; variable += 2) setenv(variable[0], variable[1], 1);
  if (put_stream(process->in, said, STDIN_FILENO) &&
      put_stream(process->out, said, STDOUT_FILENO) &&
      put_stream(process->errors, said, STDERR_FILENO) &&
      (!process->folder || chdir(process->folder) == 0))
    execvp(words[0], (char *const *)(uintptr_t)words); /* which does not change them */
}

static pid_t wait_for(pid_t pid, int *status) {
  pid_t ended;
  while ((ended = waitpid(pid, status, 0)) < 0 && errno == EINTR) continue;
  return ended;
}

/* Returns an errno where the program cannot be run, else 0. */
static int fork_off(struct process *process, int said) {
  int ends[2], why = 0; /* the child writes `why` where exec does not close this pipe */
  pid_t parent = getpid();
  if (pipe2(ends, O_CLOEXEC) != 0) return errno;
  process->pid = fork();
  if (process->pid == 0) {
    become(process, said, parent);
    why = errno;
    while (write(ends[1], &why, sizeof why) < 0 && errno == EINTR) continue;
    _exit(EXIT_FAILURE);
  }
  if (process->pid < 0) why = errno;
  close(ends[1]);
  while (process->pid > 0 && read(ends[0], &why, sizeof why) < 0 && errno == EINTR) continue;
  close(ends[0]);
  if (why && process->pid > 0) wait_for(process->pid, NULL);
  return why;
}

enum result process_start(struct process *process, struct error *error) {
  int ends[2] = {-1, -1}; /* neither waits for the other */
  bool kept = process->out == PROCESS_SAID || process->errors == PROCESS_SAID;
  int why = kept && pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0 ? errno : 0;
  process->said[0] = 0;
  process->said_end = ends[0];
  if (!why) why = fork_off(process, ends[1]);
  if (kept) close(ends[1]);
  if (!why) return RESULT_OK;
  if (kept) close(ends[0]);
  return result_fail(error, RESULT_IO, "%s: cannot be run (%s)", process->words[0], strerror(why));
}

enum result process_wait(struct process *process, struct error *error) {
  int status = 0;
  if (wait_for(process->pid, &status) < 0) status = EXIT_FAILURE << 8;
  ssize_t got = read(process->said_end, process->said, sizeof process->said - 1);
  process->said[got > 0 ? got : 0] = 0;
  if (process->said_end >= 0) close(process->said_end);
  return process_judge(process->words[0], status, process->said, error);
}

int process_signal(int status) {
  if (WIFSIGNALED(status)) return WTERMSIG(status);
  return WEXITSTATUS(status) > 128 ? WEXITSTATUS(status) - 128 : 0;
}

enum result process_judge(const char *name, int status, const char *said, struct error *error) {
  int number = process_signal(status);
  if (number)
    return result_fail(error, RESULT_IO, "%s was killed by signal %d (%s)", name, number,
                       strsignal(number));
  if (WEXITSTATUS(status) == 0) return RESULT_OK;
  said += strspn(said, " \t\r\n^");
  if (*said) return result_fail(error, RESULT_IO, "%.*s", (int)strcspn(said, "\n"), said);
  return result_fail(error, RESULT_IO, "%s failed with exit status %d", name, WEXITSTATUS(status));
}
