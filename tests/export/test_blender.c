/* test_blender.c - lamps in Blender beyond rays (test_pages) and irradiance: a letter F, and what
 * the add-on's menus do. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "engine.h"
#include "lamps.h"
#include "testing.h"

/* On the screen that the projector is made for; right-handed, z up. */
TEST(letter_reads_right) {
  if (!engine_there(BLENDER)) skip();
  double screen[LETTER_FIELDS][6] = {{0}}, got[LETTER_FIELDS][3], most = 0;
  for (int k = 0; k < LETTER_FIELDS; ++k) {
    double place[3];
    lamp_letter_place(k, place);
    screen[k][0] = place[0];
    screen[k][1] = place[2];
    screen[k][2] = place[1];
    screen[k][4] = -1;
  }
  engine_blender("blender_floor.py", lamp_export(lamp_letter(), "letter", "--as cycles"), "letter",
                 "5 64", screen, LETTER_FIELDS, got);
  for (int k = 0; k < LETTER_FIELDS; ++k) most = fmax(most, got[k][1]);
  assert_true(most > 0);
  for (int k = 0; k < LETTER_FIELDS; ++k)
    if ((got[k][1] > most / 2) != lamp_letter_is_lit(k))
      fail_msg("field %d: %g of %g", k, got[k][1], most);
}

/* The script fails where something is not as it should be. */
TEST(menus) {
  if (!engine_there(BLENDER)) skip();
  char command[1024];
  const char *given = getenv("BLENDER_PYTHON"), *python = given && *given ? given : "python3";
  const char *folder = lamp_export(lamp_letter(), "letter", "--as cycles");
  snprintf(command, sizeof command, "%s tests/export/blender_menus.py '%s' letter >'%s' 2>&1",
           python, folder, scratch("said"));
  if (system(command) == 0) return;
  snprintf(command, sizeof command, "sed 's/^/# /' '%s'", scratch("said"));
  (void)!system(command);
  fail_msg("blender_menus.py");
}

int main(void) {
  return testing_run(NULL, NULL);
}
