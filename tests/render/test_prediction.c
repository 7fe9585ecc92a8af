/* test_prediction.c - what is linear is predicted exactly, and how far a value is off the plane
 * through the others is what a plane through them alone says. */
#include <math.h>

#include "oracle/random.h"
#include "picture/prediction.h"
#include "testing.h"

static double predict(const struct prediction_places *places, const double *values, double x,
                      double y, double *off) {
  struct prediction prediction;
  double value;
  prediction_make(places, &prediction);
  *off = prediction_value(places, &prediction, values, x, y, &value);
  return value;
}

/* `count` places of a grid of 3 x 3, from number `first` on. */
static struct prediction_places grid_of(int first, int count) {
  struct prediction_places places = {.count = count};
  for (int k = 0; k < count; ++k) {
    places.at[k][0] = (first + k) % 3 - 1;
    places.at[k][1] = (first + k) / 3 - 1;
  }
  return places;
}

TEST(test_linear) {
  for (int count = 4; count <= PREDICTION_MOST; ++count) {
    const struct prediction_places places = grid_of(PREDICTION_MOST - count, count);
    double values[PREDICTION_MOST], off;
    for (int k = 0; k < count; ++k) values[k] = 5 + 2 * places.at[k][0] - 3 * places.at[k][1];
    double value = predict(&places, values, 0.25, 0.125, &off);
    /* Where but one place is off a line, nothing tells whether its value is right. */
    if (count > 4) assert_near(value, 5 + 2 * 0.25 - 3 * 0.125, 1e-12);
    assert_true(count > 4 ? off < 1e-12 : off > 1);
  }
}

TEST(test_others) {
  const struct prediction_places places = grid_of(0, PREDICTION_MOST);
  double values[PREDICTION_MOST], off, most = 0;
  uint64_t seed = 3;
  for (int k = 0; k < PREDICTION_MOST; ++k) values[k] = random_number(&seed);
  predict(&places, values, 0, 0, &off);
  for (int left = 0; left < PREDICTION_MOST; ++left) {
    struct prediction_places others = {0};
    double rest[PREDICTION_MOST], ignored;
    for (int k = 0; k < PREDICTION_MOST; ++k) {
      if (k == left) continue;
      others.at[others.count][0] = places.at[k][0];
      others.at[others.count][1] = places.at[k][1];
      rest[others.count++] = values[k];
    }
    double value = predict(&others, rest, places.at[left][0], places.at[left][1], &ignored);
    most = fmax(most, fabs(value - values[left]));
  }
  assert_near(off, most, 1e-12);
}

/* Two places, or three on a line and one beside it: their mean. */
TEST(test_level) {
  struct prediction_places places = {.count = 2, .at = {{-1, 0}, {0, 0}}};
  const double values[4] = {0, 0, 0, 4};
  double off;
  assert_near(predict(&places, values + 2, 1, 1, &off), 2, 0);
  assert_near(off, 4, 1e-12);
  places = grid_of(0, 4);
  assert_near(predict(&places, values, 1, 1, &off), 1, 0);
  assert_near(off, 4, 1e-12);
}

int main(void) {
  return testing_run(NULL, NULL);
}
