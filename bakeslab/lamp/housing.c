/* housing.c - finds the housing's declaration in a script, and those that it needs. */
#include "lamp/housing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/files.h"
#include "base/sdl_scan.h"

/* The next character from `at` on that is in no comment or string. */
static const char *next_code(const char *at) {
  for (const char *after; (after = sdl_skip_quiet(at)) != at;) at = after;
  return at;
}

static const char *skip_blanks(const char *at) {
  for (;;) {
    const char *after = at + strspn(at, " \t\r\n");
    if (*after == '/') after = sdl_skip_quiet(after);
    if (after == at) return at;
    at = after;
  }
}

/* The end of a value: after the ; of an expression, or after the brace that closes the
 * first one opened. *has_braces tells which it was. */
static const char *skip_value(const char *at, bool *has_braces) {
  int depth = 0;
  *has_braces = false;
  for (at = next_code(at); *at; at = next_code(at + 1)) {
    if (*at == '{') {
      ++depth;
      *has_braces = true;
    }
    if (*at == '}' && --depth <= 0) return at + 1;
    if (depth == 0 && (*at == ';' || *at == '#')) return *at == ';' ? at + 1 : at;
  }
  return at;
}

/* What a # before `at` introduces. */
struct directive {
  const char *word; /* not NUL-terminated */
  size_t length;
};

static struct directive directive_at(const char *at) {
  struct directive directive = {.word = skip_blanks(at)};
  directive.length = sdl_word_length(directive.word);
  return directive;
}

static const char *const declarers[] = {"declare", "local", NULL};

/* #declare NAME = VALUE */
struct declaration {
  const char *name, *value;
  size_t name_length, value_length;
  bool is_value;    /* an expression that ends with a semicolon, without braces */
  bool conditional; /* inside #if, #while, #macro ... */
  bool global;      /* #declare rather than #local */
  bool needed;      /* by the housing, or by what it needs */
};

struct script {
  struct declaration *declarations;
  size_t count;
};

/* Returns where its value starts, which may hold declarations too; NULL without memory. */
static const char *add_declaration(struct script *script, struct directive directive,
                                   bool conditional) {
  struct declaration found = {.name = skip_blanks(directive.word + directive.length),
                              .conditional = conditional,
                              .global = directive.word[0] == 'd'};
  found.name_length = sdl_word_length(found.name);
  const char *at = skip_blanks(found.name + found.name_length);
  if (*at != '=' || !found.name_length) return at;
  bool has_braces;
  found.value = skip_blanks(at + 1);
  const char *end = skip_value(found.value, &has_braces);
  found.value_length = (size_t)(end - found.value);
  found.is_value = !has_braces && end > found.value && end[-1] == ';';
  struct declaration *more =
      realloc(script->declarations, (script->count + 1) * sizeof *script->declarations);
  if (!more) return NULL;
  script->declarations = more;
  script->declarations[script->count++] = found;
  return found.value;
}

static bool read_script(const char *at, struct script *script) {
  int depth = 0;
  while (at && *(at = next_code(at))) {
    if (*at++ != '#') continue;
    struct directive directive = directive_at(at);
    depth += sdl_block(directive.word, directive.length);
    if (sdl_is_one_of(directive.word, directive.length, declarers))
      at = add_declaration(script, directive, depth > 0);
    else
      at = directive.word + directive.length;
  }
  return at != NULL;
}

/* Whether the value mentions the name, outside of comments and strings. */
static bool mentions(const struct declaration *in, const struct declaration *name) {
  const char *at = next_code(in->value);
  while (at < in->value + in->value_length) {
    size_t length = sdl_word_length(at);
    if (length == name->name_length && !memcmp(at, name->name, length)) return true;
    at = next_code(at + (length ? length : 1));
  }
  return false;
}

static bool same_name(const struct declaration *a, const struct declaration *b) {
  return a->name_length == b->name_length && !memcmp(a->name, b->name, a->name_length);
}

/* Marks what the housing needs of what is declared before. False where the text alone does not
 * decide what a name stands for. */
static bool mark_needed(struct script *script, size_t housing) {
  struct declaration *all = script->declarations;
  all[housing].needed = true;
  for (size_t k = housing + 1; k-- > 0;) {
    if (!all[k].needed) continue;
    if (all[k].conditional) return false;
    for (size_t m = 0; m < script->count; ++m) {
      bool counts = m < housing || k == housing; /* what follows changes only the housing */
      if (m != k && counts && same_name(&all[m], &all[k])) return false;
    }
    for (size_t m = 0; m < k; ++m)
      if (mentions(&all[k], &all[m])) all[m].needed = true;
  }
  return true;
}

static void print_needed(const struct script *script, size_t housing, FILE *out) {
  for (size_t k = 0; k < housing; ++k) {
    const struct declaration *d = &script->declarations[k];
    if (d->needed && d->is_value)
      fprintf(out, "#local %.*s = %.*s\n", (int)d->name_length, d->name, (int)d->value_length,
              d->value);
  }
  const struct declaration *d = &script->declarations[housing];
  fprintf(out, "%.*s", (int)d->value_length, d->value);
}

char *housing_find(const char *text) {
  static const struct declaration wanted = {.name = "Canned_Housing",
                                            .name_length = sizeof "Canned_Housing" - 1};
  struct script script = {0};
  char *found = NULL;
  size_t size = 0, housing = 0;
  if (!read_script(text, &script)) goto out;
  while (housing < script.count && !(script.declarations[housing].global &&
                                     same_name(&script.declarations[housing], &wanted)))
    ++housing;
  if (housing == script.count) goto out;
  FILE *out = open_memstream(&found, &size);
  if (!out) goto out;
  if (mark_needed(&script, housing)) print_needed(&script, housing, out);
  if (fclose(out) != 0) {
    free(found);
    found = NULL;
  }
out:
  free(script.declarations);
  return found;
}

/* A string in which a quote follows a backslash is refused: whether it ends there depends
 * on where POV-Ray meets it. So is an odd line end, which may or may not end a comment. */
static bool is_plain_text(const char *text) {
  for (const unsigned char *c = (const unsigned char *)text; *c; ++c) {
    if (*c == '\r' && c[1] == '\n') continue;
    if ((*c < ' ' && *c != '\n' && *c != '\t') || *c == 0x7f) return false;
    if (*c == '\\' && c[1] == '"') return false;
  }
  return true;
}

bool housing_is_harmless(const char *text) {
  static const char *const allowed[] = {"local", "if",    "ifdef", "ifndef", "else",
                                        "for",   "while", "end",   NULL};
  int braces = 0, blocks = 0;
  if (!is_plain_text(text)) return false;
  for (const char *at = text; *at;) {
    if ((*at == '"' && !sdl_skip_string(at)) || (!strncmp(at, "/*", 2) && !sdl_skip_comment(at)))
      return false;
    const char *after = sdl_skip_quiet(at);
    if (after != at) {
      at = after;
      continue;
    }
    if (*at == '{') ++braces;
    if (*at == '}' && --braces < 0) return false;
    if (*at == '#') {
      struct directive directive = directive_at(at + 1);
      if (!sdl_is_one_of(directive.word, directive.length, allowed)) return false;
      blocks += sdl_block(directive.word, directive.length);
      if (blocks < 0) return false;
    }
    ++at;
  }
  return braces == 0 && blocks == 0;
}

enum result housing_parses(const struct povray *povray, const struct lamp_source *source,
                           const char *housing, const char *directory,
                           const volatile sig_atomic_t *stop, struct error *error) {
  struct povray_job job = {.directory = directory,
                           .width = 4,
                           .height = 4,
                           .frames = 1,
                           .environment = lamp_without_highlights,
                           .stop = stop};
  char *scene = NULL;
  if (asprintf(&scene,
               "#version 3.7;\n#macro Housing()\n%s\n#end\nobject { Housing() }\n"
               "camera { location -z direction z }\n",
               housing) < 0)
    return result_no_memory(error);
  files_remove_tree(directory);
  enum result result = lamp_source_link(source, directory, error);
  if (result == RESULT_OK) result = files_write(directory, "scene.pov", scene, error);
  if (result == RESULT_OK) result = povray_run(povray, &job, error);
  /* A picture that cannot be written is no fault of the text. */
  if (result == RESULT_BAD && strstr(error->text, "Fatal error") &&
      !strstr(error->text, "in parser"))
    result = RESULT_IO;
  files_remove_tree(directory);
  free(scene);
  return result;
}
