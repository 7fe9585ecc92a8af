/* sdl.c - see sdl.h. */
#include "base/sdl.h"

void sdl_string(const char *text, FILE *out) {
  putc('"', out);
  for (; *text; ++text) {
    if (*text == '"' || *text == '\\') putc('\\', out);
    putc(*text, out);
  }
  putc('"', out);
}

void sdl_comment(const char *text, FILE *out) {
  for (; *text; ++text) putc((unsigned char)*text < ' ' || *text == 0x7f ? '?' : *text, out);
}
