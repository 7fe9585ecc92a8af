/* export_text.h - the texts of an export's folder, by templates (include/text/include_fill.h). */
#ifndef EXPORT_TEXT_H
#define EXPORT_TEXT_H

#include "base/result.h"
#include "export/export_frame.h"
#include "include/text/include_fill.h"

struct export_text {
  const char *template, *stem, *ending; /* the file is called STEM ENDING */
};

/* Writes them; `texts` end with one without a template. Besides `values` they may name what all
 * examples show, the scene's numbers (floor, eye, target, up), and the slab's unit and metres. */
enum result export_texts(const char *folder, const char *name, const struct export_text *texts,
                         const struct slab *slab, const struct export_scene *scene,
                         const struct include_value *values, struct error *error);

#endif
