/* nomem.c - preloaded into a program: memory that runs out. FAULT_MALLOC=N fails the N-th
 * allocation, N+ that and all later ones; 0 none. Counted are the calls of the program itself
 * and of the C libraries that work for it, for whose answers it has to look; C++ libraries,
 * which throw, and the loader's are not, nor libtiff's: 4.5 dies of a tag without memory, in
 * TIFFFreeDirectory. At the end FAULT_TELL, a file, gets the count.
 * Programs not called like FAULT_PROGRAM, which run as children, are left alone. */
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* glibc's own, under names that nobody replaces. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

enum { MOST_RANGES = 32 };
static struct { uintptr_t from, to; } ranges[MOST_RANGES];
static int range_count;
static atomic_long count;
static long fail_from, fail_to;

static int note_module(struct dl_phdr_info *info, size_t size, void *data) {
  static const char *const libraries[] = {"libc.so", "libjansson", "libOpenEXR", "libxxhash",
                                          "libpng"};
  (void)size, (void)data;
  bool ours = !*info->dlpi_name; /* the program */
  for (size_t k = 0; k < sizeof libraries / sizeof *libraries; ++k)
    ours |= strstr(info->dlpi_name, libraries[k]) != NULL;
  for (int k = 0; ours && k < info->dlpi_phnum && range_count < MOST_RANGES; ++k) {
    if (info->dlpi_phdr[k].p_type != PT_LOAD || !(info->dlpi_phdr[k].p_flags & PF_X)) continue;
    ranges[range_count].from = info->dlpi_addr + info->dlpi_phdr[k].p_vaddr;
    ranges[range_count].to = ranges[range_count].from + info->dlpi_phdr[k].p_memsz;
    ++range_count;
  }
  return 0;
}

__attribute__((constructor)) static void begin(void) {
  const char *program = getenv("FAULT_PROGRAM"), *text = getenv("FAULT_MALLOC");
  if (!program || !text || strcmp(program, program_invocation_short_name) != 0) return;
  char *end;
  fail_from = strtol(text, &end, 10);
  fail_to = *end == '+' ? INT32_MAX : fail_from;
  dl_iterate_phdr(note_module, NULL);
}

__attribute__((destructor)) static void tell(void) {
  const char *path = getenv("FAULT_TELL");
  int file = range_count && path ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
  range_count = 0;
  if (file < 0) return;
  dprintf(file, "%ld\n", (long)count);
  close(file);
}

static bool fails(const void *caller) {
  uintptr_t at = (uintptr_t)caller;
  for (int k = 0; k < range_count; ++k) {
    if (at < ranges[k].from || at >= ranges[k].to) continue;
    long number = ++count;
    if (number < fail_from || number > fail_to || !fail_from) return false;
    errno = ENOMEM;
    return true;
  }
  return false;
}

#define FAILS fails(__builtin_return_address(0))

void *malloc(size_t size) {
  return FAILS ? NULL : __libc_malloc(size);
}

void *calloc(size_t number, size_t size) {
  return FAILS ? NULL : __libc_calloc(number, size);
}

void *realloc(void *old, size_t size) {
  return FAILS ? NULL : __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
  return FAILS ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **out, size_t alignment, size_t size) {
  if (FAILS) return ENOMEM;
  void *memory = __libc_memalign(alignment, size);
  if (memory) *out = memory;
  return memory ? 0 : ENOMEM;
}
