#include "viewer/viewer_command.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/vector.h"
#include "cli/cli.h"

/* A blank and a word, quoted where it must be. */
__attribute__((format(printf, 2, 3))) static void add_word(FILE *out, const char *format, ...) {
  char *word = NULL, *quoted = NULL;
  va_list arguments;
  va_start(arguments, format);
  if (vasprintf(&word, format, arguments) < 0) word = NULL;
  va_end(arguments);
  if (word) quoted = cli_quote(word);
  fprintf(out, " %s", quoted ? quoted : "");
  free(quoted);
  free(word);
}

static void add_camera(FILE *out, const struct camera *camera) {
  const double *from = camera->from, *at = camera->at, *up = camera->up;
  add_word(out, "--camera");
  add_word(out, "from=%.9g,%.9g,%.9g at=%.9g,%.9g,%.9g up=%.9g,%.9g,%.9g fov=%.9g", from[0],
           from[1], from[2], at[0], at[1], at[2], up[0], up[1], up[2], camera->fov);
}

/* " gain.NAME=G" of each channel, to be freed; NULL without memory. */
static char *channel_gains(const struct light *light) {
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  for (int n = 0; n < light->channel_count; ++n)
    fprintf(out, " gain.%s=%.9g", light->channels[n].name, light->channels[n].gain);
  fclose(out);
  return text;
}

static void add_light(FILE *out, const char *text, const struct light *light, bool changed) {
  const double(*m)[3] = light->matrix;
  add_word(out, "--light");
  if (!changed) {
    add_word(out, "%s", text);
    return;
  }
  char *channels = channel_gains(light);
  add_word(out,
           "%s matrix=%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g "
           "gain=%.9g,%.9g,%.9g%s",
           light->path, m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1],
           m[2][2], m[3][0], m[3][1], m[3][2], light->gain[0], light->gain[1], light->gain[2],
           channels ? channels : "");
  free(channels);
}

static void add_sum(FILE *out, const struct viewer_world *world, const struct viewer_sum *sum) {
  fprintf(out, " --method gl");
  if (sum->level > 0) fprintf(out, " --level %d", sum->level);
  if (!sum->shadows) {
    fprintf(out, " --no-shadows");
    return;
  }
  fprintf(out, " --shadow-map %d", world->map_size);
  if (sum->groups > 0) fprintf(out, " --shadow-groups %d", sum->groups);
}

char *viewer_command(const struct viewer_arguments *arguments, const struct viewer_state *state,
                     int width, int height, const char *output) {
  const struct viewer_world *world = arguments->world;
  const double *behind = world->background;
  char *command = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&command, &size);
  if (!out) return NULL;
  fprintf(out, "renderslab image");
  add_word(out, "%s", arguments->mesh);
  for (int k = 0; k < world->light_count; ++k) {
    const struct viewer_light *light = &state->lights[k];
    bool changed = !viewer_same_place(light->matrix, light->first);
    for (int n = 0; n < light->channel_count; ++n)
      changed |= light->gains[n] != light->first_gains[n];
    add_light(out, arguments->lights[k], &world->lights[k], changed);
  }
  add_camera(out, &state->camera);
  add_sum(out, world, &state->sum);
  fprintf(out, " --size %dx%d", width, height);
  if (!vector_is_zero(behind))
    add_word(out, "--background=%.9g,%.9g,%.9g", behind[0], behind[1], behind[2]);
  if (arguments->repair) fprintf(out, " --repair");
  fprintf(out, " -o");
  add_word(out, "%s", output);
  if (fclose(out) != 0) {
    free(command);
    return NULL;
  }
  return command;
}
