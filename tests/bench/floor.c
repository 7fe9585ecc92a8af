/* floor.c - how well slabs of lamps/parabolic.pov light a floor.
 *
 *   floor truth FILE UV ST RAYS   computes what the lamp itself does to the floor, its flux,
 *                                 and the means over the cells of UV x UV x ST x ST samples
 *   floor ideal FILE [SLAB]       the errors of a slab of those means; writes it
 *   floor compare FILE SLAB       the errors of a slab
 *   floor lobe SLAB UV ST         writes a slab of the means of a smooth lamp, whose radiance is a
 *                                 Gaussian of the slopes
 *   floor own LAMP APERTURES SLAB...
 *                                 for each slab, what it says of its own error at a distance (all,
 *                                 st, uv, noise), and its error there against the lamp, which is
 *                                 "paper" or "lobe": RMS over RMS
 *   floor image FILE EXR [OTHER]  that of POV-Ray's picture of a floor of pigment 1 from above, a
 *                                 multiple of 64 pixels wide, and its mean over the truth's (or
 *                                 over another picture's)
 *   floor picture EXR A B         RMS difference, relative to the RMS, of POV-Ray's picture of
 *                                 the window from (A, 0, B) and the caster's
 *
 * Errors: RMSE of the floor's irradiance over its mean, in %; error of the flux in %; RMS
 * error of the samples over their mean, in %. The floor lies 60 units below the aperture and
 * is 160 wide, of 64 x 64 receivers. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_exr.h"
#include "file/slab_file.h"
#include "file/slab_json.h"
#include "lamp.h"
#include "lit.h"
#include "oracle/random.h"
#include "slab/slab_accuracy.h"

enum { SIDE = 64, POINTS = 600, FLUX_RAYS = 1 << 24 };
static double below = 60, width = 160; /* `own` asks for others */

static double receiver(int n) {
  return ((n + 0.5) / SIDE - 0.5) * width;
}

static void die(const char *text) {
  fprintf(stderr, "floor: %s\n", text);
  exit(1);
}

static void *room(size_t count, size_t size) {
  void *p = calloc(count, size);
  if (!p) die("out of memory");
  return p;
}

/* ---- Truth ---- */

struct truth {
  int uv, st;
  double flux;
  double floor[SIDE * SIDE];
  float *means[2]; /* two independent estimates of each cell's mean; a slab's raster */
};

static size_t mean_count(const struct truth *truth) {
  return (size_t)truth->uv * (size_t)truth->uv * (size_t)truth->st * (size_t)truth->st;
}

/* The smooth lamp, or the paper's. */
static const double lobe_width = 0.5;

static double lobe(double a, double b, double s, double t) {
  (void)a, (void)b;
  return exp(-(s * s + t * t) / (2 * lobe_width * lobe_width));
}

static double (*radiance_of)(double a, double b, double s, double t) = lamp_radiance;

/* Irradiance by midpoints on the aperture: cos^2/r^2 = below^2/r^4. */
static double direct(double x, double z) {
  double sum = 0, step = lamp_aperture / POINTS;
  for (int j = 0; j < POINTS; ++j)
    for (int i = 0; i < POINTS; ++i) {
      double a = (i + 0.5) * step - lamp_aperture / 2, b = (j + 0.5) * step - lamp_aperture / 2;
      double s = (x - a) / below, t = (z - b) / below, r = 1 + s * s + t * t;
      if (fabs(s) <= lamp_slope && fabs(t) <= lamp_slope) sum += radiance_of(a, b, s, t) / (r * r);
    }
  return sum * step * step / (below * below);
}

/* One eighth of the floor; the lamp is as symmetric. */
static void fill_floor(double *irradiance) {
  for (int j = 0; j < SIDE / 2; ++j)
    for (int i = 0; i <= j; ++i) {
      double e = direct(receiver(i), receiver(j));
      const int x[2] = {i, SIDE - 1 - i}, z[2] = {j, SIDE - 1 - j};
      for (int n = 0; n < 4; ++n) {
        irradiance[z[n / 2] * SIDE + x[n % 2]] = e;
        irradiance[x[n % 2] * SIDE + z[n / 2]] = e;
      }
    }
}

static double cell_mean(const double low[4], const double size[4], int rays, uint64_t *seed) {
  double shift[4], x[4], sum = 0;
  for (int c = 0; c < 4; ++c) shift[c] = random_number(seed);
  for (int n = 0; n < rays; ++n) {
    lamp_point(n, shift, x);
    for (int c = 0; c < 4; ++c) x[c] = low[c] + x[c] * size[c];
    sum += lamp_radiance(x[0], x[1], x[2], x[3]);
  }
  return sum / rays;
}

static void fill_means(struct truth *truth, int rays) {
  int uv = truth->uv, st = truth->st;
  double du = lamp_aperture / uv, ds = 2 * lamp_slope / st;
  const double size[4] = {du, du, ds, ds};
  uint64_t seed = 1;
  for (int half = 0; half < 2; ++half) {
    float *mean = truth->means[half];
    for (int row = 0; row < uv * st; ++row)
      for (int column = 0; column < uv * st; ++column) {
        const double low[4] = {column / st * du - lamp_aperture / 2,
                               row / st * du - lamp_aperture / 2, column % st * ds - lamp_slope,
                               row % st * ds - lamp_slope};
        *mean++ = (float)cell_mean(low, size, rays / 2, &seed);
      }
  }
}

static void read_truth(const char *path, struct truth *truth) {
  FILE *file = fopen(path, "rb");
  if (!file || fread(truth, sizeof *truth, 1, file) != 1) die("no truth in that file");
  for (int half = 0; half < 2; ++half) {
    size_t count = mean_count(truth);
    truth->means[half] = room(count, sizeof(float));
    if (fread(truth->means[half], sizeof(float), count, file) != count) die("half a truth");
  }
  fclose(file);
}

static void write_truth(const char *path, const struct truth *truth) {
  FILE *file = fopen(path, "wb");
  bool ok = file && fwrite(truth, sizeof *truth, 1, file) == 1;
  for (int half = 0; half < 2; ++half)
    ok = ok &&
         fwrite(truth->means[half], sizeof(float), mean_count(truth), file) == mean_count(truth);
  if (!ok || fclose(file)) die("cannot write the truth");
}

static void make_truth(const char *path, int uv, int st, int rays) {
  static struct truth truth;
  truth.uv = uv;
  truth.st = st;
  for (int half = 0; half < 2; ++half) truth.means[half] = room(mean_count(&truth), sizeof(float));
  truth.flux = lamp_flux(FLUX_RAYS);
  fill_floor(truth.floor);
  fill_means(&truth, rays);
  write_truth(path, &truth);
  double half_flux = lamp_flux(FLUX_RAYS / 2);
  printf("%.6f %.4f\n", truth.flux * 1e-4, 100 * (half_flux / truth.flux - 1));
}

/* ---- A slab ---- */

/* Prints floor, flux and samples; `flux` in lamp units, 0 where it isn't known. */
static void report(const struct truth *truth, const struct lit_samples *light, double flux) {
  double square = 0, mean = 0;
  for (int j = 0; j < SIDE; ++j)
    for (int i = 0; i < SIDE; ++i) {
      double e = truth->floor[j * SIDE + i];
      double error = lit_irradiance(light, receiver(i), receiver(j), below) - e;
      square += error * error;
      mean += e;
    }
  mean /= SIDE * SIDE;
  /* The errors of the two estimates are independent: their product's mean has no bias. */
  size_t count = mean_count(truth);
  double product = 0, level = 0;
  for (size_t n = 0; n < count; ++n) {
    double one = (double)truth->means[0][n], two = (double)truth->means[1][n];
    double sample = (double)light->sample[n];
    product += (sample - one) * (sample - two);
    level += one;
  }
  double samples = sqrt((product < 0 ? 0 : product) / (double)count) / (level / (double)count);
  printf("%.2f %.3f %.1f\n", 100 * sqrt(square / (SIDE * SIDE)) / mean,
         flux != 0 ? 100 * (flux / truth->flux - 1) : 0, 100 * samples);
}

/* As bakeslab would write it: grey. */
static void write_means(const char *name, const struct lit_samples *light) {
  struct slab slab = slab_default();
  struct error error;
  const int samples[SLAB_AXES] = {light->uv, light->uv, light->st, light->st};
  memcpy(slab.samples, samples, sizeof samples);
  slab.u[0] = slab.v[2] = lamp_aperture;
  for (int n = 0; n < 4; ++n) slab.st_window[n] = n % 2 ? lamp_slope : -lamp_slope;
  if (slab_alloc(&slab, &error) || slab_json_set(&slab, "samples_are", "\"cell_means\"", &error))
    die(error.text);
  size_t count = slab_sample_count(&slab);
  for (size_t n = 0; n < 3 * count; ++n) slab.rgb[n] = light->sample[n / 3];
  if (slab_file_write(name, &slab, 1, SLAB_PRECISION_FLOAT, &error)) die(error.text);
  slab_free(&slab);
}

static void write_lobe(const char *name, int uv, int st) {
  double mean[1024] = {0}, step = 2 * lamp_slope / st, unit = lobe_width * sqrt(2);
  float *sample = room((size_t)uv * (size_t)uv * (size_t)st * (size_t)st, sizeof *sample);
  struct lit_samples light = {uv, st, sample};
  if (st > 1024) die("too many samples");
  for (int k = 0; k < st; ++k) {
    double low = k * step - lamp_slope;
    mean[k] = unit * 0.5 * sqrt(M_PI) / step * (erf((low + step) / unit) - erf(low / unit));
  }
  for (int row = 0; row < uv * st; ++row)
    for (int column = 0; column < uv * st; ++column)
      *sample++ = (float)(mean[row % st] * mean[column % st]);
  write_means(name, &light);
}

static void ideal(const char *path, const char *name) {
  static struct truth truth;
  read_truth(path, &truth);
  size_t count = mean_count(&truth);
  float *sample = room(count, sizeof *sample);
  for (size_t n = 0; n < count; ++n) sample[n] = 0.5f * (truth.means[0][n] + truth.means[1][n]);
  struct lit_samples light = {truth.uv, truth.st, sample};
  report(&truth, &light, 0);
  if (name) write_means(name, &light);
}

static float *green(const struct slab *slab) {
  size_t count = slab_sample_count(slab);
  float *sample = room(count, sizeof *sample);
  for (size_t k = 0; k < count; ++k) sample[k] = slab->rgb[3 * k + 1];
  return sample;
}

/* RMS of a slab's error over the RMS of the truth. */
static double relative_error(const struct lit_samples *light, const double *truth) {
  double wrong = 0, all = 0;
  for (int n = 0; n < SIDE * SIDE; ++n) {
    double error = lit_irradiance(light, receiver(n % SIDE), receiver(n / SIDE), below) - truth[n];
    wrong += error * error;
    all += truth[n] * truth[n];
  }
  return sqrt(wrong / all);
}

/* On a floor that holds all of the light. */
static void own(double apertures, char **names) {
  static double truth[SIDE * SIDE];
  below = apertures * lamp_aperture;
  width = 2 * below * lamp_slope + lamp_aperture;
  fill_floor(truth);
  for (; *names; ++names) {
    struct slab *slabs;
    struct error error;
    struct slab_sampling sampling;
    struct slab_accuracy floor;
    int pages;
    if (slab_file_load_all(*names, &slabs, &pages, &error)) die(error.text);
    if (slab_json_sampling(slabs, &sampling, &error) != RESULT_OK ||
        slab_accuracy_estimate(slabs, &sampling, 1, &below, &floor, &error) != RESULT_OK)
      die(error.text);
    float *sample = green(slabs);
    struct lit_samples light = {slabs->samples[SLAB_U], slabs->samples[SLAB_S], sample};
    printf("%.3g %.3g %.3g %.3g %.3g\n", 100 * floor.all, 100 * floor.st, 100 * floor.uv,
           100 * floor.noise, 100 * relative_error(&light, truth));
    free(sample);
    slab_file_free_all(slabs, pages);
  }
}

static void compare(const char *path, const char *name) {
  static struct truth truth;
  struct slab *slabs;
  struct error error;
  int pages;
  read_truth(path, &truth);
  if (slab_file_load_all(name, &slabs, &pages, &error)) die(error.text);
  const int *n = slabs->samples;
  if (pages != 1 || n[SLAB_U] != truth.uv || n[SLAB_V] != truth.uv || n[SLAB_S] != truth.st ||
      n[SLAB_T] != truth.st)
    die("the slab has other samples than the truth");
  struct lit_samples light = {truth.uv, truth.st, green(slabs)};
  double flux[3];
  slab_flux(slabs, flux, NULL);
  report(&truth, &light, flux[1]);
}

/* Irradiance by means of blocks of a picture of the floor. */
static void seen(const char *name, double irradiance[SIDE * SIDE]) {
  struct picture shown;
  struct error error;
  if (slab_exr_read(name, &shown, &error)) die(error.text);
  int block = shown.width / SIDE;
  if (shown.width != shown.height || block * SIDE != shown.width) die("a picture of another size");
  for (int n = 0; n < SIDE * SIDE; ++n) {
    double sum = 0;
    for (int y = n / SIDE * block; y < (n / SIDE + 1) * block; ++y)
      for (int x = n % SIDE * block; x < (n % SIDE + 1) * block; ++x)
        sum += (double)shown.rgb[3 * (y * shown.width + x)];
    irradiance[n] = sum * M_PI / (block * block);
  }
  picture_free(&shown);
}

static void image(const char *path, const char *name, const char *other) {
  static struct truth truth;
  static double light[SIDE * SIDE];
  double square = 0, mean = 0, expected = 0;
  read_truth(path, &truth);
  if (other) seen(other, truth.floor);
  seen(name, light);
  for (int n = 0; n < SIDE * SIDE; ++n) {
    square += (light[n] - truth.floor[n]) * (light[n] - truth.floor[n]);
    mean += light[n];
    expected += truth.floor[n];
  }
  printf("%.2f %.4f\n", 100 * sqrt(square) * SIDE / expected, mean / expected);
}

static void picture(const char *name, double a, double b) {
  struct picture shown;
  struct error error;
  if (slab_exr_read(name, &shown, &error)) die(error.text);
  double wrong = 0, all = 0;
  int edges = 0;
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      /* `right` is +x and `up` +z of a camera that looks up. */
      double up_x = (2 * (x + 0.5) / shown.width - 1) * lamp_slope;
      double up_z = (1 - 2 * (y + 0.5) / shown.height) * lamp_slope;
      double cast = lamp_radiance(a, b, -up_x, -up_z);
      double difference = (double)shown.rgb[3 * (y * shown.width + x)] - cast;
      if (fabs(difference) > 0.01 * cast + 1e-3) {
        ++edges;
        continue;
      }
      wrong += difference * difference;
      all += cast * cast;
    }
  printf("%.1e %d\n", sqrt(wrong / all), edges);
}

int main(int argc, char **argv) {
  const char *what = argc > 2 ? argv[1] : "";
  if (!strcmp(what, "truth") && argc == 6)
    make_truth(argv[2], atoi(argv[3]), atoi(argv[4]), atoi(argv[5]));
  else if (!strcmp(what, "ideal"))
    ideal(argv[2], argv[3]);
  else if (!strcmp(what, "compare") && argc == 4)
    compare(argv[2], argv[3]);
  else if (!strcmp(what, "lobe") && argc == 5)
    write_lobe(argv[2], atoi(argv[3]), atoi(argv[4]));
  else if (!strcmp(what, "own") && argc > 4) {
    if (!strcmp(argv[2], "lobe")) radiance_of = lobe;
    own(atof(argv[3]), argv + 4);
  } else if (!strcmp(what, "image") && (argc == 4 || argc == 5))
    image(argv[2], argv[3], argv[4]);
  else if (!strcmp(what, "picture") && argc == 5)
    picture(argv[2], atof(argv[3]), atof(argv[4]));
  else
    die("see floor.c for its arguments");
  return 0;
}
