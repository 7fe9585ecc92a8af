/* closed.h - the sum over micro lights in closed form (closed_form.h). Where it does not
 * apply, or the tangent plane cuts a micro light, Gauss rules to 1e-11 take over. */
#ifndef CLOSED_H
#define CLOSED_H

#include "microlight/row_sum.h"

/* Adds the irradiance; for matte receivers. `nodes` is scratch. */
enum result closed_sum(const struct seen_page *seen, const struct strips strips[2],
                       struct rule_nodes nodes[2], double irradiance[3],
                       struct row_sum_counts *counts, struct error *error);

#endif
