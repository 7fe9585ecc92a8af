/* result.h - how library functions fail.
 *
 * A library function returns a result and, unless that is RESULT_OK,
 * leaves one line in the error: "file: what is wrong and what to do",
 * without the program's name and without a newline. It never prints or exits.
 * The caller owns the error; a NULL one is allowed where the text is
 * of no interest. */
#ifndef RESULT_H
#define RESULT_H

enum result {
  RESULT_OK = 0,
  RESULT_BAD,    /* refused: the content of a file or an argument is wrong */
  RESULT_IO,     /* the operating system, or a program we ran, failed */
  RESULT_MEMORY, /* out of memory */
  RESULT_STOPPED /* interrupted by the user; what was finished is kept */
};

struct error {
  char text[1024];
};

/* Formats the message and returns `result`, so that a caller can write
 * `return result_fail(error, RESULT_BAD, "%s: ...", path);`. */
enum result result_fail(struct error *error, enum result result, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for "out of memory". */
enum result result_no_memory(struct error *error);

/* Puts the place before the message of a failure, as in "FILE: page 2: MESSAGE"; does nothing
 * to RESULT_OK. Returns `result`. */
enum result result_at(enum result result, struct error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Makes one line of a text: line ends become blanks. */
void result_one_line(char *text);

#endif
