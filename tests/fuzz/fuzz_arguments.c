/* fuzz_arguments.c - @FILE: arguments from a file. Files that name files are left out: they
 * would be this machine's. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/arguments.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct argument_words arguments = {0};
  struct error error;
  char program[] = "fuzz", path[64];
  if (memchr(data, '@', size)) return 0;
  int fd = fuzz_file(data, size);
  snprintf(path, sizeof path, "@/proc/self/fd/%d", fd);
  char *argv[] = {program, path, NULL};
  if (arguments_expand(2, argv, &arguments, &error) == RESULT_OK)
    for (int k = 0; k < arguments.count; ++k) fuzz_check(strlen(arguments.words[k]) <= size + 4);
  arguments_free(&arguments);
  close(fd);
  return 0;
}
