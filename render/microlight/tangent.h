/* tangent.h - micro lights that the receiver's tangent plane cuts: Gauss rules over the part
 * above it, a polygon of up to five corners, as trapezoids with linear limits. (Clamping the
 * cosine instead would leave errors of per cents.) */
#ifndef TANGENT_H
#define TANGENT_H

#include "microlight/kernel.h"
#include "microlight/strips.h"

/* Adds the weights of the samples, [sample along v][sample along u] in rule.h's order, of a
 * micro light: the kernel times the hats over its part above the plane. `gloss`, where not
 * NULL, gets those with the gloss kernel. `order` of the rules: 1 to RULE_LARGEST_ORDER.
 * Returns the nodes used. */
int tangent_weights(const struct kernel *kernel, const struct strip *u, const struct strip *v,
                    int order, double weight[4][4], double (*gloss)[4]);

#endif
