/* numerics.h - hard cases for the sums over a slab, held against oracles: a table of rows, each
 * a kind of hard case, by methods. Cases are made from seeds, the same on every machine.
 *
 * An error is relative to the light, counted with all samples positive: of the channel for the
 * methods reference and closed, else of the largest channel; of the cut, or to 1e-4 of the most
 * that the page could send (cut.h). What rounding the receiver's place and normal to doubles
 * could do, 1e-15 of each, is no error of the sum: it is taken off.
 *
 * Allowed are 1e-9 for reference and closed, whose tolerance is left at 1e-6; the tolerance, 1e-2
 * to 1e-8, for auto and cut; for the others what they predict (gathered.error), and anything
 * finite, not negative, where they predict nothing.
 *
 * The methods views and gl are held against the sum over views, which they are, in rows that
 * compare with light: allowed is 1e-5 beside what rounding the receiver and directions to floats
 * could do (oracle_view), where that is less than 1e-3 of the light; where it is more, anything
 * finite, not negative. gl is not in rows about the integral or about how others get it. */
#ifndef NUMERICS_H
#define NUMERICS_H

#include <stdio.h>

#include "gl/gl_gather.h"
#include "oracle/oracle.h"
#include "render/helpers.h"

/* All of gather.h, gl the last. */
enum { NUMERICS_ROWS_MAX = 40, NUMERICS_METHODS = GATHER_METHODS };

/* Less light than this of what the lamp could send from all directions is none. */
#define NUMERICS_DARK 1e-30

/* The worst that a method met in a row. */
struct tally {
  double share;    /* error over what is allowed; 0 where nothing is */
  double error;    /* the largest relative error */
  uint32_t seed;   /* of the largest share, or else of the largest error */
  uint64_t values; /* compared */
  uint64_t stated; /* of these, with something allowed */
};

/* One seed of a row. */
struct trial {
  uint64_t seed;         /* the random numbers' next */
  uint32_t start;        /* what it began with */
  struct tally *tally;   /* [NUMERICS_METHODS] */
  bool verbose;          /* print what is not allowed */
  struct growth *growth; /* NULL: not wanted */
};

typedef void row_run(struct trial *trial);
struct numerics_row {
  const char *name, *text;
  row_run *run;
  int seeds;          /* of a sweep, per unit of effort */
  const char *oracle; /* NULL: exact rationals, long double quadrature */
};
extern const struct numerics_row numerics_rows[];
extern const int numerics_row_count;

/* Notes an error of a method, and what is allowed: INFINITY for no claim. */
void trial_note(struct trial *trial, enum gather_method method, double error, double allowed);

/* Of the st plane: infinity as often as 0.3 to 10. */
double trial_distance(struct trial *trial);

/* A slab as the program loads it. */
struct lamp {
  struct slab slab; /* as made; owned */
  struct light light;
  struct gather_prepared levels, trees;
  double most;          /* the most that it could send, times the height squared */
  double hemisphere;    /* and from all directions at once */
  bool positive;        /* no sample is negative */
  struct gl_gather *gl; /* made when it is first asked for; owned */
};
struct lamp lamp_open(const struct slab *slab); /* takes the slab over */
void lamp_close(struct lamp *lamp);
/* Counts: NULL allowed. Not for gl. */
void lamp_sum(const struct lamp *lamp, enum gather_method method, double tolerance,
              const struct surfel *receiver, struct gathered *gathered,
              struct gather_counts *counts);

/* Of the settings those that are no lamp's: method, tolerance, seed, occlusion. */
struct gather_counts lamp_sum_many(const struct lamp *lamp, const struct gather_settings *settings,
                                   const struct receiver *receivers, int count,
                                   struct gathered *gathered);

/* ---- gl.c */

/* Is there OpenGL, for this process? If not, `why` says what is missing. */
bool gl_is_here(const char **why);
/* False where there is none, or it refuses the lamp's lengths, as it should. */
bool lamp_sum_gl(struct lamp *lamp, const struct surfel *receiver, double rgb[3]);
/* What they may err relative to the light: INFINITY where nothing is claimed. */
double gl_allowed(const struct lamp *lamp, const struct surfel *receiver);
/* The error of gl relative to the light; 0 where nothing is claimed. */
double gl_error(struct lamp *lamp, const struct surfel *receiver);
/* Holds views and gl against the sum over views. */
void trial_hold_views(struct trial *trial, struct lamp *lamp, const struct surfel *receiver);

/* By any method, its tolerance 1e-3: false as lamp_sum_gl. */
bool lamp_sum_any(struct lamp *lamp, int method, const struct surfel *receiver, double rgb[3]);

/* ---- */

/* Holds all methods against the oracle. */
void trial_hold(struct trial *trial, struct lamp *lamp, const struct surfel *receiver);
/* Or against values of another one. */
void trial_hold_value(struct trial *trial, const struct lamp *lamp, const struct surfel *receiver,
                      const struct oracle_value *exact);

/* A receiver and what it should get. */
struct look {
  const struct lamp *lamp;
  const struct surfel *receiver;
  const struct oracle_value *exact;
  double height;
  double spread[3]; /* oracle_spread's, if has_spread */
  bool has_spread;
};
struct look look_at(const struct lamp *lamp, const struct surfel *receiver,
                    const struct oracle_value *exact);
/* Errors of the channels, as said above, with their signs. Returns the largest; NAN for what must
 * never be. */
double look_error(struct look *look, enum gather_method method, const double rgb[3], double allowed,
                  double error[3]);

/* Turns the receiver so that the light, a unit vector, comes in at this angle over its horizon. */
void turn_towards(struct surfel *receiver, const double to_light[3], double angle);

/* What rounding the receiver can change, in each channel. */
void oracle_spread(const struct slab *slab, const struct surfel *receiver, double spread[3]);

/* The methods that a row asks for when all behave alike: their tolerance in rounding alone. */
double method_rounding(enum gather_method method);

/* The worst errors along each kind of hardness (growth.c), and what is drawn of them. */
enum { GROWTH_AXES = 8, GROWTH_BINS = 18 };
struct growth {
  double worst[GROWTH_AXES][GROWTH_BINS][NUMERICS_METHODS]; /* 0: none */
};
struct growth_axis {
  const char *name;
  double low, high; /* in decades */
};
extern const struct growth_axis growth_axes[GROWTH_AXES];
void growth_merge(const struct growth *from, struct growth *to);
void growth_write_svg(FILE *file, const struct growth *growth);
bool growth_write_table(const char *path, const struct growth *growth); /* for gnuplot */

/* The table as text and HTML (report.c); returns how many cells miss. */
int report_print(const struct tally table[][NUMERICS_METHODS], double seconds);
bool report_write(const char *path, const struct tally table[][NUMERICS_METHODS], double seconds,
                  const struct growth *growth);

/* The rows (rows_*.c). */
row_run row_distance, row_grazing_receiver, row_grazing_lamp, row_aspect, row_st_distance,
    row_range, row_offset, row_peak, row_sizes, row_signed, row_tangent, row_window, row_touching,
    row_st_plane, row_st_infinity, row_lines, row_constant, row_mpmath, row_powers, row_units,
    row_symmetry, row_superposition, row_neighbours, row_growth, row_switches, row_strips,
    row_single, row_levels, row_random;

#endif
