/* chain.h - what the tests of the whole chain share: slabs of random radiance,
 * the include made from them, a POV-Ray picture lit by it, and the same picture
 * as a direct sum over the slab.
 *
 * The direct sum is written from light-slab(5) alone. It shares no code with
 * the library, which only carries slabs and pictures to and from files here.
 * Needs the environment variable BAKESLAB, the program under test. */
#ifndef CHAIN_H
#define CHAIN_H

#include "file/slab_exr.h"
#include "file/slab_file.h"
#include "oracle/lookup.h"
#include "oracle/random.h"
#include "testing.h"

enum { CHAIN_SIZE = 48, CHAIN_PIXELS = CHAIN_SIZE * CHAIN_SIZE };

double chain_dot(const double x[3], const double y[3]);
double chain_length(const double x[3]);

/* ---- Slabs; free with slab_free ---- */

/* Independent samples, log-uniform from 0.1 to 100. */
void chain_fill(struct slab *slab, uint64_t *state);

/* "test_lamp", a slab of such radiance in a random frame around a random
 * place; mirrored makes u x v = -n. */
struct slab chain_slab(const int samples[4], const double edges[2], const double window[4],
                       double distance, int mirrored, uint64_t seed);

/* Means over nu x nv equal cells of the aperture; old cells count by area. */
struct slab chain_means(const struct slab *from, int nu, int nv);

/* ---- The direct sum ---- */

/* A lamp in the scene: its point p stands at scale * p M + t, with M (a
 * rotation or reflection) and t those of POV-Ray's matrix <...>. */
struct chain_lamp {
  const struct slab *pages;
  int count;
  double scale, gain;
  double matrix[12];
  double case_height; /* above 0: an opaque box of this height (lamp units) stands on
                         the first page's aperture and shades other lamps' light */
};

/* One that stands as it is in lamp space, enlarged. */
struct chain_lamp chain_lamp_of(const struct slab *pages, int count, double scale);

/* The image of a point (origin 1) or a direction (0): scale x M + origin t. */
void chain_move(const double matrix[12], double scale, const double x[3], double origin,
                double out[3]);

/* A receiving plane, seen from above: pixel centres are spread over the
 * rectangle `across` x `down` around `center`. */
struct chain_plane {
  double center[3], across[3], down[3], normal[3];
};

/* The plane that a page of a lamp shines at, `distance` aperture widths away,
 * tilted a little, as large as what its light reaches there. */
struct chain_plane chain_facing(const struct chain_lamp *lamp, int page, double distance);

/* The middle of a pixel of a picture of size x size. */
void chain_pixel(const struct chain_plane *plane, int size, int pixel, double at[3]);

/* Radiance E/pi of a white plane under all lamps, CHAIN_PIXELS x RGB: a
 * midpoint sum over uv samples, which is what the sheet promises. */
void chain_direct(const struct chain_lamp *lamps, int count, const struct chain_plane *plane,
                  double *rgb);

/* ---- Programs and files, in a folder that the test owns ---- */

int chain_setup(void **state);
int chain_teardown(void **state);

/* Path of a file in the folder; valid until the next call. */
const char *chain_path(const char *name);

/* Runs a command in the folder, its output going to the file `log` there.
 * Returns its exit status. */
int chain_run(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* One that must succeed: else the test fails with its log. */
#define chain_must(...)                                                                            \
  do                                                                                               \
    if (chain_run(__VA_ARGS__) != 0) fail_msg("%s", chain_log());                                  \
  while (0)

/* Writes a text to a file there ("w"), or appends it ("a"). */
void chain_text(const char *name, const char *mode, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The log with all runs of blanks as one, since POV-Ray wraps its lines. */
const char *chain_log(void);

/* Writes slabs of exact floats to a file; and to NAME-slab.exr, and makes NAME.inc. */
void chain_write(const char *file, const struct slab *pages, int count);
void chain_include(const struct slab *pages, int count, const char *name, const char *options);

/* Writes scene.pov: the plane, white (1) or of another pigment, seen by pixel centres, under
 * `lights`. */
void chain_scene(const struct chain_plane *plane, double pigment, const char *lights);

/* SDL that includes "lamp.inc" and shows its lamp, of the Scale and Gain of a string. */
#define CHAIN_LIT(ARGUMENTS) "#include \"lamp.inc\"\nobject { Test_Lamp_Canned(" ARGUMENTS ") }"

/* The SDL that places "Test_Lamp_Canned" of these arguments, and its length. */
size_t chain_object(const char *arguments, const double matrix[12], char *sdl, size_t size);
/* SDL that includes "lamp.inc" and places lamps; valid until the next call. */
const char *chain_placed(const struct chain_lamp *lamps, int count);

/* Renders scene.pov and returns POV-Ray's exit status; or reads what it made. */
int chain_povray(void);
void chain_render(struct picture *picture);

/* Relative root mean squared difference of a picture from a sum; of the picture of the plane under
 * `sdl` from the direct sum over the lamps, and from another sum. */
double chain_rmse(const struct picture *picture, const double *sum);
double chain_error(const struct chain_lamp *lamps, int count, const struct chain_plane *plane,
                   double pigment, const char *sdl);
double chain_error_of(const struct chain_plane *plane, double pigment, const char *sdl,
                      const double *sum);

/* The plane one width from the first page, under `sdl`: POV-Ray exits so, and says this. */
void chain_says(const struct slab *pages, const char *sdl, int status, const char *text);

#endif
