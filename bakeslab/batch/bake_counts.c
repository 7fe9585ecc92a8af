#include "batch/bake_counts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "povray/povray_log.h"

/* POV-Ray says nothing of photons that miss their targets, and their light is lost. Where nobody
 * named the effect, a lamp without targets loses nothing. */
static void check_photons(struct bake_counts *counts, const struct effects *effects,
                          const char *directory) {
  enum { TOO_FEW = 1000 };
  if (!effects->setting[CAUSTICS]) return;
  double shot = fmax(0, povray_statistic(directory, "Number of photons shot:"));
  double stored = fmax(0, povray_statistic(directory, "Surface photons stored:"));
  if (shot >= TOO_FEW && stored > 0) return;
  if (!effects->named && (shot == 0 || shot >= TOO_FEW)) return;
  snprintf(counts->photons_lost, sizeof counts->photons_lost,
           "POV-Ray shot %.0f photons and stored %.0f", shot, stored);
}

/* Whether there is something in the batch's channel to shoot photons. */
static bool has_bulbs(const struct bake_counts *counts, const struct bake_round *round,
                      size_t batch) {
  const struct bake_unit *unit = &round->units[round->batches[batch].first];
  const char *name = counts->slabs[round->boxes[unit->box].page].channel;
  const struct lamp *lamp = counts->lamp;
  for (int n = 0; n < lamp->channel_count; ++n)
    if (!strcmp(lamp->channels[n].name, name)) return lamp->channels[n].bulbs > 0;
  return true;
}

void bake_counts_add(struct bake_counts *counts, const struct bake_round *round, size_t batch,
                     const char *directory) {
  static const char *const labels[] = {"Rays:", "Shadow Ray Tests:", "Number of photons shot:"};
  for (size_t n = 0; n < sizeof labels / sizeof *labels; ++n)
    counts->traced += fmax(0, povray_statistic(directory, labels[n]));
  counts->traced_cpu += povray_log_cpu(directory);
  counts->depth = fmax(counts->depth, povray_statistic(directory, "Max Level:"));
  if (has_bulbs(counts, round, batch)) check_photons(counts, counts->effects, directory);
}

void bake_counts_report(const struct bake_counts *counts, struct bake_report *report) {
  report->traced += counts->traced;
  report->traced_cpu += counts->traced_cpu;
  if (report->depth < counts->depth) report->depth = (int)counts->depth;
  if (counts->photons_lost[0])
    memcpy(report->photons_lost, counts->photons_lost, sizeof report->photons_lost);
}
