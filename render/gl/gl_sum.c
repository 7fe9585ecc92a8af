#include "gl/gl_sum.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "gl/gl_program.h"

enum { GLOSS = 1, SHADOWS = 2 };

/* Texture units of the programs. */
enum { POSITION, NORMAL, LIFT, EYE, SLIDES, VIEWS, MAPS };

/* The page itself, or fewer views of it; `number` counts pages through all lights. */
static const struct light_page *choose_level(const struct gl_sum_settings *settings,
                                             const struct light_page *page, int number) {
  const struct levels *levels = settings->levels ? &settings->levels[number] : NULL;
  int level = levels && settings->level > levels->count ? levels->count : settings->level;
  return levels && level > 0 ? &levels->page[level - 1] : page;
}

/* Groups of a page along an axis. */
static int count_groups(const struct gl_sum_settings *settings, const struct light_axis *axis) {
  bool fewer = settings->groups > 0 && settings->groups < axis->near_count;
  return fewer ? settings->groups : axis->near_count;
}

/* The pages and their middle: positions relative to it are small near them. Returns the number of
 * their groups. */
static int64_t choose_pages(struct gl_sum *sum) {
  const struct gl_sum_settings *settings = &sum->settings;
  int64_t groups = 0;
  for (int l = 0; l < settings->light_count; ++l)
    for (int k = 0; k < settings->lights[l].count; ++k) {
      const struct light_page *whole = &settings->lights[l].pages[k];
      const struct light_page *page = choose_level(settings, whole, sum->pages);
      groups +=
          (int64_t)count_groups(settings, &page->axes[0]) * count_groups(settings, &page->axes[1]);
      struct gl_slides *slides = &sum->slides[sum->pages++];
      *slides = (struct gl_slides){.page = page};
      for (int c = 0; c < 3; ++c) slides->gain[c] = settings->lights[l].gain[c] * whole->gain;
      for (int c = 0; c < 3; ++c) sum->origin[c] += (page->center[c] - sum->origin[c]) / sum->pages;
    }
  return groups;
}

/* Is there room for the maps of all groups? */
static void make_room(struct gl_sum *sum, int64_t groups) {
  sum->maps.room = gl_maps_most(sum->settings.map_size, &sum->limits);
  sum->kept = groups <= sum->maps.room;
  if (sum->kept) sum->maps.room = (int)groups;
}

static enum result make_slides(struct gl_sum *sum, struct error *error) {
  bool together = sum->settings.occluders && !sum->kept;
  enum result result = RESULT_OK;
  for (int k = 0; k < sum->pages && result == RESULT_OK; ++k) {
    struct gl_slides *slides = &sum->slides[k];
    result =
        gl_slides_create(slides, sum->origin, sum->settings.groups, together, &sum->limits, error);
    sum->unit = fmax(sum->unit, fabs(slides->scale));
  }
  if (!(sum->unit > 0)) sum->unit = 1;
  return result;
}

enum result gl_sum_create(const struct gl_sum_settings *settings, struct gl_sum *sum,
                          struct error *error) {
  int pages = light_pages(settings->lights, settings->light_count);
  *sum = (struct gl_sum){.settings = *settings};
  enum result result = gl_context_check(&sum->limits, error);
  if (result != RESULT_OK) return result;
  sum->slides = calloc((size_t)pages + 1, sizeof *sum->slides);
  if (!sum->slides) return result_no_memory(error);
  const int64_t groups = choose_pages(sum);
  if (settings->occluders) make_room(sum, groups);
  result = make_slides(sum, error);
  if (result == RESULT_OK && settings->occluders)
    result = gl_maps_create(settings->occluders, sum->origin, settings->map_size, sum->maps.room,
                            &sum->limits, &sum->maps, error);
  glGenVertexArrays(1, &sum->empty);
  if (result != RESULT_OK) gl_sum_free(sum);
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

static void choose_buffers(const struct gl_receivers *receivers, bool gloss) {
  static const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glBindFramebuffer(GL_FRAMEBUFFER, receivers->target);
  glDrawBuffers(gloss ? 2 : 1, both);
}

void gl_sum_clear(const struct gl_receivers *receivers) {
  static const float nothing[4] = {0};
  choose_buffers(receivers, true);
  glClearBufferfv(GL_COLOR, 0, nothing);
  glClearBufferfv(GL_COLOR, 1, nothing);
}

/* The program for the effects that are called for. */
static enum result choose(struct gl_sum *sum, bool gloss, unsigned *program, struct error *error) {
  static const char *const defines[] = {"", "#define GLOSS\n", "#define SHADOWS\n",
                                        "#define GLOSS\n#define SHADOWS\n"};
  int kind = (gloss ? GLOSS : 0) | (sum->settings.occluders ? SHADOWS : 0);
  enum result result = RESULT_OK;
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
  double kappa[2], window[4], cell[2];
  for (int axis = 0; axis < 2; ++axis) {
    kappa[axis] = axes[axis].kappa;
    window[axis] = axes[axis].far_low;
    window[2 + axis] = 1 / (axes[axis].far_high - axes[axis].far_low);
    cell[axis] = axes[axis].near_step * (axis ? 1 : slides->scale / sum->unit);
  }
  gl_set_floats(program, "center", 3, slides->center);
  gl_set_frame(program, slides->page->frame);
  gl_set_floats(program, "kappa", 2, kappa);
  gl_set_floats(program, "window", 4, window);
  gl_set_floats(program, "cell", 2, cell);
  gl_set_texture(program, "views", VIEWS, GL_TEXTURE_BUFFER, slides->views);
}

/* Views first to end - 1, all of one array and of the maps that are drawn; what lies within
 * `share` of them. */
static void draw(struct gl_sum *sum, unsigned program, int first, int end, const double share[2]) {
  int step = sum->settings.separate ? 1 : end - first;
  for (int k = first; k < end; k += step) {
    double here[2] = {share[0] - k, share[1] - k};
    gl_set_floats(program, "share", 2, here);
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
  if (!sum->settings.occluders || sum->kept) return end;
  int last_map = (int)slides->at[first][3] + sum->maps.room - 1;
  while ((int)slides->at[end - 1][3] > last_map) --end;
  return end;
}

/* Draws the maps of the views that are not there. Returns the group of layer 0. */
static int draw_maps(struct gl_sum *sum, const struct gl_slides *slides, int first, int end) {
  int map = (int)slides->at[first][3], layer = 0;
  if (!sum->kept) {
    gl_maps_draw(&sum->maps, slides, map, (int)slides->at[end - 1][3] - map + 1, 0);
    return map;
  }
  for (const struct gl_slides *page = sum->slides; page < slides; ++page) layer += page->groups;
  for (; first < end; ++first) {
    map = (int)slides->at[first][3];
    if (!slides->drawn[map]) gl_maps_draw(&sum->maps, slides, map, 1, layer + map);
    slides->drawn[map] = true;
  }
  return -layer;
}

static void add_page(struct gl_sum *sum, const struct gl_receivers *receivers, unsigned program,
                     const struct gl_slides *slides, const double share[2]) {
  int first = (int)floor(share[0]), end = (int)ceil(share[1]);
  for (int next; first < end; first = next) {
    next = find_end(sum, slides, first, end);
    int map = sum->settings.occluders ? draw_maps(sum, slides, first, next) : 0;
    use_target(sum, receivers, program);
    set_page(sum, slides, program);
    const struct gl_slides_array *array = slides->array;
    while (first >= array->first + array->count) ++array;
    gl_set_texture(program, "slides", SLIDES, GL_TEXTURE_2D_ARRAY, array->texture);
    if (sum->settings.occluders) gl_maps_set(&sum->maps, slides, map, program, MAPS);
    draw(sum, program, first, next, share);
  }
}

enum result gl_sum_add(struct gl_sum *sum, const struct gl_receivers *receivers, double from,
                       double to, bool gloss, struct error *error) {
  unsigned program;
  enum result result = choose(sum, gloss, &program, error);
  if (result != RESULT_OK) return result;
  choose_buffers(receivers, gloss);
  set_receivers(receivers, program);
  for (int page = 0; page < sum->pages; ++page) {
    const struct gl_slides *slides = &sum->slides[page];
    double share[2] = {from * slides->count, to * slides->count};
    if (!slides->behind) add_page(sum, receivers, program, slides, share);
  }
  glDisable(GL_BLEND);
  return gl_check("the sum over views", error);
}

void gl_sum_moved(struct gl_sum *sum, int light) {
  const struct gl_sum_settings *settings = &sum->settings;
  int number = light_pages(settings->lights, light);
  for (int k = 0; k < settings->lights[light].count; ++k) {
    struct gl_slides *slides = &sum->slides[number + k];
    vector_subtract(slides->page->center, sum->origin, slides->center);
    memset(slides->drawn, 0, (size_t)slides->groups * sizeof *slides->drawn);
  }
}
