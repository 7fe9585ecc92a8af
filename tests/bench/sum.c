/* sum.c - what summing the light of visible micro lights costs, and how exact it is.
 *
 *   sum times UV ST plane|scattered REPEATS   a slab of UV x UV x ST x ST samples, in lines:
 *       visible MEAN TOGETHER ALONE    micro lights that a receiver sees; bytes of the slab for
 *                                      each that a tile of 64 receivers, or one receiver, needs
 *       error PAPER PI REFERENCE       relative RMS against the reference to 1e-9
 *       repeat PAPER PI REFERENCE READ FUSED PLAIN
 *                                      ns a micro light; GB/s of reading the slab; 1e9
 *                                      multiply-adds a second (roofline.h)
 *   sum visits                         micro lights visited against the resolution, and pi's time
 *
 * The slab: aperture 1 x 1, slopes up to 1.5, half rough and half smooth. Receivers: 64 x 64
 * on a plane 4 apertures away, tile by tile; or anywhere 0.5 to 8 apertures away. CPU time of
 * one thread. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "gather/gather.h"
#include "microlight/seen_page.h"
#include "oracle/random.h"
#include "roofline.h"

enum { SIDE = 64, TILE = 8, COUNT = SIDE * SIDE, TOGETHER = TILE * TILE, LINE = 64 };
static const double window = 1.5, far_away = 4, nearest = 0.5, farthest = 8;

static void die(const char *text) {
  fprintf(stderr, "sum: %s\n", text);
  exit(1);
}

static void hold(enum result result, const struct error *error) {
  if (result != RESULT_OK) die(error->text);
}

/* ---- A light ---- */

static void fill(struct slab *slab) {
  uint64_t seed = 1;
  size_t count = slab_sample_count(slab);
  for (size_t p = 0; p < count; ++p) {
    int at[SLAB_AXES];
    slab_locate(slab, p, at);
    double s = slab_position(slab, SLAB_S, at[SLAB_S]), t = slab_position(slab, SLAB_T, at[SLAB_T]);
    double lobe = exp(-s * s - t * t);
    for (int c = 0; c < 3; ++c) slab->rgb[3 * p + (size_t)c] = (float)(random_number(&seed) + lobe);
  }
}

static void set_axis(struct light_axis *axis, int uv, int st) {
  *axis = (struct light_axis){.near_count = uv,
                              .far_count = st,
                              .half = 0.5,
                              .near_step = 1.0 / uv,
                              .far_low = -window,
                              .far_high = window,
                              .far_step = 2 * window / st};
}

/* Along z, at the origin. */
static void make_light(int uv, int st, bool filled, struct light *light, struct light_page *page) {
  struct error error;
  *page = (struct light_page){
      .slab = slab_default(), .gain = 1, .frame = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  struct slab *slab = &page->slab;
  const int samples[SLAB_AXES] = {uv, uv, st, st};
  const double st_window[4] = {-window, window, -window, window};
  memcpy(slab->samples, samples, sizeof samples);
  memcpy(slab->st_window, st_window, sizeof st_window);
  for (int axis = 0; axis < 2; ++axis) set_axis(&page->axes[axis], uv, st);
  if (filled) hold(slab_alloc(slab, &error), &error);
  if (filled) fill(slab);
  if (filled) hold(light_page_set_samples(page, &error), &error);
  *light = (struct light){.count = 1, .pages = page, .gain = {1, 1, 1}, .scale = 1};
}

/* ---- Receivers ---- */

static void set_receiver(struct receiver *receiver, int index, const double position[3],
                         const double normal[3]) {
  *receiver = (struct receiver){.index = (uint64_t)index};
  memcpy(receiver->position, position, sizeof receiver->position);
  memcpy(receiver->normal, normal, sizeof receiver->normal);
  vector_normalise(receiver->normal);
  memcpy(receiver->lift, receiver->normal, sizeof receiver->lift);
}

static void make_plane(struct receiver receivers[COUNT]) {
  static const double facing[3] = {0, 0, -1};
  for (int k = 0; k < COUNT; ++k) {
    int tile = k / TOGETHER, x = tile % (SIDE / TILE) * TILE + k % TILE;
    int y = tile / (SIDE / TILE) * TILE + k % TOGETHER / TILE;
    double position[3] = {(x + 0.5) / SIDE - 0.5, (y + 0.5) / SIDE - 0.5, 1};
    for (int c = 0; c < 3; ++c) position[c] *= c < 2 ? 2 * far_away : far_away;
    set_receiver(&receivers[k], k, position, facing);
  }
}

/* Through a point of the aperture and a slope of the window, turned towards the lamp by
 * 60 degrees at least. */
static void make_scattered(struct receiver receivers[COUNT]) {
  uint64_t seed = 2;
  for (int k = 0; k < COUNT; ++k) {
    double z = random_log(&seed, nearest, farthest), position[3], normal[3];
    for (int c = 0; c < 2; ++c)
      position[c] = random_between(&seed, -0.5, 0.5) + z * window * random_between(&seed, -1, 1);
    position[2] = z;
    for (int c = 0; c < 3; ++c) normal[c] = -position[c] / vector_length(position);
    for (int c = 0; c < 3; ++c) normal[c] += random_between(&seed, -0.5, 0.5);
    set_receiver(&receivers[k], k, position, normal);
  }
}

/* ---- What a receiver sees ---- */

static uint64_t look(const struct light_page *page, const struct receiver *receiver,
                     struct seen_page *seen, struct strips strips[2]) {
  struct error error;
  if (!seen_page_find(page, receiver, seen)) die("a receiver behind the lamp");
  hold(seen_page_strips(seen, false, strips, &error), &error);
  return (uint64_t)strips[0].count * (uint64_t)strips[1].count;
}

/* Marks the cache lines of a receiver's samples; returns how many were not marked as `mark`. */
static uint64_t mark_lines(const struct seen_page *seen, const struct strips strips[2],
                           uint32_t *marks, uint32_t mark) {
  uint64_t fresh = 0;
  for (int r = 0; r < strips[1].count; ++r) {
    const float *rows[4];
    seen_page_rows(seen, &strips[1].strip[r].taps, rows);
    for (int c = 0; c < strips[0].count; ++c) {
      int offset[2];
      seen_page_columns(seen, &strips[0].strip[c].taps, offset);
      for (int pair = 0; pair < 8; ++pair) {
        size_t from = (size_t)(rows[pair / 2] - seen->page->slab.rgb + offset[pair % 2]);
        size_t last = (from + 5) * sizeof(float) / LINE;
        for (size_t line = from * sizeof(float) / LINE; line <= last; ++line) {
          fresh += marks[line] != mark;
          marks[line] = mark;
        }
      }
    }
  }
  return fresh;
}

static void print_visible(const struct light_page *page, const struct receiver receivers[COUNT]) {
  struct seen_page seen;
  struct strips strips[2] = {{0}};
  size_t lines = (slab_sample_count(&page->slab) * 3 + SLAB_PADDING) * sizeof(float) / LINE + 1;
  uint32_t *marks = calloc(lines, sizeof *marks), mark = 0;
  if (!marks) die("out of memory");
  uint64_t visible = 0, fresh[2] = {0}; /* by tile, alone */
  for (int alone = 0; alone < 2; ++alone)
    for (int k = 0; k < COUNT; ++k) {
      mark += alone || k % TOGETHER == 0;
      uint64_t count = look(page, &receivers[k], &seen, strips);
      if (!alone) visible += count;
      fresh[alone] += mark_lines(&seen, strips, marks, mark);
    }
  printf("visible %.1f %.2f %.2f\n", (double)visible / COUNT,
         (double)(fresh[0] * LINE) / (double)visible, (double)(fresh[1] * LINE) / (double)visible);
  for (int axis = 0; axis < 2; ++axis) strips_free(&strips[axis]);
  free(marks);
}

/* ---- Sums ---- */

struct way {
  double tolerance;
  enum gather_method method;
};

/* Nanoseconds of CPU; the light goes to `gathered`. */
static double sum(const struct light *light, const struct way *way,
                  const struct receiver receivers[COUNT], struct gathered gathered[COUNT],
                  uint64_t *visited) {
  struct error error;
  struct gather *gather;
  const struct gather_settings settings = {.lights = light,
                                           .light_count = 1,
                                           .method = way->method,
                                           .tolerance = way->tolerance,
                                           .level = -1};
  hold(gather_create(&settings, &gather, &error), &error);
  double start = roofline_seconds();
  for (int k = 0; k < COUNT; k += TOGETHER)
    hold(gather_light(gather, receivers + k, TOGETHER, gathered + k, &error), &error);
  double spent = 1e9 * (roofline_seconds() - start);
  *visited = gather_counts(gather)->microlights;
  gather_free(gather);
  return spent;
}

static double difference(const struct gathered *a, const struct gathered *b) {
  double square = 0, norm = 0;
  for (int k = 0; k < COUNT; ++k)
    for (int c = 0; c < 3; ++c) {
      double off = a[k].irradiance[c] - b[k].irradiance[c];
      square += off * off;
      norm += b[k].irradiance[c] * b[k].irradiance[c];
    }
  return sqrt(square / norm);
}

static const struct way ways[] = {
    {1e-2, GATHER_PAPER}, {1e-2, GATHER_PI}, {1e-6, GATHER_REFERENCE}};
enum { WAYS = sizeof ways / sizeof ways[0] };

static void times(int uv, int st, const char *where, int repeats) {
  static struct receiver receivers[COUNT];
  static struct gathered truth[COUNT], gathered[COUNT];
  static const struct way exact = {1e-9, GATHER_REFERENCE};
  struct light light;
  struct light_page page;
  uint64_t visited;
  make_light(uv, st, true, &light, &page);
  (strcmp(where, "plane") ? make_scattered : make_plane)(receivers);
  print_visible(&page, receivers);
  sum(&light, &exact, receivers, truth, &visited);
  printf("error");
  for (int w = 0; w < WAYS; ++w) {
    sum(&light, &ways[w], receivers, gathered, &visited);
    printf(" %.3g", difference(gathered, truth));
  }
  printf("\n");
  for (int n = 0; n < repeats; ++n) {
    printf("repeat");
    for (int w = 0; w < WAYS; ++w) {
      double spent = sum(&light, &ways[w], receivers, gathered, &visited);
      printf(" %.4g", spent / (double)visited);
    }
    printf(" %.4g %.4g %.4g\n",
           1e-9 * roofline_read(page.slab.rgb, 3 * slab_sample_count(&page.slab)),
           1e-9 * roofline_fused(), 1e-9 * roofline_plain());
    fflush(stdout);
  }
  light_page_free(&page);
}

/* ---- Visits ---- */

static void print_visits(int uv, int st, const struct receiver receivers[COUNT]) {
  static struct gathered gathered[COUNT];
  struct light light;
  struct light_page page;
  struct seen_page seen;
  struct strips strips[2] = {{0}};
  uint64_t sum_of = 0, most = 0, visited;
  bool fits = uv * st <= 4096;
  make_light(uv, st, fits, &light, &page);
  for (int k = 0; k < COUNT; ++k) {
    uint64_t count = look(&page, &receivers[k], &seen, strips);
    sum_of += count;
    if (count > most) most = count;
  }
  double larger = uv > st ? uv : st, mean = (double)sum_of / COUNT, best = INFINITY;
  for (int n = 0; n < 3 && fits; ++n)
    best = fmin(best, sum(&light, &ways[1], receivers, gathered, &visited));
  printf("%d %d %.0f %llu %.2f %.2f ", uv, st, mean, (unsigned long long)most,
         mean / (larger * larger), (double)most / (larger * larger));
  if (fits)
    printf("%.1f\n", best / COUNT / 1e3);
  else
    printf("-\n");
  for (int axis = 0; axis < 2; ++axis) strips_free(&strips[axis]);
  light_page_free(&page);
}

static void visits(void) {
  static struct receiver receivers[COUNT];
  make_scattered(receivers);
  for (int n = 8; n <= 256; n *= 2) print_visits(n, n, receivers);
  for (int n = 8; n <= 32; n *= 2) print_visits(n, 64, receivers);
  for (int n = 8; n <= 32; n *= 2) print_visits(64, n, receivers);
}

int main(int argc, char **argv) {
  if (argc == 2 && !strcmp(argv[1], "visits"))
    visits();
  else if (argc == 6 && !strcmp(argv[1], "times"))
    times(atoi(argv[2]), atoi(argv[3]), argv[4], atoi(argv[5]));
  else
    die("times UV ST plane|scattered REPEATS, or visits");
  return 0;
}
