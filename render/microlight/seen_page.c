#include "microlight/seen_page.h"

#include "base/vector.h"

bool seen_page_find(const struct light_page *page, const struct receiver *receiver,
                    struct seen_page *seen) {
  double from_center[3];
  vector_subtract(receiver->position, page->center, from_center);
  seen->page = page;
  seen->height = vector_dot(from_center, page->frame[2]);
  if (!(seen->height >= 0)) return false;
  for (int axis = 0; axis < 2; ++axis)
    seen->foot[axis] = vector_dot(from_center, page->frame[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    seen->kernel.normal[axis] = vector_dot(receiver->normal, page->frame[axis]);
    seen->kernel.eye[axis] = vector_dot(receiver->eye, page->frame[axis]);
  }
  seen->kernel.shininess = receiver->shininess;
  return true;
}

void seen_page_middle(const struct seen_page *seen, double middle[2]) {
  for (int axis = 0; axis < 2; ++axis) middle[axis] = -seen->foot[axis] / seen->height;
}

void seen_page_aperture(const struct seen_page *seen, double low[2], double high[2]) {
  const double per_height = 1 / seen->height;
  for (int axis = 0; axis < 2; ++axis) {
    low[axis] = (-seen->page->axes[axis].half - seen->foot[axis]) * per_height;
    high[axis] = (seen->page->axes[axis].half - seen->foot[axis]) * per_height;
  }
}

void seen_page_heights(const struct seen_page *seen, const struct strips strips[2],
                       double range[2]) {
  double low[2], high[2];
  for (int axis = 0; axis < 2; ++axis) {
    low[axis] = strips[axis].strip[0].low;
    high[axis] = strips[axis].strip[strips[axis].count - 1].high;
  }
  kernel_heights(&seen->kernel, low, high, range);
}

enum result seen_page_strips(const struct seen_page *seen, bool each_view, struct strips strips[2],
                             struct error *error) {
  enum result result = RESULT_OK;
  for (int axis = 0; axis < 2 && result == RESULT_OK; ++axis)
    result = (each_view ? strips_find_views : strips_find)(
        &seen->page->axes[axis], seen->foot[axis], seen->height, &strips[axis], error);
  return result;
}

size_t seen_page_offset(const struct seen_page *seen, int axis, int near, int far) {
  const struct slab *slab = &seen->page->slab;
  size_t index = (size_t)near * (size_t)slab->samples[axis ? SLAB_T : SLAB_S] + (size_t)far;
  return 3 * index * (axis ? (size_t)slab_width(slab) : 1);
}

void seen_page_rows(const struct seen_page *seen, const struct strip_taps *taps,
                    const float *rows[4]) {
  for (int tap = 0; tap < 4; ++tap)
    rows[tap] =
        seen->page->slab.rgb + seen_page_offset(seen, 1, taps->near + (tap >> 1) * taps->near_up,
                                                taps->far + (tap & 1) * taps->far_up);
}

void seen_page_columns(const struct seen_page *seen, const struct strip_taps *taps, int offset[2]) {
  for (int side = 0; side < 2; ++side)
    offset[side] = (int)seen_page_offset(seen, 0, taps->near + side * taps->near_up, taps->far);
}
