#include "picture/picture_tile.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/numbers.h"
#include "base/output.h"
#include "base/version.h"
#include "file/json_text.h"
#include "file/slab_exr.h"
#include "file/slab_raster.h"
#include "light/light.h"
#include "scene/scene.h"

static const char attribute[] = "tile";

bool picture_tile_rows(int height, int number, int count, int *first, int *end) {
  int rows = height / IMAGE_TILE + (height % IMAGE_TILE != 0);
  *first = (int)((int64_t)rows * (number - 1) / count);
  *end = (int)((int64_t)rows * number / count);
  return count <= rows;
}

/* ---- The key ---- */

static XXH128_hash_t add(XXH128_hash_t hash, const void *bytes, size_t size) {
  const XXH128_hash_t both[2] = {hash, size > 0 ? XXH3_128bits(bytes, size) : hash};
  return XXH3_128bits(both, sizeof both);
}

static XXH128_hash_t add_scene(XXH128_hash_t hash, const struct scene *scene) {
  hash = add(hash, scene->position, scene->vertices * sizeof *scene->position);
  hash = add(hash, scene->normal, scene->vertices * sizeof *scene->normal);
  hash = add(hash, scene->uv, scene->vertices * sizeof *scene->uv);
  hash = add(hash, scene->corners, scene->triangles * sizeof *scene->corners);
  hash = add(hash, scene->material, scene->triangles * sizeof *scene->material);
  for (int k = 0; k < scene->material_count; ++k) {
    const struct scene_material *material = &scene->materials[k];
    hash = add(hash, material->diffuse, sizeof material->diffuse);
    hash = add(hash, material->specular, sizeof material->specular);
    hash = add(hash, &material->shininess, sizeof material->shininess);
    hash = add(hash, material->emission, sizeof material->emission);
    hash = add(hash, &material->texture, sizeof material->texture);
  }
  for (int k = 0; k < scene->texture_count; ++k) {
    const struct picture *picture = &scene->textures[k].picture;
    hash = add(hash, &picture->width, sizeof picture->width);
    hash = add(hash, picture->rgb,
               3 * sizeof *picture->rgb * (size_t)picture->width * (size_t)picture->height);
  }
  return hash;
}

static XXH128_hash_t add_light(XXH128_hash_t hash, const struct light *light) {
  hash = add(hash, light->gain, sizeof light->gain);
  hash = add(hash, light->matrix, sizeof light->matrix);
  for (int k = 0; k < light->count; ++k) {
    const struct light_page *page = &light->pages[k];
    hash = add(hash, page->center, sizeof page->center);
    hash = add(hash, page->frame, sizeof page->frame);
    hash = add(hash, &page->gain, sizeof page->gain);
    hash = add(hash, page->slab.samples, sizeof page->slab.samples);
    hash = add(hash, page->slab.st_window, sizeof page->slab.st_window);
    hash = add(hash, &page->slab.st_distance, sizeof page->slab.st_distance);
    hash = add(hash, page->slab.rgb, 3 * sizeof *page->slab.rgb * slab_sample_count(&page->slab));
  }
  return hash;
}

void picture_tile_key(const struct image_settings *settings, char key[33]) {
  const struct shade *shade = &settings->shade;
  const struct gather_settings *gather = &settings->gather;
  const struct camera *camera = &shade->camera;
  const int whole[] = {shade->width,        shade->height,       settings->samples,
                       (int)gather->method, gather->level,       gather->occlusion != NULL,
                       gather->shadow_grid, gather->shadow_edge, gather->all_effects};
  const double real[] = {gather->tolerance, camera->fov};
  XXH128_hash_t hash = XXH3_128bits(CANNED_VERSION, sizeof CANNED_VERSION);
  hash = add(hash, whole, sizeof whole);
  hash = add(hash, real, sizeof real);
  hash = add(hash, &gather->seed, sizeof gather->seed);
  hash = add(hash, camera->from, sizeof camera->from);
  hash = add(hash, camera->at, sizeof camera->at);
  hash = add(hash, camera->up, sizeof camera->up);
  hash = add(hash, shade->background, sizeof shade->background);
  hash = add_scene(hash, shade->scene);
  for (int k = 0; k < shade->light_count; ++k) hash = add_light(hash, &shade->lights[k]);
  snprintf(key, 33, "%016llx%016llx", (unsigned long long)hash.high64,
           (unsigned long long)hash.low64);
}

/* ---- Writing ---- */

static json_t *number(double x) {
  return isfinite(x) ? json_real(x) : json_null();
}

static enum result describe(const struct picture_tile *tile, char **text, struct error *error) {
  const struct gather_counts *counts = &tile->counts;
  unsigned long mark = json_mark();
  json_t *object = json_pack(
      "{s:i, s:i, s:i, s:i, s:i, s:i, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:o, s:f, s:f}",
      "tile", tile->number, "tiles", tile->count, "width", tile->width, "height", tile->height,
      "top", tile->top, "end", tile->end, "picture", tile->key, "receivers",
      (json_int_t)counts->receivers, "microlights", (json_int_t)counts->microlights, "nodes",
      (json_int_t)counts->nodes, "black_microlights", (json_int_t)counts->black, "shadow_rays",
      (json_int_t)counts->shadow_rays, "open_views", (json_int_t)counts->open_views, "pages_behind",
      (json_int_t)counts->pages_behind, "error_estimate", number(counts->error), "seconds",
      tile->seconds, "luminance", tile->luminance);
  enum result result = json_text(object, mark, JSON_COMPACT, text, error);
  json_decref(object);
  return result;
}

enum result picture_tile_write(const char *path, const struct picture_tile *tile,
                               const struct picture *picture, struct error *error) {
  size_t skipped = 3 * (size_t)picture->width * (size_t)tile->top;
  struct slab_raster parts[2] = {{.width = picture->width,
                                  .height = tile->end - tile->top,
                                  .precision = SLAB_PRECISION_FLOAT,
                                  .rgb = picture->rgb + skipped}};
  struct output output = {0};
  enum result result = describe(tile, &parts[0].text, error);
  parts[1] = parts[0];
  parts[1].rgb = picture->error + skipped;
  if (result == RESULT_OK) result = output_begin(&output, path, error);
  if (result == RESULT_OK) result = slab_exr_write_parts(&output, parts, 2, attribute, error);
  if (result == RESULT_OK) result = output_commit(&output, error);
  output_abandon(&output);
  free(parts[0].text);
  return result;
}

/* ---- Reading ---- */

/* What a file says of itself; its size is right. */
static bool parse(const char *text, const struct slab_raster *raster, struct picture_tile *tile) {
  json_t *object = NULL, *estimate = NULL;
  const char *key = "";
  json_int_t n[7];
  bool good = text && json_read(text, 0, &object, NULL) == RESULT_OK &&
              json_unpack(object,
                          "{s:i, s:i, s:i, s:i, s:i, s:i, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:I, "
                          "s:o, s:F, s:F}",
                          "tile", &tile->number, "tiles", &tile->count, "width", &tile->width,
                          "height", &tile->height, "top", &tile->top, "end", &tile->end, "picture",
                          &key, "receivers", &n[0], "microlights", &n[1], "nodes", &n[2],
                          "black_microlights", &n[3], "shadow_rays", &n[4], "open_views", &n[5],
                          "pages_behind", &n[6], "error_estimate", &estimate, "seconds",
                          &tile->seconds, "luminance", &tile->luminance) == 0;
  int first = 0, end = 0;
  good = good && strlen(key) == 32 && tile->width == raster->width &&
         tile->width <= NUMBERS_MOST_SIZE && tile->height > 0 &&
         tile->height <= NUMBERS_MOST_SIZE && tile->count > 0 && tile->number > 0 &&
         tile->number <= tile->count &&
         picture_tile_rows(tile->height, tile->number, tile->count, &first, &end) &&
         tile->top == first * IMAGE_TILE && tile->end - tile->top == raster->height &&
         (tile->end == end * IMAGE_TILE || tile->end == tile->height);
  if (good) {
    snprintf(tile->key, sizeof tile->key, "%s", key);
    tile->counts = (struct gather_counts){
        (uint64_t)n[0], (uint64_t)n[1],
        (uint64_t)n[2], (uint64_t)n[3],
        (uint64_t)n[4], (uint64_t)n[5],
        (uint64_t)n[6], json_is_number(estimate) ? json_number_value(estimate) : INFINITY};
  }
  json_decref(object);
  return good;
}

/* Opens a tile. */
static enum result open_tile(const char *path, struct slab_exr **exr, struct picture_tile *tile,
                             struct error *error) {
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  enum result result = slab_exr_open(file, path, attribute, exr, error);
  if (result != RESULT_OK) return result;
  const struct slab_raster *raster = slab_exr_part(*exr, 0);
  if (slab_exr_parts(*exr) == 2 && parse(raster->text, raster, tile) &&
      slab_exr_part(*exr, 1)->width == raster->width &&
      slab_exr_part(*exr, 1)->height == raster->height)
    return RESULT_OK;
  slab_exr_close(*exr);
  *exr = NULL;
  return result_fail(error, RESULT_BAD,
                     "%s: is no tile of a picture; write them by renderslab image --tile K/N",
                     path);
}

static enum result read_part(struct slab_exr *exr, int part, const struct picture_tile *tile,
                             float *rgb, struct error *error) {
  const struct slab_raster *raster = slab_exr_part(exr, part);
  const struct slab_area all = {0, 0, raster->width, raster->height};
  float *block = calloc(slab_raster_block_pixels(raster), 3 * sizeof *block);
  enum result result = block ? RESULT_OK : result_no_memory(error);
  for (int row = 0; row < slab_raster_rows(raster); ++row)
    for (int column = 0; column < slab_raster_columns(raster) && result == RESULT_OK; ++column) {
      result = slab_exr_read_block(exr, part, column, row, block, error);
      if (result == RESULT_OK)
        slab_raster_copy(raster, column, row, block, &all,
                         rgb + 3 * (size_t)tile->width * (size_t)tile->top);
    }
  free(block);
  return result;
}

/* ---- Joining ---- */

static enum result check_same(const char *path, const struct picture_tile *tile,
                              const char *first_path, const struct picture_tile *first,
                              const bool *there, struct error *error) {
  if (strcmp(tile->key, first->key) != 0)
    return result_fail(error, RESULT_BAD,
                       "%s: is a tile of another picture than %s: other options, scene, slabs or "
                       "version",
                       path, first_path);
  if (tile->count != first->count)
    return result_fail(error, RESULT_BAD, "%s: is one of %d tiles, %s one of %d", path, tile->count,
                       first_path, first->count);
  if (there[tile->number])
    return result_fail(error, RESULT_BAD, "%s: tile %d is given twice", path, tile->number);
  return RESULT_OK;
}

/* Refuses where a tile is missing, and names the first one. */
static enum result check_all(const struct picture_tile *sum, const bool *there,
                             struct error *error) {
  int missing = 0, first = 0;
  for (int k = sum->count; k > 0; --k)
    if (!there[k]) ++missing, first = k;
  if (missing == 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%d of the %d tiles are missing: tile %d%s", missing,
                     sum->count, first, missing > 1 ? " and others" : "");
}

static enum result allocate(const struct picture_tile *tile, struct picture *picture, bool **there,
                            struct error *error) {
  size_t pixels = (size_t)tile->width * (size_t)tile->height;
  *picture = (struct picture){.width = tile->width,
                              .height = tile->height,
                              .rgb = calloc(pixels, 3 * sizeof *picture->rgb),
                              .error = calloc(pixels, 3 * sizeof *picture->error)};
  *there = calloc((size_t)tile->count + 1, sizeof **there);
  if (picture->rgb && picture->error && *there) return RESULT_OK;
  return result_fail(error, RESULT_MEMORY, "out of memory for a picture of %dx%d", tile->width,
                     tile->height);
}

enum result picture_tile_join(const char *const *paths, int count, struct picture *picture,
                              struct picture_tile *sum, struct error *error) {
  enum result result = RESULT_OK;
  bool *there = NULL;
  *picture = (struct picture){0};
  for (int n = 0; n < count && result == RESULT_OK; ++n) {
    struct slab_exr *exr = NULL;
    struct picture_tile tile = {0};
    result = open_tile(paths[n], &exr, &tile, error);
    if (result == RESULT_OK && n == 0) {
      *sum = tile;
      sum->counts = (struct gather_counts){0};
      sum->seconds = 0;
      result = allocate(&tile, picture, &there, error);
    }
    if (result == RESULT_OK) result = check_same(paths[n], &tile, paths[0], sum, there, error);
    if (result == RESULT_OK) result = read_part(exr, 0, &tile, picture->rgb, error);
    if (result == RESULT_OK) result = read_part(exr, 1, &tile, picture->error, error);
    if (result == RESULT_OK) {
      there[tile.number] = true;
      gather_counts_add(&sum->counts, &tile.counts);
      sum->seconds += tile.seconds;
    }
    slab_exr_close(exr);
  }
  if (result == RESULT_OK && there) result = check_all(sum, there, error);
  free(there);
  if (result != RESULT_OK) picture_free(picture);
  return result;
}
