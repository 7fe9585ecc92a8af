/* test_radiance.c - lamps for Radiance: rays into them against `bakeslab lookup`, by a reader of
 * the files that knows Radiance's formulas alone (rad.h), and by Radiance's own rtrace where it is
 * installed, which the export's polygons and transforms are then tried with, too. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "lamps.h"
#include "oracle/random.h"
#include "rad.h"
#include "testing.h"

enum { RAYS = 4000 };
static const double close = 1e-5;

/* cd/m2 are 1/179 W/(sr m2) there. */
static double watts(const struct lamp *lamp) {
  return strcmp(lamp->unit, "cd/m2") ? 1 : 1.0 / 179;
}

/* Rays out of the lamp, and the same in Radiance, looking into it. */
static void make_rays(const struct lamp *lamp, const struct slab *pages, double (*rays)[6],
                      double (*looking)[6]) {
  uint64_t seed = 77;
  for (int k = 0; k < RAYS; ++k) {
    double back[3];
    lamp_ray(lamp, pages, &seed, rays[k]);
    for (int c = 0; c < 3; ++c) {
      rays[k][c] += 2 * rays[k][3 + c]; /* in front of the aperture */
      back[c] = -rays[k][3 + c];
    }
    lamp_z_up(rays[k], looking[k]);
    lamp_z_up(back, looking[k] + 3);
  }
}

static double rays[RAYS][6], looking[RAYS][6], wanted[RAYS][3], got[RAYS][3];

/* The lamp's rays, and what they are to see. The folder with the export. */
static const char *prepare(const struct lamp *lamp, const char *arguments) {
  struct slab pages[LAMP_PAGES];
  char whole[256];
  const char *path = lamp_write(lamp, pages);
  make_rays(lamp, pages, rays, looking);
  lamp_free(pages);
  lamp_lookup(path, rays, RAYS, wanted);
  int lit = 0;
  for (int k = 0; k < RAYS; ++k) {
    lit += wanted[k][0] > 0;
    for (int c = 0; c < 3; ++c) wanted[k][c] *= watts(lamp);
  }
  assert_true(lit > RAYS / 2 && lit < RAYS);
  snprintf(whole, sizeof whole, "--as radiance %s", arguments);
  return lamp_export(path, "radiance", whole);
}

static void check(const struct lamp *lamp, const char *by) {
  double worst = lamp_worst(wanted, got, RAYS) / watts(lamp);
  print_message("# %s: rays by %s: %.1e\n", lamp->name, by, worst);
  if (!(worst < close)) fail_msg("%s: %g off", lamp->name, worst);
}

TEST(rays_by_the_text) {
  for (int n = 0; n < lamp_count; ++n) {
    const char *folder = prepare(&lamps[n], "--polygons 3x2");
    struct rad *rad = rad_read(folder, lamps[n].name);
    for (int k = 0; k < RAYS; ++k) rad_ray(rad, looking[k], looking[k] + 3, got[k]);
    rad_free(rad);
    check(&lamps[n], "the text");
  }
}

TEST(rays_by_rtrace) {
  if (!engine_there(RADIANCE)) skip();
  for (int n = 0; n < lamp_count; ++n) {
    char scene[256];
    const char *folder = prepare(&lamps[n], "--polygons 3x2");
    snprintf(scene, sizeof scene, "!xform %s.rad", lamps[n].name);
    engine_radiance(folder, scene, "", looking, RAYS, got);
    check(&lamps[n], "rtrace");
  }
}

/* In lamp space, as POV-Ray's `rotate <30, -20, 50> scale 2.5 translate <1, 2, 3>`, first mirrored
 * in x or not: about x, y and z in turn, left-handed, y to z, z to x, x to y. */
static void place(double at[3], bool point, bool mirror) {
  static const double degrees[3] = {30, -20, 50};
  if (mirror) at[0] = -at[0];
  for (int axis = 0; axis < 3; ++axis) {
    double angle = degrees[axis] * acos(-1) / 180;
    double *from = &at[(axis + 1) % 3], *to = &at[(axis + 2) % 3], old = *from;
    *from = cos(angle) * old - sin(angle) * *to;
    *to = sin(angle) * old + cos(angle) * *to;
  }
  for (int c = 0; c < 3; ++c) at[c] = 2.5 * at[c] + (point ? c + 1 : 0);
}

/* The same placement, in POV-Ray's numbers and in xform's, by the rules of bakeslab/export. */
TEST(rays_by_rtrace_through_xform) {
  if (!engine_there(RADIANCE)) skip();
  for (int n = 0; n < 2 * lamp_count; ++n) {
    const struct lamp *lamp = &lamps[n / 2];
    bool mirror = n % 2;
    char scene[256];
    const char *folder = prepare(lamp, "--polygons 1x1");
    for (int k = 0; k < RAYS; ++k) {
      double back[3] = {-rays[k][3], -rays[k][4], -rays[k][5]};
      place(rays[k], true, mirror);
      place(back, false, mirror);
      lamp_z_up(rays[k], looking[k]);
      lamp_z_up(back, looking[k] + 3);
    }
    snprintf(scene, sizeof scene, "!xform %s -rx -30 -rz 20 -ry -50 -s 2.5 -t 1 3 2 %s.rad",
             mirror ? "-mx" : "", lamp->name);
    engine_radiance(folder, scene, "", looking, RAYS, got);
    check(lamp, mirror ? "rtrace, placed and mirrored" : "rtrace, placed");
  }
}

/* In Radiance the screen is upright, too, as seen from the projector; by a reader of the files and
 * by rtrace. */
TEST(letter_reads_right) {
  double screen[LETTER_FIELDS][6], seen[2][LETTER_FIELDS][3];
  bool rtrace_too = engine_there(RADIANCE);
  const char *folder = lamp_export(lamp_letter(), "letter", "--as radiance");
  struct rad *rad = rad_read(folder, "letter");
  for (int k = 0; k < LETTER_FIELDS; ++k) {
    double place[3];
    lamp_letter_place(k, place);
    lamp_z_up(place, screen[k]);
    for (int c = 0; c < 3; ++c) screen[k][3 + c] = -screen[k][c];
    rad_ray(rad, screen[k], screen[k] + 3, seen[0][k]);
  }
  rad_free(rad);
  if (rtrace_too) engine_radiance(folder, "!xform letter.rad", "", screen, LETTER_FIELDS, seen[1]);
  for (int way = 0; way < 1 + rtrace_too; ++way)
    for (int k = 0; k < LETTER_FIELDS; ++k)
      for (int c = 0; c < 3; ++c) assert_near(seen[way][k][c], lamp_letter_is_lit(k), 1e-5);
}

int main(void) {
  return testing_run(NULL, NULL);
}
