/* gl_sum.c - see gl_sum.h. */
#include "gl_sum.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_program.h"

enum { GLOSS = 1, SHADOWS = 2 };

/* Texture units of the programs. */
enum { POSITION, NORMAL, LIFT, EYE, SLIDES, VIEWS, MAPS };

/* The middle of the pages: what is near them has small numbers. */
static void find_origin(const struct gl_sum_settings *settings, double origin[3]) {
  int count = 0;
  memset(origin, 0, 3 * sizeof *origin);
  for (int l = 0; l < settings->light_count; ++l)
    for (int page = 0; page < settings->lights[l].count; ++page, ++count)
      for (int c = 0; c < 3; ++c)
        origin[c] += (settings->lights[l].pages[page].center[c] - origin[c]) / (count + 1);
}

/* The page itself, or fewer views of it; `number` counts pages through all lights. */
static const struct light_page *choose_level(const struct gl_sum_settings *settings,
                                             const struct light_page *page, int number) {
  const struct levels *levels = settings->levels ? &settings->levels[number] : NULL;
  int level = levels && settings->level > levels->count ? levels->count : settings->level;
  return levels && level > 0 ? &levels->page[level - 1] : page;
}

static enum slab_result make_slides(struct gl_sum *sum, struct slab_error *error) {
  const struct gl_sum_settings *settings = &sum->settings;
  enum slab_result result = SLAB_OK;
  for (int l = 0; l < settings->light_count && result == SLAB_OK; ++l)
    for (int k = 0; k < settings->lights[l].count && result == SLAB_OK; ++k) {
      const struct light *light = &settings->lights[l];
      const struct light_page *page = choose_level(settings, &light->pages[k], sum->pages);
      struct gl_slides *slides = &sum->slides[sum->pages];
      result = gl_slides_create(page, light->gain, sum->origin, settings->groups, &sum->limits,
                                slides, error);
      if (result != SLAB_OK) break;
      ++sum->pages;
      sum->unit = fmax(sum->unit, fabs(slides->scale));
    }
  if (!(sum->unit > 0)) sum->unit = 1;
  return result;
}

enum slab_result gl_sum_create(const struct gl_sum_settings *settings, struct gl_sum *sum,
                               struct slab_error *error) {
  int pages = 0;
  *sum = (struct gl_sum){.settings = *settings};
  for (int l = 0; l < settings->light_count; ++l) pages += settings->lights[l].count;
  enum slab_result result = gl_context_check(&sum->limits, error);
  if (result != SLAB_OK) return result;
  find_origin(settings, sum->origin);
  sum->slides = calloc((size_t)pages + 1, sizeof *sum->slides);
  if (!sum->slides) result = slab_fail(error, SLAB_MEMORY, "out of memory");
  if (result == SLAB_OK) result = make_slides(sum, error);
  if (result == SLAB_OK && settings->occluders)
    result = gl_maps_create(settings->occluders, sum->origin, settings->map_size, &sum->limits,
                            &sum->maps, error);
  glGenVertexArrays(1, &sum->empty);
  if (result != SLAB_OK) gl_sum_free(sum);
  return result;
}

void gl_sum_free(struct gl_sum *sum) {
  if (!sum->slides) return; /* nothing was made; perhaps there is no context */
  for (int page = 0; page < sum->pages; ++page) gl_slides_free(&sum->slides[page]);
  gl_maps_free(&sum->maps);
  for (int k = 0; k < 4; ++k) glDeleteProgram(sum->programs[k]);
  glDeleteVertexArrays(1, &sum->empty);
  free(sum->slides);
  *sum = (struct gl_sum){0};
}

void gl_sum_clear(const struct gl_receivers *receivers) {
  static const float nothing[4] = {0};
  glBindFramebuffer(GL_FRAMEBUFFER, receivers->target);
  glClearBufferfv(GL_COLOR, 0, nothing);
  glClearBufferfv(GL_COLOR, 1, nothing);
}

/* The program for the effects that are called for. */
static enum slab_result choose(struct gl_sum *sum, bool gloss, unsigned *program,
                               struct slab_error *error) {
  static const char *const defines[] = {"", "#define GLOSS\n", "#define SHADOWS\n",
                                        "#define GLOSS\n#define SHADOWS\n"};
  int kind = (gloss ? GLOSS : 0) | (sum->settings.occluders ? SHADOWS : 0);
  enum slab_result result = SLAB_OK;
  if (!sum->programs[kind])
    result = gl_program_make(gl_all_vert, gl_sum_frag, defines[kind], &sum->programs[kind], error);
  *program = sum->programs[kind];
  return result;
}

static void set_receivers(const struct gl_receivers *receivers, unsigned program) {
  gl_set_texture(program, "position", POSITION, GL_TEXTURE_2D, receivers->position);
  gl_set_texture(program, "normal", NORMAL, GL_TEXTURE_2D, receivers->normal);
  gl_set_texture(program, "lift", LIFT, GL_TEXTURE_2D, receivers->lift);
  gl_set_texture(program, "eye", EYE, GL_TEXTURE_2D, receivers->eye);
}

static void set_page(const struct gl_sum *sum, const struct gl_slides *slides, unsigned program) {
  const struct light_axis *axes = slides->page->axes;
  double kappa[2], window[4], area = slides->scale / sum->unit;
  for (int axis = 0; axis < 2; ++axis) {
    kappa[axis] = axes[axis].kappa;
    window[axis] = axes[axis].far_low;
    window[2 + axis] = 1 / (axes[axis].far_high - axes[axis].far_low);
    area *= axes[axis].near_step;
  }
  gl_set_floats(program, "center", 3, slides->center);
  gl_set_frame(program, slides->page->frame);
  gl_set_floats(program, "kappa", 2, kappa);
  gl_set_floats(program, "window", 4, window);
  gl_set_floats(program, "area", 1, &area);
  gl_set_texture(program, "views", VIEWS, GL_TEXTURE_BUFFER, slides->views);
}

/* Views first to end - 1, all of one array and of the maps that are drawn. */
static void draw(struct gl_sum *sum, unsigned program, int first, int end) {
  int step = sum->settings.separate ? 1 : end - first;
  for (int k = first; k < end; k += step) {
    gl_set_int(program, "first", k);
    gl_set_int(program, "count", step);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ++sum->passes;
  }
  sum->views += (uint64_t)(end - first);
}

static void use_target(const struct gl_sum *sum, const struct gl_receivers *receivers,
                       unsigned program) {
  glBindFramebuffer(GL_FRAMEBUFFER, receivers->target);
  glViewport(0, 0, receivers->width, receivers->height);
  glBindVertexArray(sum->empty);
  glUseProgram(program);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
}

/* The end of the run from `first` on that can be drawn with the same textures. */
static int find_end(const struct gl_sum *sum, const struct gl_slides *slides, int first, int end) {
  const struct gl_slides_array *array = slides->array;
  while (first >= array->first + array->count) ++array;
  if (end > array->first + array->count) end = array->first + array->count;
  if (!sum->settings.occluders) return end;
  int last_map = (int)slides->at[first][3] + sum->maps.room - 1;
  while ((int)slides->at[end - 1][3] > last_map) --end;
  return end;
}

static void add_page(struct gl_sum *sum, const struct gl_receivers *receivers, unsigned program,
                     const struct gl_slides *slides, int first, int end) {
  for (int next; first < end; first = next) {
    next = find_end(sum, slides, first, end);
    int map = (int)slides->at[first][3], maps = (int)slides->at[next - 1][3] - map + 1;
    if (sum->settings.occluders) gl_maps_draw(&sum->maps, slides, map, maps);
    use_target(sum, receivers, program);
    set_page(sum, slides, program);
    const struct gl_slides_array *array = slides->array;
    while (first >= array->first + array->count) ++array;
    gl_set_texture(program, "slides", SLIDES, GL_TEXTURE_2D_ARRAY, array->texture);
    if (sum->settings.occluders) gl_maps_set(&sum->maps, slides, map, program, MAPS);
    draw(sum, program, first, next);
  }
}

enum slab_result gl_sum_add(struct gl_sum *sum, const struct gl_receivers *receivers, int part,
                            int parts, bool gloss, struct slab_error *error) {
  unsigned program;
  enum slab_result result = choose(sum, gloss, &program, error);
  if (result != SLAB_OK) return result;
  set_receivers(receivers, program);
  for (int page = 0; page < sum->pages; ++page) {
    const struct gl_slides *slides = &sum->slides[page];
    int64_t count = slides->count;
    add_page(sum, receivers, program, slides, (int)(count * part / parts),
             (int)(count * (part + 1) / parts));
  }
  glDisable(GL_BLEND);
  return gl_check("the sum over views", error);
}
