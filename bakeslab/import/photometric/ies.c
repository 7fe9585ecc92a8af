/* ies.c - the file, in its order: a line of the version (since 1991), labels, TILT, ten numbers of
 * the lamp and three of its electricity, the angles, the intensities plane by plane. */
#include "import/photometric/ies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/files.h"
#include "import/photometric/ies_opening.h"
#include "import/photometric/photometry_text.h"
#include "import/photometric/photometry_unfold.h"

struct head {
  int year; /* of the standard */
  int rows, planes, type, units;
  double lamps, lumens, multiplier, width, length, height, ballast, lamp_factor, watts;
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

/* The lamps' output by the tilt of the luminaire: the factor where it is not tilted. */
static enum result read_tilt(struct photometry_text *text, double *factor, double *least,
                             struct error *error) {
  int geometry, count;
  double *angles = NULL;
  enum result result = photometry_text_whole(text, "the lamp's position in the luminaire (1 to 3)",
                                             1, 3, &geometry, error);
  if (result == RESULT_OK)
    result = photometry_text_whole(text, "the number of tilt angles", 1, PHOTOMETRY_MOST_ANGLES,
                                   &count, error);
  if (result != RESULT_OK) return result;
  if (!(angles = calloc(2 * (size_t)count, sizeof *angles))) return result_no_memory(error);
  double *factors = angles + count;
  result = photometry_text_numbers(text, "tilt angles", (size_t)count, angles, error);
  if (result == RESULT_OK)
    result = photometry_text_ascending(text, "tilt angles", angles, count, -180, 180, error);
  if (result == RESULT_OK)
    result = photometry_text_numbers(text, "tilt factors", (size_t)count, factors, error);
  if (result == RESULT_OK) {
    *factor = factors[0];
    *least = factors[0];
    for (int k = 1; k < count; ++k) {
      double part = angles[k] > angles[k - 1] ? -angles[k - 1] / (angles[k] - angles[k - 1]) : 0;
      if (angles[k - 1] <= 0 && angles[k] >= 0)
        *factor = factors[k - 1] + part * (factors[k] - factors[k - 1]);
      *least = fmin(*least, factors[k]);
    }
  }
  free(angles);
  return result;
}

/* A TILT file: what INCLUDE would have here, in a file of its own beside this one. */
static enum result read_tilt_file(const char *folder, const char *name, size_t length, int line,
                                  double *factor, double *least, struct error *error) {
  char file[200];
  for (size_t k = 0; k < length; ++k) /* paths of another machine */
    if (name[k] == '/' || name[k] == '\\') name += k + 1, length -= k + 1, k = (size_t)-1;
  if (length == 0 || length >= sizeof file)
    return result_fail(error, RESULT_BAD,
                       "line %d: TILT= must be NONE, INCLUDE or the name of a "
                       "file",
                       line);
  memcpy(file, name, length);
  file[length] = 0;
  char *content = folder ? files_read(folder, file) : NULL;
  if (!content)
    return result_fail(error, RESULT_BAD,
                       "line %d: the TILT file %s cannot be read: put it beside "
                       "this file, or write TILT=NONE",
                       line, file);
  struct photometry_text text = photometry_text_of(content, strlen(content));
  enum result result = read_tilt(&text, factor, least, error);
  free(content);
  return result_at(result, error, "TILT file %s", file);
}

static enum result apply_tilt(struct photometry_text *text, const char *tilt, size_t length,
                              const char *folder, double *factor, struct warnings *notes,
                              struct error *error) {
  double least = 1;
  enum result result;
  *factor = 1;
  while (length > 0 && tilt[length - 1] == ' ') --length;
  while (length > 0 && *tilt == ' ') ++tilt, --length;
  if (length == 4 && !memcmp(tilt, "NONE", 4)) return RESULT_OK;
  if (length == 7 && !memcmp(tilt, "INCLUDE", 7))
    result = read_tilt(text, factor, &least, error);
  else
    result = read_tilt_file(folder, tilt, length, text->line - 1, factor, &least, error);
  if (result == RESULT_OK)
    warnings_add(notes,
                 "its lamps' output changes when it is tilted (TILT: down to %g): the slab "
                 "is the luminaire as it was measured, not tilted; use gain for another position",
                 least);
  return result;
}

static enum result read_head(struct photometry_text *text, struct head *head, struct error *error) {
  enum result result = photometry_text_number(text, "the number of lamps", &head->lamps, error);
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the lumens of a lamp", &head->lumens, error);
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the candela multiplier", &head->multiplier, error);
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
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the opening's length", &head->length, error);
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the opening's height", &head->height, error);
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the ballast factor", &head->ballast, error);
  if (result == RESULT_OK)
    result = photometry_text_number(text, "the ballast-lamp factor", &head->lamp_factor, error);
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
  int plane_count = head->planes;
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
  if (result == RESULT_OK && photometry_text_left(text) > 0)
    result = result_fail(error, RESULT_BAD,
                         "line %d: %zu numbers too many: the counts of angles "
                         "(%d, %d) do not fit the table",
                         text->line, photometry_text_left(text), head->rows, head->planes);
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

enum result ies_read(const char *text, size_t size, const char *folder, struct photometry *lamp,
                     struct warnings *notes, struct error *error) {
  static const enum photometry_type types[] = {PHOTOMETRY_C, PHOTOMETRY_B, PHOTOMETRY_A};
  struct photometry_text at = photometry_text_of(text, size);
  struct head head = {0};
  const char *tilt = NULL;
  size_t tilt_length = 0;
  double factor = 1;
  *lamp = (struct photometry){0};
  enum result result = read_labels(&at, lamp, &head, &tilt, &tilt_length, error);
  if (result == RESULT_OK)
    result = apply_tilt(&at, tilt, tilt_length, folder, &factor, notes, error);
  if (result == RESULT_OK) result = read_head(&at, &head, error);
  if (result != RESULT_OK) return result;
  lamp->type = types[head.type - 1];
  lamp->lumens = head.lumens > 0 ? head.lamps * head.lumens : NAN;
  result = ies_opening(head.year, (head.units == 1 ? 0.3048 : 1), head.width, head.length,
                       head.height, lamp, notes, error);
  if (result == RESULT_OK) result = read_numbers(&at, &head, lamp, notes, error);
  if (result != RESULT_OK) return result;
  /* Until 1991 the number behind the ballast factor was one too; since 1995 it says how the file
   * was made. */
  factor *= head.multiplier * head.ballast * (head.year < 1995 ? head.lamp_factor : 1);
  if (!(fabs(factor) > 0) || !isfinite(factor))
    return result_fail(error, RESULT_BAD,
                       "line %d: the candela multiplier and ballast factors "
                       "multiply to %g",
                       at.line, factor);
  photometry_scale(lamp, factor);
  return RESULT_OK;
}
