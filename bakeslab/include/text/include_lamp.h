/* include_lamp.h - a lamp as all kinds of include see it: its pages with light, and what each
 * kind then tells of its lights. */
#ifndef INCLUDE_LAMP_H
#define INCLUDE_LAMP_H

#include <stddef.h>
#include <stdint.h>

#include "base/sdl.h"
#include "slab/slab.h"

/* A place of an include's image, to see whether it is the right image and whether POV-Ray
 * changed its gamma. */
struct include_check {
  double at[3];  /* where the pigment shows it */
  double rgb[3]; /* what the image holds there */
  int channel;   /* of them the one, between 0 and 1, that tells the gamma */
};

enum { INCLUDE_CHANNELS = 16 };

struct include_lamp {
  struct slab frame; /* the first page with light, without samples or text */
  double flux;       /* of all pages, its luminance, with lengths in lamp units */
  char channels[INCLUDE_CHANNELS][SDL_IDENTIFIER_SIZE]; /* names of all pages' */
  int channel_count;
  int black_pages;            /* pages left out because they hold no light */
  uint64_t stamp;             /* hash of all that the include says of its lights */
  struct include_check check; /* if it has an image */
};

/* The pages with light, in order: pointers into `slabs`, in an array that the caller frees;
 * sets frame, flux, black_pages and channels. Refuses negative radiance, which no light of
 * POV-Ray's can give, a lamp of which all pages are black, and channels whose names are no
 * identifiers. */
enum result include_lit_pages(const struct slab *slabs, int count, struct include_lamp *lamp,
                              const struct slab ***lit, int *lit_count, struct error *error);

/* The number of a page's channel, from 1 on; 0: it has none. */
int include_channel(const struct include_lamp *lamp, const struct slab *page);

/* Luminance of linear Rec. 709. */
double include_luminance(const double rgb[3]);

/* Largest value of any channel; 0 for a page without light. */
double include_peak(const struct slab *slab);

/* A page's geometry, without samples or text. */
struct slab include_frame(const struct slab *slab);

/* Refuses a colour that POV-Ray's lights cannot have. `page` counts from 0; -1: of all. */
enum result include_check_colour(double colour, int page, struct error *error);

/* FNV-1a over 64 bits: the hash of `bytes` after that of what came before; start with
 * include_hash_start. */
extern const uint64_t include_hash_start;
uint64_t include_hash(uint64_t before, const void *bytes, size_t count);

#endif
