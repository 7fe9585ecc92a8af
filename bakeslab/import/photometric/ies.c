/* ies.c - the file, in its order: a line of the version (since 1991), labels, TILT, ten numbers of
 * the lamp and three of its electricity, the angles, the intensities plane by plane. */
#include "import/photometric/ies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/photometric/ies_opening.h"
#include "import/photometric/ies_tilt.h"
#include "import/photometric/photometry_text.h"
#include "import/photometric/photometry_unfold.h"

struct head {
  int year; /* of the standard */
  int rows, planes, type, units;
  double lamps, lumens, multiplier, width, length, height, ballast, lamp_factor, watts;
  int multiplier_line, size_line;
};

/* The line starts with a word. */
static bool starts(const char *line, size_t length, const char *word) {
  size_t size = strlen(word);
  return length >= size && !memcmp(line, word, size);
}

bool ies_is(const char *head, size_t size) {
  struct photometry_text text = photometry_text_of(head, size);
  const char *line;
  size_t length;
  for (bool first = true; photometry_text_line(&text, &line, &length); first = false) {
    if (first && starts(line, length, "\xef\xbb\xbf")) line += 3, length -= 3;
    if (first && (starts(line, length, "IESNA") || starts(line, length, "IES:LM-63"))) return true;
    if (starts(line, length, "TILT=")) return true;
  }
  return false;
}

static int year_of(const char *line, size_t length) {
  static const struct {
    const char *word;
    int year;
  } versions[] = {{"IESNA91", 1991},          {"IESNA:LM-63-1986", 1986},
                  {"IESNA:LM-63-1991", 1991}, {"IESNA:LM-63-1995", 1995},
                  {"IESNA:LM-63-2002", 2002}, {"IES:LM-63-2019", 2019},
                  {"IESNA:LM-63-2019", 2019}};
  for (size_t k = 0; k < sizeof versions / sizeof *versions; ++k)
    if (starts(line, length, versions[k].word)) return versions[k].year;
  if (starts(line, length, "IES")) return 2002; /* a later or garbled one */
  return 1986;
}

/* A label of the luminaire: maker, number, name. */
static void read_label(struct photometry *lamp, const char *line, size_t length) {
  static const char *const keys[] = {"[MANUFAC]", "[LUMCAT]", "[LUMINAIRE]"};
  for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k)
    if (starts(line, length, keys[k]))
      photometry_text_label(lamp, line + strlen(keys[k]), length - strlen(keys[k]));
}

/* Up to TILT=, whose value is left in *tilt. */
static enum result read_labels(struct photometry_text *text, struct photometry *lamp,
                               struct head *head, const char **tilt, size_t *tilt_length,
                               struct error *error) {
  const char *line;
  size_t length;
  for (bool first = true; photometry_text_line(text, &line, &length); first = false) {
    if (first && starts(line, length, "\xef\xbb\xbf")) line += 3, length -= 3;
    if (first) head->year = year_of(line, length);
    if (starts(line, length, "TILT=")) {
      *tilt = line + 5;
      *tilt_length = length - 5;
      return RESULT_OK;
    }
    if (length > 0 && *line == '[')
      read_label(lamp, line, length);
    else if (first && head->year == 1986)
      photometry_text_label(lamp, line, length);
  }
  return result_fail(error, RESULT_BAD,
                     "line %d: the file ends without a line TILT=: it is cut "
                     "off",
                     text->line);
}

/* A factor of all intensities. */
static enum result read_factor(struct photometry_text *text, const char *what, double *factor,
                               struct error *error) {
  enum result result = photometry_text_number(text, what, factor, error);
  if (result != RESULT_OK || *factor != 0) return result;
  return result_fail(error, RESULT_BAD, "line %d: %s is 0, and so would be all intensities",
                     text->line, what);
}

static enum result read_head(struct photometry_text *text, struct head *head, struct error *error) {
  enum result result = photometry_text_number(text, "the number of lamps", &head->lamps, error);
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the lumens of a lamp", &head->lumens, error);
  if (result == RESULT_OK)
    result = read_factor(text, "the candela multiplier", &head->multiplier, error);
  head->multiplier_line = text->line;
  if (result == RESULT_OK)
    result = photometry_text_whole(text, "the number of vertical angles", 2, PHOTOMETRY_MOST_ANGLES,
                                   &head->rows, error);
  if (result == RESULT_OK)
    result = photometry_text_whole(text, "the number of horizontal angles", 1,
                                   PHOTOMETRY_MOST_ANGLES, &head->planes, error);
  if (result == RESULT_OK)
    result = photometry_text_whole(text, "the photometric type (1: C, 2: B, 3: A)", 1, 3,
                                   &head->type, error);
  if (result == RESULT_OK)
    result = photometry_text_whole(text, "the unit of length (1: feet, 2: metres)", 1, 2,
                                   &head->units, error);
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the opening's width", &head->width, error);
  head->size_line = text->line;
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the opening's length", &head->length, error);
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the opening's height", &head->height, error);
  if (result == RESULT_OK) result = read_factor(text, "the ballast factor", &head->ballast, error);
  /* Until 1991 a factor too; since 1995 it says how the file was made. */
  const char *second = "the ballast-lamp factor";
  if (result == RESULT_OK && head->year < 1995)
    result = read_factor(text, second, &head->lamp_factor, error);
  else if (result == RESULT_OK)
    result = photometry_text_number(text, second, &head->lamp_factor, error);
  if (result == RESULT_OK) result = photometry_text_number(text, "the watts", &head->watts, error);
  return result;
}

/* Which planes are mirrored; the standard allows no other ranges. */
static enum result find_symmetry(const struct photometry_text *text, const double *c, int planes,
                                 enum photometry_symmetry *symmetry, struct error *error) {
  double first = c[0], last = c[planes - 1];
  *symmetry = PHOTOMETRY_ASYMMETRIC;
  if (planes == 1)
    *symmetry = PHOTOMETRY_ROTATED;
  else if (first == 0 && last == 90)
    *symmetry = PHOTOMETRY_C0_C180 | PHOTOMETRY_C90_C270;
  else if (first == 0 && last == 180)
    *symmetry = PHOTOMETRY_C0_C180;
  else if ((first == 90 && last == 270) || (first == -90 && last == 90))
    *symmetry = PHOTOMETRY_C90_C270;
  else if (!(first == 0 && last > 180))
    return result_fail(error, RESULT_BAD,
                       "line %d: horizontal angles from %g to %g fit no "
                       "symmetry: they must run from 0 to 90, 180 or 360, or from 90 to 270",
                       text->line, first, last);
  return RESULT_OK;
}

/* Drops a last plane that repeats the angle before. */
static void drop_repeated(double *planes, int *count, struct warnings *notes) {
  if (*count < 2 || planes[*count - 1] != planes[*count - 2]) return;
  warnings_add(notes, "the last plane is there twice (%g degrees); the first counts",
               planes[*count - 1]);
  --*count;
}

/* Angles and intensities; `numbers` has room for all of them. */
static enum result read_table(struct photometry_text *text, const struct head *head,
                              double *numbers, struct photometry *lamp, struct warnings *notes,
                              struct error *error) {
  bool c = lamp->type == PHOTOMETRY_C;
  size_t count = (size_t)head->rows * (size_t)head->planes;
  double *rows = numbers, *planes = rows + head->rows, *candela = planes + head->planes;
  int plane_count = head->planes, line;
  enum photometry_symmetry symmetry = PHOTOMETRY_ASYMMETRIC;
  enum result result =
      photometry_text_numbers(text, "vertical angles", (size_t)head->rows, rows, error);
  if (result == RESULT_OK)
    result = photometry_text_ascending(text, "vertical angles", rows, head->rows, c ? 0 : -90,
                                       c ? 180 : 90, error);
  if (result == RESULT_OK)
    result =
        photometry_text_numbers(text, "horizontal angles", (size_t)head->planes, planes, error);
  if (result == RESULT_OK) {
    drop_repeated(planes, &plane_count, notes);
    result = photometry_text_ascending(text, "horizontal angles", planes, plane_count, -90,
                                       c ? 360 : 90, error);
  }
  if (result == RESULT_OK && !c && plane_count < 2)
    result = result_fail(error, RESULT_BAD,
                         "line %d: a table of type A or B has at least two horizontal angles",
                         text->line);
  if (result == RESULT_OK && c) result = find_symmetry(text, planes, plane_count, &symmetry, error);
  if (result == RESULT_OK)
    result = photometry_text_numbers(text, "candela values", count, candela, error);
  size_t left = result == RESULT_OK ? photometry_text_left(text, &line) : 0;
  if (left > 0)
    result = result_fail(error, RESULT_BAD,
                         "line %d: %zu numbers too many: the counts of angles "
                         "(%d, %d) do not fit the table",
                         line, left, head->rows, head->planes);
  if (result != RESULT_OK) return result;
  if (!c)
    return photometry_unfold_sides(lamp, planes, plane_count, rows, head->rows, candela, error);
  lamp->rows = head->rows;
  if (!(lamp->row = malloc((size_t)head->rows * sizeof *rows))) return result_no_memory(error);
  memcpy(lamp->row, rows, (size_t)head->rows * sizeof *rows);
  return photometry_unfold(lamp, planes, plane_count, candela, symmetry, error);
}

static enum result read_numbers(struct photometry_text *text, const struct head *head,
                                struct photometry *lamp, struct warnings *notes,
                                struct error *error) {
  size_t count =
      (size_t)head->rows * (size_t)head->planes + (size_t)head->rows + (size_t)head->planes;
  if (count > (size_t)(text->end - text->at))
    return result_fail(error, RESULT_BAD,
                       "line %d: the file is too short for %d vertical and %d "
                       "horizontal angles: it is cut off",
                       text->line, head->rows, head->planes);
  double *numbers = malloc(count * sizeof *numbers);
  if (!numbers) return result_no_memory(error);
  enum result result = read_table(text, head, numbers, lamp, notes, error);
  free(numbers);
  return result;
}

/* With commas as decimal points, or between numbers. */
static enum result read_all(const char *text, size_t size, bool decimal, const char *folder,
                            struct photometry *lamp, struct warnings *notes, struct error *error) {
  static const enum photometry_type types[] = {PHOTOMETRY_C, PHOTOMETRY_B, PHOTOMETRY_A};
  struct photometry_text at = photometry_text_of(text, size);
  struct head head = {0};
  const char *tilt = NULL;
  size_t tilt_length = 0;
  double factor = 1;
  *lamp = (struct photometry){0};
  at.decimal_comma = decimal;
  enum result result = read_labels(&at, lamp, &head, &tilt, &tilt_length, error);
  if (result == RESULT_OK) result = ies_tilt(&at, tilt, tilt_length, folder, &factor, notes, error);
  if (result == RESULT_OK) result = read_head(&at, &head, error);
  if (result != RESULT_OK) return result;
  lamp->type = types[head.type - 1];
  lamp->lumens = head.lumens > 0 ? head.lamps * head.lumens : NAN;
  result = ies_opening(head.year, (head.units == 1 ? 0.3048 : 1), head.width, head.length,
                       head.height, lamp, notes, error);
  result = result_at(result, error, "line %d", head.size_line);
  if (result == RESULT_OK && lamp->type == PHOTOMETRY_A) ies_opening_raise(lamp, notes);
  if (result == RESULT_OK) result = read_numbers(&at, &head, lamp, notes, error);
  if (result != RESULT_OK) return result;
  factor *= head.multiplier * head.ballast * (head.year < 1995 ? head.lamp_factor : 1);
  return result_at(photometry_scale(lamp, factor, error), error, "line %d", head.multiplier_line);
}

/* Whether the commas behind TILT= may be decimal points. */
static bool may_be_decimal(const char *text, size_t size) {
  struct photometry_text at = photometry_text_of(text, size);
  const char *line;
  size_t length;
  while (photometry_text_line(&at, &line, &length))
    if (starts(line, length, "TILT=")) return photometry_text_may_be_decimal(&at);
  return false;
}

/* Numbers are separated by blanks, commas or both. Where they do not add up so, commas may be
 * decimal points, as those of EULUMDAT. */
enum result ies_read(const char *text, size_t size, const char *folder, struct photometry *lamp,
                     struct warnings *notes, struct error *error) {
  struct warnings told[2] = {{0}, {0}};
  bool decimal = false;
  enum result result = read_all(text, size, false, folder, lamp, &told[0], error);
  if (result == RESULT_BAD && may_be_decimal(text, size)) {
    decimal = true;
    photometry_free(lamp);
    result = read_all(text, size, true, folder, lamp, &told[1], error);
    warnings_add(&told[1], "its commas are read as decimal points");
  }
  for (int k = 0; k < warnings_kept(&told[decimal]); ++k)
    warnings_add(notes, "%s", told[decimal].lines[k]);
  return result;
}
