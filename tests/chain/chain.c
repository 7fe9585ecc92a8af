/* chain.c - see chain.h. */
#include "chain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- Vectors ---- */
double chain_dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

double chain_length(const double x[3]) {
  return sqrt(chain_dot(x, x));
}

/* ---- Slabs ---- */
void chain_fill(struct slab *slab, uint64_t *state) {
  assert_int_equal(slab_alloc(slab, NULL), RESULT_OK);
  for (size_t k = 0; k < 3 * slab_sample_count(slab); ++k)
    slab->rgb[k] = (float)random_log(state, 0.1, 100);
}

struct slab chain_slab(const int samples[4], const double edges[2], const double window[4],
                       double distance, int mirrored, uint64_t seed) {
  struct slab slab = slab_default();
  double frame[3][3];
  random_frame(&seed, mirrored ? -1 : 1, frame);
  for (int c = 0; c < 3; ++c) {
    slab.u[c] = edges[0] * frame[0][c];
    slab.v[c] = edges[1] * frame[1][c];
    slab.normal[c] = frame[2][c];
    slab.center[c] = random_between(&seed, -0.2, 0.2);
  }
  memcpy(slab.samples, samples, sizeof slab.samples);
  memcpy(slab.st_window, window, sizeof slab.st_window);
  slab.st_distance = distance;
  snprintf(slab.name, sizeof slab.name, "test_lamp");
  chain_fill(&slab, &seed);
  return slab;
}

struct slab chain_means(const struct slab *from, int nu, int nv) {
  struct slab to = *from;
  to.json = NULL;
  to.rgb = NULL;
  to.samples[0] = nu;
  to.samples[1] = nv;
  assert_int_equal(slab_alloc(&to, NULL), RESULT_OK);
  for (int j = 0; j < nv * from->samples[1]; ++j)
    for (int i = 0; i < nu * from->samples[0]; ++i)
      for (int l = 0; l < to.samples[3]; ++l)
        for (int k = 0; k < to.samples[2]; ++k) /* on a grid that refines both */
          for (int c = 0; c < 3; ++c)
            (oracle_sample(&to, i / from->samples[0], j / from->samples[1], k, l))[c] +=
                oracle_sample(from, i / nu, j / nv, k, l)[c] /
                (float)(from->samples[0] * from->samples[1]);
  return to;
}

/* ---- The direct sum ---- */
struct chain_lamp chain_lamp_of(const struct slab *pages, int count, double scale) {
  return (struct chain_lamp){pages, count, scale, 1, {1, 0, 0, 0, 1, 0, 0, 0, 1}, 0};
}

void chain_move(const double m[12], double scale, const double x[3], double origin, double out[3]) {
  for (int c = 0; c < 3; ++c)
    out[c] = scale * (x[0] * m[c] + x[1] * m[3 + c] + x[2] * m[6 + c]) + origin * m[9 + c];
}

static void turn(const struct chain_lamp *lamp, const double x[3], double turned[3]) {
  chain_move(lamp->matrix, 1, x, 0, turned);
}

/* Whether the lamp's case blocks the segment between two points. */
static int shades(const struct chain_lamp *lamp, const double from[3], const double to[3]) {
  if (lamp->case_height <= 0) return 0;
  const struct slab *slab = &lamp->pages[0];
  const double *axes[3] = {slab->u, slab->v, slab->normal};
  double enter = 0, leave = 1, middle[3], relative[3], way[3];
  chain_move(lamp->matrix, lamp->scale, slab->center, 1, middle);
  for (int c = 0; c < 3; ++c) {
    relative[c] = from[c] - middle[c];
    way[c] = to[c] - from[c];
  }
  for (int k = 0; k < 3; ++k) {
    double axis[3], size = chain_length(axes[k]) * lamp->scale;
    turn(lamp, axes[k], axis);
    double start = chain_dot(relative, axis) * lamp->scale / size;
    double step = chain_dot(way, axis) * lamp->scale / size;
    double low = k < 2 ? -size / 2 : 0, high = k < 2 ? size / 2 : lamp->case_height * lamp->scale;
    double first = (low - start) / step, last = (high - start) / step;
    enter = fmax(enter, fmin(first, last));
    leave = fmin(leave, fmax(first, last));
  }
  return enter < leave;
}

/* Lamps other than the one that shines shade it. */
static int shaded(const struct chain_lamp *lamps, int count, const struct chain_lamp *lamp,
                  const double from[3], const double to[3]) {
  for (int k = 0; k < count; ++k)
    if (&lamps[k] != lamp && shades(&lamps[k], from, to)) return 1;
  return 0;
}

static void add_page(const struct chain_lamp *lamps, int count, const struct chain_lamp *lamp,
                     const struct slab *slab, const double at[3], const double normal[3],
                     double rgb[3]) {
  double n[3], u[3], v[3], lu = chain_length(slab->u), lv = chain_length(slab->v);
  turn(lamp, slab->normal, n);
  turn(lamp, slab->u, u);
  turn(lamp, slab->v, v);
  for (int j = 0; j < slab->samples[1]; ++j)
    for (int i = 0; i < slab->samples[0]; ++i) {
      double a = ((i + 0.5) / slab->samples[0] - 0.5) * lu;
      double b = ((j + 0.5) / slab->samples[1] - 0.5) * lv;
      double point[3], place[3], away[3];
      long double radiance[3];
      for (int c = 0; c < 3; ++c)
        point[c] = slab->center[c] + a * slab->u[c] / lu + b * slab->v[c] / lv;
      chain_move(lamp->matrix, lamp->scale, point, 1, place);
      for (int c = 0; c < 3; ++c) away[c] = at[c] - place[c];
      double height = chain_dot(away, n), facing = -chain_dot(away, normal);
      if (height <= 0 || facing <= 0 || shaded(lamps, count, lamp, place, at)) continue;
      oracle_lookup_view(slab, i, j, chain_dot(away, u) / lu / height + a / slab->st_distance,
                         chain_dot(away, v) / lv / height + b / slab->st_distance, radiance);
      double r2 = chain_dot(away, away);
      double area = lamp->scale * lamp->scale * lu * lv / (slab->samples[0] * slab->samples[1]);
      for (int c = 0; c < 3; ++c)
        rgb[c] += lamp->gain * (double)radiance[c] * height * facing / (r2 * r2) * area;
    }
}

/* ---- The picture ---- */
struct chain_plane chain_facing(const struct chain_lamp *lamp, int page, double distance) {
  const struct slab *slab = &lamp->pages[page];
  struct chain_plane plane;
  double u[3], v[3], n[3], middle[3], lu = chain_length(slab->u), lv = chain_length(slab->v);
  const double *w = slab->st_window;
  turn(lamp, slab->u, u);
  turn(lamp, slab->v, v);
  turn(lamp, slab->normal, n);
  turn(lamp, slab->center, middle);
  double away = distance * fmax(lu, lv), spread = fabs(1 - away / slab->st_distance);
  double size[2] = {spread * lu + away * (w[1] - w[0]), spread * lv + away * (w[3] - w[2])};
  const double tilt = 0.1;
  for (int c = 0; c < 3; ++c) {
    plane.normal[c] = (-n[c] + tilt * u[c] / lu) / sqrt(1 + tilt * tilt);
    plane.across[c] = lamp->scale * size[0] * (u[c] / lu + tilt * n[c]) / sqrt(1 + tilt * tilt);
    plane.down[c] = lamp->scale * size[1] * v[c] / lv;
    plane.center[c] = lamp->scale * (middle[c] + away * (n[c] + (w[0] + w[1]) / 2 * u[c] / lu +
                                                         (w[2] + w[3]) / 2 * v[c] / lv)) +
                      lamp->matrix[9 + c];
  }
  return plane;
}

void chain_pixel(const struct chain_plane *plane, int size, int pixel, double at[3]) {
  int row = pixel / size;
  double x = (pixel % size + 0.5) / size - 0.5, y = (row + 0.5) / size - 0.5;
  for (int c = 0; c < 3; ++c) at[c] = plane->center[c] + x * plane->across[c] + y * plane->down[c];
}

void chain_direct(const struct chain_lamp *lamps, int count, const struct chain_plane *plane,
                  double *rgb) {
  for (int pixel = 0; pixel < CHAIN_PIXELS; ++pixel) {
    double at[3], sum[3] = {0, 0, 0};
    chain_pixel(plane, CHAIN_SIZE, pixel, at);
    for (int k = 0; k < count; ++k)
      for (int p = 0; p < lamps[k].count; ++p)
        add_page(lamps, count, &lamps[k], &lamps[k].pages[p], at, plane->normal, sum);
    for (int c = 0; c < 3; ++c) rgb[3 * pixel + c] = sum[c] / M_PI;
  }
}

/* ---- Programs and files, in a folder that the test owns ---- */
static char chain_folder[64];

int chain_setup(void **state) {
  (void)state;
  strcpy(chain_folder, "/tmp/chain-XXXXXX");
  return getenv("BAKESLAB") && mkdtemp(chain_folder) ? 0 : -1;
}

int chain_teardown(void **state) {
  (void)state;
  char command[128];
  snprintf(command, sizeof command, "rm -rf '%s'", chain_folder);
  return system(command);
}

__attribute__((format(printf, 1, 2))) int chain_run(const char *format, ...) {
  char command[1024], line[1400];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(command, sizeof command, format, arguments);
  va_end(arguments);
  snprintf(line, sizeof line, "cd '%s' && ( %s ) >log 2>&1 </dev/null", chain_folder, command);
  int status = system(line);
  return status < 0 ? status : WEXITSTATUS(status);
}

const char *chain_path(const char *name) {
  static char path[128];
  snprintf(path, sizeof path, "%s/%s", chain_folder, name);
  return path;
}

const char *chain_log(void) {
  static char text[65536];
  size_t length = 0;
  FILE *file = fopen(chain_path("log"), "r");
  assert_non_null(file);
  for (int c; (c = getc(file)) != EOF && length < sizeof text - 1;) {
    if (c == '\n') c = ' ';
    if (c != ' ' || length == 0 || text[length - 1] != ' ') text[length++] = (char)c;
  }
  text[length] = 0;
  fclose(file);
  return text;
}

void chain_text(const char *name, const char *mode, const char *format, ...) {
  FILE *file = fopen(chain_path(name), mode);
  va_list arguments;
  assert_non_null(file);
  va_start(arguments, format);
  vfprintf(file, format, arguments);
  va_end(arguments);
  assert_int_equal(fclose(file), 0);
}

/* An error is at the end, below what POV-Ray prints first. */
static const char *log_tail(void) {
  const char *text = chain_log();
  size_t length = strlen(text), most = 600;
  return length > most ? text + length - most : text;
}

void chain_write(const char *file, const struct slab *pages, int count) {
  struct error error;
  if (slab_file_write(chain_path(file), pages, count, SLAB_PRECISION_FLOAT, &error) != RESULT_OK)
    fail_msg("%s", error.text);
}

void chain_include(const struct slab *pages, int count, const char *name, const char *options) {
  char file[64];
  snprintf(file, sizeof file, "%s-slab.exr", name);
  chain_write(file, pages, count);
  if (chain_run("\"$BAKESLAB\" include %s -o %s.inc %s", file, name, options) != 0)
    fail_msg("%s", log_tail());
}

void chain_scene(const struct chain_plane *plane, double pigment, const char *lights) {
  const double *p = plane->center, *n = plane->normal, *a = plane->across, *d = plane->down;
  chain_text(
      "scene.pov", "w",
      "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n"
      "camera { orthographic location <%.17g, %.17g, %.17g> direction <%.17g, %.17g, %.17g>\n"
      "  right <%.17g, %.17g, %.17g> up <%.17g, %.17g, %.17g> }\n"
      "plane { <%.17g, %.17g, %.17g>, %.17g\n"
      "  pigment { rgb %.9g } finish { diffuse 1 ambient 0 } }\n%s\n",
      p[0] + 50 * n[0], p[1] + 50 * n[1], p[2] + 50 * n[2], -n[0], -n[1], -n[2], a[0], a[1], a[2],
      -d[0], -d[1], -d[2], n[0], n[1], n[2], chain_dot(p, n), pigment, lights);
}

size_t chain_object(const char *arguments, const double matrix[12], char *sdl, size_t size) {
  size_t length = (size_t)snprintf(sdl, size, "object { Test_Lamp_Canned(%s) matrix <", arguments);
  for (int k = 0; k < 12; ++k)
    length += (size_t)snprintf(sdl + length, size - length, "%.17g%s", matrix[k],
                               k < 11 ? ", " : "> }\n");
  return length;
}

const char *chain_placed(const struct chain_lamp *lamps, int count) {
  static char sdl[20 * 512] = "#include \"lamp.inc\"\n";
  char arguments[64], *end = strchr(sdl, '\n') + 1;
  for (int k = 0; k < count; ++k) {
    snprintf(arguments, sizeof arguments, "%.17g, %.17g", lamps[k].scale, lamps[k].gain);
    end += chain_object(arguments, lamps[k].matrix, end, sizeof sdl - (size_t)(end - sdl));
  }
  return sdl;
}

int chain_povray(void) {
  return chain_run("povray +Iscene.pov +Oframe.exr +FE -A +WT1 -D +W%d +H%d", CHAIN_SIZE,
                   CHAIN_SIZE);
}

void chain_render(struct picture *picture) {
  struct error error;
  if (chain_povray() != 0) fail_msg("%s", log_tail());
  if (slab_exr_read(chain_path("frame.exr"), picture, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  assert_int_equal(picture->width, CHAIN_SIZE);
  assert_int_equal(picture->height, CHAIN_SIZE);
}

double chain_rmse(const struct picture *picture, const double *sum) {
  double error = 0, size = 0;
  for (int k = 0; k < 3 * CHAIN_PIXELS; ++k) {
    error += (picture->rgb[k] - sum[k]) * (picture->rgb[k] - sum[k]);
    size += sum[k] * sum[k];
  }
  return sqrt(error / size);
}

double chain_error_of(const struct chain_plane *plane, double pigment, const char *sdl,
                      const double *sum) {
  struct picture picture;
  chain_scene(plane, pigment, sdl);
  chain_render(&picture);
  double error = chain_rmse(&picture, sum);
  picture_free(&picture);
  return error;
}

double chain_error(const struct chain_lamp *lamps, int count, const struct chain_plane *plane,
                   double pigment, const char *sdl) {
  static double direct[3 * CHAIN_PIXELS];
  chain_direct(lamps, count, plane, direct);
  return chain_error_of(plane, pigment, sdl, direct);
}

void chain_says(const struct slab *pages, const char *sdl, int status, const char *text) {
  struct chain_lamp lamp = chain_lamp_of(pages, 1, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 1);
  chain_scene(&plane, 1, sdl);
  assert_int_equal(chain_povray(), status);
  if (!strstr(chain_log(), text)) fail_msg("POV-Ray does not say \"%s\"", text);
}
