/* tradeoff.c - repeats are interleaved: the whole ladder once, then again, so
 * that whatever else the machine does meets all methods alike. */
#include "tradeoff/tradeoff.h"

#include <malloc.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/progress.h"
#include "microlight/levels.h"

const double tradeoff_truth = 1e-6;

/* A measurement is repeated until it took so long: clocks and caches need it. */
static const double shortest = 0.02;
/* What took longer is not repeated. */
static const double longest = 1;
/* Darker than this share of the mean, a pixel's error is relative to that. */
static const double dark = 0.01;

enum { TILE = 8, TOGETHER = TILE * TILE, MOST_RUNS = 100 };

struct bench {
  const struct tradeoff_settings *settings;
  struct tradeoff *tradeoff;
  struct shade_hit *hits;     /* of the lit pixels, tile by tile */
  struct receiver *receivers; /* theirs */
  size_t count;
  size_t *first; /* [tiles + 1]: each tile's in hits */
  int tiles;
  struct gathered *gathered, *truth; /* [count] */
  struct gathered *same;             /* [count]: the reference with the usual shadows */
  struct gather **gather;            /* [threads] */
  double done, share;                /* progress: before this run, of this run */
};

static double clock_of(clockid_t clock) {
  struct timespec time;
  clock_gettime(clock, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* ---- What the camera sees ---- */

static void trace_tile(struct bench *bench, int left, int top) {
  const struct shade *shade = &bench->settings->shade;
  for (int pixel = 0; pixel < TOGETHER; ++pixel) {
    int x = left + pixel % TILE, y = top + pixel / TILE;
    if (x >= shade->width || y >= shade->height) continue;
    struct shade_hit *hit = &bench->hits[bench->count];
    shade_ray(shade, x + 0.5, y + 0.5, (uint64_t)y * (uint64_t)shade->width + (uint64_t)x, hit);
    if (hit->lit) bench->receivers[bench->count++] = hit->receiver;
  }
}

static enum result trace(struct bench *bench, struct error *error) {
  const struct tradeoff_settings *settings = bench->settings;
  int width = settings->shade.width, height = settings->shade.height;
  int columns = (width + TILE - 1) / TILE, rows = (height + TILE - 1) / TILE;
  size_t pixels = (size_t)width * (size_t)height;
  bench->tiles = columns * rows;
  bench->hits = calloc(pixels + 1, sizeof *bench->hits); /* one to try */
  bench->receivers = calloc(pixels, sizeof *bench->receivers);
  bench->first = calloc((size_t)bench->tiles + 1, sizeof *bench->first);
  bench->gathered = calloc(pixels, sizeof *bench->gathered);
  bench->truth = calloc(pixels, sizeof *bench->truth);
  bench->same = calloc(pixels, sizeof *bench->same);
  bench->gather = calloc((size_t)settings->threads, sizeof *bench->gather);
  if (!bench->hits || !bench->receivers || !bench->first || !bench->gathered || !bench->truth ||
      !bench->same || !bench->gather)
    return result_fail(error, RESULT_MEMORY, "out of memory for a picture of %dx%d", width, height);
  for (int tile = 0; tile < bench->tiles; ++tile) {
    bench->first[tile] = bench->count;
    trace_tile(bench, tile % columns * TILE, tile / columns * TILE);
  }
  bench->first[bench->tiles] = bench->count;
  bench->tradeoff->receivers = bench->count;
  return RESULT_OK;
}

/* ---- Gathering ---- */

static enum result do_tile(void *context, int tile, int worker, struct error *error) {
  struct bench *bench = context;
  size_t first = bench->first[tile];
  int count = (int)(bench->first[tile + 1] - first);
  return gather_light(bench->gather[worker], &bench->receivers[first], count,
                      &bench->gathered[first], error);
}

static void show_progress(void *context, double done) {
  const struct bench *bench = context;
  const struct tradeoff_settings *settings = bench->settings;
  if (settings->progress)
    settings->progress(settings->progress_context, bench->done + done * bench->share);
}

/* All receivers once; adds to the times. */
static enum result gather_once(struct bench *bench, const struct gather_settings *gather,
                               struct gather_counts *counts, double *cpu, double *wall,
                               struct error *error) {
  int threads = bench->settings->threads;
  enum result result = gather_create_all(gather, threads, bench->gather, error);
  double start = progress_now(), start_cpu = clock_of(CLOCK_PROCESS_CPUTIME_ID);
  if (result == RESULT_OK)
    result = tiles_run(threads, bench->tiles, do_tile, show_progress, bench, error);
  *wall += progress_now() - start;
  *cpu += clock_of(CLOCK_PROCESS_CPUTIME_ID) - start_cpu;
  memset(counts, 0, sizeof *counts);
  gather_free_all(bench->gather, threads, counts);
  return result;
}

/* ---- Errors ---- */

/* What the pixel's surface makes of it. */
static double shown(const struct shade_hit *hit, const struct gathered *gathered, int c) {
  return hit->diffuse[c] * gathered->irradiance[c] + hit->specular[c] * gathered->gloss[c];
}

static double length_of(const struct shade_hit *hit, const struct gathered *gathered) {
  double square = 0;
  for (int c = 0; c < 3; ++c) square += shown(hit, gathered, c) * shown(hit, gathered, c);
  return sqrt(square);
}

static struct tradeoff_error compare(const struct bench *bench, const struct gathered *truth) {
  double wrong = 0, all = 0, mean = 0, most = 0;
  for (size_t k = 0; k < bench->count; ++k)
    mean += length_of(&bench->hits[k], &truth[k]) / (double)bench->count;
  for (size_t k = 0; k < bench->count; ++k) {
    const struct shade_hit *hit = &bench->hits[k];
    double square = 0, light = length_of(hit, &truth[k]);
    for (int c = 0; c < 3; ++c) {
      double off = shown(hit, &bench->gathered[k], c) - shown(hit, &truth[k], c);
      square += off * off;
    }
    wrong += square;
    all += light * light;
    most = fmax(most, sqrt(square) / fmax(light, dark * mean));
  }
  return (struct tradeoff_error){sqrt(wrong / all), most};
}

static bool anything_lit(const struct bench *bench) {
  for (size_t k = 0; k < bench->count; ++k)
    if (length_of(&bench->hits[k], &bench->truth[k]) > 0) return true;
  return false;
}

/* The reference, with the usual shadows and with finer ones. */
static enum result find_truth(struct bench *bench, struct error *error) {
  struct gather_settings gather = bench->settings->gather;
  struct gathered *const results[] = {bench->same, bench->truth};
  double *cpu = &bench->tradeoff->truth_cpu;
  enum result result = RESULT_OK;
  gather.method = GATHER_REFERENCE;
  gather.tolerance = tradeoff_truth;
  gather.all_effects = true;
  gather.prepared = &bench->tradeoff->prepared[GATHER_REFERENCE].prepared;
  for (int k = 0; k < 2 && result == RESULT_OK; ++k) {
    struct gather_counts counts;
    double wall = 0;
    if (k == 0 || gather.occlusion) {
      *cpu = 0;
      result = gather_once(bench, &gather, &counts, cpu, &wall, error);
    }
    memcpy(results[k], bench->gathered, bench->count * sizeof *results[k]);
    gather.shadow_edge *= TRADEOFF_FINER_SHADOWS;
  }
  if (result == RESULT_OK && !anything_lit(bench))
    result =
        result_fail(error, RESULT_BAD, "no light reaches what the camera sees; move one of them");
  return result;
}

/* ---- The ladder ---- */

static size_t memory_used(void) {
  struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

static enum result prepare_method(struct bench *bench, enum gather_method method,
                                  struct error *error) {
  const struct tradeoff_settings *settings = bench->settings;
  struct tradeoff_prepared *made = &bench->tradeoff->prepared[method];
  size_t before = memory_used();
  double start = clock_of(CLOCK_PROCESS_CPUTIME_ID);
  enum result result = gather_prepare(settings->gather.lights, settings->gather.light_count, method,
                                      UINT64_MAX, settings->threads, &made->prepared, error);
  if (result != RESULT_OK) return result;
  size_t after = memory_used();
  made->cpu = clock_of(CLOCK_PROCESS_CPUTIME_ID) - start;
  made->bytes = after > before ? after - before : 0;
  made->made = true;
  return RESULT_OK;
}

static int most_levels(const struct tradeoff *tradeoff) {
  int most = 0;
  for (int k = 0; k < GATHER_METHODS; ++k) {
    const struct gather_prepared *prepared = &tradeoff->prepared[k].prepared;
    for (int page = 0; prepared->levels && page < prepared->pages; ++page)
      if (prepared->levels[page].count > most) most = prepared->levels[page].count;
  }
  return most;
}

static enum result prepare(struct bench *bench, struct error *error) {
  const struct tradeoff_settings *settings = bench->settings;
  struct tradeoff *tradeoff = bench->tradeoff;
  enum result result = prepare_method(bench, GATHER_REFERENCE, error);
  for (int k = 0; k < GATHER_METHODS && result == RESULT_OK; ++k)
    if (settings->methods[k] && !tradeoff->prepared[k].made)
      result = prepare_method(bench, (enum gather_method)k, error);
  if (result != RESULT_OK) return result;
  tradeoff->rungs = calloc(TRADEOFF_MOST_RUNGS, sizeof *tradeoff->rungs);
  if (!tradeoff->rungs) return result_no_memory(error);
  int levels = most_levels(tradeoff);
  if (settings->levels >= 0 && settings->levels < levels) levels = settings->levels;
  tradeoff->count = tradeoff_ladder(settings, levels, tradeoff->rungs);
  if (tradeoff->count == 0)
    return result_fail(error, RESULT_BAD,
                       "no method to measure: closed needs --no-shadows and matte materials");
  return RESULT_OK;
}

static bool wanted(const struct tradeoff_rung *rung) {
  return !rung->refused && (rung->repeats == 0 || rung->cpus[0] < longest);
}

static enum result measure(struct bench *bench, struct tradeoff_rung *rung, struct error *error) {
  struct tradeoff *tradeoff = bench->tradeoff;
  struct gather_settings gather = bench->settings->gather;
  double cpu = 0, wall = 0;
  int runs = 0;
  gather.method = rung->method;
  gather.shadow_grid = rung->shadow_grid;
  gather.shadow_edge = rung->shadow_edge;
  gather.tolerance = rung->tolerance > 0 ? rung->tolerance : tradeoff_truth;
  gather.level = rung->level;
  gather.prepared = &tradeoff->prepared[rung->method].prepared;
  while (runs < 1 || (cpu < shortest && runs < MOST_RUNS)) {
    enum result result = gather_once(bench, &gather, &rung->counts, &cpu, &wall, error);
    if (result == RESULT_BAD) { /* it is left out, and the table says why */
      char *reason = tradeoff->refusal[rung->method];
      snprintf(reason, sizeof tradeoff->refusal[0], "%.199s", error->text);
      rung->refused = true;
      return RESULT_OK;
    }
    if (result != RESULT_OK) return result;
    ++runs;
  }
  rung->error = compare(bench, bench->truth);
  rung->sum = compare(bench, bench->same);
  rung->cpus[rung->repeats] = cpu / runs;
  rung->walls[rung->repeats++] = wall / runs;
  return RESULT_OK;
}

/* What all rungs that are repeated took at first. */
static double total_time(const struct tradeoff *tradeoff) {
  double sum = 0;
  for (int k = 0; k < tradeoff->count; ++k)
    if (wanted(&tradeoff->rungs[k])) sum += tradeoff->rungs[k].walls[0];
  return sum > 0 ? sum : 1;
}

/* In the first repeat nothing is known of the rungs' times, so they count alike. */
static enum result climb(struct bench *bench, struct error *error) {
  struct tradeoff *tradeoff = bench->tradeoff;
  int repeats = bench->settings->repeats;
  enum result result = RESULT_OK;
  for (int repeat = 0; repeat < repeats && result == RESULT_OK; ++repeat) {
    double part = 0, all = repeat ? total_time(tradeoff) : tradeoff->count;
    for (int k = 0; k < tradeoff->count && result == RESULT_OK; ++k) {
      struct tradeoff_rung *rung = &tradeoff->rungs[k];
      double share = !repeat ? 1 : wanted(rung) ? rung->walls[0] : 0;
      bench->done = (repeat + part / all) / repeats;
      bench->share = share / all / repeats;
      part += share;
      if (wanted(rung)) result = measure(bench, rung, error);
    }
  }
  return result;
}

static int by_size(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

static struct tradeoff_spread spread(const double *values, int count) {
  if (count == 0) return (struct tradeoff_spread){0};
  double sorted[TRADEOFF_MOST_REPEATS];
  memcpy(sorted, values, (size_t)count * sizeof *sorted);
  qsort(sorted, (size_t)count, sizeof *sorted, by_size);
  return (struct tradeoff_spread){sorted[(count - 1) / 2], sorted[0], sorted[count - 1]};
}

enum result tradeoff_measure(const struct tradeoff_settings *settings, struct tradeoff *tradeoff,
                             struct error *error) {
  struct bench bench = {.settings = settings, .tradeoff = tradeoff};
  *tradeoff = (struct tradeoff){0};
  enum result result = trace(&bench, error);
  if (result == RESULT_OK) result = prepare(&bench, error);
  if (result == RESULT_OK) result = find_truth(&bench, error);
  if (result == RESULT_OK) result = climb(&bench, error);
  for (int k = 0; k < tradeoff->count && result == RESULT_OK; ++k) {
    struct tradeoff_rung *rung = &tradeoff->rungs[k];
    rung->cpu = spread(rung->cpus, rung->repeats);
    rung->wall = spread(rung->walls, rung->repeats);
  }
  free(bench.hits);
  free(bench.receivers);
  free(bench.first);
  free(bench.gathered);
  free(bench.truth);
  free(bench.same);
  free(bench.gather);
  return result;
}

void tradeoff_free(struct tradeoff *tradeoff) {
  for (int k = 0; k < GATHER_METHODS; ++k) gather_prepared_free(&tradeoff->prepared[k].prepared);
  free(tradeoff->rungs);
  *tradeoff = (struct tradeoff){0};
}
