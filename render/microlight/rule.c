#include "microlight/rule.h"

#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

#include "base/array.h"
#include "base/simd.h"
#include "slab/slab_gauss.h"

static struct rule_gauss gauss[RULE_LARGEST_ORDER + 1];
static pthread_once_t gauss_made = PTHREAD_ONCE_INIT;

static void make_gauss(void) {
  for (int n = 1; n <= RULE_LARGEST_ORDER; ++n) {
    slab_gauss_legendre(n, gauss[n].at, gauss[n].weight);
    for (int k = 0; k < n; ++k) {
      gauss[n].at[k] = (1 + gauss[n].at[k]) / 2;
      gauss[n].weight[k] /= 2;
    }
  }
}

const struct rule_gauss *rule_gauss(int order) {
  pthread_once(&gauss_made, make_gauss);
  return &gauss[order];
}

struct rule_orders rule_orders(double tolerance) {
  struct rule_orders orders = {{INFINITY, INFINITY, 0}};
  for (int n = 2; n <= RULE_LARGEST_ORDER; ++n)
    orders.ellipse[n] = exp(log(16 / tolerance) / (2 * (n - 1.5)));
  return orders;
}

/* The ellipse with the strip's ends as foci through the poles +-i*pole: the sum of its half axes
 * in units of half the focal distance. */
static double find_ellipse(const struct strip *strip, double pole) {
  double half = strip->width / 2, middle = (strip->low + half) / half, height = pole / half;
  double square = height * height;
  double sum =
      (sqrt((middle + 1) * (middle + 1) + square) + sqrt((middle - 1) * (middle - 1) + square)) / 2;
  return sum > 1 ? sum + sqrt(sum * sum - 1) : 1;
}

/* Of sums in single precision. */
static const double rounding = 1e-6;

double rule_pi_error(double widest, double rise, double shininess) {
  double half = widest / 2, curvature = 5.0 / 3 + shininess / 24, slope = 1 + sqrt(shininess) / 2;
  return curvature * half * half + 1.2 * slope * half + rise / (4 - rise) + rounding;
}

double rule_pole(const struct strips *other) {
  if (other->count == 0) return 1;
  double low = other->strip[0].low, high = other->strip[other->count - 1].high;
  double least = low > 0 ? low : high < 0 ? -high : 0;
  return hypot(1, least);
}

void rule_nodes_free(struct rule_nodes *nodes) {
  strips_free(&nodes->strips);
  free(nodes->first);
  free(nodes->at);
  free(nodes->weight);
  *nodes = (struct rule_nodes){0};
}

void rule_hats(const struct strip *strip, double share, double weight[4]) {
  double near = strip->near_weight[0] + share * (strip->near_weight[1] - strip->near_weight[0]);
  double far = strip->far_weight[0] + share * (strip->far_weight[1] - strip->far_weight[0]);
  weight[0] = (1 - near) * (1 - far);
  weight[1] = (1 - near) * far;
  weight[2] = near * (1 - far);
  weight[3] = near * far;
}

/* In the middle; or the exact means over the strip: that of a product of linear functions is
 * the product of their means plus the product of their rises over 12. */
static void middle_hats(const struct strip *strip, bool means, double weight[4]) {
  double near = (strip->near_weight[0] + strip->near_weight[1]) / 2;
  double far = (strip->far_weight[0] + strip->far_weight[1]) / 2;
  double rises = means ? (strip->near_weight[1] - strip->near_weight[0]) *
                             (strip->far_weight[1] - strip->far_weight[0]) / 12
                       : 0;
  weight[0] = (1 - near) * (1 - far) + rises;
  weight[1] = (1 - near) * far - rises;
  weight[2] = near * (1 - far) - rises;
  weight[3] = near * far + rises;
}

static enum result make_room(struct rule_nodes *nodes, int more, struct error *error) {
  int count = nodes->count + more;
  if (array_reserve(&nodes->at, &nodes->room, count + SIMD_LANES, sizeof *nodes->at) &&
      array_reserve(&nodes->weight, &nodes->weight_room, count, sizeof *nodes->weight) &&
      array_reserve(&nodes->first, &nodes->first_room, nodes->strips.count + 2,
                    sizeof *nodes->first))
    return RESULT_OK;
  return result_no_memory(error);
}

/* Appends a strip, and makes room for its nodes. */
static enum result append(struct rule_nodes *nodes, const struct strip *strip, int count,
                          struct error *error) {
  enum result result = make_room(nodes, count, error);
  if (result == RESULT_OK) result = strips_append(&nodes->strips, strip, error);
  if (result == RESULT_OK) nodes->first[nodes->strips.count] = nodes->count + count;
  return result;
}

static enum result place_single(struct rule_nodes *nodes, const struct strip *strip, bool means,
                                struct error *error) {
  enum result result = append(nodes, strip, 1, error);
  if (result != RESULT_OK) return result;
  double *weight = nodes->weight[nodes->count], width = strip->width;
  nodes->at[nodes->count++] = strip->low + width / 2;
  middle_hats(strip, means, weight);
  for (int tap = 0; tap < 4; ++tap) weight[tap] *= width;
  return RESULT_OK;
}

static enum result place_order(struct rule_nodes *nodes, const struct strip *strip, int order,
                               struct error *error) {
  enum result result = append(nodes, strip, order, error);
  if (result != RESULT_OK) return result;
  const struct rule_gauss *points = rule_gauss(order);
  double width = strip->width;
  for (int k = 0; k < order; ++k, ++nodes->count) {
    double *weight = nodes->weight[nodes->count];
    nodes->at[nodes->count] = strip->low + points->at[k] * width;
    rule_hats(strip, points->at[k], weight);
    for (int tap = 0; tap < 4; ++tap) weight[tap] *= points->weight[k] * width;
  }
  return RESULT_OK;
}

/* Where to cut a strip that is too wide for its distance from the poles: geometrically, so
 * that the parts are about as wide as they are far from the foot. */
static double cut(const struct strip *strip, double pole) {
  double low = strip->low, high = strip->high, middle = low / 2 + high / 2;
  if (low >= 0) return fmin(low + 1.5 * fmax(low, pole), middle);
  if (high <= 0) return fmax(high - 1.5 * fmax(-high, pole), middle);
  return high > -low ? fmin(1.5 * pole, high / 2) : fmax(-1.5 * pole, low / 2);
}

static enum result place_gauss(struct rule_nodes *nodes, const struct strip *strip,
                               const struct rule_orders *orders, double pole, struct error *error) {
  double ellipse = find_ellipse(strip, pole);
  int order = 2;
  while (order <= RULE_LARGEST_ORDER && ellipse < orders->ellipse[order]) ++order;
  double middle = order > RULE_LARGEST_ORDER ? cut(strip, pole) : strip->low;
  /* Too narrow to cut: as good as it gets. */
  if (order > RULE_LARGEST_ORDER && !(middle > strip->low && middle < strip->high))
    order = RULE_LARGEST_ORDER;
  if (order <= RULE_LARGEST_ORDER) return place_order(nodes, strip, order, error);
  struct strip left = strip_part(strip, strip->low, middle);
  struct strip right = strip_part(strip, middle, strip->high);
  enum result result = place_gauss(nodes, &left, orders, pole, error);
  return result == RESULT_OK ? place_gauss(nodes, &right, orders, pole, error) : result;
}

enum result rule_place(const struct strips *strips, enum rule rule,
                       const struct rule_orders *orders, double pole, struct rule_nodes *nodes,
                       struct error *error) {
  nodes->strips.count = nodes->count = 0;
  enum result result = make_room(nodes, 1, error);
  if (result == RESULT_OK) nodes->first[0] = 0;
  for (int k = 0; k < strips->count && result == RESULT_OK; ++k) {
    const struct strip *strip = &strips->strip[k];
    if (rule == RULE_GAUSS)
      result = place_gauss(nodes, strip, orders, pole, error);
    else
      result = place_single(nodes, strip, rule == RULE_PI, error);
  }
  return result;
}
