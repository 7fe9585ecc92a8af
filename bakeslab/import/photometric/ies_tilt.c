#include "import/photometric/ies_tilt.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/files.h"

enum { TILT_NAME = 256 };

/* The lamps' output by the tilt of the luminaire: the factor where it is not tilted. */
static enum result read_tilt(struct photometry_text *text, double *factor, double *least,
                             struct error *error) {
  int geometry, count;
  double *angles = NULL;
  enum result result = photometry_text_whole(text, "the lamp's position in the luminaire (1 to 3)",
                                             1, 3, &geometry, error);
  if (result == RESULT_OK)
    result = photometry_text_whole(text, "the number of tilt angles", 1, PHOTOMETRY_MOST_ANGLES,
                                   &count, error);
  if (result != RESULT_OK) return result;
  if (!(angles = calloc(2 * (size_t)count, sizeof *angles))) return result_no_memory(error);
  double *factors = angles + count;
  result = photometry_text_numbers(text, "tilt angles", (size_t)count, angles, error);
  if (result == RESULT_OK)
    result = photometry_text_ascending(text, "tilt angles", angles, count, -180, 180, error);
  if (result == RESULT_OK)
    result = photometry_text_numbers(text, "tilt factors", (size_t)count, factors, error);
  if (result == RESULT_OK) {
    *factor = factors[0];
    *least = factors[0];
    for (int k = 1; k < count; ++k) {
      double part = angles[k] > angles[k - 1] ? -angles[k - 1] / (angles[k] - angles[k - 1]) : 0;
      if (angles[k - 1] <= 0 && angles[k] >= 0)
        *factor = factors[k - 1] + part * (factors[k] - factors[k - 1]);
      *least = fmin(*least, factors[k]);
    }
  }
  free(angles);
  return result;
}

/* The name in a folder that differs from the file's only by its case, the first of the alphabet
 * if there are more; empty if there is none. Makers' files come from systems that make no
 * difference. */
static void find_case(const char *folder, char file[TILT_NAME]) {
  DIR *open = opendir(folder);
  char found[TILT_NAME] = "";
  for (struct dirent *entry; open && (entry = readdir(open));)
    if (!strcasecmp(entry->d_name, file) && (!*found || strcmp(entry->d_name, found) < 0))
      snprintf(found, sizeof found, "%s", entry->d_name);
  if (open) closedir(open);
  memcpy(file, found, sizeof found);
}

/* A file's text; its name becomes that which it has in the folder. */
static char *read_named(const char *folder, char file[TILT_NAME]) {
  char *content = files_read(folder, file);
  char other[TILT_NAME];
  if (content) return content;
  memcpy(other, file, sizeof other);
  find_case(folder, other);
  if (!*other) return NULL;
  memcpy(file, other, sizeof other);
  return files_read(folder, file);
}

/* A TILT file: what INCLUDE would have here, in a file of its own beside this one. */
static enum result read_tilt_file(const char *folder, const char *name, size_t length, int line,
                                  double *factor, double *least, struct error *error) {
  char file[TILT_NAME] = "";
  for (size_t k = 0; k < length; ++k) /* paths of another machine */
    if (name[k] == '/' || name[k] == '\\') name += k + 1, length -= k + 1, k = (size_t)-1;
  if (length == 0 || length >= sizeof file)
    return result_fail(error, RESULT_BAD,
                       "line %d: TILT= must be NONE, INCLUDE or the name of a "
                       "file",
                       line);
  memcpy(file, name, length);
  file[length] = 0;
  char *content = folder ? read_named(folder, file) : NULL;
  if (!content)
    return result_fail(error, RESULT_BAD,
                       "line %d: the TILT file %s cannot be read: put it beside "
                       "this file, or write TILT=NONE",
                       line, file);
  struct photometry_text text = photometry_text_of(content, strlen(content));
  enum result result = read_tilt(&text, factor, least, error);
  free(content);
  return result_at(result, error, "TILT file %s", file);
}

enum result ies_tilt(struct photometry_text *text, const char *tilt, size_t length,
                     const char *folder, double *factor, struct warnings *notes,
                     struct error *error) {
  double least = 1;
  enum result result;
  *factor = 1;
  while (length > 0 && tilt[length - 1] == ' ') --length;
  while (length > 0 && *tilt == ' ') ++tilt, --length;
  if (length == 4 && !memcmp(tilt, "NONE", 4)) return RESULT_OK;
  if (length == 7 && !memcmp(tilt, "INCLUDE", 7))
    result = read_tilt(text, factor, &least, error);
  else
    result = read_tilt_file(folder, tilt, length, text->line - 1, factor, &least, error);
  if (result == RESULT_OK)
    warnings_add(notes,
                 "its lamps' output changes when it is tilted (TILT: down to %g): the slab "
                 "is the luminaire as it was measured, not tilted; use gain for another position",
                 least);
  return result;
}
