#include "cmd/picture_files.h"

#include <string.h>

#include "cli/cli.h"
#include "file/slab_exr.h"
#include "picture/preview.h"

bool picture_files_end(const char *path, const char *ending) {
  size_t length = strlen(path), end = strlen(ending);
  return length > end && !strcmp(path + length - end, ending);
}

static enum result write_png(const char *path, const struct picture_files *files,
                             const struct picture *picture, struct error *error) {
  double white = files->exposure;
  enum result result = RESULT_OK;
  if (!(white > 0)) {
    result = preview_exposure(picture, &white, error);
    if (result == RESULT_OK)
      cli_note("%s: note: radiance %.4g is white; --exposure %.4g keeps it", path, white, white);
  }
  return result == RESULT_OK ? preview_write(path, picture, white, cli_command_line(), error)
                             : result;
}

enum result picture_files_write(const struct picture_files *files, const struct picture *picture,
                                struct error *error) {
  enum result result = picture_files_end(files->output, ".png")
                           ? write_png(files->output, files, picture, error)
                           : slab_exr_write(files->output, picture, 0, cli_command_line(), error);
  if (result == RESULT_OK && files->preview)
    result = write_png(files->preview, files, picture, error);
  return result;
}
