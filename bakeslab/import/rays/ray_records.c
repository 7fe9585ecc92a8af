#include "import/rays/ray_records.h"

#include <math.h>
#include <string.h>

#include "slab/slab_logluv.h"

uint32_t ray_records_word(const unsigned char *bytes, bool swapped) {
  uint32_t word = (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                  (uint32_t)bytes[3] << 24;
  return swapped ? __builtin_bswap32(word) : word;
}

float ray_records_float(const unsigned char *bytes, bool swapped) {
  uint32_t word = ray_records_word(bytes, swapped);
  float number;
  memcpy(&number, &word, sizeof number);
  return number;
}

enum result ray_records_begin(struct ray_file *file, uint64_t start, struct error *error) {
  const struct ray_records *records = &file->records;
  uint64_t size = (uint64_t)records->columns * sizeof(float), there = file->bytes.size;
  unsigned long long promised = records->promised;
  if (promised == 0)
    return result_fail(error, RESULT_BAD, "byte %d: its header promises no rays", records->promise);
  if (there < start)
    return result_fail(error, RESULT_BAD,
                       "byte %llu: ends within its header, after which rays begin at byte %llu",
                       (unsigned long long)there, (unsigned long long)start);
  if ((there - start) / size < promised)
    return result_fail(
        error, RESULT_BAD, "byte %llu: ends within ray %llu of the %llu that its header promises",
        (unsigned long long)there, (unsigned long long)((there - start) / size + 1), promised);
  if (there - start > promised * size)
    return result_fail(error, RESULT_BAD,
                       "byte %llu: goes on after the %llu rays that its header promises",
                       (unsigned long long)(start + promised * size), promised);
  return ray_bytes_seek(&file->bytes, start, error);
}

/* Beyond these there is no lamp; up to them nothing that is computed of rays overflows. */
static const double farthest = 1e9, brightest = 1e15;

static enum result check_numbers(const struct ray *ray, double metres, struct error *error) {
  for (int c = 0; c < 3; ++c) {
    if (!isfinite(ray->origin[c]) || !isfinite(ray->direction[c]) || !isfinite(ray->flux[c]))
      return result_fail(error, RESULT_BAD, "a ray with a number that is not finite");
    if (fabs(ray->origin[c] * metres) > farthest)
      return result_fail(error, RESULT_BAD, "a ray at %g m: must be within %g m",
                         ray->origin[c] * metres, farthest);
    if (fabs(ray->flux[c]) > brightest)
      return result_fail(error, RESULT_BAD, "a ray with a flux of %g: at most %g can be read",
                         ray->flux[c], brightest);
  }
  return RESULT_OK;
}

/* Makes it a unit vector; false where it is none. */
static bool normalise(double d[3]) {
  double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  if (!(square > 1e-200 && square < 1e200)) { /* which may have over- or underflown */
    double largest = 0;
    for (int c = 0; c < 3; ++c) largest = fmax(largest, fabs(d[c]));
    if (!(largest > 0)) return false;
    for (int c = 0; c < 3; ++c) d[c] /= largest;
    square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  }
  double scale = 1 / sqrt(square);
  for (int c = 0; c < 3; ++c) d[c] *= scale;
  return true;
}

enum result ray_check(struct ray *ray, double metres, struct error *error) {
  enum result result = check_numbers(ray, metres, error);
  if (result != RESULT_OK) return result;
  for (int c = 0; c < 3; ++c) ray->origin[c] *= metres;
  if (normalise(ray->direction)) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "a ray without direction");
}

/* Linear Rec. 709 from X, Y and Z. */
static void set_colour(double x, double y, double z, struct ray *ray) {
  const double xyz[3] = {x, y, z};
  float rgb[3];
  slab_logluv_to_rgb(xyz, rgb);
  for (int c = 0; c < 3; ++c) ray->flux[c] = (double)rgb[c];
}

static double column(const struct ray_records *records, const unsigned char *data, int number) {
  return (double)ray_records_float(data + 4 * number, records->swapped);
}

static enum result decode(const struct ray_records *records, const unsigned char *data,
                          struct ray *ray, struct error *error) {
  double flux = column(records, data, records->flux);
  for (int c = 0; c < 3; ++c) {
    ray->origin[c] = column(records, data, c);
    ray->direction[c] = column(records, data, 3 + c);
    ray->flux[c] = flux;
  }
  if (records->x)
    set_colour(column(records, data, records->x), flux, column(records, data, records->z), ray);
  if (flux < 0) return result_fail(error, RESULT_BAD, "a ray with a flux of %g", flux);
  return ray_check(ray, records->metres, error);
}

enum result ray_records_read(struct ray_file *file, struct ray *rays, size_t most, size_t *count,
                             struct error *error) {
  struct ray_records *records = &file->records;
  size_t size = (size_t)records->columns * sizeof(float), there = 0;
  uint64_t left = records->promised - records->next;
  const unsigned char *data;
  if (left < most) most = (size_t)left;
  if (most > RAY_BYTES_MOST / size) most = RAY_BYTES_MOST / size;
  if (most == 0) return RESULT_OK;
  enum result result = ray_bytes_peek(&file->bytes, most * size, &data, &there, error);
  if (result != RESULT_OK) return result;
  if (there < size)
    return result_fail(error, RESULT_BAD, "byte %llu: ends while it is read",
                       (unsigned long long)file->bytes.at);
  if (most > there / size) most = there / size;
  for (size_t n = 0; n < most && result == RESULT_OK; ++n) {
    result = decode(records, data + n * size, &rays[n], error);
    if (result != RESULT_OK)
      return result_at(result, error, "byte %llu (ray %llu)",
                       (unsigned long long)(file->bytes.at + n * size),
                       (unsigned long long)(records->next + n + 1));
  }
  ray_bytes_skip(&file->bytes, most * size);
  records->next += most;
  *count = most;
  return RESULT_OK;
}
