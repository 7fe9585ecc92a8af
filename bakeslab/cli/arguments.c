/* arguments.c - unquoting never lengthens a text: a file's words are made in place. */
#include "cli/arguments.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 8 };

static const char blanks[] = " \t\r\n\v\f";

/* A file that is being read. */
struct reader {
  const char *path;
  int depth; /* 1 where the command line names the file */
  char *at;  /* what comes next in its text */
  int line;  /* there */
};

/* Takes over `text`, also when it fails. */
static enum result add(struct argument_words *arguments, char *text, struct error *error) {
  size_t count = (size_t)arguments->count;
  char **words = text ? realloc(arguments->words, (count + 2) * sizeof *words) : NULL;
  if (!words) {
    free(text);
    return result_no_memory(error);
  }
  words[count] = text;
  words[count + 1] = NULL;
  arguments->words = words;
  ++arguments->count;
  return RESULT_OK;
}

/* Takes quotes and backslashes out of the word that comes next, puts a zero at its end, and moves
 * on behind it. */
static enum result unquote(struct reader *reader, struct error *error) {
  char *at = reader->at, *to = at, quote = 0;
  int opened = 0;
  for (; *at && (quote || !strchr(blanks, *at)); ++at) {
    bool delimits = quote ? *at == quote : *at == '\'' || *at == '"';
    bool escapes = *at == '\\' && quote != '\'';
    if (delimits) {
      quote = quote ? 0 : *at;
      opened = reader->line;
    } else if (escapes && !at[1] && !quote) {
      return result_fail(error, RESULT_BAD, "%s: line %d: ends in a backslash", reader->path,
                         reader->line);
    } else if (escapes && at[1] == '\n') {
      ++at, ++reader->line;
    } else {
      if (escapes && at[1] && (!quote || strchr("\"\\$`", at[1]))) ++at;
      if (*at == '\n') ++reader->line;
      *to++ = *at;
    }
  }
  if (quote)
    return result_fail(error, RESULT_BAD, "%s: line %d: this %s quote is never closed",
                       reader->path, opened, quote == '"' ? "double" : "single");
  if (*at == '\n') ++reader->line;
  reader->at = *at ? at + 1 : at;
  *to = 0;
  return RESULT_OK;
}

static enum result add_file(struct argument_words *arguments, const char *path,
                            const char *named_in, int depth, struct error *error);

/* Adds the word that comes next, or the words of the file that it names. */
static enum result add_word(struct argument_words *arguments, struct reader *reader,
                            struct error *error) {
  struct error place;
  bool names_file = *reader->at == '@';
  const char *word = reader->at += names_file;
  result_fail(&place, RESULT_BAD, "%s: line %d: ", reader->path, reader->line);
  enum result result = unquote(reader, error);
  if (result != RESULT_OK) return result;
  return names_file ? add_file(arguments, word, place.text, reader->depth + 1, error)
                    : add(arguments, strdup(word), error);
}

static enum result add_words(struct argument_words *arguments, struct reader *reader,
                             struct error *error) {
  enum result result = RESULT_OK;
  while (result == RESULT_OK && *reader->at) {
    bool continued = !strncmp(reader->at, "\\\n", 2);
    if (*reader->at == '#') {
      reader->at += strcspn(reader->at, "\n");
    } else if (continued || strchr(blanks, *reader->at)) {
      reader->at += continued;
      if (*reader->at++ == '\n') ++reader->line;
    } else {
      result = add_word(arguments, reader, error);
    }
  }
  return result;
}

/* The text of a file, with LF for CR LF; to be freed even after a failure. */
static enum result read_text(const char *path, const char *named_in, char **text,
                             struct error *error) {
  size_t room = 0;
  FILE *file = fopen(path, "re");
  ssize_t length = file ? getdelim(text, &room, 0, file) : -1; /* up to a zero byte */
  int why = errno;
  bool whole = file && *text && (length >= 0 || feof(file)) && !ferror(file);
  if (file) fclose(file);
  if (!whole)
    return why == ENOMEM
               ? result_no_memory(error)
               : result_fail(error, RESULT_IO, "%s@%s: %s", named_in, path, strerror(why));
  if (length < 0) **text = 0; /* an empty file */
  int line = 1;
  char *to = *text;
  for (const char *from = *text; *from; ++from) {
    if (from[0] == '\r' && from[1] == '\n') continue;
    if (*from == '\n') ++line;
    *to++ = *from;
  }
  bool zero = length > 0 && !(*text)[length - 1];
  *to = 0;
  return zero ? result_fail(error, RESULT_BAD, "%s: line %d: has a zero byte; it should be text",
                            path, line)
              : RESULT_OK;
}

/* `named_in` tells where, for messages; "" for the command line. */
static enum result add_file(struct argument_words *arguments, const char *path,
                            const char *named_in, int depth, struct error *error) {
  char *text = NULL;
  if (!*path)
    return result_fail(error, RESULT_BAD, "%s@: a file's name must follow, as in @FILE", named_in);
  if (depth > MAX_DEPTH)
    return result_fail(error, RESULT_BAD, "%s@%s: files name files more than %d deep", named_in,
                       path, MAX_DEPTH);
  enum result result = read_text(path, named_in, &text, error);
  struct reader reader = {.path = path, .depth = depth, .at = text, .line = 1};
  if (result == RESULT_OK) result = add_words(arguments, &reader, error);
  free(text);
  return result;
}

enum result arguments_expand(int argc, char **argv, struct argument_words *arguments,
                             struct error *error) {
  enum result result = RESULT_OK;
  for (int k = 0; result == RESULT_OK && k < argc; ++k)
    result = k > 0 && argv[k][0] == '@' ? add_file(arguments, argv[k] + 1, "", 1, error)
                                        : add(arguments, strdup(argv[k]), error);
  return result;
}

void arguments_free(struct argument_words *arguments) {
  for (int k = 0; k < arguments->count; ++k) free(arguments->words[k]);
  free(arguments->words);
  *arguments = (struct argument_words){0};
}
