/* include_light.c - see include_light.h. */
#include "include/text/include_light.h"

#include <math.h>

double include_peak(const struct slab *slab) {
  double peak = 0;
  size_t values = 3 * slab_sample_count(slab);
  for (size_t k = 0; k < values; ++k) peak = fmax(peak, slab->rgb[k]);
  return peak;
}

enum result include_check_radiance(const struct slab *slab, int page, struct error *error) {
  size_t values = 3 * slab_sample_count(slab), k = 0;
  int at[SLAB_AXES];
  while (k < values && !(slab->rgb[k] < 0)) ++k;
  if (k == values) return RESULT_OK;
  slab_locate(slab, k / 3, at);
  return result_fail(error, RESULT_BAD,
                     "page %d: radiance %g of sample (%d, %d, %d, %d) is negative, which a filter "
                     "before a light cannot show; give include a slab without negative light",
                     page + 1, (double)slab->rgb[k], at[SLAB_U], at[SLAB_V], at[SLAB_S],
                     at[SLAB_T]);
}

enum result include_no_light(struct error *error) {
  return result_fail(error, RESULT_BAD, "all radiance is zero: the lamp gives no light");
}
