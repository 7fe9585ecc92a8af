/* rule.h - quadrature rules for a micro light, along one axis; a micro light's rule is the
 * product of two. What they integrate is the product of the hat functions of uv and st, linear
 * each, and of the kernel (kernel.h), 1/(1 + x^2 + y^2)^2 times a linear function of the slopes:
 * it is smooth, with its nearest poles at x = +-i sqrt(1 + y^2), y the slope along the other axis.
 *
 * A node has four weights, those of the samples (near, far), (near, far + up), (near + up, far)
 * and (near + up, far + up) of its strip; the width of what it stands for is in them. */
#ifndef RULE_H
#define RULE_H

#include "base/result.h"
#include "microlight/strips.h"

enum rule {
  RULE_MIDPOINT, /* one node: the hats in the middle */
  RULE_PI,       /* one node: the hats' exact means */
  RULE_GAUSS,    /* as many as the tolerance needs; strips are split where 12 are too few */
  RULE_VIEWS     /* as RULE_MIDPOINT, of strips that are views (strips_find_views) */
};

enum { RULE_LARGEST_ORDER = 12 };

/* For each order n the smallest Bernstein ellipse with which it meets the tolerance. The error of
 * Gauss's rule for a function that is analytic inside the ellipse with the parameter rho falls as
 * rho^(-2 n) (Trefethen, "Is Gauss quadrature better than Clenshaw-Curtis?", SIAM Review 2008,
 * theorem 4.5): n >= ln(16/tolerance)/(2 ln rho) + 1.5, from 2 nodes on. */
struct rule_orders {
  double ellipse[RULE_LARGEST_ORDER + 1];
};

struct rule_orders rule_orders(double tolerance);

/* The strips of an axis with their nodes. `first` has count + 1 entries: nodes first[k] to
 * first[k+1] belong to strip k. */
struct rule_nodes {
  struct strips strips;
  int *first, count;
  double *at;          /* [count]: slopes; SIMD_LANES more may be read */
  double (*weight)[4]; /* [count]: of the samples */
  int first_room, room, weight_room;
};

void rule_nodes_free(struct rule_nodes *nodes);

/* The predicted error of RULE_PI, relative to the receiver's light: it takes the kernel from the
 * middle of a micro light. Over a strip of half width h the kernel's curvature changes the mean by
 * at most 5/3 h^2; its slope by about h where radiance rises from 0 within the strip, as all that
 * is seen may do at the rim of a beam (1.15 h was measured; a tenth of that where many strips
 * share in the light). A highlight, about exp(-m x^2/8) for the exponent m, adds its own curvature
 * and slope. The cosine changes by up to `rise` of its value in the middle, 2 where it rises from
 * 0: a quarter of that, again where radiance does. */
double rule_pi_error(double widest, double rise, double shininess);

/* Distance of the poles from the axis, given the strips along the other one. */
double rule_pole(const struct strips *other);

/* Replaces the nodes by those of the strips. `orders` and `pole` are for RULE_GAUSS. */
enum result rule_place(const struct strips *strips, enum rule rule,
                       const struct rule_orders *orders, double pole, struct rule_nodes *nodes,
                       struct error *error);

/* Gauss nodes on [0, 1] and their weights, which sum to 1. */
struct rule_gauss {
  double at[RULE_LARGEST_ORDER], weight[RULE_LARGEST_ORDER];
};
const struct rule_gauss *rule_gauss(int order); /* 1 to RULE_LARGEST_ORDER; thread-safe */

/* Weights of the four samples at a share of the strip's width. */
void rule_hats(const struct strip *strip, double share, double weight[4]);

#endif
