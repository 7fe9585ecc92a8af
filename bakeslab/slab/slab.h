/* slab.h - the light slab: the radiance that leaves a lamp through one
 * rectangle, sampled on a 4D grid (Heidrich, Kautz, Slusallek and Seidel,
 * "Canned Lightsources", 1998, section 3; light-slab(5)).
 *
 * Lamp space is POV-Ray's: left-handed, y up, in lamp units. With u' and v'
 * the unit vectors along u and v, n the normal and kappa = 1/distance, the ray
 * through (a, b, s, t) leaves
 *     center + a u' + b v'   in the direction   n + (s - kappa a) u' + (t - kappa b) v'.
 * Samples are cell centres: (i,j) sits at a = ((i+1/2)/Nu - 1/2)|u|, likewise
 * b; (k,l) at s = s0 + (k+1/2)(s1-s0)/Ns, likewise t. Radiance is quadrilinear
 * between samples, constant in the half cell at each border, and zero outside
 * the rectangle and the window. A 1-wide axis is constant.
 *
 * Nothing here needs more than the C library. */
#ifndef SLAB_H
#define SLAB_H

#include <stdbool.h>
#include <stddef.h>

#include "base/result.h"

enum { SLAB_U, SLAB_V, SLAB_S, SLAB_T, SLAB_AXES }; /* indices into samples[] */
enum { SLAB_NAME_SIZE = 128, SLAB_UNIT_SIZE = 16, SLAB_CHANNEL_SIZE = 64 };
enum { SLAB_PADDING = 8 }; /* floats behind the last sample, so that vectors may be read there */

struct slab {
  char name[SLAB_NAME_SIZE];
  char channel[SLAB_CHANNEL_SIZE]; /* the group of bulbs that lights the page; empty: all of them */
  int samples[SLAB_AXES];          /* Nu, Nv, Ns, Nt, each >= 1 */
  double center[3];
  double u[3], v[3];   /* full edge vectors, perpendicular */
  double normal[3];    /* unit; never derived from u x v */
  double st_window[4]; /* s0, s1, t0, t1: slopes as seen from center */
  double st_distance;  /* of the st plane along the normal; INFINITY allowed */
  double metres_per_unit;
  char radiance_unit[SLAB_UNIT_SIZE]; /* "W/(sr m2)", "cd/m2" or "relative" */
  char *json; /* the page's whole JSON text, with keys that only others know, or
                 NULL; owned. slab_json.c puts the fields above over it when
                 the page is written. */
  float *rgb; /* samples, linear Rec. 709, owned, or NULL while only the geometry
                 is loaded: a raster of Nv*Nt rows and Nu*Ns columns, pixel
                 (i*Ns + k, j*Nt + l) being L(u_i, v_j, s_k, t_l) */
};

/* A slab with default values and no samples. */
struct slab slab_default(void);
void slab_free(struct slab *slab); /* frees what it owns and zeroes it */

/* Checks the geometry: sizes, a rectangular frame, a window that is not empty.
 * Says what is wrong without naming a file. */
enum result slab_check(const struct slab *slab, struct error *error);

/* Allocates zeroed samples and padding; the size is checked before it is multiplied. */
enum result slab_alloc(struct slab *slab, struct error *error);

/* Deep copy of the geometry and the JSON, without samples. */
enum result slab_copy_geometry(const struct slab *from, struct slab *to, struct error *error);

double slab_kappa(const struct slab *slab); /* 1/st_distance, 0 at infinity */
size_t slab_sample_count(const struct slab *slab);
int slab_width(const struct slab *slab);  /* Nu * Ns */
int slab_height(const struct slab *slab); /* Nv * Nt */

/* The number in rgb[] of the first value that is negative; 3 * slab_sample_count: none is. */
size_t slab_negative(const struct slab *slab);

/* Whether two pages are lit by the same group of bulbs. Pages of different groups may share an
 * aperture, and add up. */
bool slab_same_channel(const struct slab *a, const struct slab *b);

/* Whether all but the samples and the channel is alike, so that the samples can be added. */
bool slab_alike(const struct slab *a, const struct slab *b);

/* Whether any sample differs from 0. */
bool slab_is_lit(const struct slab *slab);

/* The three floats of one sample. */
float *slab_at(const struct slab *slab, int i, int j, int k, int l);

/* The number of a sample's pixel in the raster, row by row; and the (i, j, k, l) of a pixel. */
size_t slab_pixel(const struct slab *slab, const int at[SLAB_AXES]);
void slab_locate(const struct slab *slab, size_t pixel, int at[SLAB_AXES]);

/* Grid position of sample `index` along an axis: a or b in lamp units from the
 * centre for SLAB_U and SLAB_V, a slope for SLAB_S and SLAB_T. */
double slab_position(const struct slab *slab, int axis, int index);
double slab_spacing(const struct slab *slab, int axis);

/* Radiance of the ray through (a, b, s, t): quadrilinear, zero outside. */
void slab_lookup(const struct slab *slab, double a, double b, double s, double t, double rgb[3]);

/* The (a, b, s, t) of a ray in lamp space. False where it does not leave
 * through the slab's side of the uv plane (direction . normal <= 0). */
bool slab_ray(const struct slab *slab, const double origin[3], const double direction[3],
              double abst[4]);

/* Lumens that a watt of light counts where watts become lumens: white light of even power over
 * the visible spectrum, as Radiance has it. */
enum { SLAB_WATT_LUMENS = 179 };

/* Rec. 709 luminance of a sample. */
static inline double slab_luminance(const float rgb[3]) {
  return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

/* Radiant flux leaving through the page: the integral of the interpolated
 * radiance times cosine over aperture and window, with lengths in lamp units
 * (slab_flux.c). NAN where memory for it runs out. */
enum result slab_flux(const struct slab *slab, double rgb[3], struct error *error);

/* The same with lengths in metres, whatever the unit of radiance: what is printed for
 * people, in slab_flux_unit: "W", "lm", or "relative m2 sr". */
enum result slab_flux_metric(const struct slab *slab, double rgb[3], struct error *error);
const char *slab_flux_unit(const struct slab *slab);

#endif
