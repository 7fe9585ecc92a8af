/* cluster_light.h - one light of a cluster: a parallelogram of the aperture whose points shine
 * alike, with a spotlight's lobe.
 *
 * Of a ray at the angle theta to the lobe's axis, and with c = cos(theta), the intensity is
 *     rgb c^tightness p^2 (3 - 2p),  p = (c - cos_falloff) / (cos_radius - cos_falloff)
 * between the cones of falloff and radius, rgb c^tightness inside, nothing outside.
 * With both cones at 90 degrees that is exactly c^tightness. No cone reaches behind
 * the aperture's plane, so that all light leaves through the aperture.
 *
 * Lengths are in aperture widths (longer edge), x along u and y along v. */
#ifndef CLUSTER_LIGHT_H
#define CLUSTER_LIGHT_H

enum { CLUSTER_MOST_LIGHTS = 64 }; /* of a page */

struct cluster_light {
  double center[2], edge[2][2]; /* of the parallelogram; full edges */
  double axis[2];               /* slopes of the lobe's axis */
  double tightness, cos_radius, cos_falloff;
  double rgb[3]; /* radiance times widths squared */
  int size[2];   /* points along its edges, powers of 2 */
};

/* Irradiance at (x, y, z) facing the aperture, and flux, of a light of rgb 1. */
double cluster_irradiance(const struct cluster_light *light, const double at[3]);
/* The same of those of its points that lie below `until`, along x and y. */
double cluster_irradiance_until(const struct cluster_light *light, const double until[2],
                                const double at[3]);
double cluster_flux(const struct cluster_light *light);

/* What a fit changes. */
enum { CLUSTER_NUMBERS = 9 };
struct cluster_numbers {
  union {
    struct {
      double center[2];
      double scale[2]; /* logarithms of factors of both edges */
      double axis[2];
      double tightness; /* the logarithm of 1 + tightness */
      double falloff;   /* cos_falloff */
      double softness;  /* the soft edge's share of the cone,
                           (cos_radius - cos_falloff) / (1 - cos_falloff) */
    };
    double x[CLUSTER_NUMBERS];
  };
};

/* Those of a light; and the light of which they are, with the edges of `seed` scaled, and its
 * size and rgb. The cone of falloff ends at the aperture's plane. */
struct cluster_numbers cluster_to_numbers(const struct cluster_light *light);
struct cluster_light cluster_from_numbers(const struct cluster_numbers *numbers,
                                          const struct cluster_light *seed);

/* Derivatives of cluster_irradiance by them. */
struct cluster_numbers cluster_gradient(const struct cluster_light *light, const double at[3]);

#endif
