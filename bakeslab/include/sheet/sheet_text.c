/* sheet_text.c - the include file of a sheet: sheet.inc.in and, for each page of its header,
 * sheet_page.inc.in. */
#include <math.h>

#include "include/sheet/sheet.h"
#include "slab/plane.h"

extern const char sheet_inc[], sheet_page_inc[], sheet_face_inc[];

/* Relative to the peak: smallest half with full precision, and half of the
 * smallest above zero. */
static const double half_normal = 6.1e-5, half_zero = 3e-8;

/* Height of the openings that keep lights to their tiles, as a share of the sheet's height.
 * The higher, the wider they are, and the farther from the origin a lamp may stand: POV-Ray
 * tests their bounding boxes in single precision. It also wants its SMALL_TOLERANCE, 0.001
 * scene units, between an opening and what casts a shadow behind it, which is the gap that
 * is left at least; and the lowest sheet that this leaves room for. */
static const double gate = 0.5, gap = 0.00104, least_height = 0.0011;

/* How far the lights below zero stand behind the box, in scene units: POV-Ray ignores shadows
 * closer than 0.001. */
static const double behind = 0.0011;

/* Rows of a page's table. */
static void print_table(const void *of, FILE *out) {
  const struct sheet_page *page = of;
  for (int k = 0; k < page->level_count; ++k) {
    const struct sheet_level *level = &page->levels[k];
    const int *lights = level->views.samples;
    char size[32];
    snprintf(size, sizeof size, "%dx%d", lights[SLAB_U], lights[SLAB_V]);
    fprintf(out, "%s//   %-8s %5d of %-5d ", k ? "\n" : "", size, level->lit,
            lights[SLAB_U] * lights[SLAB_V]);
    for (int d = 0; d < SHEET_DISTANCES; ++d)
      if (isfinite(level->error[d]))
        fprintf(out, " %6.3g", 100 * level->error[d]);
      else
        fputs("      -", out);
    fprintf(out, "  %8.3g  %8.3g", level->height, least_height / level->height);
  }
}

static void print_pages(const void *of, FILE *out) {
  const struct sheet *sheet = of;
  for (int p = 0; p < sheet->page_count; ++p) {
    const struct sheet_page *page = &sheet->pages[p];
    const struct slab *slab = &page->levels[0].views;
    const struct include_value values[] = {
        {"page", .number = p + 1},
        {"channel", .text = slab->channel},
        {"aperture_u", .number = plane_edge(slab, SLAB_U)},
        {"aperture_v", .number = plane_edge(slab, SLAB_V)},
        {"samples_s", .number = slab->samples[SLAB_S]},
        {"samples_t", .number = slab->samples[SLAB_T]},
        {"window", .numbers = slab->st_window},
        {"st_distance", .number = isfinite(slab->st_distance) ? slab->st_distance : 0},
        {"flux", .numbers = page->flux},
        {"flux_unit", .text = slab_flux_unit(slab)},
        {"faintest", .number = page->faintest < half_normal ? page->faintest : 0},
        {"lost", .text = page->faintest < half_zero ? ", and the faintest to nothing" : ""},
        {"table", .print = print_table, .of = page},
        {0}};
    if (p) putc('\n', out);
    include_fill(sheet_page_inc, "", values, out);
  }
}

static void print_page_rows(const void *of, FILE *out) {
  const struct sheet *sheet = of;
  for (int p = 0, first = 0; p < sheet->page_count; ++p) {
    const struct slab *slab = &sheet->pages[p].levels[0].views;
    const double *w = slab->st_window;
    fprintf(out, "%s  { %.15g, %.15g, %d, %.15g, %.15g, %d, %.15g, %.15g, %.15g, %d }",
            p ? ",\n" : "", plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V),
            slab->samples[SLAB_S], w[0], w[1], slab->samples[SLAB_T], w[2], w[3], slab_kappa(slab),
            first);
    first += sheet->pages[p].level_count;
  }
}

static void print_frame_rows(const void *of, FILE *out) {
  const struct sheet *sheet = of;
  for (int p = 0; p < sheet->page_count; ++p) {
    const struct slab *slab = &sheet->pages[p].levels[0].views;
    fputs(p ? ",\n  { " : "  { ", out);
    include_put_frame(slab, slab->center, ", ", out);
    fputs(" }", out);
  }
}

static void print_level_rows(const void *of, FILE *out) {
  const struct sheet *sheet = of;
  for (int p = 0, rows = 0; p < sheet->page_count; ++p)
    for (int k = 0; k < sheet->pages[p].level_count; ++k) {
      const struct sheet_level *level = &sheet->pages[p].levels[k];
      const int *lights = level->views.samples;
      fprintf(out, "%s  { %d, %d, %d, %d, %.15g, %d }", rows ? ",\n" : "", lights[SLAB_U],
              lights[SLAB_V], level->left, level->bottom, level->peak, rows);
      rows += lights[SLAB_V];
    }
}

static void print_apertures(const void *of, FILE *out) {
  const struct sheet *sheet = of;
  for (int p = 0; p < sheet->page_count; ++p)
    if (sheet->pages[p].first == p) fprintf(out, "%s%d", p ? ", " : "", p);
}

static void print_next(const void *of, FILE *out) {
  const struct sheet *sheet = of;
  for (int p = 0; p < sheet->page_count; ++p)
    fprintf(out, "%s%d", p ? ", " : "", sheet->pages[p].next);
}

static void print_channels(const void *of, FILE *out) {
  const struct sheet *sheet = of;
  for (int p = 0; p < sheet->page_count; ++p)
    fprintf(out, "%s%d", p ? ", " : "", sheet->pages[p].channel);
}

/* Whether a view of a page, or of the pages that follow in its aperture, is not black. */
static bool is_lit(const struct sheet *sheet, int page, int level, int i, int j) {
  for (; page >= 0; page = sheet->pages[page].next)
    if (sheet_is_lit(&sheet->pages[page].levels[level].views, i, j)) return true;
  return false;
}

static void print_lit_rows(const void *of, FILE *out) {
  const struct sheet *sheet = of;
  for (int p = 0, rows = 0; p < sheet->page_count; ++p)
    for (int k = 0; k < sheet->pages[p].level_count; ++k) {
      const struct slab *views = &sheet->pages[p].levels[k].views;
      for (int j = 0; j < views->samples[SLAB_V]; ++j) {
        fputs(rows++ ? ",\n  \"" : "  \"", out);
        for (int i = 0; i < views->samples[SLAB_U]; ++i)
          putc(is_lit(sheet, p, k, i, j) ? '1' : '0', out);
        putc('"', out);
      }
    }
}

void sheet_print(const struct sheet *sheet, const struct include_text *text, FILE *out) {
  int levels = 0, rows = 0;
  double faintest = INFINITY;
  for (int p = 0; p < sheet->page_count; ++p) {
    const struct sheet_level *all = &sheet->pages[p].levels[0];
    faintest = fmin(faintest, all->peak * slab_spacing(&all->views, SLAB_U) *
                                  slab_spacing(&all->views, SLAB_V));
    for (int k = 0; k < sheet->pages[p].level_count; ++k, ++levels)
      rows += sheet->pages[p].levels[k].views.samples[SLAB_V];
  }
  const double reach = include_reach(faintest, plane_width(&sheet->lamp.frame));
  const struct include_value values[] = {{"pages", .print = print_pages, .of = sheet},
                                         {"face", .part = sheet_face_inc},
                                         {"lights", .number = sheet_most_lights(sheet)},
                                         {"page_count", .number = sheet->page_count},
                                         {"page_rows", .print = print_page_rows, .of = sheet},
                                         {"frame_rows", .print = print_frame_rows, .of = sheet},
                                         {"aperture_count", .number = sheet_apertures(sheet)},
                                         {"aperture_row", .print = print_apertures, .of = sheet},
                                         {"next_row", .print = print_next, .of = sheet},
                                         {"channel_row", .print = print_channels, .of = sheet},
                                         {"level_count", .number = levels},
                                         {"level_rows", .print = print_level_rows, .of = sheet},
                                         {"lit_count", .number = rows},
                                         {"lit_rows", .print = print_lit_rows, .of = sheet},
                                         {"reach", .number = reach},
                                         {"width", .number = sheet->picture.width},
                                         {"height", .number = sheet->picture.height},
                                         {"least_height", .number = least_height},
                                         {"gate", .number = gate},
                                         {"gap", .number = gap},
                                         {"behind", .number = behind},
                                         {0}};
  include_print(sheet_inc, text, &sheet->lamp, values, out);
}
