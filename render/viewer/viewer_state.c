#include "viewer/viewer_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/numbers.h"
#include "base/vector.h"
#include "microlight/levels.h"
#include "viewer/viewer_camera.h"

/* What one key press does. */
static const double step_angle = M_PI / 36; /* turning */
static const double step_length = 0.05;     /* moving, of the camera's distance */
static const double step_zoom = 1.1, step_exposure = 1.189207115002721;
static const double steps_gain = 10; /* a unit of a channel's gain */

enum { MOST_GROUPS = 16 };

enum result viewer_state_create(const struct viewer_world *world, const struct camera *camera,
                                struct viewer_state *state, struct error *error) {
  *state = (struct viewer_state){.camera = *camera,
                                 .first = *camera,
                                 .light_count = world->light_count,
                                 .sum = {.shadows = true, .groups = 4},
                                 .text = true};
  for (int k = 0; k < world->prepared->pages; ++k)
    if (world->prepared->levels[k].count > state->levels)
      state->levels = world->prepared->levels[k].count;
  state->lights = calloc((size_t)world->light_count + 1, sizeof *state->lights);
  if (!state->lights) return result_no_memory(error);
  for (int k = 0; k < world->light_count; ++k) {
    const struct light *light = &world->lights[k];
    memcpy(state->lights[k].matrix, light->matrix, sizeof light->matrix);
    memcpy(state->lights[k].first, light->matrix, sizeof light->matrix);
    memcpy(state->lights[k].pivot, light->pages[0].slab.center, sizeof state->lights[k].pivot);
    state->lights[k].channel_count = light->channel_count;
    for (int n = 0; n < light->channel_count; ++n)
      state->lights[k].gains[n] = state->lights[k].first_gains[n] = light->channels[n].gain;
  }
  return RESULT_OK;
}

void viewer_state_free(struct viewer_state *state) {
  free(state->lights);
  *state = (struct viewer_state){0};
}

bool viewer_same_place(const double a[4][3], const double b[4][3]) {
  for (int row = 0; row < 4; ++row)
    for (int c = 0; c < 3; ++c)
      if (a[row][c] != b[row][c]) return false;
  return true;
}

/* What lights move along: level and to the right, level and away, and up. */
static void level_axes(const struct camera *camera, double axes[3][3]) {
  double forward[3], above[3];
  camera_axes(camera, forward, axes[0], above);
  memcpy(axes[2], camera->up, sizeof axes[2]);
  vector_normalise(axes[2]);
  double rise = vector_dot(forward, axes[2]);
  for (int c = 0; c < 3; ++c) axes[1][c] = forward[c] - rise * axes[2][c];
  vector_normalise(axes[1]);
}

static void move_light(struct viewer_light *light, const double axis[3], double length) {
  for (int c = 0; c < 3; ++c) light->matrix[3][c] += length * axis[c];
}

/* From axis p towards axis q; the pivot stays where it is. */
static void turn_light(struct viewer_light *light, const double p[3], const double q[3],
                       double angle) {
  double middle[3] = {0};
  for (int c = 0; c < 3; ++c)
    for (int row = 0; row < 3; ++row) middle[c] += light->pivot[row] * light->matrix[row][c];
  for (int c = 0; c < 3; ++c) light->matrix[3][c] += middle[c];
  for (int row = 0; row < 3; ++row) viewer_camera_turn(light->matrix[row], p, q, angle);
  viewer_camera_turn(middle, p, q, angle);
  for (int c = 0; c < 3; ++c) light->matrix[3][c] -= middle[c];
}

static void arrow_light(struct viewer_state *state, int key, bool shift) {
  struct viewer_light *light = &state->lights[state->selected - 1];
  double axes[3][3], step = step_length * viewer_camera_distance(&state->camera);
  bool back = key == VIEWER_KEY_LEFT || key == VIEWER_KEY_DOWN || key == VIEWER_KEY_PAGE_DOWN;
  bool aside = key == VIEWER_KEY_LEFT || key == VIEWER_KEY_RIGHT;
  bool away = key == VIEWER_KEY_UP || key == VIEWER_KEY_DOWN;
  level_axes(&state->camera, axes);
  if (!shift)
    move_light(light, axes[aside ? 0 : away ? 1 : 2], back ? -step : step);
  else if (aside)
    turn_light(light, axes[1], axes[0], back ? -step_angle : step_angle);
  else
    turn_light(light, axes[away ? 1 : 0], axes[2], back ? -step_angle : step_angle);
}

static void arrow_camera(struct viewer_state *state, int key, bool shift) {
  struct camera *camera = &state->camera;
  double right = (key == VIEWER_KEY_RIGHT) - (key == VIEWER_KEY_LEFT);
  double up = (key == VIEWER_KEY_UP) - (key == VIEWER_KEY_DOWN);
  double step = step_length * viewer_camera_distance(camera);
  if (key == VIEWER_KEY_PAGE_UP)
    viewer_camera_zoom(camera, 1 / step_zoom);
  else if (key == VIEWER_KEY_PAGE_DOWN)
    viewer_camera_zoom(camera, step_zoom);
  else if (shift)
    viewer_camera_pan(camera, right * step, up * step);
  else
    viewer_camera_orbit(camera, right * step_angle, up * step_angle);
}

static void reset(struct viewer_state *state) {
  state->camera = state->first;
  for (int k = 0; k < state->light_count; ++k) {
    struct viewer_light *light = &state->lights[k];
    memcpy(light->matrix, light->first, sizeof light->matrix);
    memcpy(light->gains, light->first_gains, sizeof light->gains);
  }
}

int viewer_state_light(const struct viewer_state *state) {
  return state->selected > 0 ? state->selected - 1 : 0;
}

/* The next channel, or so many steps more of the chosen one's gain. */
static void press_channel(struct viewer_state *state, int next, int steps) {
  struct viewer_light *light = &state->lights[viewer_state_light(state)];
  if (light->channel_count == 0) return;
  state->channel = (state->channel + next) % light->channel_count;
  double *gain = &light->gains[state->channel];
  if (steps) *gain = fmax(0, rint(*gain * steps_gain + steps) / steps_gain);
}

static void press_letter(struct viewer_state *state, int key) {
  int *groups = &state->sum.groups; /* 1, 2, 4, 8, 16, each view */
  if (key >= '0' && key <= '9' && key - '0' <= state->light_count) state->selected = key - '0';
  switch (key) {
  case 'v':
    if (state->sum.level < state->levels) ++state->sum.level;
    return;
  case 'V':
    if (state->sum.level > 0) --state->sum.level;
    return;
  case 'g':
    *groups = *groups == 0 ? MOST_GROUPS : *groups > 1 ? *groups / 2 : 1;
    return;
  case 'G':
    *groups = *groups < MOST_GROUPS ? 2 * *groups : 0;
    return;
  case 'c':
    press_channel(state, 1, 0);
    return;
  case '[':
    press_channel(state, 0, -1);
    return;
  case ']':
    press_channel(state, 0, 1);
    return;
  case 'd':
    state->sum.shadows = !state->sum.shadows;
    return;
  case '+':
  case '=':
    state->exposure /= step_exposure;
    return;
  case '-':
    state->exposure *= step_exposure;
    return;
  case 'e':
    state->exposure = 0;
    return;
  case 'r':
    reset(state);
    return;
  case 't':
    state->text = !state->text;
    return;
  case 'h':
  case 'H':
    state->help = !state->help;
    return;
  case 's':
  case 'S':
    state->save = true;
    return;
  case 'q':
  case 'Q':
    state->quit = true;
    return;
  default:
    return;
  }
}

void viewer_state_key(struct viewer_state *state, int key, bool shift) {
  if (key == VIEWER_KEY_ESCAPE)
    state->quit = true;
  else if (key == VIEWER_KEY_TAB)
    state->selected =
        (state->selected + (shift ? state->light_count : 1)) % (state->light_count + 1);
  else if (key < VIEWER_KEY_LEFT)
    press_letter(state, key);
  else if (state->selected > 0)
    arrow_light(state, key, shift);
  else
    arrow_camera(state, key, shift);
}

void viewer_state_drag(struct viewer_state *state, double right, double down, bool move) {
  struct camera *camera = &state->camera;
  double forward[3], across[3], above[3], axes[3][3];
  double length = 2 * tan(camera->fov * (M_PI / 360)) * viewer_camera_distance(camera);
  if (state->selected == 0) { /* the scene follows the mouse */
    if (move)
      viewer_camera_pan(camera, -right * length, down * length);
    else
      viewer_camera_orbit(camera, -right * M_PI, down * M_PI);
    return;
  }
  struct viewer_light *light = &state->lights[state->selected - 1];
  camera_axes(camera, forward, across, above);
  level_axes(camera, axes);
  if (move) {
    move_light(light, across, right * length);
    move_light(light, above, -down * length);
  } else {
    turn_light(light, axes[1], axes[0], right * M_PI);
    turn_light(light, axes[1], axes[2], -down * M_PI);
  }
}

void viewer_state_scroll(struct viewer_state *state, double steps) {
  viewer_camera_zoom(&state->camera, pow(step_zoom, -steps));
}

bool viewer_key_read(const char **text, int *key, bool *shift) {
  static const char *const names[] = {"left",   "right",    "up",  "down",
                                      "pageup", "pagedown", "tab", "esc"};
  const char *word = *text + strspn(*text, NUMBERS_BLANKS);
  const char *end = word + strcspn(word, NUMBERS_BLANKS);
  *shift = !strncmp(word, "shift+", 6);
  const char *name = *shift ? word + 6 : word;
  size_t length = (size_t)(end - name);
  *key = 0;
  if (length == 1 && !*shift) *key = (unsigned char)*name;
  for (int k = 0; k < (int)(sizeof names / sizeof *names); ++k)
    if (strlen(names[k]) == length && !strncmp(names[k], name, length)) *key = VIEWER_KEY_LEFT + k;
  if (*word && !*key) return false;
  *text = end;
  return true;
}
