/* slab_json.h - the JSON text of a page, to and from struct slab
 * (light-slab(5)). Keys that we do not know are kept. Messages do not name a
 * file. */
#ifndef SLAB_JSON_H
#define SLAB_JSON_H

#include <jansson.h>

#include "slab/slab_accuracy.h"
#include "slab/slab_sharpen.h"

/* Fills a slab's geometry from a text, which it copies into slab->json. The
 * slab is checked; samples stay NULL. `white` (NULL allowed) receives
 * "logluv_white", or ones. On failure the slab is empty. */
enum result slab_json_parse(const char *text, struct slab *slab, double white[3],
                            struct error *error);

/* The text for a page: slab->json with the slab's fields put over it, and
 * "logluv_white" where white is not NULL. The caller frees it. */
enum result slab_json_text(const struct slab *slab, const double white[3], char **text,
                           struct error *error);

/* Sets a key of the page's JSON, say "provenance", to a JSON value given as
 * text; NULL removes the key. Keys that are fields of struct slab are taken
 * from there when the page is written. */
enum result slab_json_set(struct slab *slab, const char *key, const char *value,
                          struct error *error);

/* The page's JSON as an object, empty where it has none; json_decref frees it. */
enum result slab_json_root(const struct slab *slab, json_t **root, struct error *error);

/* How the samples were taken, as far as "samples_are" and "provenance" say. */
enum result slab_json_sampling(const struct slab *slab, struct slab_sampling *sampling,
                               struct error *error);

/* Records in "provenance" how slab_sharpen was called. */
enum result slab_json_record_sharpening(struct slab *slab, enum slab_sharpening how,
                                        struct error *error);

/* Records in "provenance" that `command` of `tool` made the slab. The command
 * and tool before go to the end of its array "history"; its other keys stay,
 * since they still describe the light. Where the samples were `changed`, as by
 * resampling, what the bake knew of them ("rays", "noise", "missed", "warnings", ...) goes to
 * the history too. */
enum result slab_json_record(struct slab *slab, const char *command, const char *tool, bool changed,
                             struct error *error);

#endif
