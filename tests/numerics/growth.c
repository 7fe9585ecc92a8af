/* growth.c - errors grow smoothly with difficulty: a lamp and a receiver on a continuous path from
 * easy to hard, one number of decades being all that changes. Where the error changes most from
 * step to step, the step is halved down to two doubles: what is left is a jump. */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "numerics.h"

enum { DISTANCE, GRAZING_RECEIVER, GRAZING_LAMP, ASPECT, ST_DISTANCE, PEAK, RANGE, OFFSET };

const struct growth_axis growth_axes[GROWTH_AXES] = {
    [DISTANCE] = {"distance in apertures", -9, 9},
    [GRAZING_RECEIVER] = {"90 degrees/light over the horizon", 0, 9},
    [GRAZING_LAMP] = {"slope in the lamp's window", 0, 9},
    [ASPECT] = {"aspect of the aperture", 0, 6},
    [ST_DISTANCE] = {"distance of the st plane", -6, 9},
    [PEAK] = {"one sample, over the others", 0, 9},
    [RANGE] = {"largest sample; the least is its inverse", 0, 30},
    [OFFSET] = {"offset from the origin in apertures", 0, 8}};

static const enum gather_method followed[] = {GATHER_REFERENCE, GATHER_CLOSED,   GATHER_AUTO,
                                              GATHER_CUT,       GATHER_MIDPOINT, GATHER_PI};
enum { FOLLOWED = sizeof followed / sizeof followed[0], STEPS = 60 };
static const double tolerance = 1e-3;

static bool asks(enum gather_method method) {
  return method == GATHER_AUTO || method == GATHER_CUT;
}

struct path {
  int axis;
  uint64_t seed;
};

/* The samples at `lit` shine on the receiver. */
static void set_samples(struct slab *slab, int axis, double x, const int lit[SLAB_AXES]) {
  const size_t floats = 3 * slab_sample_count(slab);
  for (size_t k = 0; axis == RANGE && k < floats; ++k)
    slab->rgb[k] = (float)pow(10, x * (2 * (double)slab->rgb[k] - 1));
  for (size_t k = 0; axis == PEAK && k < floats; ++k) slab->rgb[k] *= (float)pow(10, -x);
  if (axis == PEAK) slab_at(slab, lit[0], lit[1], lit[2], lit[3])[1] = 1;
}

static struct surfel place_receiver(uint64_t *draws, const struct slab *slab, double z,
                                    const int lit[SLAB_AXES], double angle) {
  struct surfel at;
  double from[3], to_light[3], a[2], p[2];
  for (int axis = 0; axis < 2; ++axis) {
    const double beside[2] = {random_between(draws, -0.4, 0.4), random_between(draws, -0.4, 0.4)};
    a[axis] = slab_position(slab, axis, lit[axis]) + beside[0] * slab_spacing(slab, axis);
    const double s =
        slab_position(slab, 2 + axis, lit[2 + axis]) + beside[1] * slab_spacing(slab, 2 + axis);
    p[axis] = a[axis] + z * (s - slab_kappa(slab) * a[axis]);
  }
  slab_point(slab, a[0], a[1], 0, from);
  slab_point(slab, p[0], p[1], z, at.p);
  vector_subtract(from, at.p, to_light);
  vector_normalise(to_light);
  random_direction(draws, at.n);
  turn_towards(&at, to_light, angle);
  return at;
}

/* The same random numbers wherever on the path. */
static void place(const struct path *path, double x, struct slab *slab, struct surfel *at) {
  static const int grid[SLAB_AXES] = {4, 3, 6, 5};
  uint64_t draws = path->seed;
  const int axis = path->axis, frame = random_choose(&draws, 3);
  const double hard = pow(10, x), slope = axis == GRAZING_LAMP ? hard : 1;
  const double window[4] = {-0.7 * slope, 1.1 * slope, -0.9 * slope, 0.6 * slope};
  double z = random_log(&draws, 0.3, 10), angle = random_between(&draws, 0.5, 1.5);
  double distance = random_log(&draws, 0.3, 10);
  int lit[SLAB_AXES];
  if (random_choose(&draws, 2) || axis == GRAZING_LAMP) distance = INFINITY;
  if (axis == ST_DISTANCE) distance = hard;
  if (axis == DISTANCE) z = hard;
  if (axis == GRAZING_LAMP) z /= slope;
  if (axis == GRAZING_RECEIVER) angle = acos(-1) / 2 / hard;
  *slab = rough_slab(grid, distance, window, (enum frame)frame, FILL_UNIFORM, path->seed);
  for (int k = 0; k < SLAB_AXES; ++k) lit[k] = random_choose(&draws, grid[k]);
  set_samples(slab, axis, x, lit);
  for (int c = 0; c < 3 && axis == ASPECT; ++c) slab->u[c] /= hard;
  for (int c = 0; c < 3 && axis == OFFSET; ++c) slab->center[c] = (c + 1) * hard;
  *at = place_receiver(&draws, slab, z, lit, angle);
}

/* Signed errors, relative to the light. */
struct step {
  double x, error[FOLLOWED][3], predicted[FOLLOWED], gl;
  bool above; /* all of the aperture is, of the tangent plane */
};

/* What a jump may be. The rules pi and midpoint have neither tolerance nor switch, but for micro
 * lights that the tangent plane cuts: these alone get other rules. */
static double allowed(int which, const struct step *a, const struct step *b) {
  const enum gather_method method = followed[which];
  if (method == GATHER_REFERENCE || method == GATHER_CLOSED) return 1e-9;
  if (asks(method)) return tolerance;
  return a->above && b->above ? 1e-5 : fmax(a->predicted[which], b->predicted[which]);
}

static bool is_above(const struct slab *slab, const struct surfel *at) {
  for (int corner = 0; corner < 4; ++corner) {
    double height = 0;
    for (int c = 0; c < 3; ++c)
      height += at->n[c] * (slab->center[c] + (corner & 1 ? 0.5 : -0.5) * slab->u[c] +
                            (corner & 2 ? 0.5 : -0.5) * slab->v[c] - at->p[c]);
    if (!(height > 0)) return false;
  }
  return true;
}

static void take(const struct path *path, double x, int only, bool gl, struct step *step) {
  struct slab slab;
  struct surfel at;
  place(path, x, &slab, &at);
  struct lamp lamp = lamp_open(&slab);
  const struct oracle_value exact = oracle_irradiance(&slab, at.p, at.n);
  struct look look = look_at(&lamp, &at, &exact);
  step->x = x;
  step->above = is_above(&slab, &at);
  step->gl = gl ? gl_error(&lamp, &at) : 0;
  for (int k = 0; k < FOLLOWED; ++k) {
    struct gathered got;
    if (only >= 0 && k != only) continue;
    lamp_sum(&lamp, followed[k], asks(followed[k]) ? tolerance : 1e-6, &at, &got, NULL);
    step->predicted[k] = got.error;
    if (isnan(look_error(&look, followed[k], got.irradiance, asks(followed[k]) ? tolerance : 1e-9,
                         step->error[k])))
      step->error[k][0] = NAN;
  }
  lamp_close(&lamp);
}

static double difference(const struct step *a, const struct step *b, int which) {
  double most = 0;
  for (int c = 0; c < 3; ++c) {
    const double off = fabs(a->error[which][c] - b->error[which][c]);
    if (isnan(off)) return NAN;
    most = fmax(most, off);
  }
  return most;
}

/* Halves the step, and keeps the half in which the error changes more. */
static double find_jump(const struct path *path, struct step from, struct step to, int which,
                        double *may) {
  double change = difference(&from, &to, which);
  *may = allowed(which, &from, &to);
  for (int k = 0; k < 60 && change > *may; ++k) {
    struct step between;
    const double middle = (from.x + to.x) / 2;
    if (!(middle > from.x && middle < to.x)) break;
    take(path, middle, which, false, &between);
    const double first = difference(&from, &between, which);
    const double second = difference(&between, &to, which);
    if (isnan(first + second)) return NAN;
    if (first > second)
      to = between;
    else
      from = between;
    change = fmax(first, second);
    *may = allowed(which, &from, &to);
  }
  return change;
}

static void add_worst(const struct path *path, const struct step *step, struct growth *growth) {
  const struct growth_axis *axis = &growth_axes[path->axis];
  const int bin = (int)((step->x - axis->low) / (axis->high - axis->low) * GROWTH_BINS);
  double *worst = growth->worst[path->axis][bin];
  for (int k = 0; k < FOLLOWED; ++k)
    for (int c = 0; c < 3; ++c)
      worst[followed[k]] = larger(worst[followed[k]], fabs(step->error[k][c]));
  worst[GATHER_GL] = larger(worst[GATHER_GL], step->gl);
}

void row_growth(struct trial *trial) {
  const struct path path = {(int)(trial->start % GROWTH_AXES), trial->seed};
  const struct growth_axis *axis = &growth_axes[path.axis];
  const double phase = random_between(&trial->seed, 0, 1);
  static struct step steps[STEPS];
  for (int k = 0; k < STEPS; ++k) {
    take(&path, axis->low + (axis->high - axis->low) * (k + phase) / STEPS, -1, trial->growth,
         &steps[k]);
    if (trial->growth) add_worst(&path, &steps[k], trial->growth);
  }
  for (int which = 0; which < FOLLOWED; ++which) {
    int worst = 0;
    for (int k = 0; k + 1 < STEPS; ++k)
      if (!(difference(&steps[k], &steps[k + 1], which) <=
            difference(&steps[worst], &steps[worst + 1], which)))
        worst = k;
    double may, jump = find_jump(&path, steps[worst], steps[worst + 1], which, &may);
    trial_note(trial, followed[which], jump, may);
    if (trial->verbose)
      printf("  %s: changes most from 10^%.17g to 10^%.17g: %g to %g\n",
             gather_methods[followed[which]].name, steps[worst].x, steps[worst + 1].x,
             steps[worst].error[which][0], steps[worst + 1].error[which][0]);
  }
}

void growth_merge(const struct growth *from, struct growth *to) {
  for (int axis = 0; axis < GROWTH_AXES; ++axis)
    for (int bin = 0; bin < GROWTH_BINS; ++bin)
      for (int k = 0; k < NUMERICS_METHODS; ++k)
        to->worst[axis][bin][k] = larger(to->worst[axis][bin][k], from->worst[axis][bin][k]);
}
