/* numbers.h - numbers in texts: of command lines, of what they say of lights and cameras, of
 * lines of receivers and rays. Real numbers are decimal or hexadecimal, as strtod's, and finite;
 * none may follow blanks that nobody expects. */
#ifndef NUMBERS_H
#define NUMBERS_H

#include <stdbool.h>
#include <stdint.h>

/* What separates words. */
#define NUMBERS_BLANKS " \t\r\n"

/* `count` real numbers at the start of the text, separated by `between`: ',' for one comma, ' '
 * for any blanks or none. Returns where they end; NULL where they are not there. */
const char *numbers_read(const char *text, char between, int count, double *numbers);

/* The whole text is `count` real numbers with commas between them. */
bool numbers_real(const char *text, int count, double *numbers);

/* The whole text is a decimal number from `low` to `high`, digits only. */
bool numbers_whole(const char *text, uint64_t low, uint64_t high, uint64_t *number);

/* The whole text is "NxM" (or "N" for NxN), each from 1 to NUMBERS_MOST_SIZE. */
enum { NUMBERS_MOST_SIZE = 65536 };
bool numbers_size(const char *text, int size[2]);

#endif
