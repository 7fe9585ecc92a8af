#include "cal.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "testing.h"

enum { DEFINITIONS = 64, PARAMETERS = 4, NAME_SIZE = 32 };

struct definition {
  char name[NAME_SIZE], parameters[PARAMETERS][NAME_SIZE];
  int count; /* of parameters */
  const char *body;
};

struct cal {
  char *text; /* without comments */
  struct definition definitions[DEFINITIONS];
  int count;
  const struct cal_ray *ray;
};

/* Where an expression is evaluated: the rest of its text, and what its parameters are. */
struct reader {
  struct cal *cal;
  const char *at;
  const struct definition *in;
  const double *arguments;
};

static double sum(struct reader *reader);

static bool take(struct reader *reader, char wanted) {
  while (isspace((unsigned char)*reader->at)) ++reader->at;
  if (*reader->at != wanted) return false;
  ++reader->at;
  return true;
}

static void expect(struct reader *reader, char wanted) {
  if (!take(reader, wanted)) fail_msg("no %c at: %.60s", wanted, reader->at);
}

static void take_name(struct reader *reader, char name[NAME_SIZE]) {
  int length = 0;
  while (isspace((unsigned char)*reader->at)) ++reader->at;
  while (isalnum((unsigned char)*reader->at) || *reader->at == '_') {
    assert_true(length + 1 < NAME_SIZE);
    name[length++] = *reader->at++;
  }
  name[length] = 0;
  if (!length) fail_msg("no name at: %.60s", reader->at);
}

static double evaluate(struct cal *cal, const char *name, const double *arguments, int count) {
  for (const struct definition *d = cal->definitions; d < cal->definitions + cal->count; ++d)
    if (!strcmp(d->name, name) && d->count == count) {
      struct reader reader = {cal, d->body, d, arguments};
      double value = sum(&reader);
      expect(&reader, ';');
      return value;
    }
  fail_msg("%s with %d arguments is not defined", name, count);
  return NAN;
}

static double named(struct reader *reader, const char *name) {
  const struct cal *cal = reader->cal;
  for (int k = 0; k < reader->in->count; ++k)
    if (!strcmp(reader->in->parameters[k], name)) return reader->arguments[k];
  if (!strcmp(name, "Ts")) return cal->ray->length;
  for (int k = 0; k < 3; ++k) {
    if (!strcmp(name, (const char *const[]){"Px", "Py", "Pz"}[k])) return cal->ray->point[k];
    if (!strcmp(name, (const char *const[]){"Dx", "Dy", "Dz"}[k])) return cal->ray->direction[k];
  }
  return evaluate(reader->cal, name, NULL, 0);
}

/* Up to the comma or parenthesis that ends an expression. */
static void pass_over(struct reader *reader) {
  int depth = 0;
  for (; depth > 0 || !strchr(",)", *reader->at); ++reader->at) {
    assert_true(*reader->at);
    depth += *reader->at == '(';
    depth -= *reader->at == ')';
  }
}

/* if(x, a, b), of which one is evaluated: functions may call themselves. */
static double choose(struct reader *reader) {
  double value = NAN, x = sum(reader);
  for (int k = 0; k < 2; ++k) {
    expect(reader, ',');
    if ((x > 0) == (k == 0))
      value = sum(reader);
    else
      pass_over(reader);
  }
  expect(reader, ')');
  return value;
}

static double primary(struct reader *reader) {
  if (take(reader, '-')) return -primary(reader);
  if (take(reader, '(')) {
    double value = sum(reader);
    expect(reader, ')');
    return value;
  }
  if (isdigit((unsigned char)*reader->at) || *reader->at == '.') {
    char *end;
    double value = strtod(reader->at, &end);
    reader->at = end;
    return value;
  }
  char name[NAME_SIZE];
  double arguments[PARAMETERS];
  int count = 0;
  take_name(reader, name);
  if (!take(reader, '(')) return named(reader, name);
  if (!strcmp(name, "if")) return choose(reader);
  do {
    assert_true(count < PARAMETERS);
    arguments[count++] = sum(reader);
  } while (take(reader, ','));
  expect(reader, ')');
  if (!strcmp(name, "min") && count == 2) return fmin(arguments[0], arguments[1]);
  if (!strcmp(name, "max") && count == 2) return fmax(arguments[0], arguments[1]);
  return evaluate(reader->cal, name, arguments, count);
}

static double product(struct reader *reader) {
  double value = primary(reader);
  for (;;) {
    if (take(reader, '*'))
      value *= primary(reader);
    else if (take(reader, '/'))
      value /= primary(reader);
    else
      return value;
  }
}

static double sum(struct reader *reader) {
  double value = product(reader);
  for (;;) {
    if (take(reader, '+'))
      value += product(reader);
    else if (take(reader, '-'))
      value -= product(reader);
    else
      return value;
  }
}

struct cal *cal_read(const char *path) {
  struct cal *cal = calloc(1, sizeof *cal);
  FILE *file = fopen(path, "r");
  size_t size = 0;
  if (!cal || !file || getdelim(&cal->text, &size, 0, file) < 0) {
    free(cal);
    fail_msg("%s: not read", path);
    return NULL;
  }
  fclose(file);
  bool comment = false;
  for (char *c = cal->text; *c; ++c) {
    bool end = *c == '}';
    comment |= *c == '{';
    if (comment || end) *c = ' ';
    comment &= !end;
  }
  struct reader reader = {cal, cal->text, NULL, NULL};
  while (reader.at += strspn(reader.at, " \t\n"), *reader.at) {
    assert_true(cal->count < DEFINITIONS);
    struct definition *definition = &cal->definitions[cal->count++];
    take_name(&reader, definition->name);
    if (take(&reader, '(')) {
      do {
        assert_true(definition->count < PARAMETERS);
        take_name(&reader, definition->parameters[definition->count++]);
      } while (take(&reader, ','));
      expect(&reader, ')');
    }
    expect(&reader, '=');
    definition->body = reader.at;
    reader.at = strchr(reader.at, ';');
    assert_non_null(reader.at);
    ++reader.at;
  }
  return cal;
}

void cal_free(struct cal *cal) {
  free(cal->text);
  free(cal);
}

double cal_variable(struct cal *cal, const char *name, const struct cal_ray *ray) {
  cal->ray = ray;
  return evaluate(cal, name, NULL, 0);
}

double cal_function(struct cal *cal, const char *name, const double arguments[3],
                    const struct cal_ray *ray) {
  cal->ray = ray;
  return evaluate(cal, name, arguments, 3);
}
