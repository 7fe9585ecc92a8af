#include "export/export_mitsuba_plain.h"

#include <stdlib.h>

#include "export/export_errors.h"
#include "export/export_frame.h"
#include "export/export_pages.h"
#include "export/export_provenance.h"
#include "export/export_text.h"
#include "export/projectors.h"
#include "file/json_text.h"

extern const char export_mitsuba_plain_xml[], export_mitsuba_example[], export_mitsuba_plain_md[];

/* A page with light. */
struct page {
  struct projectors projectors;
  int number;
  char stem[SLAB_NAME_SIZE + 16];
};

struct lamp {
  const struct export_wish *wish;
  struct page *pages; /* owned */
  int count, lit;     /* pages, projectors */
};

static enum result make_pages(const struct slab *slabs, int count, struct lamp *lamp,
                              struct error *error) {
  lamp->pages = calloc((size_t)count, sizeof *lamp->pages);
  if (!lamp->pages) return result_no_memory(error);
  for (int k = 0; k < count; ++k) {
    struct page *page = &lamp->pages[lamp->count];
    struct error why = {{0}};
    if (!slab_is_lit(&slabs[k])) continue;
    page->number = k + 1;
    snprintf(page->stem, sizeof page->stem, "%s_%d", lamp->wish->name, k + 1);
    ++lamp->count;
    enum result result = projectors_make(&slabs[k], lamp->wish->tolerance, &page->projectors, &why);
    if (result == RESULT_BAD) return result_fail(error, result, "page %d: %s", k + 1, why.text);
    if (result != RESULT_OK) *error = why;
    if (result != RESULT_OK) return result;
    lamp->lit += projectors_lit(&page->projectors);
  }
  if (lamp->count) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "all radiance is zero: the lamp gives no light");
}

static void put_projectors(const void *of, FILE *out) {
  const struct lamp *lamp = of;
  for (int k = 0; k < lamp->count; ++k)
    projectors_put(&lamp->pages[k].projectors, lamp->pages[k].stem, out);
}

static struct export_errors errors_of(const struct page *page) {
  return (struct export_errors){page->number, "positions", page->projectors.texels.samples,
                                page->projectors.error};
}

/* Lines of the error at each distance. */
static void put_errors(const void *of, FILE *out) {
  const struct lamp *lamp = of;
  for (int k = 0; k < lamp->count; ++k) {
    const struct export_errors errors = errors_of(&lamp->pages[k]);
    export_errors_put(&errors, k ? "\n  - " : "  - ", out);
  }
}

static enum result write_texts(const struct slab *first, const struct lamp *lamp,
                               const char *folder, struct error *error) {
  const struct export_text texts[] = {{export_mitsuba_plain_xml, lamp->wish->name, ".xml"},
                                      {export_mitsuba_example, "example", ".xml"},
                                      {export_mitsuba_plain_md, "README", ".md"},
                                      {0}};
  const struct export_scene scene = export_scene_of(first, export_y_up);
  const struct include_value values[] = {{"projectors", .print = put_projectors, .of = lamp},
                                         {"samples", .number = lamp->lit},
                                         {"errors", .print = put_errors, .of = lamp},
                                         {"floor_matrix", .print = export_put_floor, .of = &scene},
                                         {0}};
  return export_texts(folder, lamp->wish->name, texts, first, &scene, values, error);
}

static enum result record(const struct slab *slabs, int count, const struct lamp *lamp,
                          const char *folder, struct error *error) {
  unsigned long mark = json_mark();
  json_t *errors = json_array();
  for (int k = 0; k < lamp->count; ++k) {
    const struct export_errors page = errors_of(&lamp->pages[k]);
    export_errors_record(&page, errors);
  }
  return export_provenance(slabs, count, lamp->wish, "mitsuba", errors, mark, folder, error);
}

static void tell(const struct lamp *lamp) {
  struct warnings *notes = lamp->wish->notes;
  for (int k = 0; k < lamp->count; ++k) {
    const struct projectors *projectors = &lamp->pages[k].projectors;
    const double *widths = export_distances;
    warnings_add(notes,
                 "page %d: %dx%d positions: irradiance %g, %g and %g aperture widths away errs "
                 "%.2g, %.2g and %.2g %% (RMS)",
                 lamp->pages[k].number, projectors->texels.samples[SLAB_U],
                 projectors->texels.samples[SLAB_V], widths[0], widths[1], widths[2],
                 100 * projectors->error[0], 100 * projectors->error[1],
                 100 * projectors->error[2]);
  }
  warnings_add(notes,
               "projectors are not seen: the lamp's face is missing in pictures and mirrors; use "
               "multijitter with %d samples or more; where the lamp is scaled, multiply "
               "its gain by the scale",
               lamp->lit);
}

enum result export_mitsuba_plain(const struct slab *slabs, int count,
                                 const struct export_wish *wish, const char *path,
                                 struct error *error) {
  struct lamp lamp = {.wish = wish};
  enum result result = make_pages(slabs, count, &lamp, error);
  if (result == RESULT_OK)
    result = write_texts(export_pages_first(slabs, count), &lamp, path, error);
  for (int k = 0; k < lamp.count && result == RESULT_OK; ++k)
    result = projectors_write(&lamp.pages[k].projectors, lamp.pages[k].stem, path, error);
  if (result == RESULT_OK) result = record(slabs, count, &lamp, path, error);
  if (result == RESULT_OK) tell(&lamp);
  for (int k = 0; k < lamp.count; ++k) projectors_free(&lamp.pages[k].projectors);
  free(lamp.pages);
  return result;
}
