/* test_blender.c - lamps in Blender beyond rays (test_pages) and irradiance: a letter F, and what
 * the add-on's menus do. Where python3, or what BLENDER_PYTHON names, has the module bpy. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "lamps.h"
#include "testing.h"

static const char *python(void) {
  const char *given = getenv("BLENDER_PYTHON");
  return given && *given ? given : "python3";
}

static bool lacks_blender(void) {
  char command[256];
  snprintf(command, sizeof command, "%s -c 'import bpy' 2>/dev/null", python());
  return system(command) != 0;
}

/* On the screen that the projector is made for; right-handed, z up. */
TEST(letter_reads_right) {
  if (lacks_blender()) skip();
  double screen[LETTER_FIELDS][6] = {{0}}, got[LETTER_FIELDS][3], most = 0;
  char command[1024];
  for (int k = 0; k < LETTER_FIELDS; ++k) {
    double place[3];
    lamp_letter_place(k, place);
    screen[k][0] = place[0];
    screen[k][1] = place[2];
    screen[k][2] = place[1];
    screen[k][4] = -1;
  }
  snprintf(command, sizeof command, "%s tests/export/blender_floor.py '%s' letter %d 64", python(),
           lamp_export(lamp_letter(), "letter", "--as cycles"), LETTER_SIDE);
  lamp_run(command, screen[0], 6, LETTER_FIELDS, got);
  for (int k = 0; k < LETTER_FIELDS; ++k) most = fmax(most, got[k][1]);
  assert_true(most > 0);
  for (int k = 0; k < LETTER_FIELDS; ++k)
    if ((got[k][1] > most / 2) != lamp_letter_is_lit(k))
      fail_msg("field %d: %g of %g", k, got[k][1], most);
}

/* The script fails where something is not as it should be. */
TEST(menus) {
  if (lacks_blender()) skip();
  char command[1024];
  const char *folder = lamp_export(lamp_letter(), "letter", "--as cycles");
  snprintf(command, sizeof command, "%s tests/export/blender_menus.py '%s' letter >'%s' 2>&1",
           python(), folder, scratch("said"));
  if (system(command) == 0) return;
  snprintf(command, sizeof command, "sed 's/^/# /' '%s'", scratch("said"));
  (void)!system(command);
  fail_msg("blender_menus.py");
}

int main(void) {
  return testing_run(NULL, NULL);
}
