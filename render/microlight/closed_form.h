/* closed_form.h - the sum over micro lights in closed form (the paper's section 4.1 calls it too
 * complicated for practical use), for matte receivers.
 *
 * Radiance is quadratic along each axis, so the integral is a sum of the moments
 *     I_ab = iint x^a y^b/(1 + x^2 + y^2)^2 dx dy,  a <= 3, b <= 2 or a <= 2, b <= 3,
 * each a signed sum of an antiderivative Phi_ab over four corners. All are elementary but
 *     F = iint 1/(1 + x^2 + y^2) = (pi/2) min(a,b) - Ti2(e^-|a-b|) + Ti2(e^-(a+b)),
 * a = asinh|x|, b = asinh|y|, odd in x and y, Ti2 the inverse tangent integral. */
#ifndef CLOSED_FORM_H
#define CLOSED_FORM_H

#include "microlight/row_sum.h"

/* Adds the irradiance of all micro lights between the strips, for matte receivers. Where the
 * closed form does not apply, or the tangent plane cuts a micro light, Gauss rules to 1e-11 take
 * over. `nodes` is scratch. */
enum result closed_form_sum(const struct seen_page *seen, const struct strips strips[2],
                            struct rule_nodes nodes[2], double irradiance[3],
                            struct gather_counts *counts, struct error *error);

#endif
