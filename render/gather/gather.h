/* gather.h - the light that receivers gather from all pages of all lights (the paper's
 * section 4.1): the sum over the visible micro lights by one of several methods. */
#ifndef GATHER_H
#define GATHER_H

#include <stdbool.h>
#include <stdint.h>

#include "light/light.h"

struct occlusion;

enum gather_method {
  GATHER_AUTO,         /* the cheapest that meets the tolerance */
  GATHER_REFERENCE,    /* Gauss rules whose order follows from the tolerance */
  GATHER_PAPER,        /* one random sample a micro light, as published */
  GATHER_MIDPOINT,     /* one in the middle */
  GATHER_PI,           /* hat functions integrated exactly, the kernel in the middle */
  GATHER_CLOSED,       /* closed form; matte receivers without occluders only */
  GATHER_VIEWS,        /* one sample a view, at the uv sample: what projective textures sum
                          (section 4.3), and POV-Ray's lights of the sheet include */
  GATHER_LEVELS,       /* the paper's hierarchy (section 4.2), kept in memory; pi on each level */
  GATHER_PAPER_LEVELS, /* the same as published: averaged on the fly, one random sample */
  GATHER_CUT,          /* blocks of views, as few as the tolerance allows (cut.h); micro lights
                          where that is no faster, and behind occluders */
  GATHER_METHODS,
  GATHER_GL = GATHER_METHODS /* as GATHER_VIEWS, by a graphics processor: gl_gather.h */
};

const char *gather_method_name(enum gather_method method);
/* Knows all but GATHER_GL. */
bool gather_method_parse(const char *name, enum gather_method *method);

/* Someone in the scene who gathers light. `index` seeds the method `paper`. */
struct receiver {
  double position[3], normal[3]; /* scene space; normal unit */
  double lift[3];                /* unit geometric normal, along which shadow rays start */
  double eye[3];                 /* unit, towards who looks; for gloss only */
  double shininess;              /* exponent of the highlight; 0: matte */
  uint64_t index;
};

struct gathered {
  double irradiance[3];
  double gloss[3]; /* integral of L (N.H)^shininess over the solid angle above the tangent
                      plane; 0 for matte receivers */
  double error;    /* predicted, relative: the largest of its pages'; INFINITY: not known */
};

struct gather_counts {
  uint64_t receivers;
  uint64_t microlights; /* visited */
  uint64_t nodes;       /* at which the kernel was evaluated */
  uint64_t black;       /* micro lights that were skipped: all their samples are 0 */
  uint64_t shadow_rays;
  uint64_t open_views;   /* views of a page for which none were traced: nothing between */
  uint64_t pages_behind; /* pages that were skipped: the receiver is behind them, beside all
                            that they emit, or they are below its tangent plane */
  double error;          /* the largest of the receivers' */
};

/* What some methods make of the slabs before the first receiver: indexed by page, counted
 * through all lights. */
struct gather_prepared {
  int pages;
  struct levels *levels;   /* [pages], methods levels; NULL for others; owned */
  struct cut_tree **trees; /* [pages], methods cut and auto; NULL for others; owned */
};

/* Makes what the method needs for about so many receivers: auto has trees only where they are
 * so many that making them pays. Frees what there was; zeroed aids are allowed. */
enum result gather_prepare(const struct light *lights, int count, enum gather_method method,
                           uint64_t receivers, int threads, struct gather_prepared *aids,
                           struct error *error);
enum { GATHER_MANY = 100000 };                           /* from so many on */
void gather_prepared_free(struct gather_prepared *aids); /* zeroed aids allowed */

struct gather_settings {
  const struct light *lights;
  int light_count;
  const struct gather_prepared *aids; /* for the same method */
  enum gather_method method;
  double tolerance;                  /* relative */
  int level;                         /* of methods levels; -1: by solid angle */
  uint64_t seed;                     /* of method paper */
  const struct occlusion *occlusion; /* NULL: nothing casts shadows */
  int shadow_grid, shadow_edge;      /* visible.h */
  bool all_effects; /* skip nothing that could be told to be invisible: only to compare */
};

/* Scratch memory of one thread. */
struct gather; /* owned by whoever created it; keeps a pointer to the settings */
enum result gather_create(const struct gather_settings *settings, struct gather **gather,
                          struct error *error);
void gather_free(struct gather *gather); /* NULL allowed */
const struct gather_counts *gather_counts(const struct gather *gather);

/* What `count` receivers gather; fast where they lie near each other (a tile). The result for
 * a receiver does not depend on the others, to the last bit. */
enum result gather_light(struct gather *gather, const struct receiver *receivers, int count,
                         struct gathered *gathered, struct error *error);

#endif
