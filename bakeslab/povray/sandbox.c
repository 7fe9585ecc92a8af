/* sandbox.c - see sandbox.h; bwrap(1). */
#include "povray/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_THERE = 127, MOST_WORDS = 40 };

/* /run may have removable disks too, perhaps with the lamp. */
static const char *const walls[] = {"bwrap",
                                    "--unshare-all",
                                    "--die-with-parent",
                                    "--new-session",
                                    "--ro-bind",
                                    "/",
                                    "/",
                                    "--dev",
                                    "/dev",
                                    "--proc",
                                    "/proc",
                                    "--tmpfs",
                                    "/run",
                                    "--ro-bind-try",
                                    "/run/media",
                                    "/run/media"};

void sandbox_exec(const char *program, const char *argument, const char *preload) {
  char folder[PATH_MAX];
  const char *words[MOST_WORDS] = {NULL};
  size_t count = sizeof walls / sizeof *walls;
  if (!getcwd(folder, sizeof folder)) return;
  memcpy(words, walls, sizeof walls);
  const char *const rest[] = {"--bind", folder, folder, "--chdir", folder};
  for (size_t k = 0; k < sizeof rest / sizeof *rest; ++k) words[count++] = rest[k];
  if (preload) {
    words[count++] = "--setenv";
    words[count++] = "LD_PRELOAD";
    words[count++] = preload;
  }
  words[count++] = "--";
  words[count++] = program;
  words[count++] = argument;
  execvp(words[0], (char *const *)(uintptr_t)words); /* which does not change them */
}

/* What a try in a folder says, cut to one line. */
static void read_words(int from, char *text, size_t size) {
  size_t length = 0;
  ssize_t n;
  while (length + 1 < size && (n = read(from, text + length, size - 1 - length)) > 0)
    length += (size_t)n;
  text[length] = 0;
  text[strcspn(text, "\n")] = 0;
}

enum result sandbox_check(struct error *error) {
  int ends[2], status = 0;
  char said[512];
  if (pipe2(ends, O_CLOEXEC) != 0)
    return result_fail(error, RESULT_IO, "pipe: %s", strerror(errno));
  pid_t pid = fork();
  if (pid == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    if (chdir("/tmp") == 0) sandbox_exec("true", NULL, NULL);
    _exit(NOT_THERE);
  }
  close(ends[1]);
  read_words(ends[0], said, sizeof said);
  close(ends[0]);
  while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
  if (pid < 0) return result_fail(error, RESULT_IO, "fork: %s", strerror(errno));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return RESULT_OK;
  if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_THERE)
    return result_fail(error, RESULT_IO,
                       "--sandbox: bwrap cannot be run; install bubblewrap (Debian: apt install "
                       "bubblewrap)");
  return result_fail(error, RESULT_IO,
                     "--sandbox: bubblewrap cannot make one here, as in some containers (%s)",
                     said);
}
