#include "import/rays/ray_file.h"

#include <math.h>

enum result ray_file_open(const char *path, const struct ray_format *format, double metres,
                          struct warnings *notes, struct ray_file *file, struct error *error) {
  *file = (struct ray_file){
      .path = path, .format = format, .metres = metres, .stated = NAN, .notes = notes};
  enum result result = ray_bytes_open(path, &file->bytes, error);
  if (result == RESULT_OK) result = format->open(file, error);
  if (result != RESULT_OK) ray_file_close(file);
  return result_at(result, error, "%s", path);
}

void ray_file_close(struct ray_file *file) {
  ray_bytes_close(&file->bytes);
}

enum result ray_file_read(struct ray_file *file, struct ray *rays, size_t most, size_t *count,
                          struct error *error) {
  *count = 0;
  return result_at(file->format->read(file, rays, most, count, error), error, "%s", file->path);
}
