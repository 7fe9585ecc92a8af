#include "export/export_rays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "base/sdl.h"
#include "export/ray_draw.h"

typedef void put_rays(const struct ray_draw *draw, const struct slab *slab,
                      const struct export_wish *wish, FILE *out);

static void put_text(const struct ray_draw *draw, const struct slab *slab,
                     const struct export_wish *wish, FILE *out) {
  fprintf(out, "# %d rays of a lamp, drawn by their luminance, of %.9g %s in all.\n# Made by: ",
          wish->rays, ray_draw_flux(draw), slab_flux_unit(slab));
  sdl_comment(wish->command, out);
  fprintf(out, "\n# x y z (m), direction, flux; left-handed, y up\n");
  for (uint64_t k = 0; k < (uint64_t)wish->rays; ++k) {
    double ray[7];
    ray_draw_ray(draw, k, ray);
    for (int n = 0; n < 7; ++n) fprintf(out, "%.9g%c", ray[n], n < 6 ? ' ' : '\n');
  }
}

static void put_word(uint32_t word, FILE *out) {
  for (int k = 0; k < 4; ++k) putc((int)(word >> 8 * k & 255), out);
}

static void put_float(double value, FILE *out) {
  float number = (float)value;
  uint32_t word;
  memcpy(&word, &number, sizeof word);
  put_word(word, out);
}

static void put_zeros(int count, FILE *out) {
  while (count-- > 0) putc(0, out);
}

/* Sections 4.7.1 to 4.7.3: 256 bytes, eight flags, nine texts of 1000 UTF-32 characters. */
static void put_tm25(const struct ray_draw *draw, const struct slab *slab,
                     const struct export_wish *wish, FILE *out) {
  enum { FLAGS = 8, TEXTS = 9, TEXT = 1000 };
  bool lumens = !strcmp(slab->radiance_unit, "cd/m2");
  fputs("TM25", out);
  put_word(2013, out);
  put_word(0, out); /* simulated */
  put_float(lumens ? ray_draw_flux(draw) : (double)NAN, out);
  put_float(lumens ? (double)NAN : ray_draw_flux(draw), out);
  put_word((uint32_t)wish->rays, out);
  put_word(0, out);
  put_zeros(28, out);       /* not dated, so that the same lamp gives the same bits */
  put_word(3, out);         /* rays start on a plane */
  put_zeros(256 - 60, out); /* no spectra, columns or text */
  const bool flags[FLAGS] = {true, true, !lumens, false, lumens};
  for (int k = 0; k < FLAGS; ++k) put_word(flags[k], out);
  for (int k = 0; k < TEXTS; ++k) {
    const char *text = k == 0 ? wish->name : k == 1 ? "bakeslab" : "";
    int length = (int)strnlen(text, TEXT - 1);
    for (const char *at = text; at < text + length; ++at)
      put_word((unsigned char)*at < 128 ? (unsigned char)*at : '?', out);
    put_zeros(4 * (TEXT - length), out);
  }
  for (uint64_t k = 0; k < (uint64_t)wish->rays; ++k) {
    double ray[7];
    ray_draw_ray(draw, k, ray);
    for (int n = 0; n < 7; ++n) put_float(n < 3 ? 1000 * ray[n] : ray[n], out);
  }
}

static enum result write_rays(const struct slab *slabs, int count, const struct export_wish *wish,
                              const char *path, put_rays *put, struct error *error) {
  struct ray_draw *draw = NULL;
  char *text = NULL;
  size_t size = 0;
  FILE *out = NULL;
  enum result result = RESULT_OK;
  for (int k = 1; k < count && result == RESULT_OK; ++k)
    if (strcmp(slabs[k].radiance_unit, slabs[0].radiance_unit) != 0)
      result =
          result_fail(error, RESULT_BAD, "pages 1 and %d have different units of radiance", k + 1);
  if (result == RESULT_OK)
    result = ray_draw_open(slabs, count, (uint64_t)wish->rays, (uint64_t)wish->seed, &draw, error);
  if (result == RESULT_OK && !(out = open_memstream(&text, &size)))
    result = result_no_memory(error);
  if (out) put(draw, &slabs[0], wish, out);
  if (out && (fclose(out) != 0 || !text)) result = result_no_memory(error);
  if (result == RESULT_OK) result = output_text(path, text, size, error);
  if (result == RESULT_OK)
    warnings_add(wish->notes, "%d rays of %.6g %s; colours are lost", wish->rays,
                 ray_draw_flux(draw), slab_flux_unit(&slabs[0]));
  free(text);
  ray_draw_close(draw);
  return result;
}

enum result export_rays(const struct slab *slabs, int count, const struct export_wish *wish,
                        const char *path, struct error *error) {
  return write_rays(slabs, count, wish, path, put_text, error);
}

enum result export_tm25(const struct slab *slabs, int count, const struct export_wish *wish,
                        const char *path, struct error *error) {
  return write_rays(slabs, count, wish, path, put_tm25, error);
}
