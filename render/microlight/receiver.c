#include "microlight/receiver.h"

#include <math.h>

void gather_counts_add(struct gather_counts *sum, const struct gather_counts *counts) {
  sum->receivers += counts->receivers;
  sum->microlights += counts->microlights;
  sum->nodes += counts->nodes;
  sum->black += counts->black;
  sum->shadow_rays += counts->shadow_rays;
  sum->open_views += counts->open_views;
  sum->pages_behind += counts->pages_behind;
  sum->error = fmax(sum->error, counts->error);
}
