#include "bake/bake_channels.h"

#include <stdlib.h>
#include <string.h>

enum result bake_channels_pages(const struct lamp *lamp, struct slab **pages, int *count,
                                struct error *error) {
  int channels = lamp->channel_count ? lamp->channel_count : 1, all = channels * lamp->slab_count;
  *count = 0;
  *pages = calloc((size_t)all, sizeof **pages);
  if (!*pages) return result_no_memory(error);
  for (int n = 0; n < all; ++n) {
    struct slab *page = &(*pages)[n];
    enum result result = slab_copy_geometry(&lamp->slabs[n % lamp->slab_count], page, error);
    if (result != RESULT_OK) return result;
    ++*count;
    if (lamp->channel_count)
      memcpy(page->channel, lamp->channels[n / lamp->slab_count].name, sizeof page->channel);
  }
  return RESULT_OK;
}
