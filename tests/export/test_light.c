/* test_light.c - the irradiance that other renderers, where they are installed, get from exported
 * lamps, against renderslab's reference: 16x16 receivers one unit before the first page. SETTING in
 * the environment is another setting than the one that the exports ask for, samples or options of
 * rtrace, and ENGINE the only one to ask: then 32x32, and the error is only told, for the tables of
 * `make bench`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "lamps.h"
#include "testing.h"

enum { MOST = 32 * 32 };
static double receivers[MOST][6], there[MOST][6], wanted[MOST][3], got[MOST][3];

/* Receivers along an edge. */
static int side(void) {
  return getenv("SETTING") ? 32 : 16;
}

/* The receivers, in lamp space and in the engine's, and what they are to have. The slab's file. */
static const char *prepare(const struct lamp *lamp,
                           void (*turn)(const double lamp[3], double there[3])) {
  struct slab pages[LAMP_PAGES];
  char command[512];
  const char *path = lamp_write(lamp, pages);
  lamp_receivers(&pages[0], 1, side(), receivers);
  lamp_free(pages);
  for (int k = 0; k < side() * side(); ++k)
    for (int c = 0; c < 6; c += 3) turn(receivers[k] + c, there[k] + c);
  snprintf(command, sizeof command, "'%s' irradiance --light '%s' --method reference",
           getenv("RENDERSLAB"), path);
  lamp_run(command, receivers[0], 6, side() * side(), wanted);
  return path;
}

static const char *setting(const char *asked) {
  const char *given = getenv("SETTING");
  return given ? given : asked;
}

static bool asked_for(enum engine engine, const char *name) {
  const char *only = getenv("ENGINE");
  return (!only || !strcmp(only, name)) && engine_there(engine);
}

static void check(const struct lamp *lamp, const char *by, const char *asked, double seconds) {
  double off = lamp_rms(got, wanted, side() * side());
  print_message("# %s: irradiance by %s, %s: %.2f %% in %.1f s\n", lamp->name, by, setting(asked),
                100 * off, seconds);
  if (!getenv("SETTING") && !(off < 0.01)) fail_msg("%s: irradiance %g off", lamp->name, off);
}

TEST(radiance) {
  static const char asked[] = "-ds 0.01 -dj 0 -dt 0 -dc 1";
  if (!asked_for(RADIANCE, "radiance")) skip();
  for (int n = 0; n < lamp_count; ++n) {
    char scene[256], options[256];
    const char *folder = lamp_export(prepare(&lamps[n], lamp_z_up), "out", "--as radiance");
    snprintf(scene, sizeof scene, "!xform %s.rad", lamps[n].name);
    snprintf(options, sizeof options, "-I %s", setting(asked));
    double seconds = engine_radiance(folder, scene, options, there, side() * side(), got);
    for (int k = 0; k < 3 * side() * side() && !strcmp(lamps[n].unit, "cd/m2"); ++k)
      got[k / 3][k % 3] *= 179; /* lm/W */
    check(&lamps[n], "Radiance", asked, seconds);
  }
}

TEST(mitsuba) {
  static const char asked[] = "samples=256";
  if (!asked_for(MITSUBA, "mitsuba")) skip();
  for (int n = 0; n < lamp_count; ++n) {
    char more[256];
    const char *folder = lamp_export(prepare(&lamps[n], lamp_y_up), "out", "--as mitsuba");
    snprintf(more, sizeof more, "irradiance %s", setting(asked));
    double seconds = engine_mitsuba(folder, lamps[n].name, more, there, side() * side(), got);
    check(&lamps[n], "Mitsuba", asked, seconds);
  }
}

/* Cycles spreads its samples over the whole aperture, of which the narrow window shows a receiver a
 * hundredth. */
TEST(cycles) {
  if (!asked_for(BLENDER, "cycles")) skip();
  for (int n = 0; n < lamp_count; ++n) {
    char more[256];
    const char *asked = strcmp(lamps[n].name, "narrow") ? "256" : "8192";
    const char *folder = lamp_export(prepare(&lamps[n], lamp_z_up), "out", "--as cycles");
    snprintf(more, sizeof more, "%d %s", side(), setting(asked));
    double seconds = engine_blender("blender_floor.py", folder, lamps[n].name, more, there,
                                    side() * side(), got);
    check(&lamps[n], "Cycles", asked, seconds);
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
