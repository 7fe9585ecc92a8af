/* eulumdat.c - the file, in its order: 25 lines, one a field; the number of lamp sets, and six
 * lines for each; then numbers, however they are wrapped: 10 direct ratios, the angles, the
 * intensities plane by plane. */
#include "import/photometric/eulumdat.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/numbers.h"
#include "import/photometric/photometry_text.h"
#include "import/photometric/photometry_unfold.h"

enum { RATIOS = 10, MOST_SETS = 1000 };

struct head {
  int symmetry, planes, rows, sets;
  double length, width, side[4]; /* of the luminous area, mm; heights towards C0, C90, ... */
  double factor;                 /* of the intensities */
  double lamps, lumens;          /* of the first set */
  int lumens_line;
};

/* The number that a line begins with, with a decimal point or comma; a line without one is 0. */
static bool line_number(const char *line, size_t length, double *number) {
  char word[64];
  size_t used = 0;
  while (length > 0 && (*line == ' ' || *line == '\t')) ++line, --length;
  while (used < length && used + 1 < sizeof word && !strchr(" \t;", line[used])) {
    word[used] = line[used] == ',' ? '.' : line[used];
    ++used;
  }
  word[used] = 0;
  *number = 0;
  return used == 0 || numbers_real(word, 1, number);
}

static bool whole(double number, double low, double high) {
  return number >= low && number <= high && number == rint(number);
}

bool eulumdat_is(const char *head, size_t size) {
  struct photometry_text text = photometry_text_of(head, size);
  const char *line;
  size_t length;
  double number[8] = {0};
  for (int n = 1; n <= 7; ++n)
    if (!photometry_text_line(&text, &line, &length) ||
        (n > 1 && (length == 0 || !line_number(line, length, &number[n]))))
      return false;
  return whole(number[2], 0, 3) && whole(number[3], 0, 4) && whole(number[4], 1, 1e4) &&
         whole(number[6], 1, 1e4);
}

static enum result next_line(struct photometry_text *text, const char *what, const char **line,
                             size_t *length, struct error *error) {
  if (photometry_text_line(text, line, length)) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "line %d: the file ends where %s should be: it is cut off",
                     text->line, what);
}

static enum result next_number(struct photometry_text *text, const char *what, double low,
                               double high, double *number, struct error *error) {
  const char *line;
  size_t length;
  enum result result = next_line(text, what, &line, &length, error);
  if (result != RESULT_OK) return result;
  if (!line_number(line, length, number))
    return result_fail(error, RESULT_BAD,
                       "line %d: %s should be here, but this is no finite "
                       "number",
                       text->line - 1, what);
  if (!(*number >= low && *number <= high))
    return result_fail(error, RESULT_BAD, "line %d: %s is %g, but must be from %g to %g",
                       text->line - 1, what, *number, low, high);
  return RESULT_OK;
}

static enum result next_whole(struct photometry_text *text, const char *what, int low, int high,
                              int *number, struct error *error) {
  double value = 0;
  enum result result = next_number(text, what, low, high, &value, error);
  *number = result == RESULT_OK ? (int)value : 0;
  if (result == RESULT_OK && value != *number)
    result = result_fail(error, RESULT_BAD, "line %d: %s is %g, but must be a whole number",
                         text->line - 1, what, value);
  return result;
}

/* Lines that the light does not depend on; what is not NULL goes to the label. */
static enum result skip_lines(struct photometry_text *text, int count, struct photometry *label,
                              struct error *error) {
  enum result result = RESULT_OK;
  for (int n = 0; n < count && result == RESULT_OK; ++n) {
    const char *line;
    size_t length;
    result = next_line(text, "a line of the luminaire's description", &line, &length, error);
    if (result == RESULT_OK && label) photometry_text_label(label, line, length);
  }
  return result;
}

/* The luminaire's tilt while it was measured; not all write a number there. */
static enum result read_tilt(struct photometry_text *text, struct warnings *notes,
                             struct error *error) {
  const char *line;
  size_t length;
  double tilt;
  enum result result =
      next_line(text, "the luminaire's tilt during the measurement", &line, &length, error);
  if (result == RESULT_OK && line_number(line, length, &tilt) && tilt != 0)
    warnings_add(notes,
                 "it was tilted by %g degrees when it was measured: its light is as measured, its "
                 "opening is taken to lie level",
                 tilt);
  return result;
}

/* Lines 1 to 25, and 26: the number of lamp sets. */
static enum result read_head(struct photometry_text *text, struct head *head,
                             struct photometry *lamp, struct warnings *notes, struct error *error) {
  static const char *const heights[] = {"the opening's height towards C0", "that towards C90",
                                        "that towards C180", "that towards C270"};
  const double most = 1e7; /* mm */
  int type;
  double step;
  enum result result = skip_lines(text, 1, lamp, error);
  if (result == RESULT_OK) result = next_whole(text, "the type (Ityp)", 0, 3, &type, error);
  if (result == RESULT_OK)
    result = next_whole(text, "the symmetry (Isym)", 0, 4, &head->symmetry, error);
  if (result == RESULT_OK)
    result =
        next_whole(text, "the number of C planes", 1, PHOTOMETRY_MOST_ANGLES, &head->planes, error);
  if (result == RESULT_OK)
    result = next_number(text, "the distance of C planes", 0, 360, &step, error);
  if (result == RESULT_OK)
    result = next_whole(text, "the number of intensities in a plane", 2, PHOTOMETRY_MOST_ANGLES,
                        &head->rows, error);
  if (result == RESULT_OK)
    result = next_number(text, "the distance of intensities", 0, 180, &step, error);
  if (result == RESULT_OK) result = skip_lines(text, 1, NULL, error);
  if (result == RESULT_OK) result = skip_lines(text, 2, lamp, error);
  if (result == RESULT_OK) result = skip_lines(text, 5, NULL, error);
  if (result == RESULT_OK)
    result = next_number(text, "the opening's length", 0, most, &head->length, error);
  if (result == RESULT_OK)
    result = next_number(text, "the opening's width", 0, most, &head->width, error);
  for (int k = 0; k < 4 && result == RESULT_OK; ++k)
    result = next_number(text, heights[k], 0, most, &head->side[k], error);
  if (result == RESULT_OK) result = skip_lines(text, 2, NULL, error);
  if (result == RESULT_OK)
    result = next_number(text, "the factor of the intensities", 0, 1e9, &head->factor, error);
  if (result == RESULT_OK) result = read_tilt(text, notes, error);
  if (result == RESULT_OK)
    result = next_whole(text, "the number of lamp sets", 0, MOST_SETS, &head->sets, error);
  return result;
}

/* The sets of lamps: the first counts, the others are alternatives to it. */
static enum result read_sets(struct photometry_text *text, struct head *head,
                             struct warnings *notes, struct error *error) {
  char others[120] = "";
  enum result result = RESULT_OK;
  for (int n = 0; n < head->sets && result == RESULT_OK; ++n) {
    double lamps = 0, lumens = 0;
    result = next_number(text, "a number of lamps", -1e6, 1e6, &lamps, error);
    if (result == RESULT_OK) result = skip_lines(text, 1, NULL, error);
    if (result == RESULT_OK)
      result = next_number(text, "the lamps' luminous flux", -1e12, 1e12, &lumens, error);
    if (result == RESULT_OK) result = skip_lines(text, 3, NULL, error);
    if (n == 0) {
      head->lamps = lamps;
      head->lumens = fabs(lumens);
      head->lumens_line = text->line - 4; /* three more lines follow */
    } else if (strlen(others) + 32 < sizeof others) {
      snprintf(others + strlen(others), 32, "%s%g", n > 1 ? ", " : "", lumens);
    }
  }
  if (result == RESULT_OK && head->sets > 1)
    warnings_add(notes,
                 "of %d sets of lamps the first counts, of %g lm (the others: %s lm): "
                 "--lumens rescales",
                 head->sets, head->lumens, others);
  if (result == RESULT_OK && !(head->lumens > 0))
    result = result_fail(error, RESULT_BAD,
                         "line %d: intensities are per 1000 lm, but the lamps "
                         "have no luminous flux: write it here",
                         head->sets > 0 ? head->lumens_line : text->line - 1);
  return result;
}

/* How many planes the file holds, and the first of them. */
static enum result stored_planes(const struct photometry_text *text, const struct head *head,
                                 int *first, int *count, struct error *error) {
  int n = head->planes;
  *first = 0;
  *count = n;
  if (head->symmetry == 1) *count = 1;
  if (head->symmetry == 2 || head->symmetry == 3) *count = n / 2 + 1;
  if (head->symmetry == 3) *first = n - n / 4;
  if (head->symmetry == 4) *count = n / 4 + 1;
  int whole_by = head->symmetry <= 1 ? 1 : head->symmetry == 2 ? 2 : 4;
  if (n % whole_by == 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "line %d: %d C planes do not fit the symmetry %d: they must "
                     "be a multiple of %d",
                     text->line, n, head->symmetry, whole_by);
}

/* Of all the C angles, those of the planes that the file holds. */
static void choose_angles(const double *all, int planes, int first, int count, double *c) {
  for (int k = 0; k < count; ++k) c[k] = all[(first + k) % planes];
}

static const enum photometry_symmetry symmetries[] = {PHOTOMETRY_ASYMMETRIC, PHOTOMETRY_ROTATED,
                                                      PHOTOMETRY_C0_C180, PHOTOMETRY_C90_C270,
                                                      PHOTOMETRY_C0_C180 | PHOTOMETRY_C90_C270};

/* `numbers` has room for the angles, and for those of the planes held, and their intensities. */
static enum result read_table(struct photometry_text *text, const struct head *head, int first,
                              int count, double *numbers, struct photometry *lamp,
                              struct error *error) {
  double *all = numbers, *row = all + head->planes, *c = row + head->rows, *candela = c + count;
  double ratios[RATIOS];
  int line;
  enum result result = photometry_text_numbers(text, "direct ratios", RATIOS, ratios, error);
  if (result == RESULT_OK)
    result = photometry_text_numbers(text, "C angles", (size_t)head->planes, all, error);
  if (result == RESULT_OK)
    result = photometry_text_ascending(text, "C angles", all, head->planes, 0, 360, error);
  if (result == RESULT_OK)
    result = photometry_text_numbers(text, "gamma angles", (size_t)head->rows, row, error);
  if (result == RESULT_OK)
    result = photometry_text_ascending(text, "gamma angles", row, head->rows, 0, 180, error);
  if (result == RESULT_OK)
    result = photometry_text_numbers(text, "intensities", (size_t)count * (size_t)head->rows,
                                     candela, error);
  size_t left = result == RESULT_OK ? photometry_text_left(text, &line) : 0;
  if (left > 0)
    result = result_fail(error, RESULT_BAD,
                         "line %d: %zu numbers too many: the counts of planes "
                         "and intensities (%d, %d) do not fit the table",
                         line, left, head->planes, head->rows);
  if (result != RESULT_OK) return result;
  choose_angles(all, head->planes, first, count, c);
  lamp->rows = head->rows;
  if (!(lamp->row = malloc((size_t)head->rows * sizeof *row))) return result_no_memory(error);
  memcpy(lamp->row, row, (size_t)head->rows * sizeof *row);
  return photometry_unfold(lamp, c, count, candela, symmetries[head->symmetry], error);
}

static enum result read_numbers(struct photometry_text *text, const struct head *head,
                                struct photometry *lamp, struct error *error) {
  int first, count;
  enum result result = stored_planes(text, head, &first, &count, error);
  if (result != RESULT_OK) return result;
  size_t most = (size_t)count * (size_t)head->rows + (size_t)head->rows + (size_t)head->planes;
  if (most > (size_t)(text->end - text->at))
    return result_fail(error, RESULT_BAD,
                       "line %d: the file is too short for %d planes of %d "
                       "intensities: it is cut off",
                       text->line, count, head->rows);
  double *numbers = malloc((most + (size_t)count) * sizeof *numbers);
  if (!numbers) return result_no_memory(error);
  result = read_table(text, head, first, count, numbers, lamp, error);
  free(numbers);
  return result;
}

/* Length lies along C90. Width 0 is a disc, or a cylinder of the mean of the four heights. */
static void set_opening(const struct head *head, struct photometry *lamp) {
  const double metres = 0.001, *side = head->side;
  double mean = (side[0] + side[1] + side[2] + side[3]) / 4;
  double highest = fmax(fmax(side[0], side[1]), fmax(side[2], side[3]));
  bool round = head->width == 0 && head->length > 0;
  lamp->axis = 1;
  lamp->shape = round ? PHOTOMETRY_CYLINDER : PHOTOMETRY_BOX;
  lamp->size[0] = metres * (round ? head->length : head->width);
  lamp->size[1] = metres * (round ? mean : highest);
  lamp->size[2] = metres * head->length;
  for (int k = 0; k < 4; ++k) lamp->side[k] = metres * side[k];
  if (head->width == 0 && head->length == 0 && highest == 0) lamp->shape = PHOTOMETRY_POINT;
}

enum result eulumdat_read(const char *text, size_t size, struct photometry *lamp,
                          struct warnings *notes, struct error *error) {
  struct photometry_text at = photometry_text_of(text, size);
  struct head head = {0};
  *lamp = (struct photometry){.type = PHOTOMETRY_C};
  at.decimal_comma = true;
  enum result result = read_head(&at, &head, lamp, notes, error);
  if (result == RESULT_OK) result = read_sets(&at, &head, notes, error);
  if (result == RESULT_OK) result = read_numbers(&at, &head, lamp, error);
  if (result != RESULT_OK) return result;
  set_opening(&head, lamp);
  lamp->lumens = head.lamps < 0 ? NAN : head.lumens; /* below 0: measured as a whole */
  if (!(head.factor > 0)) head.factor = 1;
  return result_at(photometry_scale(lamp, head.factor * head.lumens / 1000, error), error,
                   "line %d", head.lumens_line);
}
