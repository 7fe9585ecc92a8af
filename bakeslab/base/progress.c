#include "base/progress.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { BAR = 30 };

/* A terminal has one line for a bar: while one is drawn, others wait for its end. */
static atomic_flag drawing = ATOMIC_FLAG_INIT;

double progress_now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

double progress_process_start(void) {
  /* The 22nd field of /proc/self/stat, in ticks since the machine began: the 20th after the name,
   * which ends with the last parenthesis. */
  char text[1024] = "";
  double now = progress_now(), age = 0;
  struct timespec time;
  FILE *file = fopen("/proc/self/stat", "re");
  size_t length = file ? fread(text, 1, sizeof text - 1, file) : 0;
  const char *at = length > 0 ? strrchr(text, ')') : NULL;
  for (int field = 0; field < 20 && at; ++field) at = strchr(at + 1, ' ');
  if (at && clock_gettime(CLOCK_BOOTTIME, &time) == 0)
    age = (double)time.tv_sec + 1e-9 * (double)time.tv_nsec -
          (strtod(at, NULL) + 0.5) / (double)sysconf(_SC_CLK_TCK);
  if (file) fclose(file);
  return age > 0 && age < 60 ? now - age : now;
}

void progress_start(struct progress *progress, bool quiet, double part) {
  *progress = (struct progress){
      .shown = !quiet && isatty(STDERR_FILENO), .start = progress_now(), .start_part = part};
}

static void print_time(double seconds) {
  int s = (int)(seconds + 0.5);
  if (s < 3600)
    fprintf(stderr, "%d:%02d left", s / 60, s % 60);
  else
    fprintf(stderr, "%d h %02d min left", s / 3600, s / 60 % 60);
}

void progress_show(struct progress *progress, double part, const char *label) {
  double time = progress_now();
  if (!progress->shown || time - progress->drawn < 0.2) return;
  if (!progress->draws && atomic_flag_test_and_set(&drawing)) return;
  progress->draws = true;
  progress->drawn = time;
  int filled = (int)(part * BAR);
  fprintf(stderr, "\r%s [", label);
  for (int n = 0; n < BAR; ++n) fputc(n < filled ? '#' : '.', stderr);
  fprintf(stderr, "] %3.0f %%  ", 100 * part);
  double done = part - progress->start_part;
  if (done > 0.01) print_time((time - progress->start) / done * (1 - part));
  fputs("\033[K", stderr);
}

void progress_end(struct progress *progress) {
  if (progress->draws) {
    fputs("\r\033[K", stderr);
    atomic_flag_clear(&drawing);
  }
  progress->shown = progress->draws = false;
}
