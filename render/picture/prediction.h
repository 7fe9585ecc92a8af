/* prediction.h - a value in the picture from those at places nearby, by the least-squares plane
 * through them, and how well planes through all but one of them predict that one. */
#ifndef PREDICTION_H
#define PREDICTION_H

enum { PREDICTION_MOST = 9 };

struct prediction_places {
  int count; /* 2..PREDICTION_MOST */
  double at[PREDICTION_MOST][2];
};

/* The rows of `inverse` times the sums of value, value x and value y give the plane; `free` is 1
 * minus the leverage of each place. */
struct prediction {
  double inverse[3][3], free[PREDICTION_MOST];
};

/* The plane is level where the places lie on a line, or all but one do. */
void prediction_make(const struct prediction_places *places, struct prediction *prediction);

/* The value at (x, y), kept between the least and the most of `values`, those at the places.
 * Returns by how much the worst of these is off the plane through the others. */
double prediction_value(const struct prediction_places *places, const struct prediction *prediction,
                        const double *values, double x, double y, double *value);

#endif
