/* cluster_text.c - the include file of a cluster: its header, its lights, its macro. */
#include <math.h>

#include "include/cluster/cluster_text.h"
#include "slab/plane.h"

/* POV-Ray ignores shadows closer than 0.001 units: a lamp must be larger than that. */
static const double least_width = 0.002;

/* Above this, the header sends the reader to the sheet. */
static const double coarse = 0.05;

static const char macros[] =
    "// At most @_Lights, as a power of 2.\n"
    "#macro @_Points(N_)\n"
    "  #local M_ = N_;\n"
    "  #while (M_ > 1 & M_ > @_Lights) #local M_ = M_/2; #end\n"
    "  M_\n"
    "#end\n"
    "\n"
    "#macro @_Light(Number_, Size_, Gain_)\n"
    "  #local Nu_ = @_Points(@_Lobes[Number_][3]);\n"
    "  #local Nv_ = @_Points(@_Lobes[Number_][4]);\n"
    "  #local Fade_ = 1e-3*@_Lobes[Number_][5];\n"
    "  @_Fits(Size_*@_Lobes[Number_][5])\n"
    "  #if (Size_*@_Lobes[Number_][5] < @_Least_Width)\n"
    "    #error concat(\"@_Canned: too small for POV-Ray's shadow tolerance: use Scale >= \",\n"
    "      @_Text(@_Least_Width/@_Lobes[Number_][5]), \" instead of \", @_Text(Size_),\n"
    "      \", or larger scene units\\n\")\n"
    "  #end\n"
    "  light_source { Size_*@_Places[Number_][0] rgb Gain_*@_Colours[Number_]/(2*pi*1e-6)\n"
    "    spotlight point_at Size_*(@_Places[Number_][0] + @_Places[Number_][3])\n"
    "    radius @_Lobes[Number_][0] falloff @_Lobes[Number_][1] tightness @_Lobes[Number_][2]\n"
    "    fade_power 2 fade_distance Size_*Fade_\n"
    "    #if (Nu_*Nv_ > 1)  // points on the middles of Nu by Nv equal parts\n"
    "      area_light Size_*@_Places[Number_][1]*(Nu_ - 1)/Nu_,\n"
    "        Size_*@_Places[Number_][2]*(Nv_ - 1)/Nv_, Nu_, Nv_ area_illumination on\n"
    "    #end\n"
    "  }\n"
    "#end\n"
    "\n";

static const char canned[] =
    "  #if (@_Lights < 1)\n"
    "    #error concat(\"@_Canned: @_Lights is \", str(@_Lights, 0, 2),\n"
    "      \", must be at least 1\\n\")\n"
    "  #end\n"
    "  #local Most_ = <0, 0, 0>;\n"
    "  #for (Number_, 0, dimension_size(@_Lobes, 1) - 1)\n"
    "    #if (vlength(@_Colours[Number_]) > vlength(Most_)) #local Most_ = @_Colours[Number_]; "
    "#end\n"
    "  #end\n"
    "  @_Strength(Gain_*Most_/(2*pi*1e-6))\n"
    "  #local Several_ = (dimension_size(@_Lobes, 1) > 1);\n"
    "  #if (Several_) union { #end\n"
    "    #for (Number_, 0, dimension_size(@_Lobes, 1) - 1)\n"
    "      @_Light(Number_, Size_, Gain_)\n"
    "    #end\n"
    "  #if (Several_) } #end\n"
    "#end\n";

static double narrowest(const struct cluster *cluster) {
  double width = INFINITY;
  for (int p = 0; p < cluster->page_count; ++p)
    width = fmin(width, plane_width(&cluster->pages[p].frame));
  return width;
}

static void print_pages(const struct cluster *cluster, FILE *out) {
  for (int p = 0; p < cluster->page_count; ++p) {
    const struct cluster_page *page = &cluster->pages[p];
    const struct slab *slab = &page->frame;
    double metres2 = slab->metres_per_unit * slab->metres_per_unit;
    int points = 0;
    for (int k = 0; k < page->count; ++k)
      points += page->lights[k].size[0] * page->lights[k].size[1];
    fprintf(out,
            "//\n// Page %d: aperture %.6g x %.6g, %d lights of %d points in all\n"
            "//   flux at Scale 1, Gain 1: %.4g %.4g %.4g %s (red, green, blue)\n"
            "//   error of the irradiance (relative RMSE) on a plane so many aperture widths\n"
            "//   away:",
            p + 1, plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V), page->count, points,
            page->flux[0] * metres2, page->flux[1] * metres2, page->flux[2] * metres2,
            slab_flux_unit(slab));
    for (int d = 0; d < CLUSTER_DISTANCES; ++d)
      fprintf(out, " %.3g %% at %g%s", 100 * page->error[d], cluster_distances[d],
              d + 1 < CLUSTER_DISTANCES ? "," : "\n");
    if (page->error_at > coarse)
      fprintf(out,
              "//   That is coarse: at %g widths, for which it was fitted, %.3g %%. A sheet\n"
              "//   (--mode sheet) is better, --mode auto --tolerance T finds how large a one.\n",
              cluster->distance, 100 * page->error_at);
  }
}

static void print_header(const struct cluster *cluster, const struct include_text *text,
                         FILE *out) {
  include_head(text,
               "Area lights on the aperture, with\n"
               "//          the lobes of spotlights, that were fitted to it.\n",
               "//   @_Lights\n"
               "//          at most so many points along each edge of a light; fewer are\n"
               "//          faster, and shadows less smooth. The errors below hold for the\n"
               "//          default. May be changed between two lamps.\n",
               out);
  include_units(&cluster->pages[0].frame, out);
  fprintf(out,
          "// Limits:  An approximation (errors below). POV-Ray ignores shadows closer than\n"
          "//          0.001 units to a light: Scale >= %.3g, or use larger scene units.\n"
          "//          Not in a light_group, not with quality +Q4 or less. With an assumed_gamma\n"
          "//          other than 1.0 POV-Ray adds light up wrongly.\n",
          least_width / narrowest(cluster));
  if (cluster->black_pages)
    fprintf(out, "//          %d page(s) of the lamp hold no light and were left out.\n",
            cluster->black_pages);
  print_pages(cluster, out);
}

/* A vector of the aperture's plane, and along its normal, in lamp space. */
static void print_vector(const struct slab *slab, const double uv[2], double along, double origin,
                         const char *end, FILE *out) {
  double width = plane_width(slab), v[3];
  for (int c = 0; c < 3; ++c)
    v[c] = origin * slab->center[c] +
           width * (uv[0] * slab->u[c] / plane_edge(slab, SLAB_U) +
                    uv[1] * slab->v[c] / plane_edge(slab, SLAB_V) + along * slab->normal[c]);
  fprintf(out, "<%.15g, %.15g, %.15g>%s", v[0], v[1], v[2], end);
}

static void print_places(const struct cluster *cluster, const char *name, FILE *out) {
  int left = cluster_light_count(cluster);
  fprintf(out,
          "// One line a light: centre and full edges of its parallelogram, direction of its\n"
          "// lobe's axis.\n#declare %s_Places = array[%d][4] {\n",
          name, left);
  for (int p = 0; p < cluster->page_count; ++p)
    for (int k = 0; k < cluster->pages[p].count; ++k) {
      const struct slab *slab = &cluster->pages[p].frame;
      const struct cluster_light *light = &cluster->pages[p].lights[k];
      fputs("  { ", out);
      print_vector(slab, light->center, 0, 1, ", ", out);
      print_vector(slab, light->edge[0], 0, 0, ", ", out);
      print_vector(slab, light->edge[1], 0, 0, ", ", out);
      print_vector(slab, light->axis, 1, 0, --left ? " },\n" : " }\n}\n\n", out);
    }
}

static double degrees(double cosine) {
  return cosine > 0 ? acos(cosine) * 180 / M_PI : 90;
}

static void print_lobes(const struct cluster *cluster, const char *name, FILE *out) {
  int left = cluster_light_count(cluster);
  fprintf(out,
          "// One line a light: radius, falloff and tightness of its lobe, points along its\n"
          "// edges, width of its aperture.\n#declare %s_Lobes = array[%d][6] {\n",
          name, left);
  for (int p = 0; p < cluster->page_count; ++p)
    for (int k = 0; k < cluster->pages[p].count; ++k) {
      const struct cluster_light *light = &cluster->pages[p].lights[k];
      fprintf(out, "  { %.10g, %.10g, %.10g, %d, %d, %.10g }%s\n", degrees(light->cos_radius),
              degrees(light->cos_falloff), light->tightness, light->size[0], light->size[1],
              plane_width(&cluster->pages[p].frame), --left ? "," : "\n}\n");
    }
}

static void print_colours(const struct cluster *cluster, const char *name, FILE *out) {
  int left = cluster_light_count(cluster);
  fprintf(out,
          "// Intensity of each light along its axis, over the square of its aperture's width.\n"
          "#declare %s_Colours = array[%d] {\n",
          name, left);
  for (int p = 0; p < cluster->page_count; ++p)
    for (int k = 0; k < cluster->pages[p].count; ++k) {
      const double *rgb = cluster->pages[p].lights[k].rgb;
      fprintf(out, "  <%.10g, %.10g, %.10g>%s\n", rgb[0], rgb[1], rgb[2], --left ? "," : "\n}\n");
    }
}

void cluster_print(const struct cluster *cluster, const struct include_text *text, FILE *out) {
  print_header(cluster, text, out);
  include_begin(text, cluster->stamp, out);
  int most = 1;
  for (int p = 0; p < cluster->page_count; ++p)
    for (int k = 0; k < cluster->pages[p].count; ++k)
      for (int e = 0; e < 2; ++e)
        if (cluster->pages[p].lights[k].size[e] > most) most = cluster->pages[p].lights[k].size[e];
  include_named("#ifndef(@_Lights) #declare @_Lights = ", text->name, out);
  fprintf(out, "%d; #end\n\n", most);
  print_places(cluster, text->name, out);
  print_lobes(cluster, text->name, out);
  print_colours(cluster, text->name, out);
  fprintf(out,
          "// Smallest width of an aperture, in scene units: POV-Ray ignores shadows closer\n"
          "// than 0.001.\n#declare %s_Least_Width = %g;\n\n",
          text->name, least_width);
  include_checks(text->name, out);
  include_named(macros, text->name, out);
  include_canned(text->name, out);
  include_named(canned, text->name, out);
  include_end(text, cluster->stamp, out);
}
