/* zemax.c - binary source files of Zemax OpticStudio (.dat, .sdf): a header of 208 bytes,
 * then seven floats a ray, or eight where each has its wavelength (OpticStudio's help, "Source
 * File: binary source file format"). Of the header OpticStudio itself uses the number of rays, the
 * unit of length, the type of rays and the type of flux; so does this. */
#include <math.h>
#include <string.h>

#include "import/rays/ray_records.h"

enum {
  HEADER = 208,
  IDENTIFIER = 1010,
  IDENTIFIER_BEFORE = 8675309, /* of older programs, with the same header */
  RAYS = 4,
  STATED_FLUX = 112, /* of this set of rays */
  UNIT = 136,
  RAY_TYPE = 192,
  FLUX_TYPE = 196
};

static bool is_identifier(const char *head, bool swapped) {
  uint32_t word = ray_records_word((const unsigned char *)head, swapped);
  return word == IDENTIFIER || word == IDENTIFIER_BEFORE;
}

static bool is_zemax(const char *head, size_t size) {
  return size >= 4 && (is_identifier(head, false) || is_identifier(head, true));
}

static enum result read_header(const unsigned char *data, struct ray_file *file,
                               struct error *error) {
  static const double metres[] = {1, 0.0254, 0.01, 0.3048, 0.001};
  struct ray_records *records = &file->records;
  bool swapped = records->swapped = !is_identifier((const char *)data, false);
  uint32_t unit = ray_records_word(data + UNIT, swapped),
           rays = ray_records_word(data + RAY_TYPE, swapped),
           flux = ray_records_word(data + FLUX_TYPE, swapped);
  double stated = (double)ray_records_float(data + STATED_FLUX, swapped);
  if (unit >= sizeof metres / sizeof *metres)
    return result_fail(error, RESULT_BAD,
                       "byte %d: unit of length %u; must be 0 to 4 (m, in, cm, ft, mm)", UNIT,
                       unit);
  if (rays != 0 && rays != 2)
    return result_fail(error, RESULT_BAD,
                       "byte %d: rays of type %u; 0 (flux) and 2 (flux and wavelength) can be read",
                       RAY_TYPE, rays);
  if (flux > 1 || (flux == 1 && rays == 2))
    return result_fail(error, RESULT_BAD, "byte %d: flux of type %u; must be 0 (W), or 1 (lm) %s",
                       FLUX_TYPE, flux, "without wavelengths");
  int32_t count = (int32_t)ray_records_word(data + RAYS, swapped);
  if (count < 0)
    return result_fail(error, RESULT_BAD, "byte %d: its header promises %d rays", RAYS, count);
  records->promised = (uint64_t)count;
  records->promise = RAYS;
  records->columns = rays == 2 ? 8 : 7;
  records->flux = 6;
  records->metres = metres[unit];
  file->lumens = flux == 1;
  file->stated = stated > 0 && isfinite(stated) ? stated : NAN;
  return RESULT_OK;
}

static enum result open_zemax(struct ray_file *file, struct error *error) {
  const unsigned char *data;
  size_t there = 0;
  enum result result = ray_bytes_peek(&file->bytes, HEADER, &data, &there, error);
  if (result == RESULT_OK && there < HEADER)
    result = result_fail(error, RESULT_BAD, "byte %llu: ends within its header",
                         (unsigned long long)there);
  if (result == RESULT_OK) result = read_header(data, file, error);
  if (result == RESULT_OK) result = ray_records_begin(file, HEADER, error);
  if (result != RESULT_OK) return result;
  if (file->records.swapped)
    warnings_add(file->notes, "its bytes are swapped (big-endian); read so");
  if (file->records.columns == 8)
    warnings_add(file->notes, "its wavelengths are not used: the light is white");
  return RESULT_OK;
}

const struct ray_format ray_format_zemax = {"zemax", is_zemax, open_zemax, ray_records_read};
