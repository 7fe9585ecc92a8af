/* point_text.c - the include file of a point light. */
#include <math.h>

#include "include/point/point.h"
#include "slab/plane.h"

/* POV-Ray wants its SMALL_TOLERANCE, 0.001 units, between a light and what filters it;
 * twice that is exact. */
static const double least_radius = 0.002;

/* The sphere's radius in aperture widths, as far as the tolerance allows, and at most. */
static const double radius = 0.05, most_radius = 0.5;

static const char canned[] =
    "  #local Width_ = Size_*@_Width;\n"
    "  @_Fits(Width_)\n"
    "  #local Radius_ = max(@_Radius*Width_, @_Least_Radius);\n"
    "  #if (Radius_ > @_Most_Radius*Width_)\n"
    "    #error concat(\"@_Canned: too small for POV-Ray's shadow tolerance: use Scale >= \",\n"
    "      @_Text(@_Least_Radius/(@_Most_Radius*@_Width)), \" instead of \", @_Text(Size_),\n"
    "      \", or larger scene units\\n\")\n"
    "  #end\n"
    "  #local Fade_ = 1e-3*@_Width;\n"
    "  #local Colour_ = Gain_*@_Intensity/(2*pi*Fade_*Fade_);\n"
    "  @_Strength(Colour_)\n"
    "  union {\n"
    "    light_source { 0 rgb Colour_ fade_power 2 fade_distance Size_*Fade_ }\n"
    "    sphere { 0, 1 pigment { @_Sheet } finish { ambient 0 diffuse 0 emission 0 } }\n"
    "    no_image no_reflection no_radiosity\n"
    "    #local U_ = Radius_*@_Frame[0];\n"
    "    #local V_ = Radius_*@_Frame[1];\n"
    "    #local N_ = Radius_*@_Frame[2];\n"
    "    #local C_ = Size_*@_Frame[3];\n"
    "    matrix <U_.x, U_.y, U_.z, V_.x, V_.y, V_.z, N_.x, N_.y, N_.z, C_.x, C_.y, C_.z>\n"
    "  }\n"
    "#end\n";

static void print_header(const struct point *point, const struct include_text *text, FILE *out) {
  double metres2 = point->frame.metres_per_unit * point->frame.metres_per_unit;
  include_head(text,
               "One point light at its centre, as\n"
               "//          the lamp looks from far away; an image on a small sphere filters it.\n",
               "//   @_Sheet_File\n"
               "//          path of the image, which POV-Ray looks for in the working folder\n"
               "//          and in Library_Path, not beside this file.\n",
               out);
  include_units(&point->frame, out);
  fprintf(out,
          "// Limits:  Right far away only (errors below). Surfaces may not come closer than\n"
          "//          the sphere, %g of the aperture's width. POV-Ray ignores shadows closer\n"
          "//          than 0.001 units to a light: the sphere grows below Scale %.3g, and\n"
          "//          Scale must be at least %.3g; use larger scene units for small lamps.\n"
          "//          It tests boxes in single precision: keep the lamp and what it lights\n"
          "//          within 10000 of its widths of the origin, and %g units wide at most.\n"
          "//          Light of other lamps is filtered by the sphere. Not in a light_group,\n"
          "//          not with shadowless, quality +Q4 or better.\n",
          radius, least_radius / (radius * point->width),
          least_radius / (most_radius * point->width), include_most_width);
  if (point->black_pages)
    fprintf(out, "//          %d page(s) of the lamp hold no light and were left out.\n",
            point->black_pages);
  fprintf(out,
          "//\n// Aperture %.6g wide\n"
          "//   flux at Scale 1, Gain 1: %.4g %.4g %.4g %s (red, green, blue)\n"
          "//   error of the irradiance (relative RMSE) on a plane so many aperture widths\n"
          "//   away:",
          point->width, point->flux[0] * metres2, point->flux[1] * metres2,
          point->flux[2] * metres2, slab_flux_unit(&point->frame));
  for (int d = 0; d < POINT_DISTANCES; ++d)
    fprintf(out, " %.3g %% at %g%s", 100 * point->error[d], point_distances[d],
            d + 1 < POINT_DISTANCES ? "," : "\n");
}

static void print_numbers(const struct point *point, const char *name, FILE *out) {
  const struct slab *slab = &point->frame;
  const double *vectors[4] = {slab->u, slab->v, slab->normal, point->center};
  const double sizes[4] = {plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V), 1, 1};
  fprintf(out, "// Directions of u, v and the normal, centre.\n#declare %s_Frame = array[4] {\n",
          name);
  for (int k = 0; k < 4; ++k)
    fprintf(out, "  <%.15g, %.15g, %.15g>%s\n", vectors[k][0] / sizes[k], vectors[k][1] / sizes[k],
            vectors[k][2] / sizes[k], k < 3 ? "," : "\n}");
  fprintf(out,
          "// Width of the aperture; intensity that the image holds as 1.\n"
          "#declare %s_Width = %.15g;\n#declare %s_Intensity = <%.10g, %.10g, %.10g>;\n"
          "// Radius of the sphere in widths, and at most; at least, in scene units.\n"
          "#declare %s_Radius = %g;\n#declare %s_Most_Radius = %g;\n"
          "#declare %s_Least_Radius = %g;\n\n",
          name, point->width, name, point->intensity[0], point->intensity[1], point->intensity[2],
          name, radius, name, most_radius, name, least_radius);
}

void point_print(const struct point *point, const struct include_text *text, FILE *out) {
  print_header(point, text, out);
  include_begin(text, point->stamp, out);
  print_numbers(point, text->name, out);
  include_image(text, "map_type 1 ", &point->check, out);
  include_checks(text->name, out);
  include_canned(text->name, out);
  include_named(canned, text->name, out);
  include_end(text, point->stamp, out);
}
