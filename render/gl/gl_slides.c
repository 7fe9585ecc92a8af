#include "gl/gl_slides.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"

/* A view, before it is ordered. */
struct candidate {
  int i, j;
  int group[2];
  uint64_t key;
};

/* The bits of both interleaved, the lowest first: neighbours are far apart in the order of such
 * keys. */
static uint32_t spread(int i, int j) {
  uint32_t key = 0;
  for (int bit = 0; bit < 16; ++bit) {
    uint32_t x = (uint32_t)i >> bit & 1, y = (uint32_t)j >> bit & 1;
    key = key << 2 | (x ^ y) << 1 | y;
  }
  return key;
}

static int by_key(const void *left, const void *right) {
  const struct candidate *a = left, *b = right;
  return (a->key > b->key) - (a->key < b->key);
}

static bool is_black(const struct slab *slab, int i, int j) {
  size_t row = 3 * (size_t)slab->samples[SLAB_S];
  for (int l = 0; l < slab->samples[SLAB_T]; ++l) {
    const float *sample = slab_at(slab, i, j, 0, l);
    for (size_t k = 0; k < row; ++k)
      if (sample[k] != 0) return false;
  }
  return true;
}

/* The views that are not black, in their order. Returns how many. */
static int find_views(const struct slab *slab, int groups, bool together, struct candidate *views) {
  const int *n = slab->samples;
  int count = 0;
  for (int j = 0; j < n[SLAB_V]; ++j)
    for (int i = 0; i < n[SLAB_U]; ++i) {
      if (is_black(slab, i, j)) continue;
      struct candidate *view = &views[count++];
      *view = (struct candidate){.i = i, .j = j, .group = {i, j}, .key = spread(i, j)};
      if (groups > 0 && groups < n[SLAB_U]) view->group[0] = i * groups / n[SLAB_U];
      if (groups > 0 && groups < n[SLAB_V]) view->group[1] = j * groups / n[SLAB_V];
      if (together) view->key |= (uint64_t)spread(view->group[0], view->group[1]) << 32;
    }
  qsort(views, (size_t)count, sizeof *views, by_key);
  return count;
}

static double position(const struct light_axis *axis, double index, int count) {
  return ((index + 0.5) / count - 0.5) * 2 * axis->half;
}

/* Numbers the groups in order of their first views. */
static enum result number_groups(const struct candidate *views, struct gl_slides *slides,
                                 struct error *error) {
  size_t columns = (size_t)slides->page->axes[0].near_count;
  int *numbers = calloc(columns * (size_t)slides->page->axes[1].near_count, sizeof *numbers);
  if (!numbers) return result_no_memory(error);
  for (int k = 0; k < slides->count; ++k) {
    const int *group = views[k].group;
    int *number = &numbers[(size_t)group[1] * columns + (size_t)group[0]];
    if (*number == 0) *number = ++slides->groups;
    slides->at[k][3] = *number - 1;
  }
  free(numbers);
  return RESULT_OK;
}

/* Where the views and the middles of their groups are. */
static void place(const struct candidate *views, int groups, int layers, struct gl_slides *slides) {
  const struct light_axis *axes = slides->page->axes;
  for (int axis = 0; axis < 2; ++axis) {
    int n = axes[axis].near_count, parts = groups > 0 && groups < n ? groups : n;
    slides->group_half[axis] = axes[axis].half / parts;
    for (int k = 0; k < slides->count; ++k) {
      slides->at[k][axis] = position(&axes[axis], axis ? views[k].j : views[k].i, n);
      slides->at[k][2] = k % layers;
      /* The middle of the views' own cells: groups need not be of one size. */
      int group = (int)slides->at[k][3], first = (views[k].group[axis] * n + parts - 1) / parts;
      int end = ((views[k].group[axis] + 1) * n + parts - 1) / parts;
      slides->middle[group][axis] = position(&axes[axis], (first + end - 1) / 2.0, n);
    }
  }
}

/* One view, four floats a sample. */
static void copy_view(const struct slab *slab, const struct candidate *view, const double factor[3],
                      float *pixels) {
  for (int l = 0; l < slab->samples[SLAB_T]; ++l)
    for (int k = 0; k < slab->samples[SLAB_S]; ++k, pixels += 4) {
      const float *sample = slab_at(slab, view->i, view->j, k, l);
      for (int c = 0; c < 3; ++c) pixels[c] = (float)((double)sample[c] * factor[c]);
      pixels[3] = 1;
    }
}

static enum result make_array(const struct slab *slab, const struct candidate *views,
                              const double factor[3], float *pixels, struct gl_slides_array *array,
                              struct error *error) {
  int width = slab->samples[SLAB_S], height = slab->samples[SLAB_T];
  array->texture = gl_texture(GL_TEXTURE_2D_ARRAY, GL_LINEAR);
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGBA32F, width, height, array->count);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  enum result result = gl_check("the lamps", error);
  for (int k = 0; k < array->count && result == RESULT_OK; ++k) {
    copy_view(slab, &views[array->first + k], factor, pixels);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, k, width, height, 1, GL_RGBA, GL_FLOAT, pixels);
  }
  return result == RESULT_OK ? gl_check("the lamps", error) : result;
}

/* A table of doubles as a texture that shaders read by index. */
static enum result make_table(const double *values, int rows, int columns, unsigned *texture,
                              unsigned *buffer, struct error *error) {
  size_t count = (size_t)rows * (size_t)columns;
  float *floats = calloc(count, sizeof *floats);
  if (!floats) return result_no_memory(error);
  for (size_t k = 0; k < count; ++k) floats[k] = (float)values[k];
  glGenBuffers(1, buffer);
  glBindBuffer(GL_TEXTURE_BUFFER, *buffer);
  glBufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)(count * sizeof *floats), floats, GL_STATIC_DRAW);
  glGenTextures(1, texture);
  glBindTexture(GL_TEXTURE_BUFFER, *texture);
  glTexBuffer(GL_TEXTURE_BUFFER, columns == 4 ? GL_RGBA32F : GL_RG32F, *buffer);
  free(floats);
  return gl_check("the views", error);
}

/* A power of two near the largest sample: divided by it, no sum leaves the range of single
 * precision. */
static double find_scale(const struct slab *slab) {
  size_t count = 3 * slab_sample_count(slab);
  float peak = 0;
  for (size_t k = 0; k < count; ++k) peak = fmaxf(peak, fabsf(slab->rgb[k]));
  return peak > 0 ? ldexp(1, ilogbf(peak)) : 1;
}

static enum result upload(const struct candidate *views, int layers, struct gl_slides *slides,
                          struct error *error) {
  const struct slab *slab = &slides->page->slab;
  size_t samples = (size_t)slab->samples[SLAB_S] * (size_t)slab->samples[SLAB_T];
  double scale = find_scale(slab), gain = 0, factor[3];
  for (int c = 0; c < 3; ++c) gain = fmax(gain, fabs(slides->gain[c]));
  for (int c = 0; c < 3; ++c) factor[c] = gain > 0 ? slides->gain[c] / gain / scale : 0;
  float *pixels = calloc(samples, 4 * sizeof *pixels);
  slides->arrays = (slides->count + layers - 1) / layers;
  slides->array = calloc((size_t)slides->arrays + 1, sizeof *slides->array);
  slides->scale = gain * scale;
  enum result result = RESULT_OK;
  if (!pixels || !slides->array) result = result_no_memory(error);
  for (int k = 0; k < slides->arrays && result == RESULT_OK; ++k) {
    struct gl_slides_array *array = &slides->array[k];
    array->first = k * layers;
    array->count = slides->count - array->first < layers ? slides->count - array->first : layers;
    result = make_array(slab, views, factor, pixels, array, error);
  }
  free(pixels);
  if (result == RESULT_OK)
    result =
        make_table(slides->at[0], slides->count, 4, &slides->views, &slides->views_buffer, error);
  if (result == RESULT_OK)
    result = make_table(slides->middle[0], slides->groups, 2, &slides->middles,
                        &slides->middles_buffer, error);
  return result;
}

/* Lengths whose quotients floats hold, however near or far a receiver is. */
static const double shortest = 1e-15, longest = 1e15;

static enum result check(const struct gl_slides *slides, const struct gl_limits *limits,
                         struct error *error) {
  const struct light_axis *axes = slides->page->axes;
  const int *n = slides->page->slab.samples;
  double far = vector_length(slides->center);
  for (int axis = 0; axis < 2; ++axis)
    if (!(2 * axes[axis].half >= shortest && 2 * axes[axis].half <= longest && far <= longest))
      return gl_fail(error, RESULT_BAD,
                     "an aperture of %.3g x %.3g, %.3g from the middle of all; single precision "
                     "takes lengths of %g to %g",
                     2 * axes[0].half, 2 * axes[1].half, far, shortest, longest);
  if (n[SLAB_S] > limits->texture || n[SLAB_T] > limits->texture)
    return gl_fail(error, RESULT_BAD, "%d x %d directions a view; this driver's textures have %d",
                   n[SLAB_S], n[SLAB_T], limits->texture);
  if ((int64_t)n[SLAB_U] * n[SLAB_V] > limits->buffer || n[SLAB_U] > 65535 || n[SLAB_V] > 65535)
    return gl_fail(error, RESULT_BAD, "%d x %d views; this driver's buffers have %d", n[SLAB_U],
                   n[SLAB_V], limits->buffer);
  return RESULT_OK;
}

enum result gl_slides_create(struct gl_slides *slides, const double origin[3], int groups,
                             bool together, const struct gl_limits *limits, struct error *error) {
  const struct slab *slab = &slides->page->slab;
  vector_subtract(slides->page->center, origin, slides->center);
  enum result result = check(slides, limits, error);
  if (result != RESULT_OK) return result;
  size_t views = (size_t)slab->samples[SLAB_U] * (size_t)slab->samples[SLAB_V];
  struct candidate *found = calloc(views, sizeof *found);
  slides->at = calloc(views, sizeof *slides->at);
  slides->middle = calloc(views, sizeof *slides->middle);
  slides->drawn = calloc(views, sizeof *slides->drawn);
  if (!found || !slides->at || !slides->middle || !slides->drawn) result = result_no_memory(error);
  if (result == RESULT_OK) {
    slides->count = find_views(slab, groups, together, found);
    result = number_groups(found, slides, error);
  }
  if (result == RESULT_OK && slides->count > 0) {
    place(found, groups, limits->layers, slides);
    result = upload(found, limits->layers, slides, error);
  }
  free(found);
  if (result != RESULT_OK) gl_slides_free(slides);
  return result;
}

void gl_slides_free(struct gl_slides *slides) {
  for (int k = 0; slides->array && k < slides->arrays; ++k)
    glDeleteTextures(1, &slides->array[k].texture);
  glDeleteTextures(1, &slides->views);
  glDeleteTextures(1, &slides->middles);
  glDeleteBuffers(1, &slides->views_buffer);
  glDeleteBuffers(1, &slides->middles_buffer);
  free(slides->array);
  free(slides->at);
  free(slides->middle);
  free(slides->drawn);
  *slides = (struct gl_slides){0};
}
