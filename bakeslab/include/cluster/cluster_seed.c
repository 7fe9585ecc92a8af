/* cluster_seed.c - groups of the slab's 4D cells, and lights for each.
 *
 * A cell is a point (a, b, D s, D t) with its energy as weight: what lies close
 * there lights the same part of a plane at the distance D. Groups are halved
 * across their longest axis, the one with the largest moment first, then
 * relaxed by Lloyd's iteration ("Least squares quantization in PCM", 1982). A light covers the
 * smallest parallelogram around its group's uv samples. */
#include "include/cluster/cluster_seed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/cluster/parallelogram.h"
#include "slab/plane.h"
#include "slab/slab_resample.h"

enum { MOST_UV = 8, MOST_ST = 24, LLOYD_STEPS = 12, POWER_STEPS = 20 };

/* Lobes of each group, in its own widths. */
enum { WIDTHS = 3, MOST_CANDIDATES = 2 * CLUSTER_MOST_LIGHTS * WIDTHS + 8 };
static const double widths[WIDTHS] = {0.7, 1, 1.5};

/* Most points of a candidate, on its own. */
enum { CANDIDATE_POINTS = 16 };

/* Share of a group's energy that its parallelogram may leave out. */
static const double trimmed = 0.02;

/* Points of a light are at most so many widths apart; and are not seen one by one at this
 * distance. */
static const double most_apart = 0.25, near = 1.5;

struct cell {
  double x[4], energy;
  int place, group; /* index of its uv sample, of its group */
};

struct cell_list {
  struct cell *cells; /* owned */
  int count;
  double distance;
};

struct moments {
  double energy, mean[4], covariance[4][4];
  double spread; /* the covariance's trace */
};

static enum result list_cells(const struct slab *slab, struct cell_list *list,
                              struct error *error) {
  double width = plane_width(slab), kappa = slab_kappa(slab);
  list->cells = calloc(slab_sample_count(slab), sizeof *list->cells);
  if (!list->cells) return result_no_memory(error);
  for (size_t pixel = 0; pixel < slab_sample_count(slab); ++pixel) {
    int at[SLAB_AXES];
    slab_locate(slab, pixel, at);
    const float *rgb = slab->rgb + 3 * pixel;
    struct cell cell = {.place = at[SLAB_V] * slab->samples[SLAB_U] + at[SLAB_U]};
    double r2 = 1;
    for (int k = 0; k < 2; ++k) {
      double a = slab_position(slab, SLAB_U + k, at[SLAB_U + k]);
      double slope = slab_position(slab, SLAB_S + k, at[SLAB_S + k]) - kappa * a;
      cell.x[k] = a / width;
      cell.x[2 + k] = list->distance * slope;
      r2 += slope * slope;
    }
    cell.energy = ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / (r2 * r2);
    if (cell.energy > 0) list->cells[list->count++] = cell;
  }
  return RESULT_OK;
}

static struct moments group_moments(const struct cell_list *list, int group) {
  struct moments m = {0};
  for (int k = 0; k < list->count; ++k) {
    const struct cell *cell = &list->cells[k];
    if (cell->group != group) continue;
    m.energy += cell->energy;
    for (int i = 0; i < 4; ++i) m.mean[i] += cell->energy * cell->x[i];
  }
  for (int i = 0; i < 4 && m.energy > 0; ++i) m.mean[i] /= m.energy;
  for (int k = 0; k < list->count; ++k) {
    const struct cell *cell = &list->cells[k];
    if (cell->group != group) continue;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        m.covariance[i][j] += cell->energy * (cell->x[i] - m.mean[i]) * (cell->x[j] - m.mean[j]);
  }
  for (int i = 0; i < 4; ++i) m.spread += m.covariance[i][i];
  return m;
}

/* The axis of the largest moment, by power iteration from the longest column. */
static void longest_axis(const struct moments *m, double axis[4]) {
  int longest = 0;
  for (int i = 1; i < 4; ++i)
    if (m->covariance[i][i] > m->covariance[longest][longest]) longest = i;
  memcpy(axis, m->covariance[longest], sizeof m->covariance[longest]);
  for (int step = 0; step < POWER_STEPS; ++step) {
    double next[4] = {0}, size = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) next[i] += m->covariance[i][j] * axis[j];
    for (int i = 0; i < 4; ++i) size += next[i] * next[i];
    if (!(size > 0)) return;
    for (int i = 0; i < 4; ++i) axis[i] = next[i] / sqrt(size);
  }
}

/* Halves the group with the largest moment until there are `wanted`. */
static int split_groups(struct cell_list *list, int wanted) {
  struct moments groups[CLUSTER_MOST_LIGHTS];
  int count = 1;
  groups[0] = group_moments(list, 0);
  while (count < wanted) {
    int widest = 0;
    for (int k = 1; k < count; ++k)
      if (groups[k].spread > groups[widest].spread) widest = k;
    const struct moments *m = &groups[widest];
    if (!(m->spread > 1e-12 * groups[0].energy)) break;
    double axis[4];
    longest_axis(m, axis);
    for (int k = 0; k < list->count; ++k) {
      struct cell *cell = &list->cells[k];
      if (cell->group != widest) continue;
      double side = 0;
      for (int i = 0; i < 4; ++i) side += axis[i] * (cell->x[i] - m->mean[i]);
      if (side > 0) cell->group = count;
    }
    groups[widest] = group_moments(list, widest);
    groups[count] = group_moments(list, count);
    ++count;
  }
  return count;
}

static int nearest(const struct moments *groups, int count, const double x[4]) {
  int best = 0;
  double least = INFINITY;
  for (int g = 0; g < count; ++g) {
    double distance = 0;
    for (int i = 0; i < 4; ++i) distance += (x[i] - groups[g].mean[i]) * (x[i] - groups[g].mean[i]);
    if (groups[g].energy > 0 && distance < least) {
      least = distance;
      best = g;
    }
  }
  return best;
}

static void relax_groups(struct cell_list *list, int count) {
  struct moments groups[CLUSTER_MOST_LIGHTS];
  for (int step = 0; step < LLOYD_STEPS; ++step) {
    for (int g = 0; g < count; ++g) groups[g] = group_moments(list, g);
    for (int k = 0; k < list->count; ++k)
      list->cells[k].group = nearest(groups, count, list->cells[k].x);
  }
}

struct place {
  int index;
  double energy;
};

static int by_energy(const void *a, const void *b) {
  const struct place *x = a, *y = b;
  if (x->energy != y->energy) return x->energy < y->energy ? 1 : -1;
  return x->index - y->index;
}

/* The smallest parallelogram around the uv samples of a group, the faintest left out. */
static enum result support(const struct slab *slab, const struct cell_list *list, int group,
                           struct parallelogram *found, struct error *error) {
  struct place places[MOST_UV * MOST_UV];
  double corners[4 * MOST_UV * MOST_UV][2], total = 0, kept = 0;
  int nu = slab->samples[SLAB_U], count = nu * slab->samples[SLAB_V], used = 0;
  for (int k = 0; k < count; ++k) places[k] = (struct place){k, 0};
  for (int k = 0; k < list->count; ++k) {
    if (list->cells[k].group != group) continue;
    places[list->cells[k].place].energy += list->cells[k].energy;
    total += list->cells[k].energy;
  }
  qsort(places, (size_t)count, sizeof *places, by_energy);
  for (int k = 0; k < count && kept < (1 - trimmed) * total; ++k) {
    kept += places[k].energy;
    for (int corner = 0; corner < 4; ++corner, ++used)
      for (int c = 0; c < 2; ++c) {
        int index = c ? places[k].index / nu : places[k].index % nu;
        double half = slab_spacing(slab, c) / 2, middle = slab_position(slab, c, index);
        corners[used][c] = (middle + (corner >> c & 1 ? half : -half)) / plane_width(slab);
      }
  }
  return parallelogram_around(corners, used, found, error);
}

/* A lobe about the mean direction, as wide as the group, or wider by a factor. */
static void set_lobe(const struct moments *m, const struct slab *slab, double distance,
                     double wider, struct cluster_light *light) {
  double variance = 0, r2 = 1;
  for (int k = 0; k < 2; ++k) {
    double step = slab_spacing(slab, SLAB_S + k);
    light->axis[k] = m->mean[2 + k] / distance;
    r2 += light->axis[k] * light->axis[k];
    variance += m->covariance[2 + k][2 + k] / m->energy / (distance * distance) + step * step / 12;
  }
  double angle = wider * fmax(sqrt(variance / 2) / pow(r2, 0.75), 1e-3); /* of slopes, about */
  light->tightness = fmax(1 / (angle * angle) - 2, 0.1);
  light->cos_falloff = fmax(cos(fmin(3.5 * angle, M_PI / 2)), sqrt(1 - 1 / r2));
  light->cos_radius = light->cos_falloff + 0.5 * (1 - light->cos_falloff);
}

/* Points an aperture width apart throw spots that far apart; a lobe blurs those that are
 * less apart than it is wide, at `near` widths. */
static double points_apart(const struct cluster_light *light) {
  double cone = acos(light->cos_falloff) / 2, lobe = 1 / sqrt(fmax(light->tightness, 1));
  return fmin(most_apart, near * fmin(cone, lobe));
}

static int points_at(struct cluster_light *lights, int count, double wider) {
  int points = 0;
  for (int g = 0; g < count; ++g) {
    double apart = wider * points_apart(&lights[g]);
    for (int k = 0; k < 2; ++k) {
      double length = hypot(lights[g].edge[k][0], lights[g].edge[k][1]);
      lights[g].size[k] = 1;
      while (lights[g].size[k] * apart < 0.99 * length) lights[g].size[k] *= 2;
    }
    points += lights[g].size[0] * lights[g].size[1];
  }
  return points;
}

void cluster_set_sizes(struct cluster_light *lights, int count, int most) {
  double wider = 1;
  while (points_at(lights, count, wider) > most && wider < 1e3) wider *= 1.1;
}

/* Lights for the groups of one level. */
static enum result add_level(const struct slab *slab, struct cell_list *list, int wanted,
                             struct cluster_light *lights, int *count, struct error *error) {
  enum result result = RESULT_OK;
  for (int k = 0; k < list->count; ++k) list->cells[k].group = 0;
  int groups = split_groups(list, wanted);
  relax_groups(list, groups);
  for (int g = 0; g < groups && result == RESULT_OK; ++g) {
    struct moments m = group_moments(list, g);
    struct parallelogram area;
    if (!(m.energy > 0)) continue;
    result = support(slab, list, g, &area, error);
    if (result != RESULT_OK) break;
    for (size_t w = 0; w < WIDTHS; ++w) {
      struct cluster_light *light = &lights[(*count)++];
      memset(light, 0, sizeof *light);
      memcpy(light->center, area.center, sizeof area.center);
      memcpy(light->edge, area.edge, sizeof area.edge);
      set_lobe(&m, slab, list->distance, widths[w], light);
    }
  }
  return result;
}

/* Lights about the normal, as wide as the aperture: cosines and their powers. */
static void add_plain(const struct cluster_light *whole, struct cluster_light *lights, int *count) {
  static const double powers[] = {0, 1, 2, 4, 8, 16, 32, 64};
  for (size_t k = 0; k < sizeof powers / sizeof *powers; ++k) {
    struct cluster_light *light = &lights[(*count)++];
    *light = *whole;
    light->axis[0] = light->axis[1] = light->cos_falloff = light->cos_radius = 0;
    light->tightness = powers[k];
  }
}

enum result cluster_seed(const struct slab *slab, double distance,
                         struct cluster_light **candidates, int *count, struct error *error) {
  struct slab coarse = {0};
  struct cell_list list = {.distance = distance};
  int samples[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    int most = axis < SLAB_S ? MOST_UV : MOST_ST;
    samples[axis] = slab->samples[axis] < most ? slab->samples[axis] : most;
  }
  *count = 0;
  *candidates = calloc(MOST_CANDIDATES, sizeof **candidates);
  enum result result = *candidates ? RESULT_OK : result_no_memory(error);
  if (result == RESULT_OK) result = slab_resample(slab, samples, &coarse, error);
  if (result == RESULT_OK) result = list_cells(&coarse, &list, error);
  for (int groups = 1; groups <= CLUSTER_MOST_LIGHTS && result == RESULT_OK; groups *= 2)
    result = add_level(&coarse, &list, groups, *candidates, count, error);
  if (result == RESULT_OK) add_plain(*candidates, *candidates, count);
  for (int k = 0; k < *count; ++k) cluster_set_sizes(&(*candidates)[k], 1, CANDIDATE_POINTS);
  free(list.cells);
  slab_free(&coarse);
  return result;
}
