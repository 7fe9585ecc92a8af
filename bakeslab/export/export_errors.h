/* export_errors.h - what an approximated page errs by: irradiance on a plane before it at three
 * distances, as texts and provenance.json tell it. */
#ifndef EXPORT_ERRORS_H
#define EXPORT_ERRORS_H

#include <jansson.h>
#include <stdio.h>

enum { EXPORT_DISTANCES = 3 };
extern const double export_distances[EXPORT_DISTANCES]; /* in aperture widths */

struct export_errors {
  int page;          /* from 1 */
  const char *parts; /* what it is cut into: "polygons" */
  const int *count;  /* of them along u and v */
  const double *rms; /* relative, at each distance */
};

/* A line for each distance, each beginning with `begin`; the last has no line end. */
void export_errors_put(const struct export_errors *errors, const char *begin, FILE *out);

/* Appends an object for each distance to an array. */
void export_errors_record(const struct export_errors *errors, json_t *array);

#endif
