/* cut_seen.h - a tree's nodes as one receiver sees them. All lengths are in the tree's units
 * (cut_tree_seen). */
#ifndef CUT_SEEN_H
#define CUT_SEEN_H

#include "cut/cut_node.h"
#include "cut/cut_tree.h"
#include "microlight/seen_page.h"

/* What the nodes of a level have in common. */
struct cut_seen_level {
  struct cut_spots *spots[2]; /* of four intervals each */
  struct cut_taps *taps[2];   /* of each interval; `count` is -1 where they are not made yet */
  struct cut_width width;
  double reach[2]; /* largest distance from a node's center, in slopes */
  double samples;  /* of st that a node is summed over */
};

/* Zero-initialised; used again from receiver to receiver. */
struct cut_seen {
  const struct cut_tree *tree;
  const struct seen_page *seen;
  double w;                 /* cut.h */
  double rate[2], speed[2]; /* st samples per length along the aperture; its size, */
  double per_speed[2];      /* and 1 over that */
  double per_height;        /* 1/height */
  double tilt, slant;       /* cut_nodes (cut_four.h) */
  int prepared, fours;      /* levels, and the fours of intervals in them */
  struct cut_seen_level level[CUT_LEVELS];
  struct cut_spots *spots; /* owned */
  struct cut_taps *taps;   /* owned */
  int room;                /* fours */
};

void cut_seen_free(struct cut_seen *nodes);

/* Another receiver. False: no memory. */
bool cut_seen_begin(const struct cut_tree *tree, const struct seen_page *seen,
                    struct cut_seen *nodes);

/* To be called before a level's nodes are estimated, level by level; more than once is allowed. */
void cut_seen_prepare(struct cut_seen *nodes, int level);

/* Is any, is all of an interval within the st window? */
static inline bool cut_seen_any(const struct cut_seen *nodes, int level, int axis, int at) {
  return nodes->level[level].spots[axis][at >> 2].seen[at & 3];
}
static inline bool cut_seen_whole(const struct cut_seen *nodes, int level, int axis, int at) {
  return nodes->level[level].spots[axis][at >> 2].whole[at & 3];
}

/* Estimates up to four nodes of a level. Returns how many are seen: those are written to the first
 * of `nodes`, in their order. */
int cut_seen_estimate(const struct cut_seen *seen, int level, const int (*at)[2], int count,
                      struct cut_node *const *nodes);

/* Adds a node's light, as cut_node_light. False: more st samples than CUT_TAPS. */
bool cut_seen_light(struct cut_seen *nodes, const struct cut_node *node, double rgb[3],
                    double *error);

#endif
