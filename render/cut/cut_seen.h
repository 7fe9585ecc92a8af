/* cut_seen.h - a tree's nodes as one receiver sees them: what is estimated of a node, at the
 * cost of a look at one st sample, and its light. All lengths are in the tree's units
 * (cut_tree_seen). */
#ifndef CUT_SEEN_H
#define CUT_SEEN_H

#include "cut/cut_tree.h"
#include "microlight/seen_page.h"

/* Where the receiver sees the center of an interval. */
struct cut_spot {
  double slope, place;   /* place: number of the st sample */
  double size;           /* of the interval, in slopes */
  int cell;              /* number of the st sample before it */
  int line;              /* of the nearest st sample */
  double per_curvature;  /* error per curvature of radiance at that; 0 if unseen */
  bool seen, whole;      /* is any of it, is all of it within the st window */
  struct cut_taps *taps; /* NULL: not made yet */
};

/* What the nodes of a level have in common. */
struct cut_seen_level {
  struct cut_spot *spots[2]; /* NULL: not made yet */
  double across;             /* half of a node's width, in st samples */
  bool narrow;               /* seen at most one sample wide: errors are those at lines */
  bool wide;                 /* wider than errors are known for */
  int spread;      /* else errors are those of this of the CUT_SPREADS widths or the next */
  double reach[2]; /* largest distance from a node's center, in slopes */
  double samples;  /* of st that a node is summed over */
};

/* Zero-initialised; used again from receiver to receiver. */
struct cut_seen {
  const struct cut_tree *tree;
  const struct seen_page *seen;
  double w;                /* cut.h */
  double rate[2];          /* st samples per length along the aperture */
  double per_height, tilt; /* 1/height; length of the normal's part in the uv plane */
  struct cut_seen_level level[CUT_LEVELS];
  struct cut_spot *spots; /* owned */
  struct cut_taps *taps;  /* owned */
  size_t room, taps_used;
};

struct cut_node {
  int level, at[2];
  double light;               /* estimated: of the largest channel */
  double spread;              /* error: views that differ from the node */
  double curvature;           /* error: what the kernel's expansion leaves out */
  double curvature_per_light; /* of that, what is proportional to the light */
};

void cut_seen_free(struct cut_seen *nodes);

/* Another receiver. False: no memory. */
bool cut_seen_begin(const struct cut_tree *tree, const struct seen_page *seen,
                    struct cut_seen *nodes);

/* To be called before a level's nodes are estimated. */
void cut_seen_prepare(struct cut_seen *nodes, int level);

/* Estimates a node. False: nothing of it is seen. */
bool cut_seen_estimate(const struct cut_seen *nodes, int level, const int at[2],
                       struct cut_node *node);

/* Adds a node's light; and to `error` its curvature_per_light of what is more than was estimated.
 * False: more st samples than CUT_TAPS. */
bool cut_seen_light(struct cut_seen *nodes, const struct cut_node *node, double rgb[3],
                    double *error);

#endif
