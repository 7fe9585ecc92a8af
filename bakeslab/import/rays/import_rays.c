/* import_rays.c - from ray files to slabs.
 *
 * 1. All rays are read once, to see where they start and where they go (ray_look.h).
 * 2. Apertures are laid there, with windows that hold their light (ray_lay.h).
 * 3. All rays are read again: each is carried along its line to its page, and counted there
 *    (ray_estimate.h). What reaches none is told.
 * 4. The counts become samples.
 * While some rays of a file are read, a second thread does what is to be done with those before
 * them: all of it in the order of the file, with any number of threads. */
#include "import/rays/import_rays.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/tiles.h"
#include "import/rays/ray_estimate.h"
#include "import/rays/ray_lay.h"

enum { AT_A_TIME = 1 << 14, KEPT = 1 << 17, DEFAULT_UV = 16, DEFAULT_ST = 64 };

/* The work on one lamp. */
struct lamp {
  const struct import_wish *wish;
  const struct ray_format *format;
  struct ray_look look;
  struct ray_pages pages;
  struct ray_estimate *estimates[RAY_PAGES_MOST];
  bool lumens, coloured; /* as the files say */
  double factor;         /* of all flux, by --lumens */
  int threads;
  unsigned long long read;           /* rays */
  unsigned long long missed, beyond; /* rays that reach no page, or leave outside its window */
  double missed_flux, beyond_flux;
};

/* Metres per unit of length, where the wish says it. */
static double unit_of(const struct import_wish *wish) {
  return wish->metres > 0 ? wish->metres : 1;
}

/* The unit of the slabs' flux: --lumens makes lumens of watts. */
static bool in_lumens(const struct lamp *lamp) {
  return lamp->lumens || lamp->wish->lumens > 0;
}

/* Steps 1 and 3 of one file. */
typedef void use_rays(struct lamp *lamp, const struct ray *rays, size_t count);

/* Rays of a file, of which those of one batch are read and those of the other are used. */
struct batches {
  struct lamp *lamp;
  struct ray_file *file;
  use_rays *use;
  struct ray *rays; /* 2 * AT_A_TIME */
  size_t count[2];
  int read; /* which is read */
};

static enum result read_or_use(void *context, int tile, int worker, struct error *error) {
  struct batches *batches = context;
  int number = tile == 0 ? batches->read : !batches->read;
  struct ray *rays = batches->rays + number * AT_A_TIME;
  size_t *count = &batches->count[number], got = 1;
  (void)worker;
  if (tile == 1) {
    batches->use(batches->lamp, rays, *count);
    return RESULT_OK;
  }
  enum result result = RESULT_OK;
  for (*count = 0; result == RESULT_OK && got > 0 && *count < AT_A_TIME; *count += got)
    result = ray_file_read(batches->file, rays + *count, AT_A_TIME - *count, &got, error);
  return result;
}

static enum result use_file(struct lamp *lamp, struct ray_file *file, use_rays *use,
                            struct error *error) {
  struct batches batches = {.lamp = lamp, .file = file, .use = use};
  batches.rays = malloc(2 * AT_A_TIME * sizeof *batches.rays);
  enum result result = batches.rays ? RESULT_OK : result_no_memory(error);
  for (bool more = true; more && result == RESULT_OK; batches.read = !batches.read) {
    result = tiles_run(lamp->threads, 2, read_or_use, NULL, &batches, error);
    more = batches.count[batches.read] > 0;
  }
  free(batches.rays);
  return result;
}

static enum result read_file(struct lamp *lamp, int number, use_rays *use, struct error *error) {
  const struct import_wish *wish = lamp->wish;
  const char *path = wish->files[number];
  struct ray_file file;
  struct warnings notes = {0};
  enum result result = ray_file_open(path, lamp->format, unit_of(wish), &notes, &file, error);
  if (result != RESULT_OK) return result;
  double before = ray_luminance(lamp->look.flux);
  if (number == 0) lamp->lumens = file.lumens;
  lamp->coloured |= file.coloured;
  if (file.lumens != lamp->lumens)
    result = result_fail(error, RESULT_BAD,
                         "%s: its flux is in another unit than that of %s: import them one by one",
                         path, wish->files[0]);
  if (result == RESULT_OK) result = use_file(lamp, &file, use, error);
  double flux = ray_luminance(lamp->look.flux) - before;
  if (result == RESULT_OK && flux > 0 && fabs(file.stated / flux - 1) > 0.01)
    warnings_add(&notes,
                 "its rays carry %.6g %s, its header says %.6g: the rays count (--lumens X "
                 "rescales them)",
                 flux, file.lumens ? "lm" : "W", file.stated);
  ray_file_close(&file);
  for (int k = 0; k < warnings_kept(&notes); ++k)
    warnings_add(wish->notes, "%s%s%s", number ? path : "", number ? ": " : "", notes.lines[k]);
  return result;
}

static enum result read_files(struct lamp *lamp, use_rays *use, struct error *error) {
  enum result result = RESULT_OK;
  for (int n = 0; n < lamp->wish->file_count && result == RESULT_OK; ++n)
    result = read_file(lamp, n, use, error);
  return result;
}

/* ---- Step 1 ---- */

static void look_at(struct lamp *lamp, const struct ray *rays, size_t count) {
  lamp->read += count;
  ray_look_add(&lamp->look, rays, count);
}

static enum result look(struct lamp *lamp, struct error *error) {
  const struct import_wish *wish = lamp->wish;
  enum result result = ray_look_new(&lamp->look, KEPT, error);
  if (result == RESULT_OK) result = read_files(lamp, look_at, error);
  double flux = ray_luminance(lamp->look.flux);
  if (result == RESULT_OK && !(flux > 0))
    result = result_fail(error, RESULT_BAD, "%s: %s", wish->files[0],
                         lamp->read ? "has no rays that carry flux" : "has no rays, only comments");
  if (wish->lumens > 0) lamp->factor = wish->lumens / flux;
  return result;
}

/* ---- Step 2 ---- */

/* What is made wider than the rays say, since a slab has a size and a window. */
static void tell_widened(const struct lamp *lamp) {
  const struct ray_look *look = &lamp->look;
  bool point = true;
  for (int c = 0; c < 3; ++c) point &= look->low[c] == look->high[c];
  if (point && lamp->wish->aperture_count == 0)
    warnings_add(lamp->wish->notes, "its rays start at one point: the page there is %g m wide",
                 2 * lamp->pages.page[0].half[0]);
  for (int n = 0; n < lamp->pages.count; ++n) {
    const double *window = lamp->pages.page[n].geometry.st_window;
    for (int k = 0; k < 4; k += 2)
      if (window[k + 1] - window[k] < 1.01 * RAY_LAY_LEAST_WINDOW) {
        warnings_add(lamp->wish->notes,
                     "page %d: its rays are parallel: they are spread over slopes of +-%.2g", n + 1,
                     (window[k + 1] - window[k]) / 2);
        break;
      }
  }
}

static enum result lay_pages(struct lamp *lamp, struct error *error) {
  const struct import_wish *wish = lamp->wish;
  enum result result = RESULT_OK;
  for (int n = 0; n < wish->aperture_count && result == RESULT_OK; ++n) {
    const struct import_aperture *aperture = &wish->apertures[n];
    double scaled[3][3];
    for (int c = 0; c < 3; ++c) {
      scaled[0][c] = aperture->center[c] * unit_of(wish);
      scaled[1][c] = aperture->u[c] * unit_of(wish);
      scaled[2][c] = aperture->v[c] * unit_of(wish);
    }
    result = ray_pages_add(&lamp->pages, scaled[0], scaled[1], scaled[2], aperture->normal, error);
  }
  if (result == RESULT_OK && wish->aperture_count == 0)
    result = (wish->box ? ray_lay_box : ray_lay_best)(&lamp->look, &lamp->pages, error);
  if (result == RESULT_OK) result = ray_lay_windows(&lamp->look, &lamp->pages, error);
  if (result == RESULT_OK) tell_widened(lamp);
  for (int n = 0; n < lamp->pages.count && result == RESULT_OK; ++n) {
    struct slab *page = &lamp->pages.page[n].geometry;
    for (int k = 0; k < 2; ++k) {
      page->samples[SLAB_U + k] = wish->uv[k] ? wish->uv[k] : DEFAULT_UV;
      page->samples[SLAB_S + k] = wish->st[k] ? wish->st[k] : DEFAULT_ST;
    }
    snprintf(page->radiance_unit, sizeof page->radiance_unit, "%s",
             in_lumens(lamp) ? "cd/m2" : "W/(sr m2)");
    result = ray_estimate_new(page,
                              &(struct ray_estimate_wish){.coloured = lamp->coloured,
                                                          .tolerance = wish->tolerance,
                                                          .uv_given = wish->uv[0] > 0,
                                                          .st_given = wish->st[0] > 0,
                                                          .threads = lamp->threads},
                              &lamp->estimates[n], error);
  }
  return result_at(result, error, "%s", wish->files[0]);
}

/* ---- Step 3 ---- */

/* A ray on its page. */
struct place {
  int page; /* -1: it reaches none */
  double abst[SLAB_AXES];
};

static void add(struct lamp *lamp, const struct ray *ray, const struct place *place) {
  double luminance = lamp->factor * ray_luminance(ray->flux), flux[3];
  if (!(luminance > 0)) return;
  for (int c = 0; c < 3; ++c) flux[c] = lamp->factor * ray->flux[c];
  if (place->page < 0) {
    ++lamp->missed;
    lamp->missed_flux += luminance;
  } else if (!ray_estimate_add(lamp->estimates[place->page], place->abst, flux)) {
    ++lamp->beyond;
    lamp->beyond_flux += luminance;
  }
}

static void carry(struct lamp *lamp, const struct ray *rays, size_t count) {
  enum { AHEAD = 64 };
  struct place places[AHEAD];
  for (size_t first = 0; first < count; first += AHEAD) {
    size_t some = count - first < AHEAD ? count - first : AHEAD;
    for (size_t n = 0; n < some; ++n) {
      places[n].page = ray_pages_find(&lamp->pages, &rays[first + n], places[n].abst);
      if (places[n].page >= 0) ray_estimate_expect(lamp->estimates[places[n].page], places[n].abst);
    }
    for (size_t n = 0; n < some; ++n) add(lamp, &rays[first + n], &places[n]);
  }
}

static void tell_missed(const struct lamp *lamp) {
  const struct import_wish *wish = lamp->wish;
  const char *unit = in_lumens(lamp) ? "lm" : "W";
  double all = lamp->factor * ray_luminance(lamp->look.flux);
  if (lamp->missed > 0)
    warnings_add(wish->notes, "%llu of %llu rays, with %.4g %s (%.3g %%), reach no page%s",
                 lamp->missed, lamp->look.rays, lamp->missed_flux, unit,
                 100 * lamp->missed_flux / all,
                 wish->box || lamp->missed_flux < 0.02 * all ? "" : "; --box has pages all round");
  if (lamp->beyond > 0)
    warnings_add(
        wish->notes, "%llu of %llu rays, with %.4g %s (%.3g %%), leave outside the pages' windows",
        lamp->beyond, lamp->look.rays, lamp->beyond_flux, unit, 100 * lamp->beyond_flux / all);
}

/* ---- Step 4 ---- */

/* What the pages say of their errors, together. */
struct told {
  double squares, error, irradiance, held_out, samples, sample_error, flux, flux_error;
};

static void add_told(struct told *sum, const struct ray_estimate_told *page,
                     const struct slab *slab) {
  double samples = (double)slab_sample_count(slab), flux = ray_luminance(page->flux);
  sum->squares += page->square;
  sum->error += page->square * page->noise * page->noise;
  sum->irradiance = fmax(sum->irradiance, page->irradiance);
  sum->held_out += page->square * page->held_out * page->held_out;
  sum->samples += samples;
  sum->sample_error += samples * page->sample_noise * page->sample_noise;
  sum->flux += flux;
  sum->flux_error += page->flux_noise * flux * page->flux_noise * flux;
}

static void tell_story(const struct lamp *lamp, const struct told *told,
                       struct import_story *story) {
  double held_out = sqrt(told->held_out / told->squares);
  story->flux_in = lamp->factor * ray_luminance(lamp->look.flux);
  story->flux_out = told->flux;
  story->missed = (lamp->missed_flux + lamp->beyond_flux) / story->flux_in;
  story->error = sqrt(told->error / told->squares);
  story->sample_error = sqrt(told->sample_error / told->samples);
  story->flux_error = sqrt(told->flux_error) / told->flux;
  snprintf(story->assumptions, sizeof story->assumptions,
           "Rays keep their radiance along their lines, on which they were carried to the pages; "
           "axes are those of the file%s.",
           lamp->format == &ray_format_text
               ? ""
               : ", which are right-handed: here the lamp is its mirror image");
  char held[64] = "", irradiance[120] = "";
  if (isfinite(held_out)) snprintf(held, sizeof held, "; rays held out show %.3g of it", held_out);
  if (told->irradiance > 0)
    snprintf(irradiance, sizeof irradiance,
             "; irradiance errs by %.2g, blur included, at %d apertures and beyond",
             told->irradiance, RAY_ESTIMATE_APERTURES);
  snprintf(story->error_is, sizeof story->error_is,
           "RMS error of the samples, as means over their cells, over that of the samples (noise "
           "without blur)%s%s.",
           held, irradiance);
}

static void tell_tolerance(const struct lamp *lamp, int page,
                           const struct ray_estimate_told *told) {
  const struct import_wish *wish = lamp->wish;
  if (told->irradiance > wish->tolerance && wish->tolerance > 0)
    warnings_add(wish->notes,
                 "page %d: %dx%d x %dx%d samples err by %.2g of irradiance, more than --tolerance "
                 "%g: more need more rays, or --uv and --st",
                 page + 1, told->samples[SLAB_U], told->samples[SLAB_V], told->samples[SLAB_S],
                 told->samples[SLAB_T], told->irradiance, wish->tolerance);
}

static enum result finish(struct lamp *lamp, struct import_light *light, struct error *error) {
  struct told told = {0};
  enum result result = RESULT_OK;
  light->slabs = calloc((size_t)lamp->pages.count, sizeof *light->slabs);
  if (!light->slabs) return result_no_memory(error);
  for (int n = 0; n < lamp->pages.count && result == RESULT_OK; ++n) {
    struct ray_estimate_told page;
    ray_estimate_whole(lamp->estimates[n], lamp->factor * ray_luminance(lamp->look.flux));
    result = ray_estimate_finish(lamp->estimates[n], &light->slabs[n], &page, error);
    if (result != RESULT_OK) break;
    ++light->count;
    add_told(&told, &page, &light->slabs[n]);
    tell_tolerance(lamp, n, &page);
    ray_estimate_free(lamp->estimates[n]);
    lamp->estimates[n] = NULL;
  }
  if (result == RESULT_OK) tell_story(lamp, &told, &light->story);
  return result_at(result, error, "%s", lamp->wish->files[0]);
}

static enum result import(const struct import_wish *wish, const struct ray_format *format,
                          struct import_light *light, struct error *error) {
  struct lamp lamp = {.wish = wish, .format = format, .factor = 1, .threads = tiles_processors()};
  enum result result = look(&lamp, error);
  if (result == RESULT_OK) result = lay_pages(&lamp, error);
  if (result == RESULT_OK) result = read_files(&lamp, carry, error);
  if (result == RESULT_OK) tell_missed(&lamp);
  if (result == RESULT_OK) result = finish(&lamp, light, error);
  for (int n = 0; n < lamp.pages.count; ++n) ray_estimate_free(lamp.estimates[n]);
  ray_look_free(&lamp.look);
  return result;
}

/* ---- The kinds ---- */

static bool is_tm25(const char *head, size_t size, const char *path) {
  (void)path;
  return ray_format_tm25.is(head, size);
}

static bool is_zemax(const char *head, size_t size, const char *path) {
  (void)path;
  return ray_format_zemax.is(head, size);
}

static bool is_ray_text(const char *head, size_t size, const char *path) {
  (void)path;
  return ray_format_text.is(head, size);
}

static enum result tm25_slabs(const struct import_wish *wish, struct import_light *light,
                              struct error *error) {
  return import(wish, &ray_format_tm25, light, error);
}

static enum result zemax_slabs(const struct import_wish *wish, struct import_light *light,
                               struct error *error) {
  return import(wish, &ray_format_zemax, light, error);
}

static enum result ray_text_slabs(const struct import_wish *wish, struct import_light *light,
                                  struct error *error) {
  return import(wish, &ray_format_text, light, error);
}

const struct import_kind import_tm25 = {"tm25", is_tm25, IMPORT_RAYS, tm25_slabs};
const struct import_kind import_zemax = {"zemax", is_zemax, IMPORT_RAYS, zemax_slabs};
const struct import_kind import_ray_text = {"ray text", is_ray_text, IMPORT_RAYS, ray_text_slabs};
