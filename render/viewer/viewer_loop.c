#include "viewer/viewer_loop.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/progress.h"
#include "file/slab_exr.h"
#include "picture/preview.h"
#include "viewer/viewer_camera.h"
#include "viewer/viewer_status.h"
#include "viewer/viewer_window.h"

/* Seconds that a frame may take to add views: the first after a change, and later ones; views
 * that the very first one adds. */
static const double moving = 0.05, still = 0.1, first_views = 8;

struct viewer_loop {
  const struct viewer_arguments *arguments;
  const char *keys; /* that are left; NULL: none */
  struct viewer_state state;
  struct viewer_window *window;
  struct viewer_picture picture;
  struct viewer_text text;
  bool due;       /* the picture is not what the state asks for */
  double share;   /* of the views that a frame adds */
  double seconds; /* of the last frame that added views */
  double white;
  struct error unsaved; /* why the first picture that could not be saved was not */
  char news[sizeof(struct error) + 32];
};

static bool same_sum(const struct viewer_sum *a, const struct viewer_sum *b) {
  return a->level == b->level && a->shadows == b->shadows && a->groups == b->groups;
}

static void set_share(struct viewer_loop *loop, double share) {
  double least = 1 / fmax((double)loop->picture.views, 1);
  loop->share = fmin(fmax(share, least), 1);
}

static enum result follow_window(struct viewer_loop *loop, struct error *error) {
  int size[2];
  viewer_window_size(loop->window, size);
  if (size[0] < 1 || size[1] < 1) return RESULT_OK;
  if (size[0] == loop->text.width && size[1] == loop->text.height) return RESULT_OK;
  loop->due = true;
  viewer_text_free(&loop->text);
  enum result result = viewer_text_create(size[0], size[1], &loop->text, error);
  if (result == RESULT_OK) result = viewer_picture_resize(&loop->picture, size[0], size[1], error);
  return result;
}

static void follow_lights(struct viewer_loop *loop) {
  for (int k = 0; k < loop->state.light_count; ++k) {
    struct viewer_light *light = &loop->state.lights[k];
    const struct light *there = &loop->arguments->world->lights[k];
    if (viewer_same_place(light->matrix, there->matrix)) continue;
    if (!viewer_picture_move(&loop->picture, k, light->matrix))
      memcpy(light->matrix, there->matrix, sizeof light->matrix);
    loop->due = true;
  }
}

/* Whether a channel's gain has changed. */
static bool follow_channels(struct viewer_loop *loop) {
  bool changed = false;
  for (int k = 0; k < loop->state.light_count; ++k) {
    const struct light *there = &loop->arguments->world->lights[k];
    for (int n = 0; n < there->channel_count; ++n) {
      double gain = loop->state.lights[k].gains[n];
      if (gain == there->channels[n].gain) continue;
      viewer_picture_dim(&loop->picture, k, n, gain);
      changed = true;
    }
  }
  return changed;
}

/* Brings the picture up to date with the state. */
static enum result follow(struct viewer_loop *loop, struct error *error) {
  enum result result = follow_window(loop, error);
  if (result != RESULT_OK) return result;
  follow_lights(loop);
  if (follow_channels(loop) || !same_sum(&loop->picture.how, &loop->state.sum)) {
    double views = loop->share * (double)loop->picture.views;
    result = viewer_picture_set_sum(&loop->picture, &loop->state.sum, error);
    if (result != RESULT_OK) return result;
    set_share(loop, views / fmax((double)loop->picture.views, 1));
    loop->due = true;
  }
  if (!viewer_camera_same(&loop->picture.camera, &loop->state.camera)) loop->due = true;
  if (loop->due) viewer_picture_start(&loop->picture, &loop->state.camera);
  loop->due = false;
  return RESULT_OK;
}

/* Adds as many views as the time of a frame allows, and adapts their number for the next. All at
 * once for keys that wait for them. */
static enum result refine(struct viewer_loop *loop, struct error *error) {
  if (loop->picture.done >= 1) return RESULT_OK;
  if (loop->keys) return viewer_picture_add(&loop->picture, 1, error);
  double start = progress_now(), budget = loop->picture.done > 0 ? still : moving;
  enum result result = viewer_picture_add(&loop->picture, loop->share, error);
  glFinish();
  double factor = budget / fmax(progress_now() - start, 1e-6);
  set_share(loop, loop->share * fmin(fmax(factor, 0.25), 4));
  return result;
}

/* Sets the exposure by the picture, roughly at first and finally once it is complete. */
static enum result expose(struct viewer_loop *loop, struct error *error) {
  struct picture picture;
  if (loop->state.exposure > 0) loop->white = loop->state.exposure;
  if (loop->state.exposure > 0 || (loop->white > 0 && loop->picture.done < 1)) return RESULT_OK;
  enum result result = gl_show_read(&loop->picture.show, &picture, error);
  if (result != RESULT_OK) return result;
  result = preview_exposure(&picture, &loop->white, error);
  picture_free(&picture);
  if (loop->picture.done >= 1) loop->state.exposure = loop->white;
  return result;
}

static enum result save(struct viewer_loop *loop, struct error *error) {
  char path[32];
  int number = 1;
  do snprintf(path, sizeof path, "view-%d.exr", number++);
  while (access(path, F_OK) == 0);
  struct picture picture;
  enum result result = gl_show_read(&loop->picture.show, &picture, error);
  if (result != RESULT_OK) return result;
  char *command =
      viewer_command(loop->arguments, &loop->state, picture.width, picture.height, path);
  if (command)
    result = slab_exr_write(path, &picture, 0, command, error);
  else
    result = result_no_memory(error);
  if (result == RESULT_OK) {
    printf("%s\n", command);
    fflush(stdout);
    snprintf(loop->news, sizeof loop->news, "saved as %s", path);
  }
  free(command);
  picture_free(&picture);
  return result;
}

static void save_if_asked(struct viewer_loop *loop) {
  struct error error;
  if (!loop->state.save) return;
  snprintf(loop->news, sizeof loop->news, "is saved once all views are in");
  if (loop->picture.done < 1) return;
  loop->state.save = false;
  if (save(loop, &error) == RESULT_OK) return;
  if (!loop->unsaved.text[0]) loop->unsaved = error;
  snprintf(loop->news, sizeof loop->news, "not saved: %s", error.text);
}

static enum result draw_frame(struct viewer_loop *loop, struct error *error) {
  double start = progress_now();
  enum result result = follow(loop, error);
  bool complete = loop->picture.done >= 1;
  if (result == RESULT_OK) result = refine(loop, error);
  if (result == RESULT_OK && complete) result = viewer_picture_check(&loop->picture, error);
  if (result == RESULT_OK) result = expose(loop, error);
  if (result != RESULT_OK) return result;
  save_if_asked(loop);
  viewer_status_write(&loop->picture, &loop->state, loop->seconds, loop->white, loop->news,
                      &loop->text);
  gl_show_screen(&loop->picture.show, loop->white, loop->text.pixels, 0);
  viewer_window_show(loop->window);
  if (!complete) loop->seconds = progress_now() - start;
  return gl_check("a frame", error);
}

/* The next of the keys, once the picture is complete. */
static void press_key(struct viewer_loop *loop) {
  int key;
  bool shift;
  if (!loop->keys || loop->picture.done < 1) return;
  if (!viewer_key_read(&loop->keys, &key, &shift) || !key)
    loop->keys = NULL;
  else
    viewer_state_key(&loop->state, key, shift);
}

/* Is there nothing to do before something happens? */
static bool is_still(const struct viewer_loop *loop) {
  const struct viewer_picture *picture = &loop->picture;
  return picture->done >= 1 && picture->checked == VIEWER_PICTURE_ROWS && !loop->keys;
}

static enum result look(struct viewer_loop *loop, struct error *error) {
  enum result result = RESULT_OK;
  while (result == RESULT_OK && !loop->state.quit) {
    result = draw_frame(loop, error);
    viewer_window_events(loop->window, is_still(loop));
    press_key(loop);
  }
  if (result == RESULT_OK && loop->unsaved.text[0])
    result = result_fail(error, RESULT_IO, "%s", loop->unsaved.text);
  return result;
}

enum result viewer_loop_run(const struct viewer_arguments *arguments, const struct camera *camera,
                            int width, int height, const char *keys, struct error *error) {
  struct viewer_loop loop = {.arguments = arguments, .keys = keys, .due = true};
  int size[2] = {0};
  enum result result = viewer_state_create(arguments->world, camera, &loop.state, error);
  if (result == RESULT_OK)
    result = viewer_window_create(width, height, &loop.state, &loop.window, error);
  if (result == RESULT_OK) {
    viewer_window_size(loop.window, size);
    result = viewer_picture_create(arguments->world, &loop.state.sum, size[0], size[1],
                                   &loop.picture, error);
  }
  if (result == RESULT_OK) result = viewer_text_create(size[0], size[1], &loop.text, error);
  if (result == RESULT_OK) {
    set_share(&loop, first_views / fmax((double)loop.picture.views, 1));
    result = look(&loop, error);
  }
  viewer_text_free(&loop.text);
  if (loop.window) viewer_picture_free(&loop.picture);
  viewer_window_free(loop.window);
  viewer_state_free(&loop.state);
  return result;
}
