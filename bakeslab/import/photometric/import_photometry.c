#include "import/photometric/import_photometry.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/kelvin.h"
#include "import/photometric/eulumdat.h"
#include "import/photometric/ies.h"
#include "import/photometric/photometry_slab.h"

/* Of the largest intensity. Round bodies shine unlike from each position, so that finer directions
 * cost more; sheets of includes need narrow windows, and are coarser anyway. */
static const double default_tolerance = 0.005, narrow_tolerance = 0.025, rough_tolerance = 0.05;

static bool is_ies(const char *head, size_t size, const char *path) {
  (void)path;
  return ies_is(head, size);
}

/* Numbers that no such file has are told by their line where its name says what it should be. */
static bool is_eulumdat(const char *head, size_t size, const char *path) {
  size_t length = strlen(path);
  return eulumdat_is(head, size) || (length > 4 && !strcasecmp(path + length - 4, ".ldt"));
}

/* The mean intensity at gamma 60 to 85 degrees about a direction along an axis, both ways. */
static double sideways(const struct photometry *lamp, int axis) {
  double sum = 0;
  for (int gamma = 60; gamma <= 85; gamma += 5)
    for (int turn = -20; turn <= 20; turn += 5)
      for (int sign = -1; sign <= 1; sign += 2) {
        double g = gamma * M_PI / 180, c = turn * M_PI / 180 + (axis == 2 ? M_PI / 2 : 0);
        double d[3] = {sign * sin(g) * cos(c), -cos(g), sign * sin(g) * sin(c)};
        sum += photometry_candela(lamp, d);
      }
  return sum;
}

/* A long opening sends less light along itself than across, since it shows less of itself there. */
static void check_length(const struct photometry *lamp, struct warnings *notes) {
  double x = lamp->size[0], z = lamp->size[2];
  if (!(fmin(x, z) > 0) || fmax(x, z) < 3 * fmin(x, z)) return;
  int along = x > z ? 0 : 2;
  double ends = sideways(lamp, along), sides = sideways(lamp, 2 - along);
  if (ends > 1.25 * sides)
    warnings_add(notes,
                 "the opening is long in %s (%.3g x %.3g m), but more light goes that way "
                 "than across: length and width may be swapped, or C0 lies along the other axis: "
                 "--turn 90 turns the light",
                 along == 0 ? "x, towards C0" : "z, towards C90", fmax(x, z), fmin(x, z));
}

static void check_negative(const struct photometry *lamp, struct warnings *notes) {
  size_t count = (size_t)lamp->planes * (size_t)lamp->rows, negative = 0;
  for (size_t n = 0; n < count; ++n) negative += lamp->candela[n] < 0;
  if (negative > 0)
    warnings_add(notes,
                 "%zu of its intensities are negative and stay so, in samples as float, since "
                 "LogLuv cannot hold them",
                 negative);
}

/* Tables of type C begin at 0 or 90 degrees and end at 90 or 180 (LM-63-2002); what
 * another leaves out is dark. */
static void check_range(const struct photometry *lamp, struct warnings *notes) {
  double first = lamp->row[0], last = lamp->row[lamp->rows - 1];
  bool whole = (first == 0 || first == 90) && (last == 90 || last == 180);
  if (lamp->type == PHOTOMETRY_C && !whole)
    warnings_add(notes, "its vertical angles go from %g to %g degrees: beyond them it is dark",
                 first, last);
}

/* The opening in words, with what the file does not say of it. */
static void describe_opening(const struct photometry *lamp, const struct photometry_pages *pages,
                             char *text, size_t room) {
  static const char *const names[] = {"point", "box", "cylinder", "ellipsoid"};
  const double *size = pages->body.size;
  const char *name = names[lamp->shape];
  bool flat = !(lamp->size[0] > 0) || !(lamp->size[1] > 0) || !(lamp->size[2] > 0);
  if (flat && lamp->shape == PHOTOMETRY_BOX) name = "rectangle";
  if (flat && lamp->shape == PHOTOMETRY_CYLINDER) name = "disc";
  if (lamp->shape == PHOTOMETRY_POINT)
    snprintf(text, room, "a point, taken for an opening of %g x %g x %g m", size[0], size[1],
             size[2]);
  else
    snprintf(text, room, "%s of %.4g x %.4g x %.4g m%s", name, size[0], size[1], size[2],
             pages->thick ? ", thicker than the file says" : "");
}

static void note_opening(const struct photometry *lamp, const struct photometry_pages *pages,
                         struct warnings *notes) {
  const double *size = pages->body.size;
  if (lamp->shape == PHOTOMETRY_POINT)
    warnings_add(notes,
                 "the file gives no opening: the light gets one of %g x %g x %g m, so that "
                 "only its far field is known",
                 size[0], size[1], size[2]);
  else if (pages->thick)
    warnings_add(notes,
                 "the opening is flat or nearly so, but much light goes along it: it is "
                 "made thicker, %g x %g x %g m",
                 size[0], size[1], size[2]);
  for (int k = 0; k < 3 && lamp->shape == PHOTOMETRY_BOX; ++k)
    if (!(lamp->size[k] > 0) && size[k] > 0 && !pages->thick)
      warnings_add(notes, "the opening is a line: it is made %g m wide", size[k]);
}

static void tell(const struct import_wish *wish, const struct photometry *lamp,
                 const struct photometry_pages *pages, const struct photometry_grid *grid,
                 double tolerance, struct import_story *story) {
  char opening[200], turned[40] = "";
  describe_opening(lamp, pages, opening, sizeof opening);
  if (wish->turn) snprintf(turned, sizeof turned, ", turned by %d degrees", wish->turn);
  snprintf(story->assumptions, sizeof story->assumptions,
           "each point of the opening (%s) that faces a direction shines alike there: radiance is "
           "intensity over the projected luminous area%s%s",
           opening, turned,
           pages->narrow ? "; sides share light that runs along them, so that what is nearer than "
                           "the opening is wide may be lit a tenth too much or too little"
                         : "");
  snprintf(story->error_is, sizeof story->error_is,
           "RMS of the far field against the file's intensities; 95 %% of the lit directions that "
           "were tried are within %.2g %%, all within %.2g %% of the largest",
           100 * grid->error.most95, 100 * grid->error.most);
  double worth_telling = wish->tolerance > 0 ? tolerance : rough_tolerance;
  story->error = grid->error.rms;
  story->sample_error = NAN;
  story->flux_error = fabs(grid->error.factor - 1);
  story->missed = story->flux_error; /* beyond the windows, made up for by all cells */
  if (grid->error.most > worth_telling || grid->error.most95 > 0.4 * worth_telling)
    warnings_add(
        wish->notes,
        "the far field is off by up to %.2g %% of the largest intensity in 95 %% of the "
        "lit directions, by more than %.2g %% in %.2g %% of them, and by %.2g %% at most%s",
        100 * grid->error.most95, 100 * tolerance, 100 * grid->error.beyond, 100 * grid->error.most,
        wish->st[0] > 0 ? ": more samples (--st) make it better" : "");
}

static double tolerance_for(const struct import_wish *wish, const struct photometry *lamp) {
  struct photometry_body body;
  photometry_body(lamp, false, &body);
  if (wish->tolerance > 0) return wish->tolerance;
  if (!photometry_is_even(&body)) return rough_tolerance;
  return wish->narrow ? narrow_tolerance : default_tolerance;
}

static enum result make_slabs(const struct import_wish *wish, struct photometry *lamp,
                              struct import_light *light, struct error *error) {
  struct photometry_pages pages;
  struct photometry_grid grid = {0};
  double tolerance = tolerance_for(wish, lamp);
  double white[3] = {1, 1, 1};
  if (wish->kelvin > 0) kelvin_colour(wish->kelvin, white);
  enum result result = photometry_pages(lamp, wish->narrow ? rough_tolerance : tolerance,
                                        wish->narrow, &pages, error);
  if (result == RESULT_OK)
    result = photometry_grid(lamp, &pages, wish->st, tolerance, &grid, error);
  if (result == RESULT_OK)
    result = photometry_slabs(lamp, &pages, &grid, wish->uv, white, &light->slabs, error);
  if (result == RESULT_OK) {
    light->count = pages.count;
    note_opening(lamp, &pages, wish->notes);
    tell(wish, lamp, &pages, &grid, tolerance, &light->story);
  }
  photometry_grid_free(&grid);
  return result;
}

static enum result sum_flux(struct import_light *light, struct error *error) {
  enum result result = RESULT_OK;
  for (int n = 0; n < light->count && result == RESULT_OK; ++n) {
    double rgb[3];
    result = slab_flux_metric(&light->slabs[n], rgb, error);
    light->story.flux_out += 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  }
  return result;
}

/* --lumens */
static enum result rescale(const struct import_wish *wish, struct photometry *lamp,
                           struct error *error) {
  double flux = photometry_flux(lamp);
  if (!(wish->lumens > 0)) return RESULT_OK;
  if (!(flux > 0))
    return result_fail(error, RESULT_BAD, "its flux is %g lm and cannot be rescaled to %g lm", flux,
                       wish->lumens);
  return photometry_scale(lamp, wish->lumens / flux, error);
}

static enum result read_slabs(const struct import_wish *wish, struct import_light *light,
                              struct error *error) {
  const char *path = wish->files[0];
  struct photometry lamp = {0};
  if (wish->file_count > 1)
    return result_fail(error, RESULT_BAD, "%s: a lamp is one photometric file: import %s by itself",
                       path, wish->files[1]);
  enum result result = photometry_read(path, &lamp, wish->notes, error);
  if (result != RESULT_OK) return result;
  lamp.turn = wish->turn / 90;
  check_length(&lamp, wish->notes);
  check_negative(&lamp, wish->notes);
  check_range(&lamp, wish->notes);
  result = rescale(wish, &lamp, error);
  light->story.flux_in = photometry_flux(&lamp);
  if (result == RESULT_OK) result = make_slabs(wish, &lamp, light, error);
  if (result == RESULT_OK) result = sum_flux(light, error);
  photometry_free(&lamp);
  return result_at(result, error, "%s", path);
}

const struct import_kind import_ies = {"ies", is_ies, IMPORT_PHOTOMETRIC, read_slabs};
const struct import_kind import_eulumdat = {"eulumdat", is_eulumdat, IMPORT_PHOTOMETRIC,
                                            read_slabs};
