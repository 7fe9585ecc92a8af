/* picture_files.h - the files of a picture: EXR, or PNG by their endings, and a preview. */
#ifndef PICTURE_FILES_H
#define PICTURE_FILES_H

#include <argp.h>
#include <stdbool.h>

#include "base/picture.h"
#include "base/result.h"

struct picture_files {
  const char *output;  /* .exr or .png; "-": EXR on standard output */
  const char *preview; /* a PNG; NULL: none */
  bool exposed;        /* white in PNGs is by `exposure`; else by the picture, and told in a note */
  double exposure;     /* EV at ISO 100: 78/(0.65 * 100) * 2^EV cd/m2 is white (ISO 12232) */
  double luminance;    /* of 1 in the picture, cd/m2 */
};

/* Does the path have a name and this ending? */
bool picture_files_end(const char *path, const char *ending);

/* For argp: complains of an output that is not there, or neither EXR nor PNG. */
void picture_files_check(const char *path, struct argp_state *state);

/* For argp: what --exposure says, "auto" or an EV. */
void picture_files_expose(const char *value, struct picture_files *files, struct argp_state *state);

/* Seconds that writing a picture takes whose pixels are the same in blocks of step x step, by
 * writing a small one, which is not kept, to where the files will be. */
double picture_files_seconds(const struct picture_files *files, int width, int height, int step);

/* Each whole or not at all. */
enum result picture_files_write(const struct picture_files *files, const struct picture *picture,
                                struct error *error);

#endif
