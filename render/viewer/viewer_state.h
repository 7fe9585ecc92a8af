/* viewer_state.h - what keys and mouse change in the viewer: the camera, where lights are, how
 * their light is summed. No window and no OpenGL: events go in, the state changes. */
#ifndef VIEWER_STATE_H
#define VIEWER_STATE_H

#include <stdbool.h>

#include "light/light.h"
#include "scene/camera.h"
#include "viewer/viewer_picture.h"

/* Keys that write no character; others are their characters. */
enum viewer_key {
  VIEWER_KEY_LEFT = 256,
  VIEWER_KEY_RIGHT,
  VIEWER_KEY_UP,
  VIEWER_KEY_DOWN,
  VIEWER_KEY_PAGE_UP,
  VIEWER_KEY_PAGE_DOWN,
  VIEWER_KEY_TAB,
  VIEWER_KEY_ESCAPE
};

struct viewer_light {
  double matrix[4][3], first[4][3]; /* as light->matrix; at the start */
  double pivot[3];                  /* in lamp space: it is turned around the first page's centre */
  int channel_count;
  double gains[LIGHT_CHANNELS], first_gains[LIGHT_CHANNELS]; /* of its channels; at the start */
};

struct viewer_state {
  struct camera camera, first;
  struct viewer_light *lights; /* [light_count]; owned */
  int light_count;
  int selected; /* what is moved: 0: the camera; k: light number k - 1 */
  int channel;  /* whose gain is changed: of the chosen light, or of the first */
  struct viewer_sum sum;
  int levels;      /* the highest */
  double exposure; /* radiance that is white; 0: by the picture */
  bool text, help; /* on the screen */
  bool save, quit; /* asked for */
};

enum result viewer_state_create(const struct viewer_world *world, const struct camera *camera,
                                struct viewer_state *state, struct error *error);
void viewer_state_free(struct viewer_state *state); /* zeroed state allowed */

/* Are two matrices the same? */
bool viewer_same_place(const double a[4][3], const double b[4][3]);

/* The number of the chosen light, or of the first. */
int viewer_state_light(const struct viewer_state *state);

/* A key is pressed; unknown ones change nothing. */
void viewer_state_key(struct viewer_state *state, int key, bool shift);

/* The mouse is dragged, by shares of the picture's width to the right and down; `move` instead
 * of turning. Its wheel is turned away by so many steps. */
void viewer_state_drag(struct viewer_state *state, double right, double down, bool move);
void viewer_state_scroll(struct viewer_state *state, double steps);

/* The next key of a text such as "left shift+pageup V q": words with blanks between. *key is 0
 * at its end. False where the word is no key; *text stays there. */
bool viewer_key_read(const char **text, int *key, bool *shift);

#endif
