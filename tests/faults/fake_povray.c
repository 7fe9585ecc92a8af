/* fake_povray.c - stands in for POV-Ray where a test bakes some thousand times: frames of the
 * size that render.ini asks for, whose pixels follow from the scene's text, so that a frame of
 * another scene is noticed. It reads the lamp script, as the bake checks, and declares one slab.
 * FAKE_SECONDS: how long a scene takes; FAKE_LOG: a file that gets a line for each, its width and
 * height; FAKE_VERSION: instead of 3.7.0.fake. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
#include <xxhash.h>

#include "file/slab_exr.h"

static const char declared[] = "lamp fake\nneeds \nslab\ncenter 0 0 0 0 0 0\nu 0.5 2 0 0 0 0\n"
                               "v 0 0 0.5 2 0 0\nnormal 0 0 0 0 0.5 1\ns -0.5 1 0.5 1\n"
                               "t -0.5 1 0.5 1\ndistance 0 0\n";

/* A file's text, which the caller frees; an empty one where there is none. */
static char *read_text(const char *path) {
  char *text = NULL;
  size_t size = 0;
  FILE *file = fopen(path, "r");
  if (!file || getdelim(&text, &size, 0, file) < 0) {
    free(text);
    text = calloc(1, 1);
  }
  if (file) fclose(file);
  return text;
}

static int number_after(const char *text, const char *key, int otherwise) {
  const char *at = strstr(text, key);
  return at ? atoi(at + strlen(key)) : otherwise;
}

/* A marker row, as canned_bake.inc paints it, in the trial run's picture two rows that are alike,
 * since there is no haze, then radiance up to 1. */
static void paint(struct picture *picture, uint64_t seed) {
  enum { TRIAL_SIDE = 16 };
  size_t row = 3 * (size_t)picture->width, count = row * (size_t)picture->height;
  size_t alike = picture->width == TRIAL_SIDE ? 3 * row : row;
  for (size_t k = 0; k < count; ++k)
    picture->rgb[k] = k < row     ? 5
                      : k < alike ? 0.25f
                                  : (float)(XXH64(&k, sizeof k, seed) % 1024) / 1024;
}

/* By the kernel's call: what a script writes by the C library's is noticed. */
static void log_work(const struct picture *picture) {
  const char *path = getenv("FAKE_LOG");
  if (!path) return;
  int file = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND, 0666);
  dprintf(file, "%d %d\n", picture->width, picture->height);
  close(file);
}

int main(int argc, char **argv) {
  if (argc > 1 && !strcmp(argv[1], "--version")) {
    const char *version = getenv("FAKE_VERSION");
    fprintf(stderr, "POV-Ray %s\n", version ? version : "3.7.0.fake");
    return 0;
  }
  char *ini = read_text("render.ini"), *scene = read_text("scene.pov");
  free(read_text("canned-lamp.pov"));
  struct picture picture = {.width = number_after(ini, "\nWidth=", 1),
                            .height = number_after(ini, "\nHeight=", 1)};
  int frames = number_after(ini, "Final_Frame=", 1), failed = 0;
  const char *seconds = getenv("FAKE_SECONDS");
  double wait = seconds ? atof(seconds) : 0;
  nanosleep(&(struct timespec){(time_t)wait, (long)(1e9 * (wait - (double)(time_t)wait))}, NULL);
  picture.rgb = calloc(3 * (size_t)picture.width * (size_t)picture.height, sizeof *picture.rgb);
  for (int frame = 1; frame <= frames && picture.rgb; ++frame) {
    char name[64];
    int digits = snprintf(NULL, 0, "%d", frames);
    struct error error = {{0}};
    paint(&picture, XXH64(scene, strlen(scene), (uint64_t)frame));
    snprintf(name, sizeof name, "frame%0*d.exr", digits, frame);
    if (slab_exr_write(frames > 1 ? name : "frame.exr", &picture, 0, NULL, &error)) failed = 1;
    if (failed) fprintf(stderr, "Fatal error: %s\n", error.text);
  }
  if (strstr(scene, "declared.txt")) {
    FILE *out = fopen("declared.txt", "w");
    failed |= !out || fputs(declared, out) < 0;
    if (out) failed |= fclose(out) != 0;
  }
  log_work(&picture);
  picture_free(&picture);
  free(ini);
  free(scene);
  return failed;
}
