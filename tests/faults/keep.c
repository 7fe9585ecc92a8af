/* keep.c - preloaded into the viewer under the address sanitizer: libraries stay loaded, so that
 * what the globals of a driver hold can be found when leaks are looked for at the end. */
#include <dlfcn.h>

int dlclose(void *library) {
  (void)library;
  return 0;
}
