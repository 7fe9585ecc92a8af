/* array.h - arrays that grow. */
#ifndef ARRAY_H
#define ARRAY_H

#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Makes room for `count` elements of `size` bytes in *array, a pointer of any type; if it must
 * grow, to more than twice its size. False, and nothing is changed, where there is no memory. */
static inline bool array_reserve(void *array, int *room, int count, size_t size) {
  if (count <= *room) return true;
  void *old;
  int twice = *room < INT_MAX / 2 - 64 ? 2 * *room + 64 : INT_MAX;
  int more = count > twice ? count : twice;
  memcpy(&old, array, sizeof old);
  void *grown = reallocarray(old, (size_t)more, size);
  if (!grown) return false;
  memcpy(array, &grown, sizeof grown);
  *room = more;
  return true; // cppcheck-suppress memleak ; *array has it
}

#endif
