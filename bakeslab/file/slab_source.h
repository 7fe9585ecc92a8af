/* slab_source.h - where light that was not baked comes from: a page's "provenance.import", an
 * object with
 *   source       name of the file or files, without folders
 *   kind         ies, eulumdat, tm25, zemax, ray text, views or posed pictures
 *   assumptions  a sentence: what the file does not say
 *   flux_in, flux_out  of the source and of the slab's samples
 *   error        relative RMS error of the samples, weighted as they shine
 *   error_is     a sentence: what that is, and how it was found
 * Any of them may be missing, or of another kind, and is then not told. */
#ifndef SLAB_SOURCE_H
#define SLAB_SOURCE_H

#include <jansson.h>

#include "slab/slab.h"

/* The object, for json_decref; NULL where the light was not imported. */
enum result slab_source(const struct slab *slab, json_t **source, struct error *error);

/* Source, kind, assumptions and error in one line for people, which the caller frees; NULL where
 * the light was not imported. */
enum result slab_source_line(const struct slab *slab, char **line, struct error *error);

#endif
