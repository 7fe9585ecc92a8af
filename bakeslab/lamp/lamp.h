/* lamp.h - a lamp script and what it declares by canned.inc's macros.
 *
 * A trial run of the script by POV-Ray, lamp_try, tells all that a bake must know first: the
 * slabs and effects that the script declares, the files that it reads, how bright the lamp is, and
 * whether this POV-Ray's mesh_camera works and with which row defect
 * (include-pov/canned_bake.inc). */
#ifndef LAMP_H
#define LAMP_H

#include <signal.h>

#include "lamp/effects.h"
#include "lamp/lamp_reads.h"
#include "povray/povray.h"
#include "slab/slab.h"

enum { LAMP_MAX_LIBRARIES = 32, LAMP_LINK_SIZE = 24, LAMP_MAX_CHANNELS = 16 };

/* The names, in a scene's folder, of the links to the script and to the preloaded library that
 * lists the files read. LD_PRELOAD takes blanks for separators, and the library's own path may
 * hold some. */
#define LAMP_SCRIPT "canned-lamp.pov"
#define LAMP_READS "canned-reads.so"
#define LAMP_PRELOAD "./canned-reads.so" /* from the folder where POV-Ray runs */

/* The environment in which POV-Ray sees a script without its highlights. */
extern const char *const lamp_without_highlights[];

/* Where POV-Ray finds what a script needs. Paths are absolute and owned. */
struct lamp_source {
  const char *script;                      /* as the user named it, for messages; not owned */
  char *path;                              /* the script */
  char *folder;                            /* its folder: relative includes are found there */
  char *include_pov;                       /* canned.inc's folder */
  char *reads;                             /* the library that lists the files read */
  char *libraries[LAMP_MAX_LIBRARIES + 1]; /* the user's -L folders */
};

/* A group of bulbs that Canned_Channel names. */
struct lamp_channel {
  char name[SLAB_CHANNEL_SIZE];
  int bulbs;  /* calls of Canned_Bulb */
  int lights; /* of these, of Canned_Glow and of Canned_Lit */
};

struct lamp {
  int slab_count;
  struct slab *slabs; /* geometry as declared; samples[] are all 1 */
  bool needs_declared;
  char needs[256];         /* of Canned_Needs */
  struct lamp_reads reads; /* every file that the script reads */
  int channel_count;       /* 0: all bulbs together */
  struct lamp_channel channels[LAMP_MAX_CHANNELS];
  int bulbs;           /* calls of Canned_Bulb */
  int all_lights;      /* light_sources by POV-Ray's own count, which leaves light_groups out */
  int lights;          /* besides Canned_Bulb's: of lamp_count_lights; lamp_try leaves 0 */
  double peak;         /* brightest radiance of the trial run and the bulbs, any channel */
  double mean;         /* of the radiance that the trial run saw */
  double bulb_flux[3]; /* of all bulbs, in units of radiance and lamp units squared */
  double glow_flux[3]; /* the same of Canned_Glow */
  bool final_window;   /* Canned_Window_Is_Final */
  bool own_radiosity;  /* the script turns radiosity on by itself */
  bool mesh_camera;    /* works */
  bool hazy;           /* fog or media fill all of space */
  int defect_rows;     /* image rows to skip: 1 with POV-Ray 3.7's defect */
};

/* Resolves the script and finds include-pov and the preloaded library beside the
 * running program. Free it with lamp_source_free in any case. */
enum result lamp_source_open(const char *script, const char *const *libraries,
                             struct lamp_source *source, struct error *error);
void lamp_source_free(struct lamp_source *source);

/* Makes `directory` and puts links to all that a scene in it includes: the
 * script is LAMP_SCRIPT there. */
enum result lamp_source_link(const struct lamp_source *source, const char *directory,
                             struct error *error);

/* The Library_Path entries that go with the links, NULL-terminated. The library must stay where
 * it is: paths[] points into it. */
struct lamp_library {
  const char *paths[LAMP_MAX_LIBRARIES + 3];
  char names[LAMP_MAX_LIBRARIES][LAMP_LINK_SIZE];
};
void lamp_source_library(const struct lamp_source *source, struct lamp_library *library);

/* Puts the user's file names back into a message of POV-Ray's. */
void lamp_source_rename(const struct lamp_source *source, struct error *error);

/* Reads what canned.inc wrote of the script into a zeroed lamp: slabs, needs, bulbs. `text` is
 * cut up on the way; NULL is an empty one. Messages begin with `script`. */
enum result lamp_declarations(char *text, const char *script, struct lamp *lamp,
                              struct error *error);

/* Runs the script in `directory`, which is made if need be, and removed. `effects` are those that
 * are on; NULL leaves that to its Canned_Needs. `change` is a variable that
 * canned.inc or canned_bake.inc look for; NULL: none. `stop` as for povray_run. Free the lamp with
 * lamp_free in any case. */
enum result lamp_try(const struct povray *povray, const struct lamp_source *source,
                     const char *directory, const struct effects *effects, const char *change,
                     const volatile sig_atomic_t *stop, struct lamp *lamp, struct error *error);
void lamp_free(struct lamp *lamp);

#endif
