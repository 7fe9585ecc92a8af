#include "export/export_radiance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/sdl.h"
#include "export/export_errors.h"
#include "export/export_frame.h"
#include "export/export_provenance.h"
#include "export/export_text.h"
#include "export/radiance_page.h"
#include "export/radiance_source.h"
#include "file/json_text.h"
#include "slab/plane.h"

extern const char export_radiance_rad[], export_radiance_md[], export_radiance_example[];

const double export_radiance_efficacy = 179;

/* A page with light. */
struct page {
  const struct slab *slab;
  int number;
  struct radiance_source source;
  double error[EXPORT_DISTANCES];
  char stem[SLAB_NAME_SIZE + 16];
};

struct lamp {
  const struct export_wish *wish;
  struct page *pages; /* owned */
  int count;
};

static enum result check_radiance(const struct slab *slab, int number, struct error *error) {
  size_t k = slab_negative(slab);
  int at[SLAB_AXES];
  if (k == 3 * slab_sample_count(slab)) return RESULT_OK;
  slab_locate(slab, k / 3, at);
  return result_fail(error, RESULT_BAD,
                     "page %d: radiance %g of sample (%d, %d, %d, %d) is negative, which sources "
                     "of Radiance do not give; make the slab without negative light, say by "
                     "bakeslab convert --sharpen st --positive",
                     number, (double)slab->rgb[k], at[SLAB_U], at[SLAB_V], at[SLAB_S], at[SLAB_T]);
}

/* Cuts the aperture, and finds what that errs. */
static void cut_aperture(const struct export_wish *wish, struct page *page) {
  page->source = wish->polygons[0] > 0 ? radiance_source_make(page->slab, wish->polygons)
                                       : radiance_source_choose(page->slab, wish->tolerance);
  for (int k = 0; k < EXPORT_DISTANCES; ++k)
    page->error[k] = radiance_source_error(page->slab, &page->source, export_distances[k]);
}

static void add_page(struct lamp *lamp, const struct slab *slab, int number) {
  struct page *page = &lamp->pages[lamp->count++];
  *page = (struct page){.slab = slab, .number = number};
  snprintf(page->stem, sizeof page->stem, "%s_%d", lamp->wish->name, number);
}

static enum result find_pages(const struct slab *slabs, int count, struct lamp *lamp,
                              struct error *error) {
  lamp->pages = calloc((size_t)count, sizeof *lamp->pages);
  if (!lamp->pages) return result_no_memory(error);
  for (int k = 0; k < count; ++k) {
    enum result result = check_radiance(&slabs[k], k + 1, error);
    if (result != RESULT_OK) return result;
    if (slab_is_lit(&slabs[k])) add_page(lamp, &slabs[k], k + 1);
  }
  for (int k = 0; k < lamp->count; ++k) cut_aperture(lamp->wish, &lamp->pages[k]);
  if (lamp->count) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "all radiance is zero: the lamp gives no light");
}

static void tell(const struct lamp *lamp) {
  for (int k = 0; k < lamp->count; ++k) {
    const struct page *page = &lamp->pages[k];
    warnings_add(lamp->wish->notes,
                 "page %d: %dx%d polygons: irradiance one aperture width away errs %.2g %% (RMS), "
                 "with rtrace or rpict -ds %g -dj 0 -dt 0 -dc 1, which must be given%s",
                 page->number, page->source.polygons[0], page->source.polygons[1],
                 100 * page->error[0], radiance_source_ds,
                 page->error[0] > lamp->wish->tolerance ? "; more --polygons err less" : "");
  }
}

/* Corner of the aperture: x and y from 0 to 1 along u and v. */
static void put_corner(const struct slab *slab, double x, double y, FILE *out) {
  double lamp[3], at[3];
  for (int c = 0; c < 3; ++c)
    lamp[c] = slab->center[c] + (x - 0.5) * slab->u[c] + (y - 0.5) * slab->v[c];
  export_z_up(lamp, at);
  fprintf(out, " %.15g %.15g %.15g\n", at[0], at[1], at[2]);
}

/* Polygons face where their corners go round counter-clockwise. Radiance's space mirrors the
 * lamp's: there u x v points along n where it does not in lamp space. */
static bool faces_forward(const struct slab *slab) {
  const double *u = slab->u, *v = slab->v, *n = slab->normal;
  return (u[1] * v[2] - u[2] * v[1]) * n[0] + (u[2] * v[0] - u[0] * v[2]) * n[1] +
             (u[0] * v[1] - u[1] * v[0]) * n[2] <
         0;
}

static void put_polygons(const struct page *page, FILE *out) {
  static const int corners[2][4][2] = {{{0, 0}, {0, 1}, {1, 1}, {1, 0}},
                                       {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const int *n = page->source.polygons;
  bool forward = faces_forward(page->slab);
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i) {
      fprintf(out, "\n%s_light polygon %s_%d_%d\n0\n0\n12\n", page->stem, page->stem, i, j);
      for (int k = 0; k < 4; ++k) {
        const int *corner = corners[forward][k];
        put_corner(page->slab, (double)(i + corner[0]) / n[0], (double)(j + corner[1]) / n[1], out);
      }
    }
}

/* A pattern: the radiance by one set of the functions of the page's .cal. */
static void put_pattern(const struct page *page, const char *name, const char *functions,
                        FILE *out) {
  static const char channels[3] = "rgb";
  bool grey = radiance_page_grey(page->slab);
  fprintf(out, "\nvoid colordata %s_%s\n11", page->stem, name);
  for (int c = 0; c < 3; ++c) fprintf(out, " %c%c", functions[0], channels[c]);
  for (int c = 0; c < 3; ++c) fprintf(out, " %s_%c.dat", page->stem, channels[grey ? 0 : c]);
  fprintf(out, " %s.cal", page->stem);
  for (const char *axis = "abst"; *axis; ++axis) fprintf(out, " %c%c", functions[1], *axis);
  fprintf(out, "\n0\n0\n");
}

/* What is seen is a glow, which is no source; the source, an illum, shows it. */
static void put_page(const struct page *page, FILE *out) {
  const char *stem = page->stem;
  double unit = strcmp(page->slab->radiance_unit, "cd/m2") ? 1 : 1 / export_radiance_efficacy;
  put_pattern(page, "seen", "fi", out);
  fprintf(out, "\n%s_seen glow %s_glow\n0\n0\n4 %.15g %.15g %.15g 0\n", stem, stem, unit, unit,
          unit);
  put_pattern(page, "given", "gj", out);
  fprintf(out, "\n%s_given illum %s_light\n1 %s_glow\n0\n3 %.15g %.15g %.15g\n", stem, stem, stem,
          unit, unit, unit);
  put_polygons(page, out);
}

static void put_pages(const void *of, FILE *out) {
  const struct lamp *lamp = of;
  for (int page = 0; page < lamp->count; ++page) put_page(&lamp->pages[page], out);
}

static struct export_errors errors_of(const struct page *page) {
  return (struct export_errors){page->number, "polygons", page->source.polygons, page->error};
}

/* Lines of the error at each distance. */
static void put_errors(const void *of, FILE *out) {
  const struct lamp *lamp = of;
  for (int k = 0; k < lamp->count; ++k) {
    const struct export_errors errors = errors_of(&lamp->pages[k]);
    export_errors_put(&errors, k ? "\n#   " : "#   ", out);
  }
}

static enum result write_texts(const struct lamp *lamp, const char *folder, struct error *error) {
  const struct slab *first = lamp->pages[0].slab;
  const struct export_text texts[] = {{export_radiance_rad, lamp->wish->name, ".rad"},
                                      {export_radiance_md, "README", ".md"},
                                      {export_radiance_example, "example", ".rad"},
                                      {0}};
  const struct export_scene scene = export_scene_of(first, export_z_up);
  double view[3];
  for (int c = 0; c < 3; ++c) view[c] = scene.target[c] - scene.eye[c];
  const struct include_value values[] = {
      {"pages", .number = lamp->count},
      {"several", .number = lamp->count > 1},
      {"command", .text = lamp->wish->command, .write = sdl_comment},
      {"ds", .number = radiance_source_ds},
      {"errors", .print = put_errors, .of = lamp},
      {"sources", .print = put_pages, .of = lamp},
      {"photometric", .number = !strcmp(first->radiance_unit, "cd/m2")},
      {"relative", .number = !strcmp(first->radiance_unit, "relative")},
      {"view", .numbers = view},
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
  return export_provenance(slabs, count, lamp->wish, "radiance", errors, mark, folder, error);
}

enum result export_radiance(const struct slab *slabs, int count, const struct export_wish *wish,
                            const char *path, struct error *error) {
  struct lamp lamp = {.wish = wish};
  enum result result = find_pages(slabs, count, &lamp, error);
  if (result == RESULT_OK) result = write_texts(&lamp, path, error);
  for (int k = 0; k < lamp.count && result == RESULT_OK; ++k)
    result = radiance_page_write(lamp.pages[k].slab, &lamp.pages[k].source, wish, path,
                                 lamp.pages[k].stem, error);
  if (result == RESULT_OK) result = record(slabs, count, &lamp, path, error);
  if (result == RESULT_OK) tell(&lamp);
  free(lamp.pages);
  return result;
}
