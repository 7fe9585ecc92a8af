/* gather.h - the light that receivers gather from all pages of all lights (the paper's
 * section 4.1): the sum over the visible micro lights by one of several methods. */
#ifndef GATHER_H
#define GATHER_H

#include <stdbool.h>
#include <stdint.h>

#include "gather/method.h"
#include "light/light.h"
#include "microlight/receiver.h"

struct occlusion;

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
