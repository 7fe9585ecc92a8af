/* bake_options.h - what a bake is asked for, and what it reports. */
#ifndef BAKE_OPTIONS_H
#define BAKE_OPTIONS_H

#include <stdbool.h>

#include "base/warnings.h"
#include "file/slab_precision.h"

/* The st windows: as declared, those narrowed to the light that are much too wide for it, or all
 * fitted to the light, narrower or wider. */
enum bake_window { BAKE_WINDOW_DECLARED, BAKE_WINDOW_NARROWED, BAKE_WINDOW_AUTO };

/* Which rounds a shard bakes: all; the first ones, by which the last is planned; that; or the first
 * that is not whole, if it is one by which others are planned, and else the last. */
enum bake_wave { BAKE_WAVE_ALL, BAKE_WAVE_PILOT, BAKE_WAVE_REST, BAKE_WAVE_NEXT };

struct bake_options {
  const char *lamp, *output;
  const char *povray;           /* program */
  const char *const *libraries; /* Library_Path, NULL-terminated, or NULL */
  const char *effects;          /* "auto", "probe", "all", "none" or a list of words */
  double effect_threshold;      /* part of the flux that an effect must change to matter */
  double tolerance;             /* relative RMS of irradiance that decides uv[] and st[]; 0: none */
  double for_distance;          /* in lamp units; 0: none */
  /* Relative RMS that noise may add to irradiance; 0: as suits the resolution; NAN: no limit. */
  double noise;
  double gain;                         /* 0: by the brightness that the trial run shows */
  void (*warn)(const char *line);      /* told each warning at once; NULL: nobody */
  void (*tell_plan)(const char *line); /* of what it is going to be, before it begins; or NULL */
  const char *depend;  /* a rule for make goes there before the slab is written, or NULL */
  const char *command; /* for the provenance */
  int uv[2], st[2];
  int rays;     /* passes: 1 or an even number; the mean where adaptive */
  int rays_max; /* for the noisiest tiles */
  int form;     /* an enum bake_form, or -1: the cheapest */
  enum bake_window window;
  int jobs;
  int shard, shards; /* this process bakes batches shard, shard+shards, ... */
  enum bake_wave wave;
  enum slab_precision precision;
  bool uv_free, st_free; /* not given: a tolerance may choose others */
  bool centre;           /* one ray through each sample's centre */
  bool uniform;          /* the same passes everywhere */
  bool sandbox;          /* POV-Ray runs in one */
  bool strict;           /* a warning is a failure */
  bool dry_run;          /* ends with the plan */
  bool ask;              /* refuses more than an hour */
  bool quiet;
};

struct bake_report {
  double rays;           /* shot in this run */
  int batches, found;    /* of this bake; found finished by an earlier run */
  bool assembled;        /* this run wrote the slab */
  bool is_shard;         /* this run baked its part of the batches */
  bool by_others;        /* another one did, with its batches */
  bool waits;            /* a shard, for those of others, before it can go on with... */
  int pilot;             /* ... this pilot, */
  bool more_pilots;      /* which others may follow */
  double cpu, probe_cpu; /* seconds of POV-Ray in this run, for the slab and before it */
  double traced;         /* rays of all kinds, by POV-Ray's own count, of all batches */
  double traced_cpu;     /* seconds that it took, by the same count */
  int depth;             /* the deepest trace level that POV-Ray reached */
  char photons_lost[48]; /* "POV-Ray shot 5 photons and stored 0" where most light that meets glass
                            is lost; or empty */
  double error;          /* the slab's own, as slab_accuracy.h estimates it; with a tolerance */
  char energy[256];      /* the balance of its light, in words */
  bool highlights;       /* were left out */
  struct warnings warnings;
};

#endif
