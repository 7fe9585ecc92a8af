/* sandbox.c - see sandbox.h; bwrap(1). */
#include "povray/sandbox.h"

#include <stddef.h>

#include "base/process.h"

static const char *const walls[] = {"bwrap", "--unshare-all", "--die-with-parent", "--new-session",
                                    NULL};
static const char *const folders[] = {"--ro-bind", "/",      "/",     "--dev",
                                      "/dev",      "--proc", "/proc", NULL};
/* Removable disks are there too, perhaps with the lamp. */
static const char *const run[] = {"--tmpfs",    "/run",       "--ro-bind-try",
                                  "/run/media", "/run/media", NULL};

static size_t add(const char *const *list, const char **words, size_t count) {
  for (; *list; ++list) words[count++] = *list;
  return count;
}

void sandbox_command(const char *const *program, const char *folder, const char *const *environment,
                     const char *words[SANDBOX_WORDS]) {
  const char *const place[] = {"--bind", folder, folder, "--chdir", folder, NULL};
  size_t count = add(run, words, add(folders, words, add(walls, words, 0)));
  count = add(place, words, count);
  for (; environment && *environment; environment += 2) {
    const char *const set[] = {"--setenv", environment[0], environment[1], NULL};
    const char *const unset[] = {"--unsetenv", environment[0], NULL};
    count = add(*environment[1] ? set : unset, words, count);
  }
  words[count++] = "--";
  words[add(program, words, count)] = NULL;
}

enum result sandbox_check(struct error *error) {
  static const char *const program[] = {"true", NULL};
  const char *words[SANDBOX_WORDS];
  struct process process = {
      .words = words, .in = PROCESS_NOTHING, .out = PROCESS_SAID, .errors = PROCESS_SAID};
  struct error why;
  sandbox_command(program, "/tmp", NULL, words);
  if (process_run(&process, &why) == RESULT_OK) return RESULT_OK;
  if (process.exit == PROCESS_MISSING)
    return result_fail(error, RESULT_IO,
                       "--sandbox: %s; install bubblewrap (Debian: apt install bubblewrap)",
                       why.text);
  return result_fail(error, RESULT_IO,
                     "--sandbox: bubblewrap cannot make one here, as in some containers (%s)",
                     why.text);
}
