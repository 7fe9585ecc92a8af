/* sheet_text.c - the include file: what it is, the lamp's numbers, its macros. */
#include "include/sheet/sheet.h"

#include <math.h>

#include "slab/plane.h"

/* Relative to the peak: smallest half with full precision, and half of the
 * smallest above zero. */
static const double half_normal = 6.1e-5, half_zero = 3e-8;

/* POV-Ray drops what a light adds below this in every channel. */
static const double dropped = 1e-10;

static void print_limits(const struct sheet *sheet, FILE *out) {
  fprintf(
      out,
      "// Limits:  Surfaces may not come closer to the aperture than the sheet (tables\n"
      "//          below). POV-Ray ignores shadows closer than 0.001 units to a light, so\n"
      "//          there is a smallest Scale; use larger scene units for small lamps.\n"
      "//          It tests boxes in single precision: keep the lamp and what it lights within\n"
      "//          1000 of its widths of the origin, and %g units wide at most. Not in a\n"
      "//          light_group, not with shadowless, quality +Q4 or better.\n"
      "//          With an assumed_gamma other than 1.0 the image is still read right,\n"
      "//          but POV-Ray then adds light up wrongly.\n",
      include_most_width);
  if (sheet->black_pages)
    fprintf(out, "//          %d page(s) of the lamp hold no light and were left out.\n",
            sheet->black_pages);
}

static void print_faint(const struct sheet_page *page, FILE *out) {
  if (page->faintest < half_normal)
    fprintf(out,
            "//   The faintest radiance is %.2g of the peak; the image rounds below %.2g to\n"
            "//   multiples of %.1g%s.\n",
            page->faintest, half_normal, 2 * half_zero,
            page->faintest < half_zero ? ", and the faintest to nothing" : "");
  const struct sheet_level *finest = &page->levels[0];
  const struct slab *views = &finest->views;
  double reach = sqrt(finest->peak * slab_spacing(views, SLAB_U) * slab_spacing(views, SLAB_V) /
                      (M_PI * dropped));
  if (reach < 1e3 * plane_width(views))
    fprintf(out,
            "//   POV-Ray drops what is too faint (1e-10): even the brightest rays of a light\n"
            "//   end %.2g units away. Raise Gain, and lower the picture's exposure.\n",
            reach);
}

static void print_error(double error, FILE *out) {
  if (isfinite(error))
    fprintf(out, " %6.3g", 100 * error);
  else
    fputs("      -", out);
}

static void print_table(const struct sheet *sheet, FILE *out) {
  for (int p = 0; p < sheet->page_count; ++p) {
    const struct sheet_page *page = &sheet->pages[p];
    const struct slab *slab = &page->levels[0].views;
    fprintf(out, "//\n// Page %d: aperture %.6g x %.6g, %d x %d slopes %.4g..%.4g x %.4g..%.4g",
            p + 1, plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V), slab->samples[SLAB_S],
            slab->samples[SLAB_T], slab->st_window[0], slab->st_window[1], slab->st_window[2],
            slab->st_window[3]);
    if (isfinite(slab->st_distance)) fprintf(out, ", st plane at %.6g", slab->st_distance);
    fprintf(out, "\n//   flux at Scale 1, Gain 1: %.4g %.4g %.4g %s (red, green, blue)\n",
            page->flux[0], page->flux[1], page->flux[2], slab_flux_unit(slab));
    print_faint(page, out);
    fputs("//   error of the irradiance (relative RMSE) in %, on a plane so many aperture\n"
          "//   widths away (-: the sheet is farther); height of the sheet; smallest Scale\n"
          "//   lights    lit of          0.5      1      2      4      8    height  Scale >=\n",
          out);
    for (int k = 0; k < page->level_count; ++k) {
      const struct sheet_level *level = &page->levels[k];
      const int *lights = level->views.samples;
      char size[32];
      snprintf(size, sizeof size, "%dx%d", lights[SLAB_U], lights[SLAB_V]);
      fprintf(out, "//   %-8s %5d of %-5d ", size, level->lit, lights[SLAB_U] * lights[SLAB_V]);
      for (int d = 0; d < SHEET_DISTANCES; ++d) print_error(level->error[d], out);
      fprintf(out, "  %8.3g  %8.3g\n", level->height, sheet_least_height / level->height);
    }
  }
}

static void print_frames(const struct sheet *sheet, const struct include_text *text, FILE *out) {
  fputs("// One line a page: |u|, |v|, samples and range of s, samples and range of t,\n"
        "// 1/distance of the st plane, first of its levels.\n",
        out);
  fprintf(out, "#declare %s_Pages = array[%d][10] {\n", text->name, sheet->page_count);
  for (int p = 0, first = 0; p < sheet->page_count; ++p) {
    const struct slab *slab = &sheet->pages[p].levels[0].views;
    const double *w = slab->st_window;
    fprintf(out, "  { %.15g, %.15g, %d, %.15g, %.15g, %d, %.15g, %.15g, %.15g, %d }%s\n",
            plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V), slab->samples[SLAB_S], w[0], w[1],
            slab->samples[SLAB_T], w[2], w[3], slab_kappa(slab), first,
            p + 1 < sheet->page_count ? "," : "");
    first += sheet->pages[p].level_count;
  }
  fprintf(out,
          "}\n\n// One line a page: directions of u, v and the normal, centre.\n"
          "#declare %s_Frames = array[%d][4] {\n",
          text->name, sheet->page_count);
  for (int p = 0; p < sheet->page_count; ++p) {
    const struct slab *slab = &sheet->pages[p].levels[0].views;
    const double *vectors[4] = {slab->u, slab->v, slab->normal, slab->center};
    const double sizes[4] = {plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V), 1, 1};
    fputs("  { ", out);
    for (int k = 0; k < 4; ++k)
      fprintf(out, "<%.15g, %.15g, %.15g>%s", vectors[k][0] / sizes[k], vectors[k][1] / sizes[k],
              vectors[k][2] / sizes[k], k < 3 ? ", " : " }");
    fputs(p + 1 < sheet->page_count ? ",\n" : "\n", out);
  }
  fputs("}\n\n", out);
}

static void print_levels(const struct sheet *sheet, const struct include_text *text, FILE *out) {
  int levels = 0, rows = 0;
  for (int p = 0; p < sheet->page_count; ++p) levels += sheet->pages[p].level_count;
  fprintf(out,
          "// One line a level: lights along u and v, left and lower texel of its tiles in\n"
          "// the image, radiance that the image holds as 1, first of its rows in %s_Lit.\n"
          "#declare %s_Levels = array[%d][6] {\n",
          text->name, text->name, levels);
  for (int p = 0; p < sheet->page_count; ++p)
    for (int k = 0; k < sheet->pages[p].level_count; ++k) {
      const struct sheet_level *level = &sheet->pages[p].levels[k];
      const int *lights = level->views.samples;
      fprintf(out, "  { %d, %d, %d, %d, %.15g, %d }%s\n", lights[SLAB_U], lights[SLAB_V],
              level->left, level->bottom, level->peak, rows, --levels ? "," : "");
      rows += lights[SLAB_V];
    }
  fprintf(out,
          "}\n\n// Which lights are there, a row of u a line: views that are entirely black have\n"
          "// none.\n#declare %s_Lit = array[%d] {\n",
          text->name, rows);
  for (int p = 0; p < sheet->page_count; ++p)
    for (int k = 0; k < sheet->pages[p].level_count; ++k) {
      const struct sheet_level *level = &sheet->pages[p].levels[k];
      int nu = level->views.samples[SLAB_U], nv = level->views.samples[SLAB_V];
      for (int j = 0; j < nv; ++j)
        fprintf(out, "  \"%.*s\"%s\n", nu, level->mask + j * nu, --rows ? "," : "");
    }
  fputs("}\n\n", out);
}

static void print_head(const struct sheet *sheet, const struct include_text *text, FILE *out) {
  include_head(text,
               "One point light on each sample of\n"
               "//          the aperture; a sheet just before them filters each ray.\n",
               "//   @_Lights\n"
               "//          at most so many lights an axis; fewer are faster and less exact\n"
               "//          (tables below). May be changed between two lamps.\n"
               "//   @_Sheet_File\n"
               "//          path of the image, which POV-Ray looks for in the working folder\n"
               "//          and in Library_Path, not beside this file.\n",
               out);
  include_units(&sheet->pages[0].levels[0].views, out);
}

static void print_image(const struct sheet *sheet, const struct include_text *text, FILE *out) {
  const struct picture *picture = &sheet->picture;
  struct include_check check = {
      .at = {(sheet->check_left + SHEET_CHECK_SIZE / 2.0) / picture->width,
             (sheet->check_bottom + SHEET_CHECK_SIZE / 2.0) / picture->height, 0}};
  for (int c = 0; c < 3; ++c) check.rgb[c] = (double)sheet->check[c];
  include_image(text, "", &check, out);
  fprintf(out, "#declare %s_Image_Size = <%d, %d, 0>;\n\n", text->name, picture->width,
          picture->height);
}

void sheet_print(const struct sheet *sheet, const struct include_text *text, FILE *out) {
  int most = 1;
  for (int p = 0; p < sheet->page_count; ++p)
    for (int axis = SLAB_U; axis <= SLAB_V; ++axis) {
      int lights = sheet->pages[p].levels[0].views.samples[axis];
      most = lights > most ? lights : most;
    }
  print_head(sheet, text, out);
  print_limits(sheet, out);
  print_table(sheet, out);
  include_begin(text, sheet->stamp, out);
  include_named("#ifndef(@_Lights) #declare @_Lights = ", text->name, out);
  fprintf(out, "%d; #end\n\n", most);
  print_frames(sheet, text, out);
  print_levels(sheet, text, out);
  print_image(sheet, text, out);
  fprintf(out,
          "// Lowest sheet that POV-Ray sees all of, in scene units; the openings through which\n"
          "// its lights look at it stand at this share of its height, or so far before it.\n"
          "#declare %s_Least_Height = %g;\n#declare %s_Gate = %g;\n#declare %s_Gap = %g;\n\n",
          text->name, sheet_least_height, text->name, sheet_gate, text->name, sheet_gap);
  include_checks(text->name, out);
  include_named(sheet_macros, text->name, out);
  include_canned(text->name, out);
  include_named(sheet_canned, text->name, out);
  include_end(text, sheet->stamp, out);
}
