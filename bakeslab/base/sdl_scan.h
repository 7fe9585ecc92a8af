/* sdl_scan.h - reads just enough of POV-Ray's language to find words that are code: comments,
 * strings, words, and the directives that open and close blocks. Texts end with a zero. */
#ifndef SDL_SCAN_H
#define SDL_SCAN_H

#include <stdbool.h>
#include <stddef.h>

/* The end of the comment that starts with the slash and star at `at` (they nest), or of the string
 * that starts there; NULL where it has none. */
const char *sdl_skip_comment(const char *at);
const char *sdl_skip_string(const char *at);

/* The end of the comment, of either kind, or string that starts at `at`, or `at` where none does.
 * One without an end goes on to that of the text. */
const char *sdl_skip_quiet(const char *at);

/* Letters, digits and _ from `at` on. */
size_t sdl_word_length(const char *at);

/* Whether the word is one of `words`, which end with NULL. */
bool sdl_is_one_of(const char *word, size_t length, const char *const *words);

/* What a directive's word does to the depth of blocks: 1 for `if`, `macro` and their like, -1 for
 * `end`, else 0. */
int sdl_block(const char *word, size_t length);

#endif
