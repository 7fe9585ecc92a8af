/* cut_seen.h - a tree's nodes as one receiver sees them: what is estimated of a node, at the
 * cost of a look at one st sample, and its light. All lengths are in the tree's units
 * (cut_tree_view). */
#ifndef CUT_SEEN_H
#define CUT_SEEN_H

#include "cut/cut_tree.h"
#include "microlight/seen_page.h"

/* Where the receiver sees the center of an interval. */
struct cut_spot {
  double slope, place; /* place: number of the st sample */
  double size;         /* of the interval, in slopes */
  int cell;
  int line;              /* the nearest st sample */
  double bend;           /* what it makes of the error at a line; 0: not in the view */
  bool seen, whole;      /* is any of it, is all of it within the st window */
  struct cut_taps *taps; /* NULL: not made yet */
};

/* What the nodes of a level have in common. */
struct cut_seen_level {
  struct cut_spot *spots[2]; /* NULL: not made yet */
  bool narrow;               /* errors are those at lines */
  double across;             /* half the width, in st samples */
  bool wide;                 /* wider than errors are known for */
  int spread;                /* their errors are those of this width or the next, */
  double reach[2];           /* largest distance from a node's center, in slopes */
  double samples;            /* of st that a node is summed over */
};

/* Zero-initialised; used again from receiver to receiver. */
struct cut_seen {
  const struct cut_tree *tree;
  const struct seen_page *page;
  double w, rate[2]; /* cut.h; of the st sample's number, by length along the aperture */
  double per_height, tilt;
  struct cut_seen_level level[CUT_LEVELS];
  struct cut_spot *spots; /* owned */
  struct cut_taps *taps;  /* owned */
  size_t room, taps_used;
};

struct cut_node {
  int level, at[2];
  double light;  /* estimated: of the largest channel */
  double spread; /* error: views that differ from the node */
  double bent;   /* error: the kernel's expansion */
  double bend;   /* the latter's share of the light */
};

void cut_seen_free(struct cut_seen *seen);

/* Another receiver. False: without memory. */
bool cut_seen_begin(const struct cut_tree *tree, const struct seen_page *page,
                    struct cut_seen *made);

/* To be called before a level's nodes are looked at. */
void cut_seen_prepare(struct cut_seen *seen, int level);

/* Estimates a node. False: nothing of it is seen. */
bool cut_seen_estimate(const struct cut_seen *seen, int level, const int at[2],
                       struct cut_node *node);

/* Adds a node's light. `error` grows where the kernel bends more light than was estimated.
 * False: more st samples than CUT_TAPS. */
bool cut_seen_light(struct cut_seen *seen, const struct cut_node *node, double rgb[3],
                    double *error);

#endif
