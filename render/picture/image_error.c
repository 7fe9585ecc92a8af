/* image_error.c - the error of a picture, from a sample of its pixels.
 *
 * 1. Look at pixels of a regular grid, at most CANDIDATES of them; those that show a surface are
 *    kept.
 * 2. Of these take PIXELS, half of them evenly and half by how bright the lamps make them
 *    (systematic sampling with unequal probabilities: W. G. Madow, Annals of Mathematical
 *    Statistics 20, 1949). Sums over all candidates are estimated by the inverse of the
 *    probabilities (D. G. Horvitz and D. J. Thompson, Journal of the American Statistical
 *    Association 47, 1952).
 * 3. Gather their light by the method `reference`: E. What the picture differs by is the error of
 *    its sum.
 * 4. Once more with edges of shadows looked at EDGE times as finely: what changes is the error of
 *    the shadows.
 * 5. Once more by copies of the slabs (slab_variant.h): with the noise once more, rounded once
 *    more, and with s and t (u and v) halved once, E2, and twice, E4. What is left of the error by
 *    resolution in E is (E2 - E) / (r - 1) at each receiver, where r is the RMS of E4 - E2 over
 *    that of E2 - E, within bounds: Richardson extrapolation as in slab_accuracy.c, whose bounds
 *    these are. Errors by st and by uv add up, since both blur.
 * 6. The parts are added in quadrature: they have nothing to do with each other. */
#include "picture/image_error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_json.h"
#include "light/light_variant.h"
#include "shadow/visible.h"

enum { CANDIDATES = 4096, PIXELS = 256, PIECE = 8, EDGE = 4 };
static const double tolerance = 1e-4; /* of the method reference */

struct rgb {
  double of[3];
};

struct looked {
  struct shade_hit hit;
  struct rgb light; /* of the lamps, in the picture */
  double weight;    /* of its squares in sums over all pixels; 0: not taken */
};

/* What one gathering finds. */
struct gathering {
  const struct looked *pixels;
  int count;
  struct gather **gathers; /* [threads] */
  struct rgb *out;         /* [count] */
};

struct estimate {
  const struct image_settings *settings;
  const struct picture *picture;
  bool sharpened;        /* a slab is, along s and t */
  double shared;         /* the largest noise that all samples of a slab share, relative */
  struct looked *pixels; /* owned */
  int count;
  double mean;          /* of the lamps' light over all candidates, and all channels */
  struct rgb *light[4]; /* [count] each; owned: E, E2, E4, and the sum of errors by resolution */
};

/* ---- 1. and 2. ---- */

static double brightness(const struct rgb *light) {
  return (light->of[0] + light->of[1] + light->of[2]) / 3;
}

static void look(struct estimate *estimate, int x, int y) {
  const struct shade *shade = &estimate->settings->shade;
  struct looked *looked = &estimate->pixels[estimate->count];
  size_t pixel = (size_t)y * (size_t)shade->width + (size_t)x;
  shade_ray(shade, x + 0.5, y + 0.5, pixel, &looked->hit);
  if (!looked->hit.lit) return;
  for (size_t c = 0; c < 3; ++c) {
    double light = (double)estimate->picture->rgb[3 * pixel + c] - looked->hit.shows[c];
    looked->light.of[c] = light;
  }
  ++estimate->count;
}

/* Takes pixels; the others go. */
static void take(struct estimate *estimate) {
  int count = estimate->count, taken = 0;
  double sum = 0, passed = 0;
  for (int k = 0; k < count; ++k) sum += fmax(brightness(&estimate->pixels[k].light), 0);
  estimate->mean = count > 0 ? sum / count : 0;
  for (int k = 0; k < count; ++k) {
    struct looked *looked = &estimate->pixels[k];
    double share = 1.0 / count;
    if (sum > 0) share = (share + fmax(brightness(&looked->light), 0) / sum) / 2;
    double expected = count > PIXELS ? PIXELS * share : 1;
    double times = floor(passed + expected + 0.5) - floor(passed + 0.5);
    passed += expected;
    if (!(times > 0)) continue;
    looked->weight = times / (expected * count);
    estimate->pixels[taken++] = *looked;
  }
  estimate->count = taken;
}

static enum result choose_pixels(struct estimate *estimate, struct error *error) {
  int width = estimate->picture->width, height = estimate->picture->height;
  int step = (int)ceil(sqrt((double)width * height / CANDIDATES));
  int columns = (width + step / 2) / step + 1, rows = (height + step / 2) / step + 1;
  estimate->pixels = calloc((size_t)columns * (size_t)rows, sizeof *estimate->pixels);
  if (!estimate->pixels) return result_no_memory(error);
  for (int y = step / 2; y < height; y += step)
    for (int x = step / 2; x < width; x += step) look(estimate, x, y);
  take(estimate);
  return RESULT_OK;
}

/* ---- Gathering ---- */

static enum result gather_piece(void *context, int piece, int worker, struct error *error) {
  const struct gathering *all = context;
  enum result result = RESULT_OK;
  for (int k = PIECE * piece; k < PIECE * (piece + 1) && k < all->count; ++k) {
    const struct shade_hit *hit = &all->pixels[k].hit;
    struct gathered gathered;
    double ignored[3];
    result = gather_light(all->gathers[worker], &hit->receiver, 1, &gathered, error);
    if (result != RESULT_OK) break;
    shade_radiance(hit, &gathered, all->out[k].of, ignored);
    for (int c = 0; c < 3; ++c) all->out[k].of[c] -= hit->shows[c];
  }
  return result;
}

/* What the pixels gather from these lights. */
static enum result gather_all(const struct estimate *estimate, const struct gather_settings *gather,
                              struct rgb *out, struct error *error) {
  int threads = estimate->settings->threads;
  struct gather_counts counts = {0};
  struct gathering all = {estimate->pixels, estimate->count,
                          calloc((size_t)threads, sizeof *all.gathers), out};
  if (!all.gathers) return result_no_memory(error);
  enum result result = gather_create_all(gather, threads, all.gathers, error);
  if (result == RESULT_OK)
    result =
        tiles_run(threads, (estimate->count + PIECE - 1) / PIECE, gather_piece, NULL, &all, error);
  gather_free_all(all.gathers, threads, &counts);
  free(all.gathers);
  return result;
}

static struct gather_settings reference(const struct estimate *estimate) {
  struct gather_settings gather = estimate->settings->gather;
  gather.method = GATHER_REFERENCE;
  gather.tolerance = tolerance;
  gather.prepared = NULL;
  return gather;
}

/* The same by copies of the lights; *lack: pages of which there is none. */
static enum result gather_variant(const struct estimate *estimate, enum slab_variant which,
                                  struct rgb *out, int *lack, struct error *error) {
  struct gather_settings gather = reference(estimate);
  struct light *copies = NULL;
  enum result result =
      light_variant_make(gather.lights, gather.light_count, which, &copies, lack, error);
  if (result != RESULT_OK) return result;
  gather.lights = copies;
  result = gather_all(estimate, &gather, out, error);
  light_variant_free(copies, gather.light_count);
  return result;
}

/* RMS of what two differ by, over the mean. */
static double differ(const struct estimate *estimate, const struct rgb *a, const struct rgb *b) {
  double sum = 0;
  for (int k = 0; k < estimate->count; ++k)
    for (int c = 0; c < 3; ++c) {
      double off = a[k].of[c] - b[k].of[c];
      sum += estimate->pixels[k].weight * off * off;
    }
  return sqrt(sum / 3) / estimate->mean;
}

/* ---- 3. and 4. ---- */

/* What the picture differs by from E; of pixels that are means over several rays, their middle. */
static enum result find_sum(const struct estimate *estimate, double *told, struct error *error) {
  const struct image_settings *settings = estimate->settings;
  struct rgb *out = estimate->light[1];
  enum result result = RESULT_OK;
  if (settings->samples > 1 && (settings->gl || settings->until)) return RESULT_OK;
  for (int k = 0; k < estimate->count; ++k) out[k] = estimate->pixels[k].light;
  if (settings->samples > 1) result = gather_all(estimate, &settings->gather, out, error);
  *told = differ(estimate, out, estimate->light[0]);
  return result;
}

static enum result find_shadows(const struct estimate *estimate, double *told,
                                struct error *error) {
  struct gather_settings gather = reference(estimate);
  if (!gather.occlusion) {
    *told = 0;
    return RESULT_OK;
  }
  gather.shadow_grid *= 2;
  gather.shadow_edge *= EDGE;
  if (gather.shadow_edge > VISIBLE_MOST_EDGE) gather.shadow_edge = VISIBLE_MOST_EDGE;
  if (gather.shadow_grid > gather.shadow_edge) gather.shadow_grid = gather.shadow_edge;
  enum result result = gather_all(estimate, &gather, estimate->light[1], error);
  *told = differ(estimate, estimate->light[1], estimate->light[0]);
  return result;
}

/* ---- 5. ---- */

static enum result find_by(const struct estimate *estimate, enum slab_variant which, double *told,
                           struct error *error) {
  int lack = 0;
  enum result result = gather_variant(estimate, which, estimate->light[1], &lack, error);
  if (result != RESULT_OK) return result;
  double off = differ(estimate, estimate->light[1], estimate->light[0]);
  if (which == SLAB_NOISY) {
    memset(estimate->light[1], 0, (size_t)estimate->count * sizeof *estimate->light[1]);
    off = hypot(off, estimate->shared * differ(estimate, estimate->light[0], estimate->light[1]));
  }
  *told = which == SLAB_NOISY && lack > 0 ? NAN : off;
  return RESULT_OK;
}

/* Adds the error that halving s and t, or u and v, tells to light[3]; *lack as above. */
static enum result extrapolate(const struct estimate *estimate, enum slab_variant first, int *lack,
                               struct error *error) {
  struct rgb *const *light = estimate->light;
  int lacks[2] = {0, 0};
  enum result result = gather_variant(estimate, first, light[1], &lacks[0], error);
  if (result == RESULT_OK) result = gather_variant(estimate, first + 1, light[2], &lacks[1], error);
  if (result != RESULT_OK) return result;
  *lack += lacks[1];
  double once = differ(estimate, light[1], light[0]), twice = differ(estimate, light[2], light[1]);
  double ratio = slab_accuracy_ratio(first == SLAB_ST_2, estimate->sharpened, once, twice);
  for (int k = 0; k < estimate->count; ++k)
    for (int c = 0; c < 3; ++c)
      light[3][k].of[c] += (light[1][k].of[c] - light[0][k].of[c]) / (ratio - 1);
  return RESULT_OK;
}

static enum result find_resolution(const struct estimate *estimate, double *told,
                                   struct error *error) {
  int lack = 0;
  memset(estimate->light[3], 0, (size_t)estimate->count * sizeof *estimate->light[3]);
  enum result result = extrapolate(estimate, SLAB_ST_2, &lack, error);
  if (result == RESULT_OK) result = extrapolate(estimate, SLAB_UV_2, &lack, error);
  if (result != RESULT_OK || lack > 0) return result;
  memset(estimate->light[1], 0, (size_t)estimate->count * sizeof *estimate->light[1]);
  *told = differ(estimate, estimate->light[3], estimate->light[1]);
  return result;
}

/* ---- 6. ---- */

static double add_up(const struct image_error *told) {
  const double parts[] = {told->noise, told->resolution, told->logluv, told->sum, told->shadows};
  double sum = 0;
  for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k)
    if (!isnan(parts[k])) sum += parts[k] * parts[k];
  return sqrt(sum);
}

/* How the slabs' samples were taken. */
static enum result find_sampling(struct estimate *estimate, struct error *error) {
  const struct gather_settings *gather = &estimate->settings->gather;
  enum result result = RESULT_OK;
  for (int l = 0; l < gather->light_count; ++l)
    for (int page = 0; page < gather->lights[l].count && result == RESULT_OK; ++page) {
      struct slab_sampling sampling;
      result = slab_json_sampling(&gather->lights[l].pages[page].slab, &sampling, error);
      estimate->sharpened |= sampling.sharpened;
      if (sampling.flux_noise > estimate->shared) estimate->shared = sampling.flux_noise;
    }
  return result;
}

static enum result find_all(struct estimate *estimate, struct image_error *told,
                            struct error *error) {
  struct gather_settings gather = reference(estimate);
  enum result result = find_sampling(estimate, error);
  for (int k = 0; k < 4 && result == RESULT_OK; ++k) {
    estimate->light[k] = calloc((size_t)estimate->count, sizeof *estimate->light[k]);
    if (!estimate->light[k]) result = result_no_memory(error);
  }
  if (result == RESULT_OK) result = gather_all(estimate, &gather, estimate->light[0], error);
  if (result == RESULT_OK) result = find_sum(estimate, &told->sum, error);
  if (result == RESULT_OK) result = find_shadows(estimate, &told->shadows, error);
  if (result == RESULT_OK) result = find_by(estimate, SLAB_NOISY, &told->noise, error);
  if (result == RESULT_OK) result = find_by(estimate, SLAB_ROUNDED, &told->logluv, error);
  if (result == RESULT_OK) result = find_resolution(estimate, &told->resolution, error);
  told->all = add_up(told);
  return result;
}

enum result image_error_estimate(const struct image_settings *settings,
                                 const struct picture *picture, struct image_error *told,
                                 struct error *error) {
  struct estimate estimate = {.settings = settings, .picture = picture};
  *told = (struct image_error){NAN, NAN, NAN, NAN, NAN, NAN};
  enum result result = choose_pixels(&estimate, error);
  if (result == RESULT_OK && estimate.mean > 0) result = find_all(&estimate, told, error);
  for (int k = 0; k < 4; ++k) free(estimate.light[k]);
  free(estimate.pixels);
  return result;
}

void image_error_text(const struct image_error *told, char text[IMAGE_ERROR_TEXT]) {
  const struct {
    const char *name;
    double part;
  } parts[] = {{"noise", told->noise},
               {"resolution", told->resolution},
               {"LogLuv", told->logluv},
               {"sum", told->sum},
               {"shadows", told->shadows}};
  size_t used = 0;
  bool lacks = false;
  if (isnan(told->all)) {
    snprintf(text, IMAGE_ERROR_TEXT, "unknown: the lamps light nothing that the picture shows");
    return;
  }
  for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k) {
    char part[32] = "unknown";
    if (!isnan(parts[k].part)) snprintf(part, sizeof part, "%.2g %%", 100 * parts[k].part);
    lacks |= isnan(parts[k].part);
    used += (size_t)snprintf(text + used, IMAGE_ERROR_TEXT - used, "%s%s %s", k ? ", " : "",
                             parts[k].name, part);
  }
  snprintf(text + used, IMAGE_ERROR_TEXT - used, "; all %s%.2g %% (RMS over mean)",
           lacks ? "at least " : "", 100 * told->all);
}
