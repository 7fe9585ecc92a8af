/* test_pages.c - lamps for Mitsuba and Blender: rays into them against `bakeslab lookup`, by a
 * reader of NAME.json, its pictures and NAME.xml that knows only light-slab(5) and how a rectangle
 * of Mitsuba is placed; and by Mitsuba and Cycles themselves where python3 has their modules
 * (MITSUBA_PYTHON, BLENDER_PYTHON: another python3). */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "file/slab_exr.h"
#include "lamps.h"
#include "oracle/lookup.h"
#include "oracle/random.h"
#include "testing.h"

enum { RAYS = 4000 };

/* A page as the files tell it; its frame: u, v, normal, center, in whatever space. */
struct page {
  struct slab slab;
  double frame[4][3];
};

static double rays[RAYS][6], there[RAYS][6], wanted[RAYS][3], got[RAYS][3];

static double number(const json_t *page, const char *key, size_t k) {
  const json_t *value = json_array_get(json_object_get(page, key), k);
  assert_true(json_is_number(value));
  return json_number_value(value);
}

static void read_page(const char *folder, const json_t *json, struct page *page) {
  static const char *const keys[4] = {"u", "v", "normal", "center"};
  char path[512];
  struct picture picture = {0};
  const json_t *distance = json_object_get(json, "st_distance");
  page->slab = slab_default();
  snprintf(path, sizeof path, "%s/%s", folder, json_string_value(json_object_get(json, "image")));
  assert_int_equal(slab_exr_read(path, &picture, NULL), RESULT_OK);
  for (size_t k = 0; k < 4; ++k) {
    page->slab.samples[k] = (int)number(json, "samples", k);
    page->slab.st_window[k] = number(json, "st_window", k);
    for (size_t c = 0; c < 3; ++c) page->frame[k][c] = number(json, keys[k], c);
  }
  for (size_t c = 0; c < 3; ++c) {
    page->slab.u[c] = page->frame[0][c];
    page->slab.v[c] = page->frame[1][c];
  }
  page->slab.st_distance = json_is_number(distance) ? json_number_value(distance) : INFINITY;
  assert_int_equal(picture.width, page->slab.samples[0] * page->slab.samples[2]);
  assert_int_equal(picture.height, page->slab.samples[1] * page->slab.samples[3]);
  page->slab.rgb = picture.rgb;
}

static int read_pages(const char *folder, const char *name, struct page pages[LAMP_PAGES]) {
  char path[512];
  snprintf(path, sizeof path, "%s/%s.json", folder, name);
  json_t *root = json_load_file(path, 0, NULL);
  assert_string_equal(json_string_value(json_object_get(root, "format")), "light-slab-pages");
  const json_t *array = json_object_get(root, "pages");
  int count = (int)json_array_size(array);
  assert_in_range(count, 1, LAMP_PAGES);
  for (int k = 0; k < count; ++k) read_page(folder, json_array_get(array, (size_t)k), &pages[k]);
  json_decref(root);
  return count;
}

/* Puts the frames of NAME.xml in place: the columns of each matrix are u/2, v/2, normal, center. */
static void read_xml(const char *folder, const char *name, struct page *pages, int count) {
  static const double scale[4] = {2, 2, 1, 1};
  static const char before[] = "<matrix value=\"";
  char path[512], line[1024];
  int page = 0;
  snprintf(path, sizeof path, "%s/%s.xml", folder, name);
  FILE *file = fopen(path, "r");
  assert_non_null(file);
  while (fgets(line, sizeof line, file)) {
    char *at = strstr(line, before);
    if (!at || strchr(at, '$')) continue;
    assert_true(page < count);
    at += strlen(before);
    for (int k = 0; k < 12; ++k) pages[page].frame[k % 4][k / 4] = scale[k % 4] * strtod(at, &at);
    ++page;
  }
  fclose(file);
  assert_int_equal(page, count);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Light of all pages along a ray out of the lamp, whose space is the frames'. */
static void see(const struct page *pages, int count, const double ray[6], double rgb[3]) {
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int k = 0; k < count; ++k) {
    const double(*frame)[3] = pages[k].frame, *direction = ray + 3;
    double out = dot(direction, frame[2]), at[3], abst[4], light[3];
    if (!(out > 0)) continue;
    for (int c = 0; c < 3; ++c) at[c] = ray[c] - frame[3][c];
    double behind = dot(at, frame[2]) / out;
    for (int axis = 0; axis < 2; ++axis) {
      double edge = sqrt(dot(frame[axis], frame[axis]));
      abst[axis] = (dot(at, frame[axis]) - behind * dot(direction, frame[axis])) / edge;
      abst[2 + axis] =
          dot(direction, frame[axis]) / edge / out + abst[axis] / pages[k].slab.st_distance;
    }
    oracle_lookup(&pages[k].slab, abst, light);
    for (int c = 0; c < 3; ++c) rgb[c] += light[c];
  }
}

/* The lamp's rays and what they are to see; the folder with the export. */
static const char *prepare(const struct lamp *lamp, const char *kind) {
  struct slab pages[LAMP_PAGES];
  uint64_t seed = 77;
  const char *path = lamp_write(lamp, pages);
  for (int k = 0; k < RAYS; ++k) {
    lamp_ray(lamp, pages, &seed, rays[k]);
    for (int c = 0; c < 3; ++c) rays[k][c] += 2 * rays[k][3 + c]; /* in front of the aperture */
  }
  lamp_free(pages);
  lamp_lookup(path, rays, RAYS, wanted);
  return lamp_export(path, "out", kind);
}

static void check(const struct lamp *lamp, const char *by, double allowed) {
  double worst = lamp_worst(wanted, got, RAYS);
  print_message("# %s: rays by %s: %.1e\n", lamp->name, by, worst);
  if (!(worst < allowed)) fail_msg("%s: %g off", lamp->name, worst);
}

TEST(rays_by_the_text) {
  for (int n = 0; n < lamp_count; ++n) {
    struct page pages[LAMP_PAGES];
    const char *folder = prepare(&lamps[n], "--as mitsuba");
    int count = read_pages(folder, lamps[n].name, pages);
    for (int k = 0; k < RAYS; ++k) see(pages, count, rays[k], got[k]);
    check(&lamps[n], "the text", 1e-6);
    read_xml(folder, lamps[n].name, pages, count);
    for (int k = 0; k < RAYS; ++k) {
      double ray[6];
      lamp_y_up(rays[k], ray);
      lamp_y_up(rays[k] + 3, ray + 3);
      see(pages, count, ray, got[k]);
    }
    check(&lamps[n], "the text", 1e-6);
    for (int k = 0; k < count; ++k) slab_free(&pages[k].slab);
  }
}

/* Two channels through one aperture become one page, their sum; what cannot be added is refused. */
TEST(channels_are_added_up) {
  const struct lamp *lamp = &lamps[4];
  struct slab slabs[LAMP_PAGES];
  struct page pages[LAMP_PAGES];
  uint64_t seed = 5;
  char command[512], path[256];
  lamp_make(lamp, slabs);
  memcpy(slabs[1].center, slabs[0].center, sizeof slabs[1].center);
  memcpy(slabs[1].normal, slabs[0].normal, sizeof slabs[1].normal);
  strcpy(slabs[0].channel, "warm");
  strcpy(slabs[1].channel, "cold");
  snprintf(path, sizeof path, "%s", lamp_save(lamp, slabs));
  for (int k = 0; k < RAYS; ++k) lamp_ray(lamp, slabs, &seed, rays[k]);
  lamp_lookup(path, rays, RAYS, wanted);
  assert_int_equal(read_pages(lamp_export(path, "out", "--as mitsuba"), lamp->name, pages), 1);
  for (int k = 0; k < RAYS; ++k) see(pages, 1, rays[k], got[k]);
  check(lamp, "the text", 1e-6);
  slabs[1].st_window[0] -= 0.1;
  lamp_save(lamp, slabs);
  snprintf(command, sizeof command,
           "\"$BAKESLAB\" export '%s' --as cycles -o '%s' 2>&1 | grep -q '%s'", path,
           scratch("none"), "pages 1 and 2 overlap");
  assert_int_equal(system(command), 0);
  slab_free(&pages[0].slab);
  lamp_free(slabs);
}

/* Turned, mirrored and scaled by 2.5. */
static const double place[3][4] = {{-1.5, 2, 0, 1}, {2, 1.5, 0, -2}, {0, 0, 2.5, 0.5}};
static const char place_text[] = "rays 'place=-1.5 2 0 1 2 1.5 0 -2 0 0 2.5 .5 0 0 0 1'";

TEST(rays_by_mitsuba) {
  if (!engine_there(MITSUBA_RAYS)) skip();
  for (int n = 0; n < 2 * lamp_count; ++n) {
    const struct lamp *lamp = &lamps[n / 2];
    const char *folder = prepare(lamp, "--as mitsuba");
    for (int k = 0; k < RAYS; ++k) {
      double at[3], out[3];
      lamp_y_up(rays[k], at);
      lamp_y_up(rays[k] + 3, out);
      for (int c = 0; c < 3; ++c) {
        there[k][c] = n % 2 ? dot(place[c], at) + place[c][3] : at[c];
        there[k][3 + c] = n % 2 ? -dot(place[c], out) : -out[c];
      }
    }
    engine_mitsuba(folder, lamp->name, n % 2 ? place_text : "rays", there, RAYS, got);
    check(lamp, n % 2 ? "Mitsuba, placed" : "Mitsuba", 1e-4);
  }
}

/* Rays from the screen, which is upright in Mitsuba, too, to the projector. */
static void prepare_letter(void) {
  for (int k = 0; k < LETTER_FIELDS; ++k) {
    lamp_letter_place(k, rays[k]);
    lamp_y_up(rays[k], there[k]);
    for (int c = 0; c < 3; ++c) there[k][3 + c] = -there[k][c];
  }
}

static void check_letter(void) {
  for (int k = 0; k < LETTER_FIELDS; ++k)
    for (int c = 0; c < 3; ++c) assert_near(got[k][c], lamp_letter_is_lit(k), 1e-4);
}

TEST(letter_reads_right) {
  struct page pages[LAMP_PAGES];
  const char *folder = lamp_export(lamp_letter(), "letter", "--as mitsuba");
  int count = read_pages(folder, "letter", pages);
  read_xml(folder, "letter", pages, count);
  prepare_letter();
  for (int k = 0; k < LETTER_FIELDS; ++k) {
    for (int c = 0; c < 3; ++c) there[k][3 + c] = there[k][c]; /* out of the lamp */
    see(pages, count, there[k], got[k]);
  }
  check_letter();
  for (int k = 0; k < count; ++k) slab_free(&pages[k].slab);
}

TEST(letter_by_mitsuba) {
  if (!engine_there(MITSUBA_RAYS)) skip();
  prepare_letter();
  engine_mitsuba(lamp_export(lamp_letter(), "letter", "--as mitsuba"), "letter", "rays", there,
                 LETTER_FIELDS, got);
  check_letter();
}

/* Cycles chooses the rays; what they see is asked of the slab. */
static void ask_cycles(const struct lamp *lamp, const char *placed) {
  struct slab pages[LAMP_PAGES];
  const char *path = lamp_write(lamp, pages), *chosen = scratch("rays");
  char more[1024];
  lamp_free(pages);
  snprintf(more, sizeof more, "%d '%s' %s", RAYS, chosen, placed);
  engine_blender("blender_rays.py", lamp_export(path, "out", "--as cycles"), lamp->name, more, rays,
                 RAYS, got);
  FILE *file = fopen(chosen, "r");
  assert_non_null(file);
  for (int k = 0; k < 6 * RAYS; ++k) assert_int_equal(fscanf(file, "%lf", &rays[k / 6][k % 6]), 1);
  fclose(file);
  lamp_lookup(path, rays, RAYS, wanted);
  int lit = 0;
  for (int k = 0; k < RAYS; ++k) lit += wanted[k][0] > 0;
  assert_true(lit > RAYS / 20);
  check(lamp, *placed ? "Cycles, placed" : "Cycles", 1e-4);
}

TEST(rays_by_cycles) {
  if (!engine_there(BLENDER)) skip();
  for (int n = 0; n < 2 * lamp_count; ++n) ask_cycles(&lamps[n / 2], n % 2 ? "placed" : "");
}

int main(void) {
  return testing_run(NULL, NULL);
}
