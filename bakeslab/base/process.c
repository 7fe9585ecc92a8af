#include "base/process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* A descriptor for a stream of struct process that none of the standard ones overwrites. */
static int lift(int stream, int said) {
  if (stream == PROCESS_SAID) stream = said;
  if (stream == PROCESS_NOTHING) stream = open("/dev/null", O_RDWR | O_CLOEXEC);
  return fcntl(stream, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
}

static void limit(__rlimit_resource_t what, size_t most) {
  struct rlimit now;
  if (most == 0 || getrlimit(what, &now) != 0 || now.rlim_max <= most) return;
  setrlimit(what, &(struct rlimit){most, most});
}

/* In the child: never returns. */
static void become(const struct process *process, int said, pid_t parent) {
  const char *const *words = process->words, *const *variable = process->environment;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(PROCESS_MISSING);
  setpgid(0, 0);
  signal(SIGPIPE, SIG_DFL);
  for (; variable && *variable; variable += 2)
    if (*variable[1])
      setenv(variable[0], variable[1], 1);
    else
      unsetenv(variable[0]);
  int in = lift(process->in, said), out = lift(process->out, said),
      errors = lift(process->errors, said);
  if (dup2(errors, STDERR_FILENO) >= 0 && dup2(in, STDIN_FILENO) >= 0 &&
      dup2(out, STDOUT_FILENO) >= 0 && (!process->folder || chdir(process->folder) == 0)) {
    limit(RLIMIT_FSIZE, process->most_written);
    limit(RLIMIT_AS, process->most_memory);
    execvp(words[0], (char *const *)(uintptr_t)words); /* which does not change them */
  }
  dprintf(STDERR_FILENO, "%s: cannot be run (%s)\n", words[0], strerror(errno));
  _exit(PROCESS_MISSING);
}

enum result process_start(struct process *process, struct error *error) {
  int ends[2] = {-1, -1};
  bool kept = process->out == PROCESS_SAID || process->errors == PROCESS_SAID;
  pid_t parent = getpid();
  /* neither end waits for the other */
  if (kept && pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
    return result_fail(error, RESULT_IO, "pipe: %s", strerror(errno));
  process->pid = fork();
  if (process->pid == 0) become(process, ends[1], parent);
  int why = errno;
  process->said_end = ends[0];
  if (kept) close(ends[1]);
  if (process->pid > 0) return RESULT_OK;
  if (kept) close(ends[0]);
  return result_fail(error, RESULT_IO, "fork: %s", strerror(why));
}

enum result process_wait(struct process *process, struct error *error) {
  const char *name = process->words[0], *said = process->said;
  int status = 0;
  enum result result = process_await(process->pid, process->stop, &status, error);
  process->exit = process_exit(status);
  ssize_t got = read(process->said_end, process->said, sizeof process->said - 1);
  process->said[got > 0 ? got : 0] = 0;
  if (process->said_end >= 0) close(process->said_end);
  if (result != RESULT_OK) return result;
  int number = process->exit - PROCESS_SIGNAL;
  if (process->exit == 0) return RESULT_OK;
  if (number > 0)
    return result_fail(error, RESULT_IO, "%s was killed by signal %d (%s)", name, number,
                       strsignal(number));
  said += strspn(said, " \t\r\n^");
  if (*said) return result_fail(error, RESULT_IO, "%.*s", (int)strcspn(said, "\n"), said);
  return result_fail(error, RESULT_IO, "%s failed with exit status %d", name, process->exit);
}

enum result process_run(struct process *process, struct error *error) {
  enum result result = process_start(process, error);
  return result == RESULT_OK ? process_wait(process, error) : result;
}

void process_kill(pid_t pid) {
  kill(-pid, SIGKILL); /* not there yet where it has just been started */
  kill(pid, SIGKILL);
}

enum result process_await(pid_t pid, const volatile sig_atomic_t *stop, int *status,
                          struct error *error) {
  bool stopped = false;
  pid_t ended;
  while ((ended = waitpid(pid, status, stop ? WNOHANG : 0)) != pid) {
    if (ended < 0 && errno != EINTR)
      return result_fail(error, RESULT_IO, "waitpid: %s", strerror(errno));
    if (stop && *stop && !stopped) {
      stopped = true;
      process_kill(pid);
    }
    if (stop) nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
  }
  return stopped ? result_fail(error, RESULT_STOPPED, "interrupted") : RESULT_OK;
}

int process_exit(int status) {
  return WIFSIGNALED(status) ? PROCESS_SIGNAL + WTERMSIG(status) : WEXITSTATUS(status);
}
