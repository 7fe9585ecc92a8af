/* hard_run.c - see hard.h. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hard.h"

static const double exact = 5e-4, slack = 1.15, more = 5e-3;

const char *const hard_kind_names[HARD_KINDS] = {"sheet", "cluster", "point"};

void hard_free(struct hard_case *lit) {
  for (int p = 0; p < lit->page_count; ++p) slab_free(&lit->pages[p]);
}

__attribute__((format(printf, 3, 4))) static void
judge(struct hard_result *result, enum hard_expect verdict, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(result->why, sizeof result->why, format, arguments);
  va_end(arguments);
  result->verdict = verdict;
}

/* The end of what a program said. */
static const char *last_words(void) {
  const char *text = chain_log();
  size_t length = strlen(text), most = 200;
  return length > most ? text + length - most : text;
}

/* One line of bakeslab's own, and no file. */
static bool refused_well(int status) {
  if (status != 1 && status != 2) return false;
  if (chain_run("test ! -e lamp.inc && test ! -e lamp.exr && test ! -e lamp.inc.part") != 0)
    return false;
  return chain_run("test $(grep -c . said) = 1 && grep -q '^bakeslab: [^ ]*: ' said") == 0;
}

static bool make_include(const struct hard_case *lit, struct hard_result *result) {
  char lights[32] = "";
  chain_run("rm -f lamp.* said");
  chain_write("lamp-slab.exr", lit->pages, lit->page_count);
  if (lit->lights > 0) snprintf(lights, sizeof lights, "--lights %d", lit->lights);
  int status = chain_run("\"$BAKESLAB\" include lamp-slab.exr -o lamp.inc --mode %s %s 2>said",
                         hard_kind_names[lit->kind], lights);
  if (status == 0) return true;
  bool well = refused_well(status);
  chain_run("cat said");
  judge(result, well ? HARD_REFUSED : HARD_MISSED, "exit %d: %s", status, last_words());
  return false;
}

static size_t place(const struct hard_lamp *lamp, char *sdl, size_t size) {
  char numbers[128];
  snprintf(numbers, sizeof numbers, "%.17g, rgb <%.17g, %.17g, %.17g>", lamp->scale, lamp->gain[0],
           lamp->gain[1], lamp->gain[2]);
  return chain_object(*lamp->arguments ? lamp->arguments : numbers, lamp->matrix, sdl, size);
}

/* The first warning that is not the include's, nor of the camera, which may be askew. */
static const char *unasked(void) {
  static const char *const known[] = {"Test_Lamp_Canned: ", "Camera vectors are not perpendicular"};
  const char *warning = chain_log();
  while ((warning = strstr(warning, "Parse Warning: "))) {
    const char *of = warning + strlen("Parse Warning: ");
    if (strncmp(of, known[0], strlen(known[0])) && strncmp(of, known[1], strlen(known[1])))
      return warning;
    warning = of;
  }
  return NULL;
}

/* Stops only at an #error of the include, and warns of nothing but what it warns of. */
static bool render(const struct hard_case *lit, double pigment, struct hard_result *result) {
  static char sdl[HARD_LAMPS * 600 + 200];
  size_t length = 0;
  if (lit->most > 0)
    length = (size_t)snprintf(sdl, sizeof sdl, "#declare Test_Lamp_Lights = %.17g;\n", lit->most);
  length += (size_t)snprintf(sdl + length, sizeof sdl - length, "#include \"lamp.inc\"\n");
  for (int n = 0; n < lit->lamp_count; ++n)
    length += place(&lit->lamps[n], sdl + length, sizeof sdl - length);
  chain_scene(&lit->plane, pigment, sdl);
  int status =
      chain_run("rm -f frame.exr; povray +Iscene.pov +Oframe.exr +FE -A -D +WT1 +W%d +H%d %s",
                lit->size, lit->size, lit->switches ? lit->switches : "");
  const char *said = strstr(chain_log(), "Parse halted by #error directive: Test_Lamp_Canned: ");
  if (status == 1 && said) /* POV-Ray cuts long words off */
    judge(result, strstr(said, "... Fatal") ? HARD_MISSED : HARD_REFUSED, "%.200s", said);
  else if (status != 0)
    judge(result, HARD_MISSED, "POV-Ray: exit %d: %s", status, last_words());
  else if ((said = unasked()))
    judge(result, HARD_MISSED, "POV-Ray: %.200s", said);
  else
    return true;
  return false;
}

/* Of the pixels that are compared; RMS over them. */
static double difference(const struct hard_case *lit, const struct picture *picture,
                         const struct hard_sum *sum, double pigment, int *compared) {
  double error = 0, size = 0;
  *compared = 0;
  for (int k = 0; k < lit->size * lit->size; ++k) {
    if (isinf(sum->doubt[k])) continue;
    ++*compared;
    for (int c = 0; c < 3; ++c) {
      double shown = (double)picture->rgb[3 * k + c], right = sum->rgb[k][c] * pigment;
      double off = fabs(shown - right) - sum->doubt[k] * pigment;
      if (!(off <= 0)) error += off * off;
      size += right * right;
    }
  }
  return error == 0 ? 0 : sqrt(error / size);
}

/* Whether the plane at which errors are stated lies before the sheet. */
static bool too_near(const struct hard_case *lit) {
  const struct slab *page = &lit->pages[0];
  int lights[2];
  hard_lights(lit, page, lights);
  return lit->stated && lit->kind == HARD_SHEET &&
         hard_height(lit, page, lights) >= lit->away * hard_width(page);
}

static void compare(const struct hard_case *lit, const struct hard_sum *sum, double pigment,
                    struct hard_result *result) {
  struct picture picture;
  struct error error;
  int compared;
  result->allowed = lit->stated ? slack * hard_stated(lit) + more : exact;
  if (slab_exr_read(chain_path("frame.exr"), &picture, &error) != RESULT_OK) {
    judge(result, HARD_MISSED, "%s", error.text);
    return;
  }
  result->error = difference(lit, &picture, sum, pigment, &compared);
  bool right = result->error <= result->allowed && isinf(result->allowed) == too_near(lit);
  if (compared == 0 && !too_near(lit)) right = false; /* it would say nothing */
  judge(result, right ? HARD_RIGHT : HARD_MISSED, "error %.3g, %.3g allowed, %d pixels",
        result->error, result->allowed, compared);
  if (isinf(result->allowed)) result->error = 0; /* of which nothing is claimed */
  picture_free(&picture);
}

void hard_run(const struct hard_case *lit, struct hard_result *result) {
  static struct hard_sum sum;
  static const char *const names[] = {"", "right", "refused"};
  double most = 0;
  memset(result, 0, sizeof *result);
  if (make_include(lit, result)) {
    if (!hard_add(lit, &sum)) judge(result, HARD_MISSED, "no numbers in the include");
    for (int k = 0; k < 3 * lit->size * lit->size; ++k)
      if (!isinf(sum.doubt[k / 3])) most = fmax(most, fabs(sum.rgb[k / 3][k % 3]));
    double pigment = most > 0 ? fmin(fmax(1 / most, 1e-35), 1e35) : 1;
    if (result->verdict != HARD_MISSED && render(lit, pigment, result))
      compare(lit, &sum, pigment, result);
    result->dark = most == 0 && result->verdict == HARD_RIGHT;
  }
  if (lit->expect == HARD_EITHER || result->verdict == HARD_MISSED ||
      result->verdict == lit->expect)
    return;
  char was[sizeof result->why];
  memcpy(was, result->why, sizeof was);
  judge(result, HARD_MISSED, "should be %s: %.200s", names[lit->expect], was);
}
