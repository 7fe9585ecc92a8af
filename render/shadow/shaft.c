/* shaft.c - triangles are the leaves of a tree of boxes. */
#include "shadow/shaft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "scene/scene.h"

enum { LEAF = 4 }; /* most triangles */

struct triangle {
  double corner[3][3];
};

/* A box around the triangles first to last; its halves are the next node and `right`. */
struct node {
  double low[3], high[3];
  int first, last, right; /* right 0: a leaf */
};

struct shaft_tree {
  struct triangle *triangles;
  struct node *nodes;
  int count;
};

static double centre(const struct triangle *triangle, int axis) {
  return triangle->corner[0][axis] + triangle->corner[1][axis] + triangle->corner[2][axis];
}

static void bound(const struct shaft_tree *tree, struct node *node) {
  vector_box(node->low, node->high);
  for (int k = node->first; k < node->last; ++k)
    for (int corner = 0; corner < 3; ++corner)
      vector_widen(node->low, node->high, tree->triangles[k].corner[corner]);
}

/* Reorders triangles so that those before `middle` are not right of it (Hoare's selection). */
static void select_middle(struct triangle *triangles, int first, int last, int middle, int axis) {
  while (last - first > 1) {
    double pivot = centre(&triangles[(first + last) / 2], axis);
    int low = first, high = last - 1;
    while (low <= high) {
      while (centre(&triangles[low], axis) < pivot) ++low;
      while (centre(&triangles[high], axis) > pivot) --high;
      if (low > high) break;
      struct triangle swap = triangles[low];
      triangles[low++] = triangles[high];
      triangles[high--] = swap;
    }
    if (middle <= high)
      last = high + 1;
    else if (middle >= low)
      first = low;
    else
      return;
  }
}

/* Makes the node for a range and those below it; halves are equal, so the depth is small. */
static void build(struct shaft_tree *tree, int first, int last) {
  struct node *node = &tree->nodes[tree->count++];
  *node = (struct node){.first = first, .last = last};
  bound(tree, node);
  if (last - first <= LEAF) return;
  int axis = 0, middle = first + (last - first) / 2;
  for (int c = 1; c < 3; ++c)
    if (node->high[c] - node->low[c] > node->high[axis] - node->low[axis]) axis = c;
  select_middle(tree->triangles, first, last, middle, axis);
  build(tree, first, middle);
  node->right = tree->count;
  build(tree, middle, last);
}

enum result shaft_tree_create(const struct scene *scene, struct shaft_tree **tree,
                              struct error *error) {
  size_t count = scene->triangles;
  if (count > (1 << 29))
    return result_fail(error, RESULT_MEMORY, "%zu triangles are too many", count);
  struct shaft_tree *made = calloc(1, sizeof *made);
  if (made) {
    made->triangles = calloc(count + 1, sizeof *made->triangles);
    made->nodes = calloc(count + 1, sizeof *made->nodes);
  }
  if (!made || !made->triangles || !made->nodes) {
    shaft_tree_free(made);
    return result_fail(error, RESULT_MEMORY, "out of memory for %zu triangles", count);
  }
  for (size_t k = 0; k < count; ++k)
    for (int corner = 0; corner < 3; ++corner)
      memcpy(made->triangles[k].corner[corner], scene->position[scene->corners[k][corner]],
             sizeof made->triangles[k].corner[corner]);
  if (count > 0) build(made, 0, (int)count);
  *tree = made;
  return RESULT_OK;
}

void shaft_tree_free(struct shaft_tree *tree) {
  if (!tree) return;
  free(tree->triangles);
  free(tree->nodes);
  free(tree);
}

/* What lies between: the hull of the receivers' box and the aperture, as its corners. */
enum { HULL = 12 };
struct shaft {
  const double (*receivers)[3];
  int count;
  const double (*corners)[3];
  double hull[HULL][3];
};

static double extreme(const double (*points)[3], int count, const double axis[3], double sign,
                      const double **at) {
  double best = -INFINITY;
  for (int k = 0; k < count; ++k) {
    double along = sign * vector_dot(points[k], axis);
    if (along > best) {
      best = along;
      *at = points[k];
    }
  }
  return best;
}

/* Is there a plane between two sets of points? Looks along the vector from one to the other
 * and moves it towards the shortest one (Frank and Wolfe); `true` is certain. */
static bool apart(const double (*a)[3], int a_count, const double (*b)[3], int b_count) {
  double v[3];
  vector_subtract(a[0], b[0], v);
  for (int step = 0; step < 24; ++step) {
    const double *from = a[0], *to = b[0];
    double nearest = -extreme(a, a_count, v, -1, &from), farthest = extreme(b, b_count, v, 1, &to);
    if (nearest - farthest > 1e-12 * (fabs(nearest) + fabs(farthest))) return true;
    double w[3], back[3];
    vector_subtract(from, to, w);
    vector_subtract(v, w, back);
    double length = vector_dot(back, back);
    if (!(length > 0)) return false;
    double share = fmin(fmax(vector_dot(v, back) / length, 0), 1);
    for (int c = 0; c < 3; ++c) v[c] -= share * back[c];
  }
  return false;
}

static void box_corners(const double low[3], const double high[3], double corners[8][3]) {
  for (int k = 0; k < 8; ++k)
    for (int c = 0; c < 3; ++c) corners[k][c] = (k >> c & 1) ? high[c] : low[c];
}

static bool one_side(const double normal[3], const double at[3], const double (*points)[3],
                     int count, double sign) {
  for (int k = 0; k < count; ++k) {
    double to[3];
    vector_subtract(points[k], at, to);
    if (sign * vector_dot(to, normal) < 0) return false;
  }
  return true;
}

static bool may_block(const struct shaft *shaft, const struct triangle *triangle) {
  double along[2][3], normal[3];
  for (int k = 0; k < 2; ++k)
    vector_subtract(triangle->corner[k + 1], triangle->corner[0], along[k]);
  vector_cross(along[0], along[1], normal);
  for (int sign = -1; sign <= 1; sign += 2)
    if (one_side(normal, triangle->corner[0], shaft->receivers, shaft->count, sign) &&
        one_side(normal, triangle->corner[0], shaft->corners, 4, sign))
      return false;
  return !apart((const double(*)[3])triangle->corner, 3, (const double(*)[3])shaft->hull, HULL);
}

static bool search(const struct shaft_tree *tree, const struct shaft *shaft, int index) {
  const struct node *node = &tree->nodes[index];
  double corners[8][3];
  box_corners(node->low, node->high, corners);
  if (apart((const double(*)[3])corners, 8, (const double(*)[3])shaft->hull, HULL)) return false;
  if (node->right > 0) return search(tree, shaft, index + 1) || search(tree, shaft, node->right);
  for (int k = node->first; k < node->last; ++k)
    if (may_block(shaft, &tree->triangles[k])) return true;
  return false;
}

bool shaft_may_block(const struct shaft_tree *tree, const double (*receivers)[3], int count,
                     const double corners[4][3]) {
  if (tree->count == 0 || count == 0) return false;
  struct shaft shaft = {receivers, count, corners, {{0}}};
  double low[3], high[3];
  vector_box(low, high);
  for (int k = 0; k < count; ++k) vector_widen(low, high, receivers[k]);
  box_corners(low, high, shaft.hull);
  memcpy(shaft.hull[8], corners, 4 * sizeof *corners);
  return search(tree, &shaft, 0);
}
