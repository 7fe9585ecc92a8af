/* lamp_declared.c - what a script declares, as canned.inc writes it down: a key and its value
 * a line. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/sdl.h"
#include "lamp/lamp.h"

/* A script that declares more is in a loop. */
enum { MOST_SLABS = 4096 };

/* Numbers as canned.inc writes them: mantissa and binary exponent. */
static bool read_numbers(const char *text, int count, double *numbers) {
  for (int n = 0; n < count; ++n) {
    char *end;
    double mantissa = strtod(text, &end);
    if (end == text) return false;
    text = end;
    long exponent = strtol(text, &end, 10);
    if (end == text || exponent < -8192 || exponent > 8192) return false;
    text = end;
    numbers[n] = ldexp(mantissa, (int)exponent);
  }
  return true;
}

static bool read_text(const char *value, char *text, size_t size) {
  size_t length = strlen(value);
  if (length < size) memcpy(text, value, length + 1);
  return length < size;
}

/* The script, as far as it is read. */
struct reading {
  struct lamp *lamp;
  struct slab common;           /* what all slabs share */
  struct lamp_channel *channel; /* to which bulbs belong now; NULL: none was declared */
};

/* A bulb may be too small for the trial run's rays to hit. */
static bool read_bulb(const char *value, struct reading *reading) {
  double rgb[3];
  struct lamp *lamp = reading->lamp;
  if (!read_numbers(value, 3, rgb)) return false;
  ++lamp->bulbs;
  if (reading->channel) ++reading->channel->bulbs;
  for (int c = 0; c < 3; ++c) lamp->peak = fmax(lamp->peak, fabs(rgb[c]));
  return true;
}

static bool add_flux(const char *value, double flux[3]) {
  double rgb[3];
  if (!read_numbers(value, 3, rgb)) return false;
  for (int c = 0; c < 3; ++c) flux[c] += rgb[c];
  return true;
}

/* What gives light in a channel, a bulb told by its flux: Canned_Lit tells nothing else. */
static bool count_light(struct reading *reading) {
  if (reading->channel) ++reading->channel->lights;
  return true;
}

/* Keys of the lamp as a whole. */
static bool read_of_lamp(const char *key, const char *value, struct reading *reading) {
  struct lamp *lamp = reading->lamp;
  struct slab *common = &reading->common;
  if (!strcmp(key, "lamp")) return read_text(value, common->name, sizeof common->name);
  if (!strcmp(key, "radiance_unit"))
    return read_text(value, common->radiance_unit, sizeof common->radiance_unit);
  if (!strcmp(key, "metres_per_unit")) return read_numbers(value, 1, &common->metres_per_unit);
  if (!strcmp(key, "bulb")) return read_bulb(value, reading);
  if (!strcmp(key, "bulb_flux")) return count_light(reading) && add_flux(value, lamp->bulb_flux);
  if (!strcmp(key, "glow_flux")) return count_light(reading) && add_flux(value, lamp->glow_flux);
  if (!strcmp(key, "lit")) return count_light(reading);
  if (!strcmp(key, "final_window")) return lamp->final_window = true;
  if (strcmp(key, "needs") != 0) return false;
  lamp->needs_declared = true;
  return read_text(value, lamp->needs, sizeof lamp->needs);
}

/* Keys of the latest "slab". */
static bool read_of_slab(const char *key, const char *value, struct slab *slab) {
  const struct {
    const char *key;
    int count;
    double *numbers;
  } known[] = {
      {"center", 3, slab->center},        {"u", 3, slab->u},         {"v", 3, slab->v},
      {"normal", 3, slab->normal},        {"s", 2, slab->st_window}, {"t", 2, slab->st_window + 2},
      {"distance", 1, &slab->st_distance}};
  for (size_t k = 0; k < sizeof known / sizeof *known; ++k)
    if (!strcmp(key, known[k].key)) return read_numbers(value, known[k].count, known[k].numbers);
  return false;
}

static enum result add_slab(struct lamp *lamp, struct error *error) {
  if (lamp->slab_count == MOST_SLABS)
    return result_fail(error, RESULT_BAD, "declares more than %d slabs", MOST_SLABS);
  struct slab *grown = realloc(lamp->slabs, (size_t)(lamp->slab_count + 1) * sizeof *grown);
  if (!grown) return result_no_memory(error);
  lamp->slabs = grown;
  grown[lamp->slab_count++] = slab_default();
  return RESULT_OK;
}

/* From here on bulbs belong to the channel of this name. */
static enum result enter_channel(const char *name, struct reading *reading, struct error *error) {
  struct lamp *lamp = reading->lamp;
  int n = 0;
  enum result result = sdl_check_identifier(name, SLAB_CHANNEL_SIZE - 1, error);
  if (result != RESULT_OK) return result_at(result, error, "Canned_Channel");
  while (n < lamp->channel_count && strcasecmp(lamp->channels[n].name, name) != 0) ++n;
  if (n == LAMP_MAX_CHANNELS)
    return result_fail(error, RESULT_BAD, "Canned_Channel(\"%s\"): more than %d channels", name,
                       LAMP_MAX_CHANNELS);
  reading->channel = &lamp->channels[n];
  if (n == lamp->channel_count) {
    strcpy(reading->channel->name, name);
    ++lamp->channel_count;
  }
  if (!strcmp(reading->channel->name, name)) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "Canned_Channel(\"%s\"): differs from \"%s\" in capitals only, which an "
                     "include cannot tell apart; choose another name",
                     name, reading->channel->name);
}

static enum result read_line(char *line, struct reading *reading, struct error *error) {
  static const char channel[] = "channel ";
  struct lamp *lamp = reading->lamp;
  if (!strcmp(line, "slab")) return add_slab(lamp, error);
  if (!strncmp(line, channel, strlen(channel)))
    return enter_channel(line + strlen(channel), reading, error);
  char *value = strchr(line, ' ');
  if (value) {
    *value = 0;
    struct slab *slab = lamp->slab_count ? &lamp->slabs[lamp->slab_count - 1] : NULL;
    if (read_of_lamp(line, value + 1, reading) || (slab && read_of_slab(line, value + 1, slab)))
      return RESULT_OK;
    *value = ' ';
  }
  return result_fail(
      error, RESULT_BAD,
      "canned.inc said \"%s\", which this bakeslab does not know; use the canned.inc "
      "that came with it",
      line);
}

/* Fills in what all slabs share, and checks them. */
static enum result finish(struct lamp *lamp, const struct slab *common, struct error *error) {
  if (!lamp->slab_count)
    return result_fail(error, RESULT_BAD,
                       "declares no slab; it must #include \"canned.inc\" and call Canned_Slab");
  if (!common->name[0])
    return result_fail(error, RESULT_BAD, "has no name; call Canned_Lamp(\"name\")");
  for (int n = 0; n < lamp->channel_count; ++n)
    if (!lamp->channels[n].lights)
      return result_fail(error, RESULT_BAD,
                         "Canned_Channel(\"%s\"): nothing after it gives light; add a Canned_Bulb "
                         "(or emission by Canned_Lit), or leave the channel out",
                         lamp->channels[n].name);
  for (int n = 0; n < lamp->slab_count; ++n) {
    struct slab *slab = &lamp->slabs[n];
    memcpy(slab->name, common->name, sizeof slab->name);
    memcpy(slab->radiance_unit, common->radiance_unit, sizeof slab->radiance_unit);
    slab->metres_per_unit = common->metres_per_unit;
    if (slab->st_distance == 0) slab->st_distance = INFINITY;
    double length = hypot(hypot(slab->normal[0], slab->normal[1]), slab->normal[2]);
    for (int axis = 0; axis < 3; ++axis) slab->normal[axis] /= length;
    enum result result = slab_check(slab, error);
    if (result != RESULT_OK) return result_at(result, error, "Canned_Slab %d", n + 1);
  }
  return RESULT_OK;
}

enum result lamp_declarations(char *text, const char *script, struct lamp *lamp,
                              struct error *error) {
  struct reading reading = {.lamp = lamp, .common = slab_default()};
  enum result result = RESULT_OK;
  for (char *line; result == RESULT_OK && (line = strsep(&text, "\n"));)
    if (*line) result = read_line(line, &reading, error);
  if (result == RESULT_OK) result = finish(lamp, &reading.common, error);
  return result_at(result, error, "%s", script);
}
