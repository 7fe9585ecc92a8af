/* sheet_image.c - the image of a sheet: where the tiles of all levels lie, and
 * what they show. */
#include "include/sheet/sheet.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { CHECK_SIZE = 3 };

/* Texels, before the size of the image is known to fit. */
struct extent {
  long long width, height;
};

static struct extent level_extent(const struct sheet_level *level) {
  const int *samples = level->views.samples;
  return (struct extent){(long long)samples[SLAB_U] * (samples[SLAB_S] + 2 * SHEET_RING),
                         (long long)samples[SLAB_V] * (samples[SLAB_T] + 2 * SHEET_RING)};
}

static long long larger(long long x, long long y) {
  return x > y ? x : y;
}

/* Pages stand on each other; within a page the finest level lies at the left
 * and the others in a column at its right. The check texels stand on top. */
static struct extent place_levels(struct sheet *sheet) {
  struct extent image = {CHECK_SIZE, 0};
  for (int p = 0; p < sheet->page_count; ++p) {
    struct sheet_page *page = &sheet->pages[p];
    struct extent finest = level_extent(&page->levels[0]);
    long long column = 0;
    for (int k = 0; k < page->level_count; ++k) {
      struct extent level = level_extent(&page->levels[k]);
      page->levels[k].left = k ? (int)finest.width : 0;
      page->levels[k].bottom = (int)(image.height + (k ? column : 0));
      if (k) column += level.height;
      image.width = larger(image.width, (k ? finest.width : 0) + level.width);
    }
    image.height += larger(finest.height, column);
  }
  image.height += CHECK_SIZE;
  return image;
}

static float *texel(const struct picture *picture, int x, int y) {
  return picture->rgb +
         3 * ((size_t)(picture->height - 1 - y) * (size_t)picture->width + (size_t)x);
}

static int clamp(int index, int count) {
  return index < 0 ? 0 : index >= count ? count - 1 : index;
}

static void paint_tile(const struct sheet_level *level, int i, int j,
                       const struct picture *picture) {
  const struct slab *views = &level->views;
  int ns = views->samples[SLAB_S], nt = views->samples[SLAB_T];
  int left = level->left + i * (ns + 2 * SHEET_RING);
  int bottom = level->bottom + j * (nt + 2 * SHEET_RING);
  for (int l = -SHEET_RING; l < nt + SHEET_RING; ++l)
    for (int k = -SHEET_RING; k < ns + SHEET_RING; ++k) {
      const float *from = slab_at(views, i, j, clamp(k, ns), clamp(l, nt));
      float *to = texel(picture, left + SHEET_RING + k, bottom + SHEET_RING + l);
      for (int c = 0; c < 3; ++c) to[c] = (float)(from[c] / level->peak);
    }
}

/* What the image and the numbers of the include hold. */
static uint64_t stamp_of(const struct sheet *sheet) {
  const struct picture *picture = &sheet->picture;
  uint64_t hash =
      include_hash(include_hash_start, picture->rgb,
                   3 * sizeof(float) * (size_t)picture->width * (size_t)picture->height);
  for (int p = 0; p < sheet->page_count; ++p)
    for (int k = 0; k < sheet->pages[p].level_count; ++k) {
      const struct sheet_level *level = &sheet->pages[p].levels[k];
      const struct slab *slab = &level->views;
      hash = include_hash(hash, slab->samples, sizeof slab->samples);
      hash = include_hash(hash, slab->center, sizeof slab->center);
      hash = include_hash(hash, slab->u, sizeof slab->u);
      hash = include_hash(hash, slab->v, sizeof slab->v);
      hash = include_hash(hash, slab->normal, sizeof slab->normal);
      hash = include_hash(hash, slab->st_window, sizeof slab->st_window);
      hash = include_hash(hash, &slab->st_distance, sizeof slab->st_distance);
      hash = include_hash(hash, &level->peak, sizeof level->peak);
    }
  return hash;
}

/* The include looks at these texels before it trusts the image: the first
 * value tells whether POV-Ray changed its gamma, the others whether it is the
 * image that was written together with the include. Both are exact in half. */
static void paint_check(struct sheet *sheet) {
  struct picture *picture = &sheet->picture;
  struct include_check *check = &sheet->lamp.check;
  uint64_t hash = sheet->lamp.stamp;
  const float rgb[3] = {0.25f, 0.25f + (float)(hash >> 56) / 1024,
                        0.25f + (float)(hash >> 48 & 0xff) / 1024};
  int bottom = picture->height - CHECK_SIZE;
  for (int y = 0; y < CHECK_SIZE; ++y)
    for (int x = 0; x < CHECK_SIZE; ++x) memcpy(texel(picture, x, bottom + y), rgb, sizeof rgb);
  for (int c = 0; c < 3; ++c) check->rgb[c] = (double)rgb[c];
  check->at[0] = CHECK_SIZE / 2.0 / picture->width;
  check->at[1] = (bottom + CHECK_SIZE / 2.0) / picture->height;
}

enum result sheet_paint(struct sheet *sheet, struct error *error) {
  struct extent image = place_levels(sheet);
  /* POV-Ray keeps 16 bytes a texel; beyond this it is of no use to anyone. */
  if (image.width > SHRT_MAX || image.height > SHRT_MAX)
    return result_fail(error, RESULT_BAD,
                       "the sheet's image would be %lld x %lld texels, more than %d; allow fewer "
                       "lights with --lights, or convert the slab to fewer samples",
                       image.width, image.height, SHRT_MAX);
  struct picture *picture = &sheet->picture;
  picture->rgb = calloc((size_t)(image.width * image.height), 3 * sizeof *picture->rgb);
  if (!picture->rgb)
    return result_fail(error, RESULT_MEMORY, "out of memory for the sheet's image");
  picture->width = (int)image.width;
  picture->height = (int)image.height;
  for (int p = 0; p < sheet->page_count; ++p)
    for (int k = 0; k < sheet->pages[p].level_count; ++k) {
      const struct sheet_level *level = &sheet->pages[p].levels[k];
      for (int j = 0; j < level->views.samples[SLAB_V]; ++j)
        for (int i = 0; i < level->views.samples[SLAB_U]; ++i) paint_tile(level, i, j, picture);
    }
  sheet->lamp.stamp = stamp_of(sheet);
  paint_check(sheet);
  return RESULT_OK;
}
