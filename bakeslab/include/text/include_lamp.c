#include "include/text/include_lamp.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const uint64_t include_hash_start = 14695981039346656037u;

/* POV-Ray takes light colours up to here. */
static const double largest_colour = 1e37;

double include_luminance(const double rgb[3]) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

double include_peak(const struct slab *slab) {
  double peak = 0;
  size_t values = 3 * slab_sample_count(slab);
  for (size_t k = 0; k < values; ++k) peak = fmax(peak, slab->rgb[k]);
  return peak;
}

static enum result check_radiance(const struct slab *slab, int page, struct error *error) {
  size_t k = slab_negative(slab);
  int at[SLAB_AXES];
  if (k == 3 * slab_sample_count(slab)) return RESULT_OK;
  slab_locate(slab, k / 3, at);
  return result_fail(error, RESULT_BAD,
                     "page %d: radiance %g of sample (%d, %d, %d, %d) is negative, which a filter "
                     "before a light cannot show; give include a slab without negative light",
                     page + 1, (double)slab->rgb[k], at[SLAB_U], at[SLAB_V], at[SLAB_S],
                     at[SLAB_T]);
}

struct slab include_frame(const struct slab *slab) {
  struct slab frame = *slab;
  frame.rgb = NULL;
  frame.json = NULL;
  return frame;
}

int include_channel(const struct include_lamp *lamp, const struct slab *page) {
  int n = 0;
  if (!*page->channel) return 0;
  while (n < lamp->channel_count && strcmp(lamp->channels[n], page->channel) != 0) ++n;
  return n + 1;
}

/* Adds the page's channel to the lamp's. */
static enum result add_channel(const struct slab *page, int number, struct include_lamp *lamp,
                               struct error *error) {
  char capitalised[2][SDL_IDENTIFIER_SIZE];
  if (include_channel(lamp, page) <= lamp->channel_count) return RESULT_OK;
  if (lamp->channel_count == INCLUDE_CHANNELS)
    return result_fail(error, RESULT_BAD, "it has more than %d channels", INCLUDE_CHANNELS);
  enum result result = sdl_capitalise(page->channel, capitalised[0], error);
  for (int n = 0; n < lamp->channel_count && result == RESULT_OK; ++n)
    if (sdl_capitalise(lamp->channels[n], capitalised[1], error) == RESULT_OK &&
        !strcmp(capitalised[0], capitalised[1]))
      result = result_fail(error, RESULT_BAD, "\"%s\" and \"%s\" differ in capitals only",
                           page->channel, lamp->channels[n]);
  if (result != RESULT_OK) return result_at(result, error, "page %d: its channel", number + 1);
  strcpy(lamp->channels[lamp->channel_count++], page->channel);
  return RESULT_OK;
}

enum result include_lit_pages(const struct slab *slabs, int count, struct include_lamp *lamp,
                              const struct slab ***lit, int *lit_count, struct error *error) {
  *lit_count = 0;
  *lit = calloc((size_t)count, sizeof **lit);
  if (!*lit) return result_no_memory(error);
  for (int k = 0; k < count; ++k) {
    enum result result = check_radiance(&slabs[k], k, error);
    if (result == RESULT_OK) result = add_channel(&slabs[k], k, lamp, error);
    if (result != RESULT_OK) return result;
    if (!(include_peak(&slabs[k]) > 0)) continue;
    (*lit)[(*lit_count)++] = &slabs[k];
    double flux[3];
    result = slab_flux(&slabs[k], flux, error);
    if (result != RESULT_OK) return result;
    lamp->flux += include_luminance(flux);
  }
  if (!*lit_count)
    return result_fail(error, RESULT_BAD, "all radiance is zero: the lamp gives no light");
  lamp->frame = include_frame((*lit)[0]);
  lamp->black_pages = count - *lit_count;
  return RESULT_OK;
}

enum result include_check_colour(double colour, int page, struct error *error) {
  char where[32] = "";
  if (colour <= largest_colour) return RESULT_OK;
  if (page >= 0) snprintf(where, sizeof where, "page %d: ", page + 1);
  return result_fail(error, RESULT_BAD,
                     "%sit is brighter than POV-Ray's light colours hold (1e37); use a larger "
                     "radiance unit",
                     where);
}

uint64_t include_hash(uint64_t hash, const void *bytes, size_t count) {
  const unsigned char *byte = bytes;
  for (size_t k = 0; k < count; ++k) hash = (hash ^ byte[k]) * 1099511628211u;
  return hash;
}
