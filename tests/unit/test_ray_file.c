/* test_ray_file.c - files of rays: what their headers and columns say is what is read, and what is
 * damaged is refused with its line or byte. */
#include <stdio.h>
#include <string.h>

#include "helpers.h"
#include "import/rays/ray_file.h"
#include "made_rays.h"

enum { MOST = 64 };

/* All rays of a file, in blocks of a size that does not divide their number. */
static enum result read_all(const char *path, const struct ray_format *format, double metres,
                            struct ray_file *file, struct ray *rays, size_t *count,
                            struct error *error) {
  static struct warnings notes;
  notes = (struct warnings){0};
  size_t got = 1;
  *count = 0;
  enum result result = ray_file_open(path, format, metres, &notes, file, error);
  if (result != RESULT_OK) return result;
  while (result == RESULT_OK && got > 0) {
    assert_true(*count + 3 <= MOST);
    result = ray_file_read(file, rays + *count, 3, &got, error);
    *count += got;
  }
  ray_file_close(file);
  return result;
}

static void assert_refuses(const char *path, const struct ray_format *format, const char *where,
                           const char *what) {
  struct ray rays[MOST];
  struct ray_file file;
  struct error error = {{0}};
  size_t count;
  assert_refused(read_all(path, format, 1, &file, rays, &count, &error), &error, path, where, what,
                 NULL);
}

/* What was read although it is not as it should be. */
static void assert_told(const struct ray_file *file, const char *piece) {
  bool told = false;
  for (int k = 0; k < warnings_kept(file->notes); ++k)
    told |= strstr(file->notes->lines[k], piece) != NULL;
  if (!told) fail_msg("'%s' is not told", piece);
}

static void assert_ray(const struct ray *ray, const double origin[3], const double direction[3],
                       const double flux[3]) {
  double length = 0;
  for (int c = 0; c < 3; ++c) length += direction[c] * direction[c];
  for (int c = 0; c < 3; ++c) {
    assert_near(ray->origin[c], origin[c], 1e-7 * fabs(origin[c]));
    assert_near(ray->direction[c], direction[c] / sqrt(length), 1e-7);
    assert_near(ray->flux[c], flux[c], 2e-6 * fabs(flux[1]));
  }
}

/* ---- TM-25 ---- */

static struct made_rays made;

TEST(test_tm25_watts) {
  struct ray rays[MOST];
  struct ray_file file;
  struct error error = {{0}};
  size_t count;
  made = (struct made_rays){0};
  made_tm25(&made, 4, "11100000");
  for (int k = 0; k < 4; ++k)
    made_floats(&made, 7, (const double[]){k, -2, 1e-3, 0.6, 0, -0.8, 1.25 * k});
  const char *path = made_write(&made, "w.tm25ray");
  assert_ok(read_all(path, &ray_format_tm25, 1, &file, rays, &count, &error), &error);
  assert_int_equal(count, 4);
  assert_false(file.lumens || file.coloured);
  assert_near(file.stated, 5, 0);
  assert_int_equal(file.notes->count, 0);
  for (int k = 0; k < 4; ++k)
    assert_ray(&rays[k], (const double[]){1e-3 * k, -2e-3, 1e-6}, (const double[]){3, 0, -4},
               (const double[]){1.25 * k, 1.25 * k, 1.25 * k});
}

/* Every column, tables, names and a text before the rays; X, Y, Z of the primaries and of white. */
TEST(test_tm25_columns) {
  static const double xyz[4][3] = {{0.4123908, 0.2126390, 0.0193308},
                                   {0.3575843, 0.7151687, 0.1191948},
                                   {0.1804808, 0.0721923, 0.9505322},
                                   {0.9504559, 1, 1.0890578}};
  static const double rgb[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  struct ray rays[MOST];
  struct ray_file file;
  struct error error = {{0}};
  size_t count;
  made = (struct made_rays){0};
  made_tm25(&made, 4, "11111110");
  made_over(&made, 4, 2020);
  made_over(&made, 76, 2);  /* tables */
  made_over(&made, 80, 2);  /* columns */
  made_over(&made, 84, 64); /* bytes of text */
  made_word(&made, 1), made_float(&made, 500), made_float(&made, 1);
  made_word(&made, 3), made_zeros(&made, 24);
  made_zeros(&made, 64 - 12 - 28); /* up to a multiple of 32 */
  made_zeros(&made, 2 * 512 + 64);
  for (int k = 0; k < 4; ++k) {
    made_floats(&made, 6, (const double[]){1, 2, 3, 0, 0, 1});
    made_floats(&made, 9, (const double[]){11, 555, xyz[k][1], 0, 0, 0, 1, 0, 0});
    made_floats(&made, 4, (const double[]){xyz[k][0], xyz[k][2], 77, 78});
  }
  const char *path = made_write(&made, "c.tm25ray");
  assert_ok(read_all(path, &ray_format_tm25, 1, &file, rays, &count, &error), &error);
  assert_int_equal(count, 4);
  assert_true(file.lumens && file.coloured);
  assert_near(file.stated, 7, 0);
  assert_told(&file, "luminous");
  assert_told(&file, "polarisation");
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c) assert_near(rays[k].flux[c], rgb[k][c], 1e-5);
}

/* With both fluxes the luminous one counts, but where the header does not know it. The bytes of its
 * NaN may be swapped. */
TEST(test_tm25_unknown_flux) {
  static const uint32_t unknown[] = {0, 0x7fc00001, 0x7f800001, 0x0100807f};
  struct ray rays[MOST];
  struct ray_file file;
  struct error error = {{0}};
  size_t count;
  for (int k = 0; k < 4; ++k) {
    made = (struct made_rays){0};
    made_tm25(&made, 1, "11101000");
    made_over(&made, 12, unknown[k]);
    made_over(&made, 16, unknown[k]);
    made_floats(&made, 8, (const double[]){0, 0, 0, 0, 0, 1, 0.5, 341.5});
    const char *path = made_write(&made, "u.tm25ray");
    assert_ok(read_all(path, &ray_format_tm25, 1, &file, rays, &count, &error), &error);
    assert_false(file.lumens);
    assert_true(isnan(file.stated));
    assert_near(rays[0].flux[1], 0.5, 0);
    made_over(&made, 12, 0x43000000); /* 128 lm */
    path = made_write(&made, "u.tm25ray");
    assert_ok(read_all(path, &ray_format_tm25, 1, &file, rays, &count, &error), &error);
    assert_true(file.lumens);
    assert_near(rays[0].flux[1], 341.5, 0);
  }
}

TEST(test_tm25_big_endian) {
  struct ray rays[MOST];
  struct ray_file file;
  struct error error = {{0}};
  size_t count;
  made = (struct made_rays){.big_endian = true};
  made_tm25(&made, 2, "11100000");
  for (int k = 0; k < 2; ++k) made_floats(&made, 7, (const double[]){1, 2, 3, 0, 1, 0, 0.25});
  const char *path = made_write(&made, "b.tm25ray");
  assert_ok(read_all(path, &ray_format_tm25, 1, &file, rays, &count, &error), &error);
  assert_int_equal(count, 2);
  assert_told(&file, "swapped");
  assert_ray(&rays[1], (const double[]){1e-3, 2e-3, 3e-3}, (const double[]){0, 1, 0},
             (const double[]){0.25, 0.25, 0.25});
}

/* A header that promises a table and names, and rays that begin right behind it. */
TEST(test_tm25_without_blocks) {
  struct ray rays[MOST];
  struct ray_file file;
  struct error error = {{0}};
  size_t count;
  made = (struct made_rays){0};
  made_tm25(&made, 2, "11100000");
  made_over(&made, 76, 1);
  for (int k = 0; k < 2; ++k) made_floats(&made, 7, (const double[]){1, 2, 3, 0, 1, 0, 0.25});
  const char *path = made_write(&made, "m.tm25ray");
  assert_ok(read_all(path, &ray_format_tm25, 1, &file, rays, &count, &error), &error);
  assert_int_equal(count, 2);
  assert_told(&file, "are not there");
  assert_near(rays[0].flux[1], 0.25, 0);
}

/* A file of three rays, with a word put somewhere, or bytes less or more. */
static const char *damaged(size_t at, uint32_t word, int more) {
  made = (struct made_rays){0};
  made_tm25(&made, 3, "11100000");
  for (int k = 0; k < 3; ++k) made_floats(&made, 7, (const double[]){1, 2, 3, 0, 1, 0, 0.25});
  made_over(&made, at, word);
  if (more < 0)
    made.size -= (size_t)-more;
  else
    made_zeros(&made, (size_t)more);
  return made_write(&made, "d.tm25ray");
}

TEST(test_tm25_refused) {
  const struct ray_format *format = &ray_format_tm25;
  const uint32_t nan = 0x7fc00000, minus = 0xbf800000, huge = 0x7149f2ca;
  assert_refuses(damaged(4, 2014, 0), format, "byte 4", "version 2014");
  assert_refuses(damaged(20, 0, 0), format, "byte 20", "promises no rays");
  assert_refuses(damaged(20, 1000000000, 0), format, "byte 36372", "ray 4 of the 1000000000");
  assert_refuses(damaged(24, 0xffffffff, 0), format, "byte 36372", "ray 4 of");
  assert_refuses(damaged(20, 2, 0), format, "byte 36344", "goes on after the 2 rays");
  assert_refuses(damaged(4, 2013, -1), format, "byte 36371", "ray 3 of the 3");
  assert_refuses(damaged(4, 2013, 1), format, "byte 36372", "goes on after");
  assert_refuses(damaged(4, 2013, -36272), format, "byte 100", "header");
  assert_refuses(damaged(4, 2013, -30000), format, "byte 6372", "within its header");
  assert_refuses(damaged(76, 1000000000, 0), format, "byte 76", "spectral tables");
  assert_refuses(damaged(80, 0x80000000, 0), format, "byte 80", "additional columns");
  assert_refuses(damaged(84, 0xffffffff, 1), format, "byte 36373", "within its header");
  assert_refuses(damaged(256, 0, 0), format, "byte 256", "no place");
  assert_refuses(damaged(264, 0, 0), format, "byte 264", "no flux");
  assert_refuses(damaged(272, 7, 0), format, "byte 272", "flag");
  assert_refuses(damaged(36288 + 28 + 4, nan, 0), format, "byte 36316 (ray 2)", "not finite");
  assert_refuses(damaged(36288 + 16, 0, 0), format, "byte 36288 (ray 1)", "without direction");
  assert_refuses(damaged(36288 + 24, minus, 0), format, "(ray 1)", "flux of -1");
  assert_refuses(damaged(36288 + 28, huge, 0), format, "byte 36316 (ray 2)", "within 1e+09 m");
  assert_refuses(damaged(36288 + 24, huge, 0), format, "byte 36288 (ray 1)", "at most 1e+15");
  /* A table that is not there, in a file whose rays do not begin right behind the header. */
  made_over(&made, 36288 + 24, 0);
  made_over(&made, 76, 1);
  made_zeros(&made, 28 * 4);
  made_over(&made, 20, 6);
  assert_refuses(made_write(&made, "d.tm25ray"), format, "byte 36288", "table 1 of 1");
}

/* ---- Zemax ---- */

TEST(test_zemax) {
  static const double metres[] = {1, 0.0254, 0.01, 0.3048, 0.001};
  struct ray rays[MOST];
  struct ray_file file;
  struct error error = {{0}};
  size_t count;
  for (uint32_t k = 0; k < 10; ++k) {
    bool wavelengths = k % 2, lumens = k == 4;
    made = (struct made_rays){.big_endian = k > 7};
    made_zemax(&made, 5, k % 5, wavelengths ? 2 : 0, lumens);
    for (int n = 0; n < 5; ++n)
      made_floats(&made, wavelengths ? 8 : 7, (const double[]){n, 2, 3, 0, 0, 2, 0.5, 0.55});
    if (k == 3) made_over(&made, 0, 8675309);
    const char *path = made_write(&made, "z.sdf");
    assert_ok(read_all(path, &ray_format_zemax, 1, &file, rays, &count, &error), &error);
    assert_int_equal(count, 5);
    assert_true(file.lumens == lumens);
    assert_near(file.stated, 6, 0);
    if (wavelengths) assert_told(&file, "wavelengths");
    if (made.big_endian) assert_told(&file, "swapped");
    double unit = metres[k % 5];
    for (int n = 0; n < 5; ++n)
      assert_ray(&rays[n], (const double[]){unit * n, unit * 2, unit * 3},
                 (const double[]){0, 0, 1}, (const double[]){0.5, 0.5, 0.5});
  }
}

TEST(test_zemax_refused) {
  const struct ray_format *format = &ray_format_zemax;
  static const struct {
    uint32_t rays, unit, type, flux;
    const char *where, *what;
  } cases[] = {{0, 4, 0, 0, "byte 4", "promises no rays"},
               {(uint32_t)-5, 4, 0, 0, "byte 4", "promises -5 rays"},
               {2, 4, 0, 0, "byte 236", "goes on after the 2"},
               {1, 4, 2, 0, "byte 236", "ray 1 of the 1"},
               {1000000000, 4, 0, 0, "byte 236", "ray 2 of the 1000000000"},
               {1, 5, 0, 0, "byte 136", "unit of length 5"},
               {1, 4, 1, 0, "byte 192", "type 1"},
               {1, 4, 0, 2, "byte 196", "type 2"},
               {1, 4, 2, 1, "byte 196", "type 1"}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    made = (struct made_rays){0};
    made_zemax(&made, cases[k].rays == 2 ? 1 : cases[k].rays, cases[k].unit, cases[k].type,
               cases[k].flux);
    made_floats(&made, 7, (const double[]){0, 0, 0, 0, 0, 1, 1});
    if (cases[k].rays == 2) made_zeros(&made, 1);
    assert_refuses(made_write(&made, "z.sdf"), format, cases[k].where,
                   cases[k].rays == 2 ? "goes on after the 1" : cases[k].what);
  }
  made.size = 207;
  assert_refuses(made_write(&made, "z.sdf"), format, "byte 207", "header");
}

/* ---- Text ---- */

static const char *written(const char *text) {
  const char *path = scratch("t.txt");
  write_bytes(path, text, strlen(text));
  return path;
}

TEST(test_text) {
  struct ray rays[MOST];
  struct ray_file file;
  struct error error = {{0}};
  size_t count;
  const char *path = written("# a lamp\r\n\r\n 1 -2 3e0\t0 0 -5 0.25 # its first ray\r\n"
                             "#\n0 0 0 1 1 0 .5\n   \n+0 -0 0 0 0x1p-3 0 0");
  assert_ok(read_all(path, &ray_format_text, 0.001, &file, rays, &count, &error), &error);
  assert_int_equal(count, 3);
  assert_ray(&rays[0], (const double[]){1e-3, -2e-3, 3e-3}, (const double[]){0, 0, -1},
             (const double[]){0.25, 0.25, 0.25});
  assert_ray(&rays[1], (const double[]){0, 0, 0}, (const double[]){1, 1, 0},
             (const double[]){0.5, 0.5, 0.5});
  assert_near(rays[2].flux[0], 0, 0);
  /* Directions so long that their square overflows, or so short that it vanishes. */
  path = written("0 0 0 1e300 1e300 0 1\n0 0 0 0 -1e-300 0 1\n");
  assert_ok(read_all(path, &ray_format_text, 1, &file, rays, &count, &error), &error);
  assert_near(rays[0].direction[0], sqrt(0.5), 1e-15);
  assert_near(rays[1].direction[1], -1, 0);
}

TEST(test_text_refused) {
  static char longer[5000];
  const struct ray_format *format = &ray_format_text;
  assert_refuses(written("0 0 0 0 0 1 1\n0 0 0 0 0 1\n"), format, "line 2", "seven");
  assert_refuses(written("\n0 0 0 0 0 1 1 1\n"), format, "line 2", "seven");
  assert_refuses(written("0 0 0 0 0 1 nan\n"), format, "line 1", "finite");
  assert_refuses(written("0 0 0 0 0 1 1e999\n"), format, "line 1", "finite");
  assert_refuses(written("0 0 0 0 0 1 1,5\n"), format, "line 1", "seven");
  assert_refuses(written("# x\n0 0 0 0 0 0 1\n"), format, "line 2", "without direction");
  assert_refuses(written("0 0 0 0 0 1 -1\n"), format, "line 1", "flux of -1");
  assert_refuses(written("9 4 0 0 0 0 0\n"), format, "line 1", "Zemax");
  assert_refuses(written("#\n0 1e200 0 0 0 1 1\n"), format, "line 2", "at 1e+200 m");
  assert_refuses(written("0 0 0 0 0 1 1e20\n"), format, "line 1", "flux of 1e+20");
  memset(longer, '1', sizeof longer - 1);
  assert_refuses(written(longer), format, "line 1", "characters");
  write_bytes(scratch("n.txt"), "0 0 0 0 0 1 1\n0 0\0 0 0 0 1 1\n", 29);
  assert_refuses(scratch("n.txt"), format, "line 2", "not text");
}

TEST(test_no_file) {
  assert_refuses(scratch("gone"), &ray_format_text, "gone", "No such file");
  assert_refuses("/dev/null", &ray_format_text, "/dev/null", "no regular file");
}

/* Kinds are known by their first bytes. */
TEST(test_kinds) {
  static const char *const texts[] = {"# c\n\n 1 2 3",    "1 2", "#",    "",
                                      "IESNA:LM-63\n1 2", "1",   "x 1 2"};
  static const bool is_text[] = {true, true, true, false, false, false, false};
  for (int k = 0; k < 7; ++k) {
    assert_true(ray_format_text.is(texts[k], strlen(texts[k])) == is_text[k]);
    assert_false(ray_format_tm25.is(texts[k], strlen(texts[k])));
    assert_false(ray_format_zemax.is(texts[k], strlen(texts[k])));
  }
  assert_true(ray_format_tm25.is("TM25\0", 5));
  assert_true(ray_format_zemax.is("\xf2\x03\0\0", 4) && ray_format_zemax.is("\0\0\x03\xf2", 4));
  assert_false(ray_format_zemax.is("\xf2\x03\0", 3) || ray_format_text.is("1 2\0 3", 6));
}

int main(void) {
  return testing_run(NULL, NULL);
}
