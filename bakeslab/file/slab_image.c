/* slab_image.c - see slab_image.h. OpenImageIO is 261 libraries, so its oiiotool reads the
 * images, run as a program of its own, and hands over an EXR file. */
#include "file/slab_image.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

#include "file/slab_exr.h"

enum { EXEC_FAILED = 127 };

/* A scratch folder: in.SUFFIX (oiiotool takes # and % in names for patterns, so it never sees
 * the file's own), out.exr, and what oiiotool said. */
struct scratch {
  char folder[512];
  char in[32];
};

static const char LETTERS[] = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
static const char OUT[] = "out.exr", SAID[] = "said", ERRORS[] = "errors";

static void scratch_path(const struct scratch *scratch, const char *name, char path[600]) {
  snprintf(path, 600, "%s/%s", scratch->folder, name);
}

/* An oiiotool that was killed leaves files under names of its own. */
static void scratch_remove(const struct scratch *scratch) {
  DIR *folder = opendir(scratch->folder);
  const struct dirent *entry;
  while (folder && (entry = readdir(folder)))
    unlinkat(dirfd(folder), entry->d_name, 0); /* neither . nor .. goes */
  if (folder) closedir(folder);
  rmdir(scratch->folder);
}

static bool write_bytes(const char *path, const void *bytes, size_t size) {
  FILE *file = fopen(path, "wxe");
  if (!file) return false;
  bool good = fwrite(bytes, 1, size, file) == size;
  return fclose(file) == 0 && good;
}

/* *made tells whether the folder is there, also after a failure. */
static enum result scratch_make(struct scratch *scratch, const char *name, const void *bytes,
                                size_t size, const char *suffix, bool *made, struct error *error) {
  const char *temporary = getenv("TMPDIR");
  char path[600];
  *made = false;
  snprintf(scratch->in, sizeof scratch->in, "in.%.*s", (int)strspn(suffix, LETTERS), suffix);
  int length = snprintf(scratch->folder, sizeof scratch->folder, "%s/slab-image-XXXXXX",
                        temporary && temporary[0] ? temporary : "/tmp");
  if (length >= (int)sizeof scratch->folder || !mkdtemp(scratch->folder))
    return result_fail(error, RESULT_IO, "%s: %s", scratch->folder, strerror(errno));
  *made = true;
  scratch_path(scratch, scratch->in, path);
  if (bytes) {
    if (!write_bytes(path, bytes, size))
      return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
    return RESULT_OK;
  }
  char *absolute = realpath(name, NULL);
  bool good = absolute && access(absolute, R_OK) == 0 && symlink(absolute, path) == 0;
  int failure = errno;
  free(absolute);
  return good ? RESULT_OK : result_fail(error, RESULT_IO, "%s: %s", name, strerror(failure));
}

/* In the child: never returns. */
static void become_oiiotool(const struct scratch *scratch) {
  if (chdir(scratch->folder) != 0) _exit(EXEC_FAILED);
  int none = open("/dev/null", O_RDONLY | O_CLOEXEC);
  int said = open(SAID, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  int errors = open(ERRORS, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (none < 0 || said < 0 || errors < 0) _exit(EXEC_FAILED);
  dup2(none, STDIN_FILENO);
  dup2(said, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  /* colours as they are in the file, not multiplied by alpha; the first three channels,
   * or the first for all three; the least alpha, and what the numbers mean */
  execlp("oiiotool", "oiiotool", "--native", "--iconfig", "oiio:UnassociatedAlpha", "1",
         scratch->in, "--if", "{TOP.alpha_channel >= 0}", "--dup", "--ch", "{TOP.alpha_channel}",
         "--echo:newline=0", "{TOP.MINCOLOR} ", "--pop", "--else", "--echo:newline=0", "1 ",
         "--endif", "--echo", "{TOP.format} {TOP['oiio:ColorSpace']}", "--if",
         "{TOP.nchannels < 3}", "--ch", "0,0,0", "--else", "--ch", "0,1,2", "--endif", "--chnames",
         "R,G,B", "-d", "float", "--compression", "none", "-o", OUT, (char *)NULL);
  _exit(EXEC_FAILED);
}

/* The first line of a file in the folder; "" where there is none. */
static void first_line(const struct scratch *scratch, const char *name, char line[512]) {
  char path[600];
  scratch_path(scratch, name, path);
  FILE *file = fopen(path, "re");
  if (!file || !fgets(line, 512, file)) line[0] = 0;
  if (file) fclose(file);
  line[strcspn(line, "\n")] = 0;
}

static enum result run(const struct scratch *scratch, const char *name, struct error *error) {
  pid_t pid = fork();
  if (pid < 0) return result_fail(error, RESULT_IO, "fork: %s", strerror(errno));
  if (pid == 0) become_oiiotool(scratch);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) return result_fail(error, RESULT_IO, "oiiotool: %s", strerror(errno));
  if (WIFEXITED(status) && WEXITSTATUS(status) == EXEC_FAILED)
    return result_fail(error, RESULT_IO,
                       "%s: oiiotool, which reads images, cannot be run; install it (Debian: apt "
                       "install openimageio-tools)",
                       name);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return RESULT_OK;
  char message[512];
  first_line(scratch, ERRORS, message);
  if (WIFSIGNALED(status))
    snprintf(message, sizeof message, "oiiotool was killed by signal %d", WTERMSIG(status));
  return result_fail(error, RESULT_BAD, "%s: is no image that can be read: %s", name, message);
}

/* Floating-point files hold light; others are sRGB unless they say that they are linear. */
static bool is_linear(const char *said) {
  static const char *const linear[] = {"half ", "float ", "double "};
  for (size_t k = 0; k < sizeof linear / sizeof *linear; ++k)
    if (strncmp(said, linear[k], strlen(linear[k])) == 0) return true;
  const char *space = strchr(said, ' ');
  return space &&
         (strcasecmp(space + 1, "linear") == 0 || strcasecmp(space + 1, "scene_linear") == 0);
}

static enum result decode(const char *name, const char *said, struct picture *picture,
                          struct error *error) {
  size_t count = 3 * (size_t)picture->width * (size_t)picture->height;
  bool linear = is_linear(said);
  for (size_t k = 0; k < count; ++k) {
    double x = (double)picture->rgb[k];
    if (!(x >= 0) || !isfinite(x))
      return result_fail(error, RESULT_BAD,
                         "%s: column %zu, row %zu holds a value that is negative or not finite",
                         name, k / 3 % (size_t)picture->width, k / 3 / (size_t)picture->width);
    if (linear) continue;
    picture->rgb[k] = (float)(x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4));
  }
  return RESULT_OK;
}

enum result slab_image_read(const char *path, const void *bytes, size_t size, const char *suffix,
                            struct picture *picture, bool *transparent, struct error *error) {
  struct scratch scratch = {"", ""};
  struct error inner = {""};
  const char *dot = strrchr(path, '.');
  char out[600], said[512], *meaning = said;
  bool made;
  *picture = (struct picture){0};
  if (!suffix) suffix = dot ? dot + 1 : "";
  enum result result = scratch_make(&scratch, path, bytes, size, suffix, &made, error);
  if (result == RESULT_OK) result = run(&scratch, path, error);
  if (result == RESULT_OK) {
    scratch_path(&scratch, OUT, out);
    result = slab_exr_read(out, picture, &inner);
    if (result != RESULT_OK)
      result_fail(error, result, "%s: oiiotool's copy: %s", path, inner.text);
  }
  if (result == RESULT_OK) {
    first_line(&scratch, SAID, said);
    double alpha = strtod(said, &meaning);
    if (transparent) *transparent = !(alpha >= 1);
    result = decode(path, meaning + strspn(meaning, " "), picture, error);
  }
  if (made) scratch_remove(&scratch);
  if (result != RESULT_OK) picture_free(picture);
  return result;
}
