#include "viewer/viewer_text.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST = ' ', LAST = '~', IN_BAND = 14, WIDE = 5, HIGH = 7, STEP = 6, LINE = 9 };

/* The printable characters, in order. */
/* clang-format off */
static const char *const font[(LAST - FIRST + IN_BAND) / IN_BAND][HIGH] = {
    {
     "        #    # #          #   ##     ##     #      #   #                            ",
     "        #    # #   # #   #### ##  # #  #    #     #     #     #     #               ",
     "        #    # #  ##### # #      #  # #    #     #       #  # # #   #               ",
     "        #          # #   ###    #    #           #       #   ###  #####       ##### ",
     "        #         #####   # #  #    # # #        #       #  # # #   #               ",
     "                   # #  ####  #  ## #  #          #     #     #     #     ##        ",
     "        #                 #      ##  ## #          #   #                   #        "},
    {
     "             ###    #    ###  #####    #  #####   ##  #####  ###   ###              ",
     "          # #   #  ##   #   #    #    ##  #      #        # #   # #   #  ##    ##   ",
     "         #  #  ##   #       #   #    # #  ####  #        #  #   # #   #  ##    ##   ",
     "        #   # # #   #      #     #  #  #      # ####    #    ###   ####             ",
     "       #    ##  #   #     #       # #####     # #   #  #    #   #     #  ##    ##   ",
     " ##   #     #   #   #    #    #   #    #  #   # #   #  #    #   #    #   ##     #   ",
     " ##          ###   ###  #####  ###     #   ###   ###   #     ###   ##          #    "},
    {
     "   #         #     ###   ###   ###  ####   ###  ####  ##### #####  ###  #   #  ###  ",
     "  #           #   #   # #   # #   # #   # #   # #   # #     #     #   # #   #   #   ",
     " #    #####    #      # # ### #   # #   # #     #   # #     #     #     #   #   #   ",
     "#               #    #  # # # ##### ####  #     #   # ####  ####  #  ## #####   #   ",
     " #    #####    #    #   # ##  #   # #   # #     #   # #     #     #   # #   #   #   ",
     "  #           #         #     #   # #   # #   # #   # #     #     #   # #   #   #   ",
     "   #         #      #    ###  #   # ####   ###  ####  ##### #      #### #   #  ###  "},
    {
     "  ### #   # #     #   # #   #  ###  ####   ###  ####   #### ##### #   # #   # #   # ",
     "   #  #  #  #     ## ## ##  # #   # #   # #   # #   # #       #   #   # #   # #   # ",
     "   #  # #   #     # # # # # # #   # #   # #   # #   # #       #   #   # #   # #   # ",
     "   #  ##    #     # # # #  ## #   # ####  #   # ####   ###    #   #   # #   # # # # ",
     "   #  # #   #     #   # #   # #   # #     # # # # #       #   #   #   # #   # # # # ",
     "#  #  #  #  #     #   # #   # #   # #     #  #  #  #      #   #   #   #  # #  ## ## ",
     " ##   #   # ##### #   # #   #  ###  #      ## # #   # ####    #    ###    #   #   # "},
    {
     "#   # #   # #####  ###         ###    #          #          #               #       ",
     "#   # #   #     #  #    #        #   # #          #         #               #       ",
     " # #   # #     #   #     #       #  #   #              ###  # ##   ###   ## #  ###  ",
     "  #     #     #    #      #      #                        # ##  # #     #  ## #   # ",
     " # #    #    #     #       #     #                     #### #   # #     #   # ##### ",
     "#   #   #   #      #        #    #                    #   # #   # #   # #   # #     ",
     "#   #   #   #####  ###         ###        #####        #### ####   ###   ####  ###  "},
    {
     "  ##        #       #      #  #      ##                                             ",
     " #  #       #                 #       #                                             ",
     " #     #### # ##   ##     ##  #  #    #   ## #  # ##   ###  ####   #### # ##   #### ",
     "###   #   # ##  #   #      #  # #     #   # # # ##  # #   # #   # #   # ##  # #     ",
     " #     #### #   #   #      #  ##      #   # # # #   # #   # #   # #   # #      ###  ",
     " #        # #   #   #   #  #  # #     #   # # # #   # #   # ####   #### #         # ",
     " #     ###  #   #  ###   ##   #  #   ###  # # # #   #  ###  #         # #     ####  "},
    {
     " #                                           ##   #   ##          ",
     " #                                          #     #     #         ",
     "###   #   # #   # #   # #   # #   # #####   #     #     #    #    ",
     " #    #   # #   # #   #  # #  #   #    #   #      #      #  # # # ",
     " #    #   # #   # # # #   #    ####   #     #     #     #      #  ",
     " #  # #  ##  # #  # # #  # #      #  #      #     #     #         ",
     "  ##   ## #   #    # #  #   #  ###  #####    ##   #   ##          "}};
/* clang-format on */

enum result viewer_text_create(int width, int height, struct viewer_text *text,
                               struct error *error) {
  int dot = width / 320 < height / 240 ? width / 320 : height / 240;
  *text = (struct viewer_text){.width = width, .height = height, .dot = dot < 1 ? 1 : dot};
  if (text->dot > 3) text->dot = 3;
  text->pixels = calloc((size_t)width * (size_t)height, 1);
  return text->pixels ? RESULT_OK : result_no_memory(error);
}

void viewer_text_free(struct viewer_text *text) {
  free(text->pixels);
  *text = (struct viewer_text){0};
}

void viewer_text_clear(struct viewer_text *text) {
  memset(text->pixels, 0, (size_t)text->width * (size_t)text->height);
}

/* Is there a dot? From the character's cell's corner. */
static bool has_dot(char character, int x, int y) {
  int number = character >= FIRST && character <= LAST ? character - FIRST : 0;
  if (x < 0 || x >= WIDE || y < 0 || y >= HIGH) return false;
  return font[number / IN_BAND][y][number % IN_BAND * STEP + x] == '#';
}

void viewer_text_line(struct viewer_text *text, int row, const char *line) {
  int length = (int)strlen(line), left = text->dot * STEP / 2;
  for (int y = 0; y < LINE * text->dot; ++y)
    for (int x = 0; x < (length * STEP + 1) * text->dot; ++x) {
      int column = left + x, down = left + row * LINE * text->dot + y, at = x / text->dot - 1;
      if (column >= text->width || down >= text->height) continue;
      bool dot = at >= 0 && has_dot(line[at / STEP], at % STEP, y / text->dot - 1);
      text->pixels[(size_t)down * (size_t)text->width + (size_t)column] = dot ? 255 : 1;
    }
}
