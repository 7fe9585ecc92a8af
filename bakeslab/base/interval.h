/* interval.h - where a number lies among ascending ones. */
#ifndef INTERVAL_H
#define INTERVAL_H

/* The largest k <= count - 2 with values[k] <= x, by bisection; 0 where there is none. */
static inline int interval_find(const double *values, int count, double x) {
  int low = 0, high = count - 1;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (values[middle] <= x)
      low = middle;
    else
      high = middle;
  }
  return low;
}

#endif
