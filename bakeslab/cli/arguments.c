/* arguments.c - reads the files character by character: what is no text is
 * refused before it has filled the memory. */
#include "cli/arguments.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 8 };

/* A file that is being read. */
struct reader {
  const char *path;
  FILE *file;
  bool peeked;
  int ahead;  /* where peeked */
  int line;   /* of the last character */
  int opened; /* line of the last quote that was opened */
};

/* A word that grows; it has a zero at its end when all of it is there. */
struct word {
  char *text;
  size_t length, room;
};

static enum result no_memory(struct error *error) {
  return result_fail(error, RESULT_MEMORY, "out of memory");
}

static enum result append(struct word *word, int c, struct error *error) {
  if (word->length == word->room) {
    size_t room = word->room ? 2 * word->room : 64;
    char *text = realloc(word->text, room);
    if (!text) return no_memory(error);
    word->text = text;
    word->room = room;
  }
  word->text[word->length++] = (char)c;
  return RESULT_OK;
}

/* Takes over `text`, also when it fails. */
static enum result add(struct argument_words *arguments, char *text, struct error *error) {
  size_t count = (size_t)arguments->count;
  char **words = text ? realloc(arguments->words, (count + 2) * sizeof *words) : NULL;
  if (!words) {
    free(text);
    return no_memory(error);
  }
  words[count] = text;
  words[count + 1] = NULL;
  arguments->words = words;
  ++arguments->count;
  return RESULT_OK;
}

/* The character that next() will read; a line may end in CR LF. */
static int peek(struct reader *reader) {
  if (reader->peeked) return reader->ahead;
  int c = getc(reader->file);
  if (c == '\r') {
    int after = getc(reader->file);
    if (after == '\n')
      c = after;
    else
      ungetc(after, reader->file);
  }
  reader->peeked = true;
  reader->ahead = c;
  return c;
}

static int next(struct reader *reader) {
  int c = peek(reader);
  reader->peeked = false;
  if (c == '\n') ++reader->line;
  return c;
}

static bool is_blank(int c) {
  return c && strchr(" \t\r\n\v\f", c);
}

/* The character after a backslash in `quote`, or outside quotes where that is 0. */
static enum result read_escaped(struct reader *reader, struct word *word, int quote,
                                struct error *error) {
  if (peek(reader) == 0) return RESULT_OK; /* refused like any other */
  int c = next(reader);
  if (c == '\n') return RESULT_OK;
  if (c == EOF)
    return quote ? RESULT_OK /* the quote is complained about */
                 : result_fail(error, RESULT_BAD, "%s: line %d: ends in a backslash", reader->path,
                               reader->line);
  enum result result = RESULT_OK;
  if (quote && !strchr("\"\\$`", c)) result = append(word, '\\', error);
  return result == RESULT_OK ? append(word, c, error) : result;
}

/* Reads on to the end of a word, from its character c, which ends it where it is blank. */
static enum result read_word(struct reader *reader, int c, struct word *word, struct error *error) {
  int quote = 0;
  enum result result = RESULT_OK;
  for (; result == RESULT_OK && c != EOF && (quote || !is_blank(c)); c = next(reader)) {
    if (c == 0)
      return result_fail(error, RESULT_BAD, "%s: line %d: has a zero byte; it should be text",
                         reader->path, reader->line);
    if (quote ? c == quote : c == '\'' || c == '"') {
      quote = quote ? 0 : c;
      reader->opened = reader->line;
    } else if (c == '\\' && quote != '\'') {
      result = read_escaped(reader, word, quote, error);
    } else {
      result = append(word, c, error);
    }
  }
  if (result == RESULT_OK && quote && !ferror(reader->file))
    return result_fail(error, RESULT_BAD, "%s: line %d: this %s quote is never closed",
                       reader->path, reader->opened, quote == '"' ? "double" : "single");
  return result == RESULT_OK ? append(word, 0, error) : result;
}

static enum result add_file(struct argument_words *arguments, const char *path,
                            const struct reader *from, int depth, struct error *error);

static enum result add_words(struct argument_words *arguments, struct reader *reader, int depth,
                             struct error *error) {
  enum result result = RESULT_OK;
  for (int c = next(reader); result == RESULT_OK && c != EOF; c = next(reader)) {
    if (is_blank(c)) continue;
    if (c == '\\' && peek(reader) == '\n') {
      next(reader);
      continue;
    }
    if (c == '#') {
      while (c != '\n' && c != EOF) c = next(reader);
      continue;
    }
    struct word word = {0};
    const struct reader here = *reader; /* messages tell where the word starts */
    bool file = c == '@';
    result = read_word(reader, file ? next(reader) : c, &word, error);
    if (result == RESULT_OK && file)
      result = add_file(arguments, word.text, &here, depth + 1, error);
    else if (result == RESULT_OK)
      result = add(arguments, strdup(word.text), error);
    free(word.text);
  }
  if (result == RESULT_OK && ferror(reader->file))
    result = result_fail(error, RESULT_IO, "%s: line %d: %m", reader->path, reader->line);
  return result;
}

/* `from` is the file that names this one; NULL for the command line. */
static enum result add_file(struct argument_words *arguments, const char *path,
                            const struct reader *from, int depth, struct error *error) {
  struct error where = {{0}};
  if (from) result_fail(&where, RESULT_BAD, "%s: line %d: ", from->path, from->line);
  if (!*path)
    return result_fail(error, RESULT_BAD, "%s@: a file's name must follow, as in @FILE",
                       where.text);
  if (depth > MAX_DEPTH)
    return result_fail(error, RESULT_BAD, "%s@%s: files name files more than %d deep", where.text,
                       path, MAX_DEPTH);
  struct reader reader = {.path = path, .file = fopen(path, "re"), .line = 1};
  if (!reader.file && errno == ENOMEM) return no_memory(error);
  if (!reader.file)
    return result_fail(error, RESULT_IO, "%s@%s: %s", where.text, path, strerror(errno));
  enum result result = add_words(arguments, &reader, depth, error);
  fclose(reader.file);
  return result;
}

enum result arguments_expand(int argc, char **argv, struct argument_words *arguments,
                             struct error *error) {
  enum result result = RESULT_OK;
  for (int k = 0; result == RESULT_OK && k < argc; ++k) {
    if (k > 0 && argv[k][0] == '@')
      result = add_file(arguments, argv[k] + 1, NULL, 1, error);
    else
      result = add(arguments, strdup(argv[k]), error);
  }
  return result;
}

void arguments_free(struct argument_words *arguments) {
  for (int k = 0; k < arguments->count; ++k) free(arguments->words[k]);
  free(arguments->words);
  *arguments = (struct argument_words){0};
}
