/* slab_image.c - see slab_image.h and image/bakeslab-image.cc, the program that does the work. */
#include "file/slab_image.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"

static const char PROGRAM[] = "lib/canned/bakeslab-image";
static const char LETTERS[] = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/* Reads what the program writes; where that breaks off, the program's own words say why. */
static enum result take(FILE *from, struct picture *picture, struct slab_image_says *says,
                        struct error *error) {
  int transparent = 0, several = 0, integers = 0;
  result_fail(error, RESULT_IO, "%s broke off", PROGRAM);
  if (fscanf(from, "%d %d %d %d %d %lf", &picture->width, &picture->height, &transparent, &several,
             &integers, &says->pixel_aspect) != 6 ||
      getc(from) != '\n')
    return RESULT_IO;
  says->transparent = transparent;
  says->several = several;
  says->integers = integers;
  size_t count = (size_t)picture->width * (size_t)picture->height, pixel = 3 * sizeof(float);
  picture->rgb = calloc(count, pixel);
  if (!picture->rgb)
    return result_fail(error, RESULT_MEMORY, "out of memory for %d x %d pixels", picture->width,
                       picture->height);
  return fread(picture->rgb, pixel, count, from) == count ? RESULT_OK : RESULT_IO;
}

static enum result start(struct slab_images *images, struct error *error) {
  int requests[2], answers[2];
  char *program = files_beside_program(PROGRAM);
  if (!program)
    return result_fail(error, RESULT_IO,
                       "%s, which reads images, is not where this program was installed; run "
                       "`make` or `make install` again",
                       PROGRAM);
  *images = (struct slab_images){.program = program, .words = {program}, .requests = -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, requests) != 0)
    return result_fail(error, RESULT_IO, "socketpair: %s", strerror(errno));
  images->requests = requests[0];
  enum result result = RESULT_OK;
  if (pipe2(answers, O_CLOEXEC) != 0) {
    result = result_fail(error, RESULT_IO, "pipe: %s", strerror(errno));
  } else {
    images->process = (struct process){
        .words = images->words, .in = requests[1], .out = answers[1], .errors = PROCESS_SAID};
    images->answers = fdopen(answers[0], "r");
    result = images->answers ? process_start(&images->process, error) : result_no_memory(error);
    if (!images->answers) close(answers[0]);
    close(answers[1]);
  }
  close(requests[1]);
  return result;
}

/* Hands the program an open file, and a line of what to take it for. */
static enum result ask(const struct slab_images *images, const char *suffix,
                       enum slab_image_colours colours, int in, struct error *error) {
  char line[32];
  union {
    char bytes[CMSG_SPACE(sizeof in)];
    struct cmsghdr header;
  } control = {{0}};
  snprintf(line, sizeof line, "%s %.*s", colours == SLAB_IMAGE_OWN ? "own" : "srgb",
           (int)strspn(suffix, LETTERS), suffix);
  struct iovec text = {line, strlen(line)};
  struct msghdr message = {.msg_iov = &text,
                           .msg_iovlen = 1,
                           .msg_control = control.bytes,
                           .msg_controllen = sizeof control.bytes};
  control.header.cmsg_level = SOL_SOCKET;
  control.header.cmsg_type = SCM_RIGHTS;
  control.header.cmsg_len = CMSG_LEN(sizeof in);
  memcpy(CMSG_DATA(&control.header), &in, sizeof in);
  if (sendmsg(images->requests, &message, MSG_NOSIGNAL) >= 0) return RESULT_OK;
  return result_fail(error, RESULT_IO, "%s broke off", PROGRAM);
}

/* Ends the program, which reads on until there are no more requests. Where it failed, its own words
 * say why. */
static enum result end(struct slab_images *images, struct error *error) {
  enum result result = RESULT_OK;
  if (images->requests >= 0) close(images->requests);
  if (images->answers) fclose(images->answers);
  if (images->process.pid > 0) result = process_wait(&images->process, error);
  free(images->program);
  *images = (struct slab_images){0};
  return result;
}

/* A file that can be sought in. Nothing waits for a pipe's other end. */
static enum result open_file(const char *path, int *fd, struct error *error) {
  struct stat status;
  *fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (*fd < 0 || fstat(*fd, &status) != 0)
    return result_fail(error, RESULT_IO, "%s", strerror(errno));
  if (S_ISREG(status.st_mode)) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "is not a file");
}

static enum result keep_bytes(const void *bytes, size_t size, int *fd, struct error *error) {
  *fd = memfd_create("image", MFD_CLOEXEC);
  size_t done = 0;
  while (*fd >= 0 && done < size) {
    ssize_t put = write(*fd, (const char *)bytes + done, size - done);
    if (put < 0) break;
    done += (size_t)put;
  }
  if (*fd >= 0 && done == size) return RESULT_OK;
  return result_fail(error, RESULT_IO, "%s", strerror(errno));
}

enum result slab_images_read(struct slab_images *images, const char *path, const void *bytes,
                             size_t size, const char *suffix, enum slab_image_colours colours,
                             struct picture *picture, struct slab_image_says *says,
                             struct error *error) {
  const char *dot = strrchr(path, '.');
  struct slab_image_says unasked;
  int in = -1;
  *picture = (struct picture){0};
  if (!suffix) suffix = dot ? dot + 1 : "";
  enum result result = bytes ? keep_bytes(bytes, size, &in, error) : open_file(path, &in, error);
  if (result == RESULT_OK && !images->program) result = start(images, error);
  if (result == RESULT_OK) {
    result = ask(images, suffix, colours, in, error);
    if (result == RESULT_OK) result = take(images->answers, picture, says ? says : &unasked, error);
    if (result != RESULT_OK && end(images, result == RESULT_MEMORY ? NULL : error) != RESULT_OK &&
        result != RESULT_MEMORY)
      result = RESULT_BAD;
  }
  if (result != RESULT_OK) picture_free(picture);
  if (in >= 0) close(in);
  return result_at(result, error, "%s", path);
}

void slab_images_close(struct slab_images *images) {
  if (images->program) end(images, NULL);
}

enum result slab_image_read(const char *path, const void *bytes, size_t size, const char *suffix,
                            enum slab_image_colours colours, struct picture *picture,
                            struct slab_image_says *says, struct error *error) {
  struct slab_images images = {0};
  enum result result =
      slab_images_read(&images, path, bytes, size, suffix, colours, picture, says, error);
  slab_images_close(&images);
  return result;
}
