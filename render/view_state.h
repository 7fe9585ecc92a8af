/* view_state.h - what keys and mouse decide in the viewer: the camera, where lights are, how
 * their light is summed. No window and no OpenGL: events go in, the state changes. */
#ifndef VIEW_STATE_H
#define VIEW_STATE_H

#include <stdbool.h>

#include "camera.h"
#include "light.h"
#include "view_picture.h"

/* Others are the characters that they write. */
enum view_key {
  VIEW_KEY_LEFT = 256,
  VIEW_KEY_RIGHT,
  VIEW_KEY_UP,
  VIEW_KEY_DOWN,
  VIEW_KEY_PAGE_UP,
  VIEW_KEY_PAGE_DOWN,
  VIEW_KEY_TAB,
  VIEW_KEY_ESCAPE
};

struct view_light {
  double matrix[4][3], first[4][3]; /* as light->matrix; at the start */
  double pivot[3];                  /* in lamp space: it is turned around the first page's centre */
};

struct view_state {
  struct camera camera, first;
  struct view_light *lights; /* [light_count]; owned */
  int light_count;
  int selected; /* what is moved: 0: the camera; k: light number k - 1 */
  struct view_sum sum;
  int levels;      /* the highest */
  double exposure; /* radiance that is white; 0: by the picture */
  bool text, help; /* on the screen */
  bool save, quit; /* asked for */
};

enum slab_result view_state_create(const struct view_world *world, const struct camera *camera,
                                   struct view_state *state, struct slab_error *error);
void view_state_free(struct view_state *state); /* zeroed state allowed */

/* Are two matrices the same? */
bool view_same_place(const double a[4][3], const double b[4][3]);

/* A key is pressed. Those that mean nothing change nothing. */
void view_state_key(struct view_state *state, int key, bool shift);

/* The mouse is dragged, by shares of the picture's width to the right and down; `move` instead
 * of turning. Its wheel is turned away by so many steps. */
void view_state_drag(struct view_state *state, double right, double down, bool move);
void view_state_scroll(struct view_state *state, double steps);

/* The next key of a text such as "left shift+pageup V q": words with blanks between. *key is 0
 * at its end. False where the word is no key; *text stays there. */
bool view_key_read(const char **text, int *key, bool *shift);

#endif
