#include "import/rays/ray_range.h"

#include <math.h>
#include <stdlib.h>

static const double margin = 0.005; /* of the range, at each end */

static int ascending(const void *left, const void *right) {
  const struct ray_weighed *a = left, *b = right;
  return (a->value > b->value) - (a->value < b->value);
}

void ray_range(struct ray_weighed *values, size_t count, double negligible, double much_longer,
               double range[2]) {
  double all = 0, below = 0, above = 0;
  size_t low = 0, high = count - 1;
  qsort(values, count, sizeof *values, ascending);
  for (size_t n = 0; n < count; ++n) all += values[n].flux;
  while (low < high && below + values[low].flux <= negligible * all) below += values[low++].flux;
  while (high > low && above + values[high].flux <= negligible * all) above += values[high--].flux;
  range[0] = values[low].value;
  range[1] = values[high].value;
  double whole = values[count - 1].value - values[0].value;
  if (whole <= much_longer * (range[1] - range[0])) {
    range[0] = values[0].value;
    range[1] = values[count - 1].value;
  }
  double wider = margin * (range[1] - range[0]), middle = (range[0] + range[1]) / 2;
  range[0] -= wider;
  range[1] += wider;
  if (fabs(middle) < 5 * wider) { /* as good as even: make it so */
    range[1] = fmax(-range[0], range[1]);
    range[0] = -range[1];
  }
}
