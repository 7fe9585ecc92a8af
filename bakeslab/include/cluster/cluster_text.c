/* cluster_text.c - the include file of a cluster: cluster.inc.in and, for each page of its
 * header, cluster_page.inc.in. */
#include <math.h>

#include "include/cluster/cluster.h"
#include "slab/plane.h"

extern const char cluster_inc[], cluster_page_inc[];

/* POV-Ray ignores shadows closer than 0.001 units: a lamp must be larger than that. */
static const double least_width = 0.002;

/* Above this, the header sends the reader to the sheet. */
static const double coarse = 0.05;

static void print_pages(const void *of, FILE *out) {
  const struct cluster *cluster = of;
  for (int p = 0; p < cluster->page_count; ++p) {
    const struct cluster_page *page = &cluster->pages[p];
    double metres = page->frame.metres_per_unit, flux[3], percent[CLUSTER_DISTANCES];
    for (int c = 0; c < 3; ++c) flux[c] = page->flux[c] * (metres * metres);
    for (int d = 0; d < CLUSTER_DISTANCES; ++d) percent[d] = 100 * page->error[d];
    const struct include_value values[] = {
        {"page", .number = p + 1},
        {"channel", .text = page->frame.channel},
        {"aperture_u", .number = plane_edge(&page->frame, SLAB_U)},
        {"aperture_v", .number = plane_edge(&page->frame, SLAB_V)},
        {"lights", .number = page->count},
        {"points", .number = cluster_page_points(page)},
        {"flux", .numbers = flux},
        {"flux_unit", .text = slab_flux_unit(&page->frame)},
        {"percent", .numbers = percent},
        {"coarse", .number = page->error_at > coarse ? 100 * page->error_at : 0},
        {"distance", .number = cluster->distance},
        {0}};
    if (p) putc('\n', out);
    include_fill(cluster_page_inc, "", values, out);
  }
}

/* Rows of an array, one a light. */
struct rows {
  const struct cluster *cluster;
  void (*print)(const struct slab *frame, const struct cluster_light *light, FILE *out);
};

static void print_rows(const void *of, FILE *out) {
  const struct rows *rows = of;
  const struct cluster *cluster = rows->cluster;
  for (int p = 0, row = 0; p < cluster->page_count; ++p)
    for (int k = 0; k < cluster->pages[p].count; ++k) {
      fputs(row++ ? ",\n  " : "  ", out);
      rows->print(&cluster->pages[p].frame, &cluster->pages[p].lights[k], out);
    }
}

/* A vector of the aperture's plane, and along its normal, in lamp space. */
static void print_vector(const struct slab *frame, const double uv[2], double along, double origin,
                         FILE *out) {
  double width = plane_width(frame), v[3];
  for (int c = 0; c < 3; ++c)
    v[c] = origin * frame->center[c] +
           width * (uv[0] * frame->u[c] / plane_edge(frame, SLAB_U) +
                    uv[1] * frame->v[c] / plane_edge(frame, SLAB_V) + along * frame->normal[c]);
  fprintf(out, "<%.15g, %.15g, %.15g>", v[0], v[1], v[2]);
}

static void print_place(const struct slab *frame, const struct cluster_light *light, FILE *out) {
  fputs("{ ", out);
  print_vector(frame, light->center, 0, 1, out);
  for (int k = 0; k < 2; ++k) {
    fputs(", ", out);
    print_vector(frame, light->edge[k], 0, 0, out);
  }
  fputs(", ", out);
  print_vector(frame, light->axis, 1, 0, out);
  fputs(" }", out);
}

/* Of a cone. POV-Ray's media look for light within cones, and miss much of what is in those
 * nearer to 90 degrees; what is left out is at most 1.8e-4 of a light, where its lobe is flat. */
static double degrees(double cosine) {
  static const double widest = 89.99;
  return fmin(acos(fmax(cosine, 0)) * 180 / M_PI, widest);
}

static void print_lobe(const struct slab *frame, const struct cluster_light *light, FILE *out) {
  fprintf(out, "{ %.10g, %.10g, %.10g, %d, %d, %.10g }", degrees(light->cos_radius),
          degrees(light->cos_falloff), light->tightness, light->size[0], light->size[1],
          plane_width(frame));
}

static void print_colour(const struct slab *frame, const struct cluster_light *light, FILE *out) {
  (void)frame;
  fprintf(out, "<%.10g, %.10g, %.10g>", light->rgb[0], light->rgb[1], light->rgb[2]);
}

static void print_channels(const void *of, FILE *out) {
  const struct cluster *cluster = of;
  for (int p = 0, row = 0; p < cluster->page_count; ++p)
    for (int k = 0; k < cluster->pages[p].count; ++k)
      fprintf(out, "%s%d", row++ ? ", " : "  ",
              include_channel(&cluster->lamp, &cluster->pages[p].frame));
}

/* Intensity of the brightest point of the page's lights, on their axes, at Scale 1. */
static double brightest_point(const struct cluster_page *page) {
  double width = plane_width(&page->frame), most = 0;
  for (int k = 0; k < page->count; ++k) {
    const struct cluster_light *light = &page->lights[k];
    double of_all = fmax(light->rgb[0], fmax(light->rgb[1], light->rgb[2]));
    most = fmax(most, of_all / (light->size[0] * light->size[1]));
  }
  return most * width * width;
}

void cluster_print(const struct cluster *cluster, const struct include_text *text, FILE *out) {
  double narrowest = INFINITY, faintest = INFINITY;
  int most = 1;
  for (int p = 0; p < cluster->page_count; ++p) {
    const struct cluster_page *page = &cluster->pages[p];
    narrowest = fmin(narrowest, plane_width(&page->frame));
    faintest = fmin(faintest, brightest_point(page));
    for (int k = 0; k < page->count; ++k)
      for (int e = 0; e < 2; ++e)
        if (page->lights[k].size[e] > most) most = page->lights[k].size[e];
  }
  const struct include_value values[] = {
      {"least_scale", .number = least_width / narrowest},
      {"pages", .print = print_pages, .of = cluster},
      {"no_face", .number = 1},
      {"lights", .number = most},
      {"light_count", .number = cluster_light_count(cluster)},
      {"place_rows", .print = print_rows, .of = &(struct rows){cluster, print_place}},
      {"lobe_rows", .print = print_rows, .of = &(struct rows){cluster, print_lobe}},
      {"colour_rows", .print = print_rows, .of = &(struct rows){cluster, print_colour}},
      {"channel_row", .print = print_channels, .of = cluster},
      {"least_width", .number = least_width},
      {"reach", .number = include_reach(faintest, plane_width(&cluster->lamp.frame))},
      {0}};
  include_print(cluster_inc, text, &cluster->lamp, values, out);
}
