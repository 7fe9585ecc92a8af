#include "cmd/receiver_text.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/numbers.h"
#include "base/vector.h"

void receiver_text_free(struct receivers *receivers) {
  free(receivers->receiver);
  free(receivers->order);
  *receivers = (struct receivers){0};
}

static enum result add(struct receivers *receivers, const char *line, struct error *error) {
  double numbers[6];
  unsigned long long number = receivers->line;
  const char *end = numbers_read(line, ' ', 6, numbers);
  if (!end || end[strspn(end, NUMBERS_BLANKS)])
    return result_fail(
        error, RESULT_BAD,
        "stdin: line %llu: is not a receiver `px py pz nx ny nz` of six finite numbers", number);
  struct receiver *receiver = &receivers->receiver[receivers->count++];
  *receiver = (struct receiver){.index = receivers->index++};
  memcpy(receiver->position, numbers, sizeof receiver->position);
  memcpy(receiver->normal, numbers + 3, sizeof receiver->normal);
  if (!vector_normalise(receiver->normal))
    return result_fail(error, RESULT_BAD, "stdin: line %llu: the normal has no direction", number);
  memcpy(receiver->lift, receiver->normal, sizeof receiver->lift);
  return RESULT_OK;
}

/* Ten bits, each followed by two zeros. */
static uint32_t spread(uint32_t bits) {
  bits = (bits | bits << 16) & 0x30000ff;
  bits = (bits | bits << 8) & 0x300f00f;
  bits = (bits | bits << 4) & 0x30c30c3;
  return (bits | bits << 2) & 0x9249249;
}

struct place {
  uint32_t key;
  int index;
};

static int compare(const void *left, const void *right) {
  const struct place *a = left, *b = right;
  if (a->key != b->key) return a->key < b->key ? -1 : 1;
  return (a->index > b->index) - (a->index < b->index);
}

/* Orders the receivers along a Z curve through their box. */
static enum result sort(struct receivers *receivers, struct error *error) {
  double low[3], high[3];
  struct place *places = malloc(((size_t)receivers->count + 1) * sizeof *places);
  if (!places) return result_no_memory(error);
  vector_box(low, high);
  for (int k = 0; k < receivers->count; ++k)
    vector_widen(low, high, receivers->receiver[k].position);
  double size = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
  for (int k = 0; k < receivers->count; ++k) {
    places[k] = (struct place){0, k};
    for (int c = 0; c < 3 && size > 0 && isfinite(size); ++c) {
      double share = (receivers->receiver[k].position[c] - low[c]) / size;
      places[k].key |= spread((uint32_t)(share * 1023)) << c;
    }
  }
  qsort(places, (size_t)receivers->count, sizeof *places, compare);
  for (int k = 0; k < receivers->count; ++k) receivers->order[k] = places[k].index;
  free(places);
  return RESULT_OK;
}

enum result receiver_text_read(FILE *in, int most, struct receivers *receivers,
                               struct error *error) {
  if (receivers->room < most) {
    receivers->receiver = calloc((size_t)most, sizeof *receivers->receiver);
    receivers->order = calloc((size_t)most, sizeof *receivers->order);
    if (!receivers->receiver || !receivers->order) return result_no_memory(error);
    receivers->room = most;
  }
  enum result result = RESULT_OK;
  char *line = NULL;
  size_t room = 0;
  receivers->count = 0;
  while (result == RESULT_OK && receivers->count < most) {
    if (getline(&line, &room, in) < 0) {
      if (!feof(in)) result = result_fail(error, RESULT_IO, "stdin: %s", strerror(errno));
      break;
    }
    ++receivers->line;
    const char *start = line + strspn(line, NUMBERS_BLANKS);
    if (*start && *start != '#') result = add(receivers, start, error);
  }
  free(line);
  return result == RESULT_OK ? sort(receivers, error) : result;
}
