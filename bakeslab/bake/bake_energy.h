/* bake_energy.h - weighs a lamp's light: what its bulbs and glowing things give, what leaves
 * through its pages, and what these miss.
 *
 * Beside the bake, two small ones more: without bulbs, which shows what else gives light, and
 * around the pages, which shows what passes beside them or beyond their windows. */
#ifndef BAKE_ENERGY_H
#define BAKE_ENERGY_H

#include "bake/bake_planes.h"
#include "probe/probe_bake.h"

enum { BAKE_ENERGY_LINE = 256 };

/* Fluxes are r, g, b in units of radiance and lamp units squared. */
struct bake_energy {
  double sources[3]; /* of Canned_Bulb's, and of Canned_Glow's */
  double dark[3];    /* through the pages without the bulbs */
  double window[3];  /* passes through an aperture beyond its window, and through no page */
  double beside[3];  /* passes through no aperture */
  double pages[3];   /* through the pages, each ray once */
  double efficiency; /* pages over sources, in luminance; NAN: not known */
  double missed;     /* window and beside, as a part of all light that leaves; in luminance;
 NAN: not known */
  char line[BAKE_ENERGY_LINE]; /* all that in words */
};

/* The two small bakes; all owned. */
struct bake_energy_bakes {
  struct lamp lamp; /* the work's, with the planes for pages; owns nothing */
  struct bake_planes planes;
  struct probe_bake dark, around;
};

/* What that takes: small bakes, of a POV-Ray process each, and their rays. */
enum result bake_energy_cost(const struct bake_work *work, int *bakes, double *rays,
                             struct error *error);

/* Starts the small bakes, once the windows are known. Free them in any case; that waits for them.
 */
enum result bake_energy_start(const struct bake_work *work, struct bake_energy_bakes *bakes,
                              struct error *error);
void bake_energy_free(struct bake_energy_bakes *bakes);

/* Waits for them, weighs the finished `pages`, those of all channels, and warns in the report where
 * the lamp gives more light than its bulbs, beyond the noise of the bake, or where the pages miss
 * light. */
enum result bake_energy(const struct bake_work *work, const struct slab *pages, int count,
                        const struct bake_noise *noise, struct bake_energy_bakes *bakes,
                        struct bake_energy *energy, struct bake_report *report,
                        struct error *error);

#endif
