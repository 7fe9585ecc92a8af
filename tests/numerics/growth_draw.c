/* growth_draw.c - the worst errors along each kind of hardness: small plots in SVG, and a table. */
#include <math.h>

#include "numerics.h"

static const struct {
  enum gather_method method;
  const char *colour;
} curves[] = {{GATHER_MIDPOINT, "#8c564b"}, {GATHER_PI, "#9467bd"}, {GATHER_AUTO, "#1f77b4"},
              {GATHER_CUT, "#2ca02c"},      {GATHER_GL, "#ff7f0e"}, {GATHER_CLOSED, "#7f7f7f"},
              {GATHER_REFERENCE, "#d62728"}};
enum { CURVES = sizeof curves / sizeof curves[0], WIDTH = 270, HEIGHT = 170, LEFT = 42, TOP = 24 };

/* From 10^LOW to 10^HIGH; what is less lies on the axis. */
enum { LOW = -16, HIGH = 0 };

static double place_y(double error) {
  const double decades = fmin(fmax(log10(error), LOW), HIGH);
  return TOP + HEIGHT * (HIGH - decades) / (HIGH - LOW);
}

static double place_x(double bin) {
  return LEFT + WIDTH * bin / GROWTH_BINS;
}

static void draw_curve(FILE *file, const struct growth *growth, int axis, int curve) {
  const char *before = "<path fill=none stroke-width=1.6 stroke='";
  char pen = 'M';
  for (int bin = 0; bin < GROWTH_BINS; ++bin) {
    const double worst = growth->worst[axis][bin][curves[curve].method];
    if (!(worst > 0)) {
      pen = 'M';
      continue;
    }
    if (before) fprintf(file, "%s%s' d='", before, curves[curve].colour);
    before = NULL;
    fprintf(file, "%c%.1f %.1f", pen, place_x(bin + 0.5), place_y(worst));
    pen = 'L';
  }
  if (!before) fprintf(file, "'/>\n");
}

static void draw_axis(FILE *file, const struct growth *growth, int axis) {
  const struct growth_axis *about = &growth_axes[axis];
  fprintf(file, "<svg width=%d height=%d font-size=11><text x=%d y=14>%s</text>\n", WIDTH + 60,
          HEIGHT + 46, LEFT, about->name);
  for (int y = LOW; y <= HIGH; y += 4)
    fprintf(file, "<path stroke='#ddd' d='M%d %.1fh%d'/><text x=2 y=%.1f>1e%d</text>\n", LEFT,
            place_y(pow(10, y)), WIDTH, place_y(pow(10, y)) + 4, y);
  for (int x = (int)about->low; x <= about->high; x += about->high > 9 ? 10 : 3)
    fprintf(file, "<text x=%.1f y=%d text-anchor=middle>1e%d</text>\n",
            place_x((x - about->low) / (about->high - about->low) * GROWTH_BINS), TOP + HEIGHT + 16,
            x);
  for (int curve = 0; curve < CURVES; ++curve) draw_curve(file, growth, axis, curve);
  fprintf(file, "</svg>\n");
}

void growth_write_svg(FILE *file, const struct growth *growth) {
  fprintf(file, "<h2>How errors grow</h2>\n<p>The largest relative error against what makes a case "
                "hard; <b>auto</b> and <b>cut</b> are asked for 1e-3, <b>gl</b> is against the sum "
                "over views. ");
  for (int curve = 0; curve < CURVES; ++curve)
    fprintf(file, "<b style='color:%s'>%s</b> ", curves[curve].colour,
            gather_methods[curves[curve].method].name);
  fprintf(file, "</p>\n");
  for (int axis = 0; axis < GROWTH_AXES; ++axis) draw_axis(file, growth, axis);
}

bool growth_write_table(const char *path, const struct growth *growth) {
  FILE *file = fopen(path, "w");
  if (!file) {
    perror(path);
    return false;
  }
  for (int axis = 0; axis < GROWTH_AXES; ++axis) {
    const struct growth_axis *about = &growth_axes[axis];
    fprintf(file, "\"%s\"", about->name);
    for (int curve = 0; curve < CURVES; ++curve)
      fprintf(file, " %s", gather_methods[curves[curve].method].name);
    for (int bin = 0; bin < GROWTH_BINS; ++bin) {
      fprintf(file, "\n%g",
              pow(10, about->low + (about->high - about->low) * (bin + 0.5) / GROWTH_BINS));
      for (int curve = 0; curve < CURVES; ++curve)
        fprintf(file, " %g", growth->worst[axis][bin][curves[curve].method]);
    }
    fprintf(file, "\n\n\n");
  }
  return fclose(file) == 0;
}
