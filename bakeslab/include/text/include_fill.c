#include "include/text/include_fill.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const struct include_value *find(const struct include_value *values, const char *key) {
  size_t length = strcspn(key, "[:}");
  for (; values->key || values->more; values = values->key ? values + 1 : values->more)
    if (values->key && strlen(values->key) == length && !memcmp(values->key, key, length)) break;
  return values;
}

static bool is_given(const struct include_value *value) {
  return value->part || value->print || value->numbers || (value->text && *value->text) ||
         value->number != 0;
}

/* Of @{key:format}; it goes on at `key`. */
static void put_number(const char *key, const struct include_value *value, FILE *out) {
  const char *index = key + strcspn(key, "[:}"), *colon = key + strcspn(key, ":}");
  char format[16] = "%.15g";
  if (*colon == ':')
    snprintf(format, sizeof format, "%%%.*s", (int)strcspn(colon + 1, "}"), colon + 1);
  fprintf(out, format, value->numbers ? value->numbers[atoi(index + 1)] : value->number);
}

static void put_value(const char *key, const char *name, const struct include_value *values,
                      FILE *out) {
  const struct include_value *value = find(values, key);
  if (!value->key)
    fprintf(out, "@{%.*s}", (int)strcspn(key, "}"), key);
  else if (value->part)
    include_fill(value->part, name, values, out);
  else if (value->text && value->write)
    value->write(value->text, out);
  else if (value->text)
    fputs(value->text, out);
  else if (value->print)
    value->print(value->of, out);
  else
    put_number(key, value, out);
}

/* Where a line goes on after its `@{if key}`: there, at its end, or after its end. */
static const char *after_if(const char *at, bool starts, const struct include_value *values) {
  if (is_given(find(values, at + 5))) return strchr(at, '}') + 1;
  return at + strcspn(at, "\n") + starts;
}

void include_fill(const char *template, const char *name, const struct include_value *values,
                  FILE *out) {
  bool ended = false; /* a line whose end is not yet written */
  for (const char *c = template; *c;) {
    if (!strncmp(c, "@{if ", 5)) {
      c = after_if(c, c == template || c[-1] == '\n', values);
      continue;
    }
    if (ended) putc('\n', out);
    ended = *c == '\n';
    if (*c == '@' && c[1] == '{') {
      put_value(c + 2, name, values, out);
      c += strcspn(c, "}");
    } else if (*c == '@') {
      fputs(name, out);
    } else if (!ended) {
      putc(*c, out);
    }
    ++c;
  }
}
