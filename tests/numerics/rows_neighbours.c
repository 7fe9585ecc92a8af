/* rows_neighbours.c - a receiver's light does not depend on the receivers summed with it: in
 * another order and in other groups, with and without shadows, the same bits. */
#include <math.h>

#include "numerics.h"
#include "scene/scene.h"
#include "shadow/occlusion.h"

enum { COUNT = 100 }; /* more than are taken together */

/* A rectangle over half of the lamp. */
static void place_screen(struct occlusion **occlusion) {
  double position[4][3] = {{0, -9, 0.2}, {9, -9, 0.2}, {9, 9, 0.2}, {0, 9, 0.2}};
  int corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
  const struct scene scene = {
      .vertices = 4, .triangles = 2, .position = position, .corners = corners};
  struct error error = {{0}};
  if (occlusion_create(&scene, occlusion, &error) != RESULT_OK) fail_msg("%s", error.text);
}

/* Near and far, and beside each other; every 5th has a highlight. */
static void place_receivers(struct trial *trial, const struct slab *slab,
                            struct receiver receivers[COUNT]) {
  for (int k = 0; k < COUNT; ++k) {
    const struct surfel at = aimed_receiver(
        slab, random_log(&trial->seed, 0.01, 100),
        (enum receiver_kind)random_choose(&trial->seed, RECEIVER_KINDS), &trial->seed);
    receivers[k] = receiver_at(&at);
    receivers[k].index = (uint64_t)k;
    if (k % 5 == 0) {
      receivers[k].shininess = 20;
      receivers[k].eye[2] = -1;
    }
  }
}

/* In groups of 1 to 20, in any order. */
static void sum_otherwise(struct trial *trial, const struct lamp *lamp,
                          const struct gather_settings *settings,
                          const struct receiver receivers[COUNT], struct gathered got[COUNT]) {
  struct receiver group[COUNT];
  struct gathered light[COUNT];
  int order[COUNT] = {0}, size;
  for (int k = 0; k < COUNT; ++k) {
    int other = random_choose(&trial->seed, k + 1);
    order[k] = order[other];
    order[other] = k;
  }
  for (int first = 0; first < COUNT; first += size) {
    size = 1 + random_choose(&trial->seed, 20);
    if (size > COUNT - first) size = COUNT - first;
    for (int k = 0; k < size; ++k) group[k] = receivers[order[first + k]];
    lamp_sum_many(lamp, settings, group, size, light);
    for (int k = 0; k < size; ++k) got[order[first + k]] = light[k];
  }
}

static bool same(const struct gathered *a, const struct gathered *b) {
  for (int c = 0; c < 3; ++c)
    if (a->irradiance[c] != b->irradiance[c] || a->gloss[c] != b->gloss[c]) return false;
  return a->error == b->error;
}

void row_neighbours(struct trial *trial) {
  static const int grid[SLAB_AXES] = {8, 8, 16, 16};
  static const double window[4] = {-1.5, 1.5, -1.5, 1.5};
  const double distance = random_choose(&trial->seed, 2) ? INFINITY : 3;
  struct slab slab =
      rough_slab(grid, distance, window, FRAME_PLAIN,
                 random_choose(&trial->seed, 2) ? FILL_UNIFORM : FILL_EXTREME, trial->seed);
  struct receiver receivers[COUNT];
  struct gathered all[COUNT], other[COUNT];
  struct occlusion *occlusion = NULL;
  struct lamp lamp = lamp_open(&slab);
  place_receivers(trial, &slab, receivers);
  if (random_choose(&trial->seed, 2)) place_screen(&occlusion);
  for (int k = 0; k < GATHER_METHODS; ++k) {
    const struct gather_settings settings = {.method = (enum gather_method)k,
                                             .tolerance =
                                                 pow(10, -2 - random_choose(&trial->seed, 4)),
                                             .occlusion = occlusion,
                                             .shadow_grid = 4,
                                             .shadow_edge = 8};
    if (gather_methods[k].matte_only || gather_methods[k].sum == METHOD_OPENGL) continue;
    lamp_sum_many(&lamp, &settings, receivers, COUNT, all);
    sum_otherwise(trial, &lamp, &settings, receivers, other);
    for (int r = 0; r < COUNT; ++r)
      trial_note(trial, settings.method, same(&all[r], &other[r]) ? 0 : 1, 1e-300);
  }
  occlusion_free(occlusion);
  lamp_close(&lamp);
}
