/* far_page.c - the mean over a of L(a, s + kappa a), and then the same along b and t. L is bilinear
 * between samples, so that between the lines at which a or s + kappa a passes a sample it is a
 * quadratic of a, which Simpson's rule integrates exactly. */
#include "export/far_page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/plane.h"
#include "slab/slab_resample.h"

enum {
  FINER = 31, /* directions for one of the page at most; odd, so that samples are among them */
  MOST = 768  /* of all, unless the page has as many */
};

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Positions and slopes along one axis of a page, and the slopes of its view. */
struct line {
  int positions, slopes, views;
  double edge, low, high, kappa;
  double first, step; /* slopes of the view's samples */
};

/* The view's window is wider by what the aperture's ends see beyond the page's, and holds a dark
 * sample at each end. */
static struct line line_of(const struct slab *slab, int axis) {
  const double *window = slab->st_window + 2 * axis;
  struct line line = {.positions = slab->samples[axis],
                      .slopes = slab->samples[2 + axis],
                      .edge = plane_edge(slab, axis),
                      .low = window[0],
                      .high = window[1],
                      .kappa = slab_kappa(slab)};
  double reach = line.kappa * line.edge / 2, cell = (line.high - line.low) / line.slopes;
  double cells = line.slopes + 2 * reach / cell;
  int finer = (int)fmax(1, fmin(FINER, MOST / cells));
  line.step = fmax(cell / (finer - 1 + finer % 2), cells * cell / fmax(MOST, line.slopes));
  int wider = (int)ceil(reach / line.step) + 1;
  line.views = (int)lround((line.high - line.low) / line.step) + 2 * wider;
  line.first = (line.low + line.high) / 2 - (line.views - 1) / 2.0 * line.step;
  return line;
}

/* Sample number `at`, linear between whole ones. */
static int cell_of(double at, int count, double *part) {
  double held = fmin(fmax(at, 0), count - 1);
  int cell = (int)fmin(floor(held), fmax(0, count - 2));
  *part = held - cell;
  return cell;
}

/* L at a position and a slope within the window; values: [positions][slopes]. */
static double line_value(const struct line *line, const float *values, double x, double slope) {
  double right, up;
  int i = cell_of((x / line->edge + 0.5) * line->positions - 0.5, line->positions, &right);
  int k = cell_of((slope - line->low) / (line->high - line->low) * line->slopes - 0.5, line->slopes,
                  &up);
  const float *a = values + i * line->slopes + k, *b = a + (right > 0 ? line->slopes : 0);
  int next = up > 0 ? 1 : 0;
  return (1 - right) * ((1 - up) * (double)a[0] + up * (double)a[next]) +
         right * ((1 - up) * (double)b[0] + up * (double)b[next]);
}

/* The mean over the edge: between neighbouring lines by Simpson's rule. */
static double line_mean(const struct line *line, const float *values, double slope) {
  double cell = (line->high - line->low) / line->slopes, kappa = line->kappa, sum = 0;
  double from = fmax(-line->edge / 2, (line->low - slope) / kappa);
  double to = fmin(line->edge / 2, (line->high - slope) / kappa);
  if (!(from < to)) return 0;
  int i = (int)floor((from / line->edge + 0.5) * line->positions - 0.5) + 1;
  int k = (int)floor((slope + kappa * from - line->low) / cell - 0.5) + 1;
  for (double x = from; x < to;) {
    double position = ((i + 0.5) / line->positions - 0.5) * line->edge;
    double direction = (line->low + (k + 0.5) * cell - slope) / kappa;
    double next = fmin(to, fmin(position, direction)), middle = (x + next) / 2;
    if (position <= next) ++i;
    if (direction <= next) ++k;
    if (!(next > x)) continue;
    sum += (next - x) / 6 *
           (line_value(line, values, x, slope + kappa * x) +
            4 * line_value(line, values, middle, slope + kappa * middle) +
            line_value(line, values, next, slope + kappa * next));
    x = next;
  }
  return sum / line->edge;
}

/* Luminances of a row of samples along u and s: [positions][slopes]. */
static void take_row(const struct slab *slab, int j, int l, float *values) {
  for (int i = 0; i < slab->samples[SLAB_U]; ++i)
    for (int k = 0; k < slab->samples[SLAB_S]; ++k)
      *values++ = (float)slab_luminance(slab_at((struct slab *)slab, i, j, k, l));
}

/* Along u for each row of v and t: columns[view along s][v][t]; then along v. */
static void fill(const struct slab *slab, const struct line line[2], float *values, float *columns,
                 struct slab *view) {
  int rows = line[1].positions * line[1].slopes;
  for (int j = 0; j < line[1].positions; ++j)
    for (int l = 0; l < line[1].slopes; ++l) {
      take_row(slab, j, l, values);
      for (int p = 0; p < line[0].views; ++p)
        columns[(size_t)p * (size_t)rows + (size_t)(j * line[1].slopes + l)] =
            (float)line_mean(&line[0], values, line[0].first + p * line[0].step);
    }
  for (int p = 0; p < line[0].views; ++p)
    for (int q = 0; q < line[1].views; ++q) {
      const float *column = columns + (size_t)p * (size_t)rows;
      slab_at(view, 0, 0, p, q)[0] =
          (float)line_mean(&line[1], column, line[1].first + q * line[1].step);
    }
}

static enum result take_means(const struct slab *slab, struct slab *view, struct error *error) {
  struct line line[2] = {line_of(slab, 0), line_of(slab, 1)};
  size_t row = (size_t)line[0].positions * (size_t)line[0].slopes;
  size_t rows = (size_t)line[1].positions * (size_t)line[1].slopes;
  *view = slab_default();
  memcpy(view->u, slab->u, sizeof view->u);
  memcpy(view->v, slab->v, sizeof view->v);
  memcpy(view->normal, slab->normal, sizeof view->normal);
  for (int axis = 0; axis < 2; ++axis) {
    double *window = view->st_window + 2 * axis;
    view->samples[2 + axis] = line[axis].views;
    window[0] = line[axis].first - line[axis].step / 2;
    window[1] = window[0] + line[axis].views * line[axis].step;
  }
  float *values = malloc(row * sizeof *values);
  float *columns = calloc((size_t)line[0].views, rows * sizeof *columns);
  enum result result = values && columns ? slab_alloc(view, error) : result_no_memory(error);
  if (result == RESULT_OK) fill(slab, line, values, columns, view);
  free(values);
  free(columns);
  return result;
}

enum result far_page_make(const struct slab *slab, struct far_page *page, struct error *error) {
  const int one[SLAB_AXES] = {1, 1, slab->samples[SLAB_S], slab->samples[SLAB_T]};
  double unit = strcmp(slab->radiance_unit, "W/(sr m2)") ? 1 : SLAB_WATT_LUMENS;
  *page = (struct far_page){.slab = slab,
                            .scale = unit * slab->metres_per_unit * slab->metres_per_unit *
                                     plane_edge(slab, SLAB_U) * plane_edge(slab, SLAB_V)};
  if (slab_kappa(slab) != 0) return take_means(slab, &page->view, error);
  enum result result = slab_resample(slab, one, &page->view, error);
  for (size_t k = 0; result == RESULT_OK && k < slab_sample_count(&page->view); ++k)
    page->view.rgb[3 * k] = (float)slab_luminance(page->view.rgb + 3 * k);
  return result;
}

void far_page_free(struct far_page *page) {
  slab_free(&page->view);
  *page = (struct far_page){0};
}

double far_page_candela(const struct far_page *page, const double direction[3]) {
  const struct slab *slab = page->slab;
  double cosine = dot(direction, slab->normal), rgb[3];
  if (!(cosine > 0)) return 0;
  double s = dot(direction, slab->u) / plane_edge(slab, SLAB_U) / cosine;
  double t = dot(direction, slab->v) / plane_edge(slab, SLAB_V) / cosine;
  slab_lookup(&page->view, 0, 0, s, t, rgb);
  return page->scale * cosine * rgb[0];
}
