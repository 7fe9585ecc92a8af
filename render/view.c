/* view.c - see view.h. */
#include "view.h"

#include "vector.h"

bool view_find(const struct light_page *page, const struct receiver *receiver, struct view *view) {
  double from_center[3];
  vector_subtract(receiver->position, page->center, from_center);
  view->page = page;
  view->height = vector_dot(from_center, page->frame[2]);
  if (!(view->height >= 0)) return false;
  for (int axis = 0; axis < 2; ++axis)
    view->foot[axis] = vector_dot(from_center, page->frame[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    view->kernel.normal[axis] = vector_dot(receiver->normal, page->frame[axis]);
    view->kernel.eye[axis] = vector_dot(receiver->eye, page->frame[axis]);
  }
  view->kernel.shininess = receiver->shininess;
  return true;
}

enum slab_result view_strips(const struct view *view, bool each_view, struct strips strips[2],
                             struct slab_error *error) {
  enum slab_result result = SLAB_OK;
  for (int axis = 0; axis < 2 && result == SLAB_OK; ++axis)
    result = (each_view ? strips_find_views : strips_find)(
        &view->page->axes[axis], view->foot[axis], view->height, &strips[axis], error);
  return result;
}

size_t view_offset(const struct view *view, int axis, int near, int far) {
  const struct slab *slab = &view->page->slab;
  size_t index = (size_t)near * (size_t)slab->samples[axis ? SLAB_T : SLAB_S] + (size_t)far;
  return 3 * index * (axis ? (size_t)slab_width(slab) : 1);
}

void view_rows(const struct view *view, const struct strip_taps *taps, const float *rows[4]) {
  for (int tap = 0; tap < 4; ++tap)
    rows[tap] = view->page->slab.rgb + view_offset(view, 1, taps->near + (tap >> 1) * taps->near_up,
                                                   taps->far + (tap & 1) * taps->far_up);
}

void view_columns(const struct view *view, const struct strip_taps *taps, int offset[2]) {
  for (int side = 0; side < 2; ++side)
    offset[side] = (int)view_offset(view, 0, taps->near + side * taps->near_up, taps->far);
}
