/* ways.h - what accuracy costs from the lamp to the picture: for a ladder of errors the cheapest
 * way there, from a lamp script through a bake and an include or a method to the picture of a
 * scene. Everything is done as a user would do it, by running bakeslab, povray and renderslab,
 * and costs are CPU seconds of those.
 *
 * Errors are RMS over mean of the picture's pixels that show a surface, against renderslab's
 * reference from the finest slab. That slab is the last of the bakes; they end where one's own
 * error is well below the least that is asked for, or with their table (ways_bakes.c). Its own
 * error is what it tells (slab_accuracy.h), times what bakes of this lamp were seen to err by over
 * what they told.
 *
 * Bakes and pictures are measured apart: a bake by the picture that renderslab's reference makes
 * of it, against that of the finest; an include or a method on one slab a resolution of
 * positions, against that slab's reference. The error of a way is predicted as the root of the
 * sum of both squares. What is advised has been tried: its own picture was measured too. */
#ifndef WAYS_H
#define WAYS_H

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>

#include "picture/shade.h"
#include "tradeoff/pixels.h"
#include "tradeoff/programs.h"

enum {
  WAYS_MOST_BAKES = 12,
  WAYS_PICTURES = 9, /* rows of ways_pictures */
  WAYS_MOST_RUNGS = 16,
  WAYS_WHOLE = 5, /* pictures of the whole lamp */
  WAYS_NAME = 64
};

struct ways_settings {
  const char *lamp;      /* a lamp script, or a slab */
  bool script;           /* which of the two */
  const char *placement; /* of the light, as on the command line, after the file's name; "" */
  const char *mesh;
  bool repair;
  struct shade view; /* mesh, camera and size; ways_measure adds the light */
  const char *bakes; /* folder in which slabs are kept and found again; NULL: none */
  const char *command;
  double errors[WAYS_MOST_RUNGS]; /* the ladder, falling; > 0 */
  int error_count;                /* >= 1 */
  int pictures;                   /* that a bake is to pay for; >= 1 */
  double time_limit;              /* CPU seconds to the first picture; 0: none */
  bool all; /* then try every cheaper way too, however unlikely, and tell of those that would do */
  void (*progress)(void *context, double done, const char *label); /* may be NULL */
  void *progress_context;
  const volatile sig_atomic_t *stop; /* ends the work; may be NULL */
};

/* A slab, and what came before it. */
struct ways_bake {
  int uv, st;             /* samples of the first page, u and s */
  int rays;               /* a sample; 0: the slab was given */
  char *slab;             /* its file; owned */
  double cpu;             /* seconds of its bake */
  double bytes;           /* of its file */
  double told;            /* its own error where the scene is, as it tells itself */
  double parts[3];        /* of it: st, uv, noise */
  double error;           /* of its picture by reference; of the last slab, its own */
  struct picture picture; /* by reference; owned */
};

/* How a picture is made from a slab. */
enum ways_kind { WAYS_SHEET, WAYS_CLUSTER, WAYS_POINT, WAYS_METHOD };
struct ways_picture {
  enum ways_kind kind;
  int lights;       /* a side of a sheet; in all of a cluster */
  double tolerance; /* of renderslab */
};
extern const struct ways_picture ways_pictures[WAYS_PICTURES];

/* A slab and a kind of picture. */
struct ways_made {
  bool known;         /* include_cpu, cpu and error are, of this very slab */
  bool refused;       /* it cannot be made */
  bool tried;         /* `measured` is known */
  double include_cpu; /* seconds of its include; 0 where it has none */
  double cpu;         /* of a picture */
  double error;       /* of that picture, against the slab's by reference */
  double predicted;   /* with the bake's error */
  double measured;    /* against the truth */
};

/* POV-Ray with the lamp itself in the scene. */
struct ways_lamp {
  int rays; /* that gather light at a point, or photons / 1000 */
  double cpu, error;
};

/* For one rung, in POV-Ray (0) or renderslab (1). */
struct ways_advice {
  bool found;
  int bake, picture;
  int tried;       /* how many ways were */
  bool missed;     /* none that was tried reached it: this one came closest */
  double cheapest; /* seconds of the cheapest that would, beyond --time-limit; 0: none would */
  int cheaper;     /* with `all`: how many cheaper ways were tried, */
  double best;     /* and seconds of the cheapest way that reaches the rung: ways_cost */
  int pays_from;   /* with this many pictures it is cheaper than the whole lamp; 0: not known */
  double whole;    /* seconds of the whole lamp's picture at that error; 0: not known */
  bool reckoned;   /* that, from how its noise falls */
};

struct ways {
  struct ways_bake bakes[WAYS_MOST_BAKES];
  int bake_count; /* the last is the reference */
  struct ways_made made[WAYS_MOST_BAKES][WAYS_PICTURES];
  struct ways_lamp lamp[WAYS_WHOLE];
  int lamp_count;
  char lamp_refusal[256]; /* why there is none */
  bool lamp_photons;
  struct ways_advice advice[WAYS_MOST_RUNGS][2];
  double start;    /* CPU seconds that POV-Ray takes to start */
  double doubt;    /* >= 1: the slab before the reference erred by so often what it told */
  double distance; /* of what is lit from the pages, in lamp units: mean, by light */
  /* for the measurement: */
  struct programs programs;
  struct pixels pixels;
  struct light light;
  const struct picture *truth; /* the reference's */
};

/* Measures and chooses. Refuses, before the first bake where it can, a time limit below POV-Ray's
 * start, a scene in which the lamp lights nothing, and a ladder all of which lies below the
 * reference's own error. Free with ways_free, also after a failure. */
enum result ways_measure(const struct ways_settings *settings, struct ways *ways,
                         struct error *error);
void ways_free(struct ways *ways); /* zeroed allowed */

/* ---- The steps, in this order ---- */

/* ways_bakes.c: bakes, tells their errors, makes their pictures by reference. */
enum result ways_bake_all(const struct ways_settings *settings, struct ways *ways,
                          struct error *error);
/* Options of a bake that would have at most that error, from what the reference tells of its
 * parts. */
void ways_would_reach(const struct ways *ways, double error, char text[WAYS_NAME]);

/* ways_pictures.c: measures includes and methods on one slab of each number of positions, and
 * predicts all ways; tries one way. */
enum result ways_picture_all(const struct ways_settings *settings, struct ways *ways,
                             struct error *error);
enum result ways_try(const struct ways_settings *settings, struct ways *ways, int bake, int picture,
                     struct error *error);
/* The slab's picture by renderslab, with these words after the others; CPU seconds are added. */
enum result ways_render(const struct ways_settings *settings, struct ways *ways,
                        const struct ways_bake *bake, const char *const *words,
                        struct picture *picture, double *cpu, struct error *error);
/* A picture by POV-Ray of a scene in the programs' folder. */
enum result ways_povray(const struct ways_settings *settings, struct ways *ways, const char *scene,
                        int width, int height, struct picture *picture, double *cpu,
                        struct error *error);

/* ways_lamp.c: the whole lamp in POV-Ray. */
enum result ways_lamp_all(const struct ways_settings *settings, struct ways *ways,
                          struct error *error);

/* ways_choose.c: the advice for each rung. */
enum result ways_choose(const struct ways_settings *settings, struct ways *ways,
                        struct error *error);
/* CPU seconds: of a way to its first picture, and for all pictures that the bake is to pay for. */
double ways_first(const struct ways *ways, int bake, int picture);
double ways_cost(const struct ways_settings *settings, const struct ways *ways, int bake,
                 int picture);

/* ---- What came out ---- */

/* ways_write.c: the advice in words, a line each begun with `before`; the table, with it in its
 * head. ways_plot.c: a script for gnuplot, without its terminal. */
void ways_say(FILE *file, const char *before, const struct ways_settings *settings,
              const struct ways *ways);
void ways_print(FILE *file, const struct ways_settings *settings, const struct ways *ways);
void ways_plot(FILE *file, const struct ways_settings *settings, const struct ways *ways);
/* "include --lights 8", "image --tolerance 0.03": what makes the picture. */
void ways_name(const struct ways_bake *bake, const struct ways_picture *picture,
               char name[WAYS_NAME]);
bool ways_in_povray(int picture);

#endif
