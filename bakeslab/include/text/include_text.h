/* include_text.h - what the texts of all kinds of include share. The callers check
 * the stream. */
#ifndef INCLUDE_TEXT_H
#define INCLUDE_TEXT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "slab/slab.h"

/* What an include says besides the light itself. */
struct include_text {
  const char *name;     /* an identifier, capitalised: Desk_Lamp */
  const char *file;     /* names of the include and its image, without folders */
  const char *image;    /* NULL: it has none */
  const char *command;  /* that made them */
  const char *housing;  /* SDL of the visible lamp, or NULL */
  int housing_left_out; /* there was one, which is not safe to use */
  const char *chosen;   /* why it is of this kind, or NULL; one line */
};

/* Prints `template` with @ replaced by the lamp's name. */
void include_named(const char *template, const char *name, FILE *out);

/* The header's first part. `description` goes on where "light that leaves its aperture."
 * ends; `options` are the variables that may be declared, with @ for the name. */
void include_head(const struct include_text *text, const char *description, const char *options,
                  FILE *out);
void include_units(const struct slab *slab, FILE *out);

/* Guard, stamp and, at the end, the housing's macro. Only the first of two includes of
 * one name declares it; the second finds out whether it is the same lamp. `stamp` is the
 * hash of the lamp's data. */
void include_begin(const struct include_text *text, uint64_t stamp, FILE *out);
void include_end(const struct include_text *text, uint64_t stamp, FILE *out);

/* A place of the image whose value the include knows, to see that it is the right
 * image and whether POV-Ray changed its gamma. */
struct include_check {
  double at[3];  /* where the pigment shows it */
  double rgb[3]; /* what the image holds there */
  int channel;   /* of them the one, between 0 and 1, that tells the gamma */
};

/* Finds and reads the image into the pigment @_Sheet; `mapping` goes into its
 * image_map. */
void include_image(const struct include_text *text, const char *mapping,
                   const struct include_check *check, FILE *out);

/* Macros: @_Text(X) writes a number for a message. @_Strength(Colour) stops where POV-Ray's
 * numbers cannot hold a lamp whose brightest light has this colour and a fade distance of 1e-3
 * aperture widths, @_Fits(Width) where it is wider in the scene than include_most_width. */
extern const double include_most_width;
void include_checks(const char *name, FILE *out);

/* Begins the macro @_Canned(Scale, Gain): declares Size_, a positive number, and Gain_, a
 * vector, or stops. */
void include_canned(const char *name, FILE *out);

/* FNV-1a over 64 bits: the hash of `bytes` after that of what came before; start with
 * include_hash_start. */
extern const uint64_t include_hash_start;
uint64_t include_hash(uint64_t before, const void *bytes, size_t count);

#endif
