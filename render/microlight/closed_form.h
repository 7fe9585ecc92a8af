/* closed_form.h - a micro light's light in closed form (the paper's section 4.1 calls it too
 * complicated for practical use). Matte receivers, no occluders, not cut by the tangent plane.
 *
 * Radiance is quadratic along each axis, so the integral is a sum of the moments
 *     I_ab = iint x^a y^b/(1 + x^2 + y^2)^2 dx dy,  a <= 3, b <= 2 or a <= 2, b <= 3,
 * each a signed sum of an antiderivative Phi_ab over four corners. All are elementary but
 *     F = iint 1/(1 + x^2 + y^2) = (pi/2) min(a,b) - Ti2(e^-|a-b|) + Ti2(e^-(a+b)),
 * a = asinh|x|, b = asinh|y|, odd in x and y, Ti2 the inverse tangent integral. */
#ifndef CLOSED_FORM_H
#define CLOSED_FORM_H

#include <stdbool.h>

#include "microlight/strips.h"

/* Narrow, remote or oblong micro lights cancel away too many digits: use a Gauss rule. */
bool closed_form_applies(const struct strip *u, const struct strip *v);

/* Weights of the samples, [sample along v][sample along u] in rule.h's order, for the
 * irradiance of a receiver with the unit normal. */
void closed_form_weights(const double normal[3], const struct strip *u, const struct strip *v,
                         double weight[4][4]);

#endif
