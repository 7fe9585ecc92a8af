/* mutants.c - slab files that were changed at random: every one is refused with a reason, or
 * read as a slab that is whole. No crash, no hang, and no more memory than a file of its size
 * may ask for.
 *
 *   mutants FIRST LAST FILE...
 *
 * Which file a mutant comes from and what is changed follow from its number, so that one that
 * failed can be made again alone.
 * Children do the reading, each many files, so that a crash costs one mutant. */
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "file/slab_file.h"
#include "oracle/random.h"

enum { LARGEST = 1 << 16, MOST_SAMPLES = 1 << 20, SECONDS = 20 };
static const rlim_t memory = (rlim_t)1 << 30;

struct base {
  unsigned char bytes[LARGEST];
  size_t size;
};

/* Shared with the children. */
struct tally {
  long reached; /* the mutant that is being read */
  long accepted, refused;
};

static uint64_t random_state;

static uint64_t draw(uint64_t below) {
  return random_bits(&random_state) % below;
}

/* One change; half of them in the first part, where the headers are. */
static size_t change(unsigned char *bytes, size_t size) {
  static const uint32_t extremes[] = {0, 1, 0x7f, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0xffffffff};
  size_t at = draw(2) ? draw(size) : draw(size < 512 ? size : 512);
  size_t other = draw(size), length = 1 + draw(16);
  if (at + length > size) length = size - at;
  if (other + length > size) other = size - length;
  uint32_t value = extremes[draw(sizeof extremes / sizeof *extremes)];
  switch (draw(6)) {
  case 0:
    bytes[at] ^= (unsigned char)(1 << draw(8));
    return size;
  case 1:
    bytes[at] = (unsigned char)draw(256);
    return size;
  case 2:
    memcpy(bytes + at, &value, length < 4 ? length : 4);
    return size;
  case 3: /* text: another digit */
    for (size_t k = at; k < size; ++k)
      if (bytes[k] >= '0' && bytes[k] <= '9') {
        bytes[k] = (unsigned char)"0123456789-.e"[draw(13)];
        break;
      }
    return size;
  case 4:
    memmove(bytes + at, bytes + other, length);
    return size;
  default:
    return draw(4) ? size : 1 + at;
  }
}

static size_t mutate(const struct base *bases, int count, long number, unsigned char *bytes) {
  random_state = (uint64_t)number;
  const struct base *base = &bases[draw((uint64_t)count)];
  size_t size = base->size;
  memcpy(bytes, base->bytes, size);
  for (uint64_t changes = 1 + draw(4); changes > 0; --changes) size = change(bytes, size);
  return size;
}

static void require(bool holds, const char *what) {
  if (holds) return;
  fprintf(stderr, "# does not hold: %s\n", what);
  abort();
}

/* What slab.h and slab_file.h promise of a page that was taken. */
static void use_page(struct slab_file *file, int page) {
  const struct slab *geometry = slab_file_page(file, page);
  struct error error = {{0}};
  struct slab slab;
  require(slab_check(geometry, &error) == RESULT_OK, "the geometry is checked");
  require(12.0 * (double)slab_sample_count(geometry) < (double)memory, "no 1 GB from some bytes");
  size_t view = (size_t)geometry->samples[SLAB_S] * (size_t)geometry->samples[SLAB_T];
  if (slab_sample_count(geometry) > MOST_SAMPLES) return;
  float *rgb = calloc(view, 3 * sizeof *rgb);
  if (slab_file_load(file, page, &slab, &error) == RESULT_OK) {
    double least = 0, most = 0, found[3];
    for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) {
      require(isfinite(slab.rgb[k]), "samples are finite");
      least = fmin(least, (double)slab.rgb[k]);
      most = fmax(most, (double)slab.rgb[k]);
    }
    require(slab_file_read_view(file, page, 0, 0, rgb, &error) == RESULT_OK, "views are as pages");
    for (int c = 0; c < 3; ++c)
      require(rgb[c] == slab_at(&slab, 0, 0, 0, 0)[c], "views hold the samples");
    slab_lookup(&slab, 0, 0, slab.st_window[0] / 2 + slab.st_window[1] / 2,
                slab.st_window[2] / 2 + slab.st_window[3] / 2, found);
    for (int c = 0; c < 3; ++c)
      require(found[c] >= least * 1.0001 && found[c] <= most * 1.0001, "a mean of samples");
    slab_flux(&slab, found, NULL);
    slab_free(&slab);
  } else {
    require(*error.text, "a refusal has a reason");
  }
  free(rgb);
}

static void use(const unsigned char *bytes, size_t size, struct tally *tally) {
  char path[64];
  struct slab_file *file;
  struct error error = {{0}};
  int fd = memfd_create("mutant", MFD_CLOEXEC);
  require(fd >= 0 && write(fd, bytes, size) == (ssize_t)size, "memory for the file");
  snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
  if (slab_file_open(path, &file, &error) == RESULT_OK) {
    ++tally->accepted;
    for (int page = 0; page < slab_file_pages(file); ++page) use_page(file, page);
    slab_file_close(file);
  } else {
    ++tally->refused;
    require(*error.text, "a refusal has a reason");
    require(!strstr(error.text, "out of memory"), "no 1 GB from some bytes");
  }
  close(fd);
}

/* In a child: the mutants from tally->reached on. */
static void read_mutants(const struct base *bases, int count, long last, struct tally *tally) {
  unsigned char bytes[LARGEST];
  const struct itimerval limit = {.it_value.tv_sec = SECONDS};
#ifndef __SANITIZE_ADDRESS__ /* which reserves terabytes */
  setrlimit(RLIMIT_AS, &(struct rlimit){memory, memory});
#endif
  setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
  for (; tally->reached <= last; ++tally->reached) {
    size_t size = mutate(bases, count, tally->reached, bytes);
    setitimer(ITIMER_PROF, &limit, NULL);
    use(bytes, size, tally);
  }
  exit(0);
}

static int load(char **paths, int count, struct base *bases) {
  for (int k = 0; k < count; ++k) {
    FILE *file = fopen(paths[k], "rbe");
    bases[k].size = file ? fread(bases[k].bytes, 1, LARGEST, file) : 0;
    if (file) fclose(file);
    if (!bases[k].size) return k;
  }
  return count;
}

int main(int argc, char **argv) {
  int count = argc - 3, failures = 0;
  long first = count > 0 ? strtol(argv[1], NULL, 10) : 1;
  long last = count > 0 ? strtol(argv[2], NULL, 10) : 0;
  struct base *bases = calloc(count > 0 ? (size_t)count : 1, sizeof *bases);
  struct tally *tally =
      mmap(NULL, sizeof *tally, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (last < first || !bases || tally == MAP_FAILED || load(argv + 3, count, bases) < count) {
    fprintf(stderr, "usage: mutants FIRST LAST FILE...\n");
    free(bases);
    return 2;
  }
  printf("1..1\n");
  for (tally->reached = first; tally->reached <= last;) {
    fflush(stdout);
    pid_t pid = fork();
    if (pid == 0) read_mutants(bases, count, last, tally);
    int status = 0;
    waitpid(pid, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
    printf("# mutant %ld: %s\n", tally->reached,
           WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF ? "does not end" : "crashes");
    ++failures;
    ++tally->reached;
  }
  printf("# %ld mutants: %ld read, %ld refused, %d failures\n", last - first + 1, tally->accepted,
         tally->refused, failures);
  printf("%s 1 - mutants of slabs\n", failures || !tally->accepted ? "not ok" : "ok");
  free(bases);
  return failures > 0;
}
