/* slab_error.h - how library functions fail.
 *
 * A library function returns a slab_result and, unless that is SLAB_OK,
 * leaves one line in the slab_error: "file: what is wrong and what to do",
 * without the program's name and without a newline. It never prints or exits.
 * The caller owns the slab_error; a NULL one is allowed where the text is
 * of no interest. */
#ifndef SLAB_ERROR_H
#define SLAB_ERROR_H

#ifdef __cplusplus
extern "C" {
#endif

enum slab_result {
  SLAB_OK = 0,
  SLAB_BAD,    /* refused: the content of a file or an argument is wrong */
  SLAB_IO,     /* the operating system, or a program we ran, failed */
  SLAB_MEMORY, /* out of memory */
  SLAB_STOPPED /* interrupted by the user; what was finished is kept */
};

struct slab_error {
  char text[1024];
};

/* Formats the message and returns `result`, so that a caller can write
 * `return slab_fail(error, SLAB_BAD, "%s: ...", path);`. */
enum slab_result slab_fail(struct slab_error *error, enum slab_result result, const char *format,
                           ...) __attribute__((format(printf, 3, 4)));

/* Makes one line of a text: line ends become blanks. */
void slab_one_line(char *text);

#ifdef __cplusplus
}
#endif
#endif
