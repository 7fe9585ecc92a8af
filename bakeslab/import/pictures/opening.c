#include "import/pictures/opening.h"

#include <math.h>
#include <stdlib.h>

/* What half cells are. Those that no ray shows count as lit. */
enum state { UNSEEN, DARK, LIT, EDGE };

struct half_cell {
  enum state state;
  double product, square; /* of an edge: sums of radiance times what it would be, and of that^2 */
};

static const double dark = 1e-3;

static struct half_cell *find_cell(const struct opening *opening, const struct rebin_ray *ray) {
  int half[2];
  for (int k = 0; k < 2; ++k) {
    double at = floor(2 * ((double)ray->at[k] + 0.5));
    half[k] = (int)fmin(fmax(at, 0), opening->size[k] - 1);
  }
  return &opening->cell[(size_t)half[1] * (size_t)opening->size[0] + (size_t)half[0]];
}

static bool is_beside_dark(const struct opening *opening, int i, int j) {
  for (int n = 0; n < 9; ++n) {
    int x = i + n % 3 - 1, y = j + n / 3 - 1;
    if (x >= 0 && y >= 0 && x < opening->size[0] && y < opening->size[1] &&
        opening->cell[(size_t)y * (size_t)opening->size[0] + (size_t)x].state == DARK)
      return true;
  }
  return false;
}

enum result opening_find(const struct rebin_ray *rays, size_t count, const struct slab *slab,
                         struct opening *opening, struct error *error) {
  double brightest = 0;
  for (int k = 0; k < 2; ++k) opening->size[k] = 2 * slab->samples[SLAB_U + k];
  size_t cells = (size_t)opening->size[0] * (size_t)opening->size[1];
  opening->cell = calloc(cells, sizeof *opening->cell);
  if (!opening->cell) return result_no_memory(error);
  for (size_t n = 0; n < count; ++n) brightest = fmax(brightest, slab_luminance(rays[n].rgb));
  for (size_t n = 0; n < count; ++n) {
    struct half_cell *cell = find_cell(opening, &rays[n]);
    if (slab_luminance(rays[n].rgb) >= dark * brightest)
      cell->state = LIT;
    else if (cell->state == UNSEEN)
      cell->state = DARK;
  }
  for (size_t n = 0; n < cells; ++n)
    if (opening->cell[n].state == LIT &&
        is_beside_dark(opening, (int)(n % (size_t)opening->size[0]),
                       (int)(n / (size_t)opening->size[0])))
      opening->cell[n].state = EDGE;
  return RESULT_OK;
}

void opening_free(struct opening *opening) {
  free(opening->cell);
  *opening = (struct opening){0};
}

enum opening_part opening_part(const struct opening *opening, const struct rebin_ray *ray) {
  enum state state = find_cell(opening, ray)->state;
  return state == DARK ? OPENING_DARK : state == EDGE ? OPENING_EDGE : OPENING_CLEAR;
}

void opening_compare(struct opening *opening, const struct rebin_ray *ray, double clear) {
  struct half_cell *cell = find_cell(opening, ray);
  cell->product += slab_luminance(ray->rgb) * clear;
  cell->square += clear * clear;
}

static double half_cell_share(const struct half_cell *cell) {
  if (cell->state != EDGE) return cell->state == DARK ? 0 : 1;
  return cell->square > 0 ? fmin(cell->product / cell->square, 1) : 0.5;
}

double opening_share(const struct opening *opening, int i, int j) {
  double open = 0;
  for (int n = 0; n < 4; ++n) {
    size_t row = (size_t)(2 * j + n / 2), column = (size_t)(2 * i + n % 2);
    open += half_cell_share(&opening->cell[row * (size_t)opening->size[0] + column]) / 4;
  }
  return open;
}
