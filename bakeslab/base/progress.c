#include "base/progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

enum { BAR = 30 };

double progress_now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
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
  if (progress->shown) fputs("\r\033[K", stderr);
  progress->shown = false;
}
