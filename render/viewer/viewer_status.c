#include "viewer/viewer_status.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *const help[] = {"",
                                   "Tab 0-9    choose what is moved: camera 0 or a light",
                                   "arrows     turn around, or move the light",
                                   "PgUp PgDn  nearer, farther; light: up, down",
                                   "with Shift pan, or turn the light",
                                   "mouse      left: turn, right: move, wheel: zoom",
                                   "c [ ]      channel: next, dimmer, brighter",
                                   "v V        fewer, more views",
                                   "d          shadows: on, off",
                                   "g G        fewer, more shadow maps",
                                   "- + e      darker, brighter, by the picture",
                                   "r          camera and lights as at the start",
                                   "s          save EXR and print its command",
                                   "t h        this text, this help: on, off",
                                   "q Esc      quit"};

struct writer {
  struct viewer_text *text;
  int row;
};

__attribute__((format(printf, 2, 3))) static void say(struct writer *writer, const char *format,
                                                      ...) {
  char line[160];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  viewer_text_line(writer->text, writer->row++, line);
}

static void say_selected(const struct viewer_picture *picture, const struct viewer_state *state,
                         struct writer *writer) {
  if (state->selected == 0)
    say(writer, "moves: camera");
  else
    say(writer, "moves: light %d of %d, %.30s", state->selected, state->light_count,
        picture->world->lights[state->selected - 1].pages[0].slab.name);
}

static void say_channel(const struct viewer_picture *picture, const struct viewer_state *state,
                        struct writer *writer) {
  const struct light *light = &picture->world->lights[viewer_state_light(state)];
  if (light->channel_count == 0) return;
  int n = state->channel % light->channel_count;
  say(writer, "channel: %.30s, %d of %d, gain %.3g", light->channels[n].name, n + 1,
      light->channel_count, light->channels[n].gain);
}

/* Of the chosen light, or the first; all pages count. */
static void say_views(const struct viewer_picture *picture, const struct viewer_state *state,
                      struct writer *writer) {
  int light = viewer_state_light(state);
  int number = light_pages(picture->world->lights, light);
  const struct light_axis *all = picture->world->lights[light].pages[0].axes;
  const struct light_axis *used = picture->sum.slides[number].page->axes;
  double in = picture->done * (double)picture->views;
  say(writer, "views: %d x %d of %d x %d, %.0f of %lld are in", used[0].near_count,
      used[1].near_count, all[0].near_count, all[1].near_count, in, (long long)picture->views);
}

/* What is told before all is known leaves shadow maps out. */
static void say_error(const struct viewer_picture *picture, const struct viewer_state *state,
                      struct writer *writer) {
  const char *shadows = state->sum.shadows ? "with" : "without";
  if (isfinite(picture->exact))
    say(writer, "error: %.2g %% %s shadows, by 256 pixels", 100 * picture->exact, shadows);
  else if (picture->done >= 1)
    say(writer, "error: being measured");
  else if (isfinite(picture->error))
    say(writer, "error: %.2g %% against all views, without shadows", 100 * picture->error);
  else if (isfinite(picture->change))
    say(writer, "error: about %.2g %% without shadows (change since half as many views)",
        100 * picture->change);
  else
    say(writer, "error: not known yet");
}

static void say_shadows(const struct viewer_picture *picture, const struct viewer_state *state,
                        struct writer *writer) {
  int size = picture->world->map_size, groups = state->sum.groups;
  if (!state->sum.shadows) return;
  if (groups > 0)
    say(writer, "shadows: %d x %d maps of %d x %d%s", groups, groups, size, size,
        picture->sum.kept ? ", kept" : "");
  else
    say(writer, "shadows: a map a view, %d x %d%s", size, size, picture->sum.kept ? ", kept" : "");
}

static void say_skipped(const struct viewer_picture *picture, const struct viewer_state *state,
                        struct writer *writer) {
  char black[64] = "", behind[64] = "";
  if (picture->black > 0)
    snprintf(black, sizeof black, ", %lld black views", (long long)picture->black);
  if (picture->behind > 0)
    snprintf(behind, sizeof behind, ", %lld views behind", (long long)picture->behind);
  char skipped[256];
  snprintf(skipped, sizeof skipped, "%s%s%s%s", black, behind,
           picture->raster.glossy ? "" : ", highlights: none",
           state->sum.shadows ? "" : ", shadows");
  if (*skipped) say(writer, "skipped: %s", skipped + 2);
}

void viewer_status_write(const struct viewer_picture *picture, const struct viewer_state *state,
                         double seconds, double white, const char *news, struct viewer_text *text) {
  struct writer writer = {.text = text};
  viewer_text_clear(text);
  if (state->text) {
    say(&writer, "%.1f ms a frame, %d x %d; h: help", 1e3 * seconds, text->width, text->height);
    say_selected(picture, state, &writer);
    say_channel(picture, state, &writer);
    say_views(picture, state, &writer);
    say_error(picture, state, &writer);
    say_shadows(picture, state, &writer);
    say_skipped(picture, state, &writer);
    say(&writer, "white: %.3g", white);
    if (*news) say(&writer, "%s", news);
  }
  for (size_t k = 0; state->help && k < sizeof help / sizeof *help; ++k)
    say(&writer, "%s", help[k]);
}
