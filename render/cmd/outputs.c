/* outputs.c - see outputs.h. */
#include "cmd/outputs.h"

#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>

#include "base/output.h"

/* By whatever links; files that are not there are the same by name. */
static bool same_file(const char *path, const char *other) {
  struct stat a, b;
  if (!strcmp(path, other)) return true;
  if (stat(path, &a) != 0 || stat(other, &b) != 0) return false;
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

static enum result check(const char *output, struct error *error) {
  struct output trial;
  enum result result = output_begin(&trial, output, error);
  output_abandon(&trial);
  return result;
}

enum result outputs_check(const char *const *outputs, int output_count, const char *const *inputs,
                          int input_count, struct error *error) {
  for (int k = 0; k < output_count; ++k) {
    if (!outputs[k]) continue;
    for (int i = 0; i < input_count; ++i)
      if (inputs[i] && same_file(outputs[k], inputs[i]))
        return result_fail(error, RESULT_BAD, "%s: is read too and would be overwritten",
                           outputs[k]);
    for (int i = 0; i < k; ++i)
      if (outputs[i] && same_file(outputs[k], outputs[i]))
        return result_fail(error, RESULT_BAD, "%s: is to hold two different outputs", outputs[k]);
    enum result result = check(outputs[k], error);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}
