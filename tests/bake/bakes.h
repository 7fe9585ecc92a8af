/* bakes.h - what the bake's tests share: a scratch folder, lamps of known radiance
 * (lamps/known.inc), bakes in parallel, and their samples. */
#ifndef BAKES_H
#define BAKES_H

#include "file/slab_file.h"
#include "testing.h"

/* ---- The scratch folder of a test program ---- */

int bakes_setup(void **state);
int bakes_teardown(void **state);

/* Path of a file there; valid until the next 8 calls. */
const char *bakes_path(const char *name);

/* Runs a shell command there, `$BAKESLAB` being the program and `$FIXTURES`
 * the folder of known.inc. Returns its exit status. */
int bakes_run(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* ---- Lamps ---- */

/* Where a slab sits; window and distance as in Canned_Slab. */
struct bakes_frame {
  double center[3], u[3], v[3], normal[3];
  double window[4];
  double distance; /* 0: infinity */
};

/* Begins NAME.pov: the prelude of a lamp without effects. */
void bakes_lamp(const char *name);
/* Appends Canned_Slab of a frame, or text. */
void bakes_lamp_slab(const char *name, const struct bakes_frame *frame);
void bakes_lamp_add(const char *name, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Appends MACRO(center, u, v, normal, the rest). */
void bakes_lamp_macro(const char *name, const char *macro, const struct bakes_frame *frame,
                      const char *rest);

/* x and y at a depth below the aperture of the ray (a, b, s, t). */
void bakes_point(const struct bakes_frame *frame, const double abst[4], double depth, double *x,
                 double *y);
/* The radiances of known.inc's Waves and Slope. */
void bakes_waves(const struct bakes_frame *frame, double radiance, const double abst[4],
                 double rgb[3]);
void bakes_slope(const struct bakes_frame *frame, double depth, const double abst[4],
                 double rgb[3]);

/* A pixel of a slab's raster: which sample it is, and of which ray (a, b, s, t). */
void bakes_sample(const struct slab *slab, size_t pixel, int at[SLAB_AXES], double abst[4]);

/* Mean of a Pane of radiance 1 over the 4D cell of a sample. */
double bakes_pane(const struct slab *slab, double depth, const double rectangle[4],
                  const int at[SLAB_AXES]);

/* ---- Bakes ---- */

/* Starts `bakeslab bake LAMP.pov -o OUTPUT` with further options beside others that
 * still run; its output goes to OUTPUT.log. */
void bakes_start(const char *lamp, const char *output, const char *options);
/* Waits for all; fails the test where one failed. */
void bakes_wait(void);

/* Reads a baked slab; the test fails where that fails. Free it with slab_free. */
struct slab bakes_load(const char *output, int page);

/* A number of the page's provenance, such as "noise" "flux". `inner` may be NULL. */
double bakes_provenance(const struct slab *slab, const char *key, const char *inner);

#endif
