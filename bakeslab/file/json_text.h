/* json_text.h - JSON values to text and back, with a check that nothing is lost: without memory
 * jansson leaves out a key or a value, and reports nothing. */
#ifndef JSON_TEXT_H
#define JSON_TEXT_H

#include <jansson.h>

#include "base/result.h"

/* To be taken before a value is built or read. */
unsigned long json_mark(void);

/* RESULT_MEMORY where anything found no memory since the mark was taken, in this thread. */
enum result json_whole(unsigned long mark, struct error *error);

/* The text of a value that was built since the mark; the caller frees it. */
enum result json_text(const json_t *value, unsigned long mark, size_t flags, char **text,
                      struct error *error);

/* Reads a text; json_decref frees the value, which is NULL after a failure. */
enum result json_read(const char *text, size_t flags, json_t **value, struct error *error);

/* A string. Command lines and file names may hold any bytes, JSON only UTF-8: in those that are not
 * UTF-8, ? stands for each byte that is not ASCII. */
json_t *json_any_string(const char *text);

#endif
