#include "base/picture.h"

#include <stdlib.h>
#include <string.h>

void picture_free(struct picture *picture) {
  if (!picture) return;
  free(picture->rgb);
  free(picture->error);
  free(picture->about);
  memset(picture, 0, sizeof *picture);
}
