/* gauss.c - see gauss.h: the roots of Legendre's polynomial by Newton's method. */
#include "oracle/gauss.h"

#include <math.h>

const struct gauss *gauss_rule(int n) {
  static struct gauss rules[GAUSS_MOST + 1];
  struct gauss *rule = &rules[n];
  for (int i = rule->count; i < n; ++i, rule->count = i) {
    long double x = cosl(acosl(-1.0L) * (i + 0.75L) / (n + 0.5L)), slope = 1;
    for (int step = 0; step < 12; ++step) {
      long double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        long double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule->x[i] = x;
    rule->w[i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}
