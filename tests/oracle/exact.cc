/* exact.cc - see exact.h. Only |u| is rounded, to long double: it is a square root. */
#include "oracle/exact.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace {

using Rational = CGAL::Exact_rational;

long double rounded(const Rational &q) {
  double high = CGAL::to_double(q);
  return (long double)high + (long double)CGAL::to_double(Rational(q - high));
}

Rational exactly(long double x) {
  return Rational((double)x) + Rational((double)(x - (long double)(double)x));
}

/* (p - center) . axis */
Rational dot_from(const double p[3], const double center[3], const double axis[3]) {
  Rational sum = 0;
  for (int k = 0; k < 3; ++k) sum += (Rational(p[k]) - center[k]) * axis[k];
  return sum;
}

/* One axis of the aperture and the receiver over it. A line of a grid is `half` half cells from
 * its border, at a slope x; a place on it is counted in samples, of which sample i is at i. */
struct line {
  Rational length, foot, height; /* |u|, qx, z */
  Rational kappa, lean;          /* 1/D, 1 - kappa z */
  Rational low, high;            /* of the window */
  int uv, st;                    /* samples */

  line(const struct slab *slab, const double p[3], int which)
      : low(slab->st_window[2 * which]), high(slab->st_window[2 * which + 1]),
        uv(slab->samples[which]), st(slab->samples[2 + which]) {
    static const double origin[3] = {0, 0, 0};
    const double *edge = which ? slab->v : slab->u;
    Rational square = dot_from(edge, origin, edge);
    length = exactly(std::sqrt(rounded(square)));
    foot = dot_from(p, slab->center, edge) / square * length;
    height = dot_from(p, slab->center, slab->normal);
    kappa = std::isinf(slab->st_distance) ? Rational(0) : 1 / Rational(slab->st_distance);
    lean = 1 - kappa * height;
  }

  Rational uv_line(int half) const {
    return (Rational(half - uv) / (2 * uv) * length - foot) / height;
  }
  Rational st_line(int half) const {
    return (kappa * foot - low - (high - low) * Rational(half) / (2 * st)) / lean;
  }
  Rational uv_place(const Rational &x) const {
    return ((x * height + foot) / length + Rational(1) / 2) * uv - Rational(1) / 2;
  }
  Rational st_place(const Rational &x) const {
    return (kappa * foot - lean * x - low) / (high - low) * st - Rational(1) / 2;
  }
};

/* Slopes that are visible, and where lines cut them. */
struct cuts {
  bool bounded = false;
  Rational low, high;
  std::vector<Rational> at;

  template <typename Line> void add_grid(int samples, Line line_at) {
    Rational first = line_at(0), last = line_at(2 * samples);
    if (first > last) std::swap(first, last); /* whichever is lower */
    if (!bounded || first > low) low = first;
    if (!bounded || last < high) high = last;
    bounded = true;
    for (int k = 0; k < samples; ++k) at.push_back(line_at(2 * k + 1));
  }

  /* The limit from above: a border is at -infinity, 0 or +infinity, as seen from the foot. */
  void touch(const line &line) {
    for (int side = -1; side <= 1; side += 2) {
      Rational beyond = Rational(side) / 2 * line.length - line.foot;
      bool hides = side < 0 ? low < 0 : high > 0;
      if (beyond * side < 0) low = high;
      if (beyond == 0 && hides) (side < 0 ? low : high) = 0;
    }
  }

  /* Keeps what is inside, in order, each once, with both ends; nothing where nothing is visible. */
  void merge() {
    auto outside = [this](const Rational &x) { return x <= low || x >= high; };
    at.erase(std::remove_if(at.begin(), at.end(), outside), at.end());
    if (low >= high) return;
    at.push_back(low);
    at.push_back(high);
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end()), at.end());
  }
};

/* The two samples around a piece and the place between them at its ends. */
template <typename Place>
void find_samples(const Rational &low, const Rational &high, int samples, Place place, int index[2],
                  long double at[2]) {
  Rational middle = place((low + high) / 2);
  bool first = middle <= 0, last = middle >= samples - 1;
  at[0] = at[1] = 0;
  index[0] = index[1] = last && !first ? samples - 1 : 0;
  if (first || last) return;
  while (middle >= index[0] + 1) ++index[0];
  index[1] = index[0] + 1;
  at[0] = rounded(place(low) - index[0]);
  at[1] = rounded(place(high) - index[0]);
}

Rational mean(const struct slab *slab, int channel) {
  Rational sum = 0;
  size_t count = slab_sample_count(slab);
  for (size_t k = 0; k < count; ++k) sum += (double)slab->rgb[3 * k + (size_t)channel];
  return sum / count;
}

} // namespace

void oracle_axis_find(const struct slab *slab, const double p[3], int which,
                      struct oracle_axis *axis) {
  const line line(slab, p, which);
  cuts cuts;
  Rational sum = 0;
  auto uv_place = [&](const Rational &x) { return line.uv_place(x); };
  auto st_place = [&](const Rational &x) { return line.st_place(x); };
  axis->count = 0;
  if (line.height < 0) return;
  if (line.height > 0) cuts.add_grid(line.uv, [&](int half) { return line.uv_line(half); });
  Rational s = line.kappa * line.foot; /* on the st plane: one s for all of the aperture */
  if (line.lean != 0)
    cuts.add_grid(line.st, [&](int half) { return line.st_line(half); });
  else if (s < line.low || s > line.high)
    cuts.low = cuts.high;
  if (line.height == 0) cuts.touch(line);
  cuts.merge();
  if (cuts.at.size() > ORACLE_PIECES + 1) abort();
  for (size_t k = 0; k + 1 < cuts.at.size(); ++k) {
    const Rational &low = cuts.at[k], &high = cuts.at[k + 1], width = high - low;
    struct oracle_piece *piece = &axis->piece[axis->count++];
    sum += width;
    piece->x = rounded(low);
    piece->width = rounded(width);
    find_samples(low, high, line.uv, uv_place, piece->uv, piece->uv_at);
    find_samples(low, high, line.st, st_place, piece->st, piece->st_at);
  }
  if (axis->count && sum != cuts.high - cuts.low) abort();
}

double oracle_mean_change(const struct slab *from, const struct slab *to, int channel) {
  Rational before = mean(from, channel);
  return CGAL::to_double(Rational((mean(to, channel) - before) / before));
}
