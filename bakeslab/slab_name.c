/* slab_name.c - see slab_name.h. */
#include "slab_name.h"

#include <ctype.h>
#include <string.h>

enum slab_result slab_name_capitalise(const char *name, char capitalised[SLAB_IDENTIFIER_SIZE],
                                      struct slab_error *error) {
  size_t length = strlen(name);
  int good = length > 0 && isalpha((unsigned char)name[0]);
  for (size_t k = 0; k < length; ++k)
    good = good && (isalnum((unsigned char)name[k]) || name[k] == '_');
  if (!good)
    return slab_fail(error, SLAB_BAD, "the name \"%s\" is no identifier (letters, digits, _)",
                     name);
  if (length >= SLAB_IDENTIFIER_SIZE)
    return slab_fail(error, SLAB_BAD, "the name \"%s\" is longer than %d characters", name,
                     SLAB_IDENTIFIER_SIZE - 1);
  for (size_t k = 0; k <= length; ++k) {
    int first = k == 0 || name[k - 1] == '_';
    capitalised[k] = first ? (char)toupper((unsigned char)name[k]) : name[k];
  }
  return SLAB_OK;
}
