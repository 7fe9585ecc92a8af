/* test_slab_missed.c - light that ends at a window's or rectangle's border is told, and where. */
#include <string.h>

#include "helpers.h"
#include "slab/slab_missed.h"

static const struct slab *page_of(const void *of, int n) {
  return (const struct slab *)of + n;
}

/* Radiance 1 in the cells low <= index < high of each axis, 8 of them an axis. */
static struct slab_missed missed_of(const int low[SLAB_AXES], const int high[SLAB_AXES]) {
  struct slab slab = awkward_slab((const int[]){8, 8, 8, 8}, INFINITY);
  struct slab_missed missed = {0};
  for (size_t k = 0; k < slab_sample_count(&slab); ++k) {
    int at[SLAB_AXES];
    bool lit = true;
    slab_locate(&slab, k, at);
    for (int axis = 0; axis < SLAB_AXES; ++axis)
      lit &= at[axis] >= low[axis] && at[axis] < high[axis];
    for (int c = 0; c < 3; ++c) slab.rgb[3 * k + (size_t)c] = lit;
  }
  assert_int_equal(slab_missed_add(&slab, 0, 1, page_of, &slab, &missed, NULL), RESULT_OK);
  slab_free(&slab);
  return missed;
}

TEST(test_dark_borders_miss_nothing) {
  struct slab_missed missed = missed_of((const int[]){2, 2, 2, 2}, (const int[]){6, 6, 6, 6});
  assert_true(missed.flux > 0 && missed.beyond == 0);
  assert_string_equal(missed.where, "");
}

/* Light up to one end of s is told there, and no other end is; more of it means more beyond. */
TEST(test_lit_end_is_named) {
  struct slab_missed some = missed_of((const int[]){2, 2, 4, 2}, (const int[]){6, 6, 8, 6});
  struct slab_missed more = missed_of((const int[]){2, 2, 4, 0}, (const int[]){6, 6, 8, 8});
  assert_true(strstr(some.where, "page 1") && strstr(some.where, "high s"));
  assert_true(!strstr(some.where, "low") && !strstr(some.where, " t"));
  assert_true(strstr(more.where, "high s") && strstr(more.where, "low t"));
  assert_true(some.beyond > 0 && more.beyond > some.beyond);
}

int main(void) {
  return testing_run(NULL, NULL);
}
