/* slab_json.h - the JSON text of a page, to and from struct slab
 * (light-slab(5)). Keys that we do not know are kept. Messages do not name a
 * file. */
#ifndef SLAB_JSON_H
#define SLAB_JSON_H

#include "slab/slab.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How many allocations have failed here in this thread. jansson passes over many of them (a
 * key is not set, a value is not found): compare before and after. */
unsigned long slab_json_lost(void);

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

/* The value of a key as JSON text, or NULL where there is none or no memory.
 * The caller frees it. */
char *slab_json_get(const struct slab *slab, const char *key);

/* The string at key.inner, say "provenance" and "housing"; NULL where it is none. The
 * caller frees it. */
char *slab_json_get_string(const struct slab *slab, const char *key, const char *inner);

/* The number at key.inner.innermost, say "provenance", "noise" and "sample"; NAN where it
 * is none. */
double slab_json_get_number(const struct slab *slab, const char *key, const char *inner,
                            const char *innermost);

/* Sets the string at key.inner; whatever else is at `key` stays if it is an object. */
enum result slab_json_set_string(struct slab *slab, const char *key, const char *inner,
                                 const char *value, struct error *error);

/* Records in "provenance" that `command` of `tool` made the slab. The command
 * and tool before go to the end of its array "history"; its other keys stay,
 * since they still describe the light. Where the samples were `changed`, as by
 * resampling, what is known of how well each was taken, "rays" and "noise",
 * goes to the history too. */
enum result slab_json_record(struct slab *slab, const char *command, const char *tool, bool changed,
                             struct error *error);

#ifdef __cplusplus
}
#endif
#endif
