/* gather.h - the light that receivers gather from all pages of all lights (the paper's
 * section 4.1): the sum over the visible micro lights by one of the methods of method.h. */
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
  struct levels *levels;   /* [pages]; NULL where the method has none; owned */
  struct cut_tree **trees; /* [pages]; NULL where the method has none; owned */
};

/* Makes what the method needs for about so many receivers: METHOD_TREES_FOR_MANY has trees from
 * GATHER_MANY receivers on. Frees what there was; a zeroed struct is allowed. */
enum { GATHER_MANY = 100000 };
enum result gather_prepare(const struct light *lights, int count, enum gather_method method,
                           uint64_t receivers, int threads, struct gather_prepared *prepared,
                           struct error *error);
void gather_prepared_free(struct gather_prepared *prepared); /* zeroed allowed */

struct gather_settings {
  const struct light *lights;
  int light_count;
  const struct gather_prepared *prepared; /* for the same method; NULL where it needs nothing */
  enum gather_method method;              /* any but METHOD_OPENGL */
  double tolerance;                       /* relative */
  int level;                              /* of methods with levels; -1: by solid angle */
  uint64_t seed;                          /* of random samples */
  const struct occlusion *occlusion;      /* NULL: nothing casts shadows */
  int shadow_grid, shadow_edge;           /* visible.h */
  bool all_effects; /* skip nothing that could be told to be invisible: only to compare */
};

/* Sums for one receiver after the other, with the scratch memory of one thread. */
struct gather; /* owned by whoever created it; keeps a pointer to the settings */
enum result gather_create(const struct gather_settings *settings, struct gather **gather,
                          struct error *error);
void gather_free(struct gather *gather); /* NULL allowed */
const struct gather_counts *gather_counts(const struct gather *gather);

/* One for each thread, in an array that was zeroed; after a failure too they are freed by
 * gather_free_all, which adds to `counts` and zeroes the array. */
enum result gather_create_all(const struct gather_settings *settings, int threads,
                              struct gather **all, struct error *error);
void gather_free_all(struct gather **all, int threads, struct gather_counts *counts);

/* What `count` receivers gather. Where these lie near each other (a tile), occluders that cannot
 * stand between them and an aperture are found once for all. The light of a receiver does not
 * depend on the others, to the last bit. */
enum result gather_light(struct gather *gather, const struct receiver *receivers, int count,
                         struct gathered *gathered, struct error *error);

#endif
