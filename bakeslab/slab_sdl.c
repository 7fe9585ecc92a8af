/* slab_sdl.c - see slab_sdl.h. */
#include "slab_sdl.h"

void slab_sdl_string(const char *text, FILE *out) {
  putc('"', out);
  for (; *text; ++text) {
    if (*text == '"' || *text == '\\') putc('\\', out);
    putc(*text, out);
  }
  putc('"', out);
}

void slab_sdl_comment(const char *text, FILE *out) {
  for (; *text; ++text) putc((unsigned char)*text < ' ' || *text == 0x7f ? '?' : *text, out);
}
