#include "export/export_errors.h"

const double export_distances[EXPORT_DISTANCES] = {1, 2, 4};

void export_errors_put(const struct export_errors *errors, const char *begin, FILE *out) {
  for (int d = 0; d < EXPORT_DISTANCES; ++d)
    fprintf(out, "%s%spage %d, %dx%d %s, %g aperture width%s away: %.2g %%", d ? "\n" : "", begin,
            errors->page, errors->count[0], errors->count[1], errors->parts, export_distances[d],
            export_distances[d] == 1 ? "" : "s", 100 * errors->rms[d]);
}

void export_errors_record(const struct export_errors *errors, json_t *array) {
  for (int d = 0; d < EXPORT_DISTANCES; ++d)
    json_array_append_new(array,
                          json_pack("{s:i, s:[i,i], s:f, s:f}", "page", errors->page, errors->parts,
                                    errors->count[0], errors->count[1], "aperture_widths",
                                    export_distances[d], "irradiance_rms", errors->rms[d]));
}
