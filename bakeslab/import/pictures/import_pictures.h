/* import_pictures.h - pictures of a lamp from known places as kinds of import: an array of views
 * (views.h), and pictures with poses (posed.h). Lengths become metres; radiance is as the pictures
 * have it, times wish->exposure. */
#ifndef IMPORT_PICTURES_H
#define IMPORT_PICTURES_H

#include "import/kind/import_kind.h"

extern const struct import_kind import_views, import_posed;

#endif
