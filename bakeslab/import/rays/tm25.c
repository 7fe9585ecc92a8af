/* tm25.c - ray files after IES TM-25 (2013, 2020): little-endian, lengths in mm.
 *
 * 1. A header block of 256 bytes (section 4.7.1), flags that tell the columns (4.7.2), nine texts
 *    of 1000 UTF-32 characters (4.7.3).
 * 2. Spectral tables (4.7.4), filled up to a multiple of 32 bytes; names of additional columns, of
 *    128 characters (4.7.5); a text (4.7.6).
 * 3. The rays: floats, in the order of the flags.
 *
 * A header of 2020 is read as one of 2013, and either only where the file's size then fits its
 * number of rays. A slab has neither spectrum nor polarisation: those are left out. What is not
 * known is NaN in the header, in some files with its bytes swapped (7F800001 as 0100807F). */
#include <math.h>
#include <string.h>

#include "import/rays/ray_records.h"

enum {
  HEADER = 288, /* with the flags */
  VERSION = 4,
  LUMENS = 12,
  WATTS = 16,
  RAYS = 20, /* 64 bits */
  SPECTRUM = 60,
  TABLES = 76,
  COLUMNS = 80,
  TEXT = 84,
  FLAGS = 256,
  TEXTS_END = HEADER + 9 * 1000 * 4, /* steps 1's end */
  TABLES_FILL = 32,
  NAME_SIZE = 128 * 4,
  MOST_COLUMNS = 1000,
  MOST_TABLES = 1000
};

enum {
  FLAG_PLACE,
  FLAG_DIRECTION,
  FLAG_WATTS,
  FLAG_WAVELENGTH,
  FLAG_LUMENS,
  FLAG_STOKES,
  FLAG_TRISTIMULUS,
  FLAG_SPECTRUM,
  FLAG_COUNT
};

struct header {
  bool swapped;
  double lumens, watts; /* NAN: not known */
  uint64_t rays;
  uint32_t spectrum, tables, columns, text;
  bool flags[FLAG_COUNT];
};

static bool is_tm25(const char *head, size_t size) {
  return size >= 4 && !memcmp(head, "TM25", 4);
}

/* NaN in either order of bytes, and 0, are fluxes that are not known. */
static double known_flux(const unsigned char *bytes, bool swapped) {
  double flux = (double)ray_records_float(bytes, swapped);
  return flux > 1e-30 && isfinite(flux) ? flux : NAN;
}

static enum result read_flags(const unsigned char *data, struct header *header,
                              struct error *error) {
  for (int n = 0; n < FLAG_COUNT; ++n) {
    uint32_t flag = ray_records_word(data + FLAGS + 4 * n, header->swapped);
    if (flag > 1)
      return result_fail(error, RESULT_BAD, "byte %d: a flag is %u, must be 0 or 1", FLAGS + 4 * n,
                         flag);
    header->flags[n] = flag;
  }
  if (!header->flags[FLAG_PLACE] || !header->flags[FLAG_DIRECTION])
    return result_fail(error, RESULT_BAD, "byte %d: its rays have no place or no direction", FLAGS);
  if (!header->flags[FLAG_WATTS] && !header->flags[FLAG_LUMENS])
    return result_fail(error, RESULT_BAD, "byte %d: its rays have no flux", FLAGS + 4 * FLAG_WATTS);
  return RESULT_OK;
}

static enum result read_header(const unsigned char *data, struct header *header,
                               struct error *error) {
  uint32_t version = ray_records_word(data + VERSION, false);
  header->swapped = version != 2013 && version != 2020;
  if (header->swapped) {
    uint32_t other = ray_records_word(data + VERSION, true);
    if (other != 2013 && other != 2020)
      return result_fail(error, RESULT_BAD,
                         "byte 4: version %u of TM-25; 2013 and 2020 can be read", version);
  }
  header->lumens = known_flux(data + LUMENS, header->swapped);
  header->watts = known_flux(data + WATTS, header->swapped);
  uint64_t low = ray_records_word(data + RAYS, header->swapped),
           high = ray_records_word(data + RAYS + 4, header->swapped);
  header->rays = header->swapped ? low << 32 | high : high << 32 | low;
  header->spectrum = ray_records_word(data + SPECTRUM, header->swapped);
  header->tables = ray_records_word(data + TABLES, header->swapped);
  header->columns = ray_records_word(data + COLUMNS, header->swapped);
  header->text = ray_records_word(data + TEXT, header->swapped);
  if (header->columns > MOST_COLUMNS)
    return result_fail(error, RESULT_BAD, "byte %d: %d additional columns; at most %d can be read",
                       COLUMNS, (int)header->columns, MOST_COLUMNS);
  if (header->tables > MOST_TABLES)
    return result_fail(error, RESULT_BAD, "byte %d: %d spectral tables; at most %d can be read",
                       TABLES, (int)header->tables, MOST_TABLES);
  return read_flags(data, header, error);
}

/* Step 2: where the rays begin. */
static enum result skip_blocks(struct ray_file *file, const struct header *header, uint64_t *start,
                               struct error *error) {
  uint64_t at = TEXTS_END, size = file->bytes.size;
  for (uint32_t n = 0; n < header->tables; ++n) {
    const unsigned char *data;
    size_t there;
    enum result result = ray_bytes_seek(&file->bytes, at, error);
    if (result == RESULT_OK) result = ray_bytes_peek(&file->bytes, 4, &data, &there, error);
    if (result != RESULT_OK) return result;
    uint64_t pairs = there < 4 ? 0 : ray_records_word(data, header->swapped);
    if (pairs == 0 || pairs > (size - at) / 8)
      return result_fail(error, RESULT_BAD, "byte %llu: spectral table %u of %u is not there whole",
                         (unsigned long long)at, n + 1, header->tables);
    at += 4 + 8 * pairs;
  }
  at += (TABLES_FILL - (at - TEXTS_END) % TABLES_FILL) % TABLES_FILL;
  *start = at + (uint64_t)header->columns * NAME_SIZE + header->text;
  return RESULT_OK;
}

/* Step 3: the columns. Lumens, where there are both and they are known. */
static void set_columns(const struct header *header, struct ray_file *file) {
  const bool *flags = header->flags;
  struct ray_records *records = &file->records;
  int at = 6, watts = at, lumens, tristimulus;
  at += flags[FLAG_WATTS] + flags[FLAG_WAVELENGTH];
  lumens = at;
  at += flags[FLAG_LUMENS] + 6 * flags[FLAG_STOKES];
  tristimulus = at;
  at += 2 * flags[FLAG_TRISTIMULUS] + flags[FLAG_SPECTRUM] + (int)header->columns;
  file->lumens = flags[FLAG_LUMENS] && !(flags[FLAG_WATTS] && isnan(header->lumens));
  file->coloured = file->lumens && flags[FLAG_TRISTIMULUS];
  file->stated = file->lumens ? header->lumens : header->watts;
  *records = (struct ray_records){.swapped = header->swapped,
                                  .columns = at,
                                  .flux = file->lumens ? lumens : watts,
                                  .metres = 1e-3,
                                  .promised = header->rays,
                                  .promise = RAYS};
  if (file->coloured) records->x = tristimulus, records->z = tristimulus + 1;
}

static void tell(const struct header *header, struct ray_file *file) {
  const bool *flags = header->flags;
  if (header->swapped) warnings_add(file->notes, "its bytes are swapped (big-endian); read so");
  if (file->lumens && flags[FLAG_WATTS])
    warnings_add(file->notes, "has radiant and luminous flux; the luminous is read");
  if (!file->coloured && header->spectrum > 0)
    warnings_add(file->notes, "its spectra are not used: the light is white");
  if (flags[FLAG_STOKES]) warnings_add(file->notes, "polarisation is left out");
}

/* Some writers leave out what the header says of tables, names and text (step 2). */
static enum result find_start(struct ray_file *file, const struct header *header, uint64_t *start,
                              struct error *error) {
  uint64_t record = (uint64_t)file->records.columns * sizeof(float), size = file->bytes.size;
  bool blocks = header->tables || header->columns || header->text;
  if (blocks && size >= TEXTS_END && (size - TEXTS_END) % record == 0 &&
      (size - TEXTS_END) / record == header->rays) {
    warnings_add(file->notes, "the tables, names and text that its header promises are not there");
    *start = TEXTS_END;
    return RESULT_OK;
  }
  return skip_blocks(file, header, start, error);
}

static enum result open_tm25(struct ray_file *file, struct error *error) {
  const unsigned char *data;
  size_t there = 0;
  uint64_t start = 0;
  struct header header = {0};
  enum result result = ray_bytes_peek(&file->bytes, HEADER, &data, &there, error);
  if (result == RESULT_OK && there < HEADER)
    result = result_fail(error, RESULT_BAD, "byte %llu: ends within its header",
                         (unsigned long long)there);
  if (result == RESULT_OK) result = read_header(data, &header, error);
  if (result != RESULT_OK) return result;
  set_columns(&header, file);
  result = find_start(file, &header, &start, error);
  if (result == RESULT_OK) result = ray_records_begin(file, start, error);
  if (result == RESULT_OK) tell(&header, file);
  return result;
}

const struct ray_format ray_format_tm25 = {"tm25", is_tm25, open_tm25, ray_records_read};
