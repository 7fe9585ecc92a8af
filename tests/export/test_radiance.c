/* test_radiance.c - lamps for Radiance: rays into them against `bakeslab lookup`, by a reader of
 * the files that knows Radiance's formulas alone (rad.h), and by Radiance's own rtrace where it is
 * installed, which the export's polygons, transforms and sums are then tried with, too. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lamps.h"
#include "oracle/random.h"
#include "rad.h"
#include "testing.h"

enum { RAYS = 4000, SIDE = 8, RECEIVERS = SIDE * SIDE };
static const double close = 1e-5;
static const char rtrace[] = "rtrace -h -ab 0 -ds 0.01 -dj 0 -dt 0 -dc 1";

/* A lamp point or vector in Radiance's space. */
static void to_radiance(const double lamp[3], double radiance[3]) {
  radiance[0] = lamp[0];
  radiance[1] = lamp[2];
  radiance[2] = lamp[1];
}

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
    to_radiance(rays[k], looking[k]);
    to_radiance(back, looking[k] + 3);
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

static bool have_rtrace(void) {
  return system("for p in rtrace oconv xform; do command -v $p || exit 1; done >/dev/null") == 0;
}

/* Runs rtrace in the folder on a scene of one line. */
static void trace(const char *folder, const char *scene, const char *options, double (*rows)[6],
                  int count, double (*rgb)[3]) {
  char command[1024];
  snprintf(command, sizeof command, "cd '%s' && echo '%s' | oconv - >scene.oct && %s %s scene.oct",
           folder, scene, rtrace, options);
  lamp_run(command, rows[0], 6, count, rgb);
}

TEST(rays_by_the_text) {
  for (int n = 0; n < lamp_count; ++n) {
    const char *folder = prepare(&lamps[n], "--polygons 3x2");
    struct rad *rad = rad_read(folder, lamps[n].name);
    for (int k = 0; k < RAYS; ++k) rad_ray(rad, looking[k], looking[k] + 3, got[k]);
    rad_free(rad);
    double worst = lamp_worst(wanted, got, RAYS);
    if (!(worst < close * watts(&lamps[n]))) fail_msg("%s: %g off", lamps[n].name, worst);
  }
}

TEST(rays_by_rtrace) {
  if (!have_rtrace()) skip();
  for (int n = 0; n < lamp_count; ++n) {
    char scene[256];
    const char *folder = prepare(&lamps[n], "--polygons 3x2");
    snprintf(scene, sizeof scene, "!xform %s.rad", lamps[n].name);
    trace(folder, scene, "", looking, RAYS, got);
    double worst = lamp_worst(wanted, got, RAYS);
    if (!(worst < close * watts(&lamps[n]))) fail_msg("%s: %g off", lamps[n].name, worst);
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
  if (!have_rtrace()) skip();
  for (int n = 0; n < 2 * lamp_count; ++n) {
    const struct lamp *lamp = &lamps[n / 2];
    bool mirror = n % 2;
    char scene[256];
    const char *folder = prepare(lamp, "--polygons 1x1");
    for (int k = 0; k < RAYS; ++k) {
      double back[3] = {-rays[k][3], -rays[k][4], -rays[k][5]};
      place(rays[k], true, mirror);
      place(back, false, mirror);
      to_radiance(rays[k], looking[k]);
      to_radiance(back, looking[k] + 3);
    }
    snprintf(scene, sizeof scene, "!xform %s -rx -30 -rz 20 -ry -50 -s 2.5 -t 1 3 2 %s.rad",
             mirror ? "-mx" : "", lamp->name);
    trace(folder, scene, "", looking, RAYS, got);
    double worst = lamp_worst(wanted, got, RAYS);
    if (!(worst < close * watts(lamp))) fail_msg("%s: %g off", lamp->name, worst);
  }
}

/* A projector shines along lamp space's z, its picture upright as it is seen from there. In
 * Radiance that is y, z is up, and the right hand of somebody who looks along y is y x z = x. */
TEST(letter_reads_right) {
  static const char *const letter[5] = {"####.", "#....", "###..", "#....", "#...."};
  static const double forward[3] = {0, 1, 0}, up[3] = {0, 0, 1};
  char command[1024];
  const char *image = scratch("letter.ppm"), *slab = scratch("letter.exr");
  FILE *file = fopen(image, "w");
  assert_non_null(file);
  fprintf(file, "P3\n5 5\n255\n");
  for (int k = 0; k < 25; ++k)
    fputs(letter[k / 5][k % 5] == '#' ? "255 255 255\n" : "0 0 0\n", file);
  assert_int_equal(fclose(file), 0);
  snprintf(command, sizeof command,
           "'%s' projector '%s' -o '%s' --uv 2 --aperture 0.1 --focus 3 --width 2",
           getenv("BAKESLAB"), image, slab);
  assert_int_equal(system(command), 0);
  struct rad *rad = rad_read(lamp_export(slab, "letter", "--as radiance"), "letter");
  for (int k = 0; k < 25; ++k) {
    double screen[3], back[3], rgb[3], right = (k % 5 - 2) * 0.4, high = (2 - k / 5) * 0.4;
    for (int c = 0; c < 3; ++c) {
      int y = (c + 1) % 3, z = (c + 2) % 3;
      screen[c] = 3 * forward[c] + high * up[c] + right * (forward[y] * up[z] - forward[z] * up[y]);
      back[c] = -screen[c];
    }
    rad_ray(rad, screen, back, rgb);
    for (int c = 0; c < 3; ++c) assert_near(rgb[c], letter[k / 5][k % 5] == '#', 1e-6);
  }
  rad_free(rad);
}

/* Receivers that face the first page, one unit before it, over all that its light reaches. */
static void make_receivers(const struct slab *slab, double (*lamp)[6], double (*radiance)[6]) {
  double kappa = slab_kappa(slab);
  for (int k = 0; k < RECEIVERS; ++k) {
    double at[2], cell[2] = {(k % SIDE + 0.5) / SIDE, (k / SIDE + 0.5) / SIDE};
    for (int axis = 0; axis < 2; ++axis) {
      const double *window = slab->st_window + 2 * axis;
      double edge = slab_spacing(slab, axis) * slab->samples[axis], half = (1 + kappa) * edge / 2;
      double reach = window[1] - window[0] + 2 * half;
      at[axis] = (window[0] - half + cell[axis] * reach) / edge;
    }
    for (int c = 0; c < 3; ++c) {
      lamp[k][c] = slab->center[c] + slab->normal[c] + at[0] * slab->u[c] + at[1] * slab->v[c];
      lamp[k][3 + c] = -slab->normal[c];
    }
    to_radiance(lamp[k], radiance[k]);
    to_radiance(lamp[k] + 3, radiance[k] + 3);
  }
}

/* At the default settings, which the export chooses. */
TEST(irradiance_by_rtrace) {
  static double receivers[RECEIVERS][6], there[RECEIVERS][6];
  if (!have_rtrace()) skip();
  for (int n = 0; n < lamp_count; ++n) {
    struct slab pages[LAMP_PAGES];
    char command[512], scene[256];
    const char *path = lamp_write(&lamps[n], pages);
    make_receivers(&pages[0], receivers, there);
    lamp_free(pages);
    snprintf(command, sizeof command, "'%s' irradiance --light '%s' --method reference",
             getenv("RENDERSLAB"), path);
    lamp_run(command, receivers[0], 6, RECEIVERS, wanted);
    snprintf(scene, sizeof scene, "!xform %s.rad", lamps[n].name);
    trace(lamp_export(path, "radiance", "--as radiance"), scene, "-I", there, RECEIVERS, got);
    double off = 0, all = 0;
    for (int k = 0; k < RECEIVERS; ++k)
      for (int c = 0; c < 3; ++c) {
        double difference = got[k][c] / watts(&lamps[n]) - wanted[k][c];
        off += difference * difference;
        all += wanted[k][c] * wanted[k][c];
      }
    print_message("# %s: irradiance %.2f %% off\n", lamps[n].name, 100 * sqrt(off / all));
    if (!(all > 0 && sqrt(off / all) < 0.01))
      fail_msg("%s: irradiance %g off", lamps[n].name, sqrt(off / all));
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
