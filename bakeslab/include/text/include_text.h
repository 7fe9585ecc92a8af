/* include_text.h - the text of an include: a template of its kind, which names the parts that
 * all kinds share, filled with what is known of the lamp. */
#ifndef INCLUDE_TEXT_H
#define INCLUDE_TEXT_H

#include <stdio.h>

#include "include/text/include_fill.h"
#include "include/text/include_lamp.h"

/* What an include says besides the light itself. */
struct include_text {
  const char *name;       /* an identifier, capitalised: Desk_Lamp */
  const char *file;       /* names of the include and its image, without folders */
  const char *image;      /* NULL: it has none */
  const char *image_path; /* where it is written, if its name alone does not say so, or NULL */
  const char *command;    /* that made them */
  const char *housing;    /* SDL of the visible lamp, or NULL */
  int housing_left_out;   /* there was one, which is not safe to use */
  const char *own_error;  /* the slab's: include_own_error's lines */
  const char *source;     /* where imported light comes from, one line; or NULL */
  const char *chosen;     /* why it is of this kind, or NULL; one line */
};

/* Prints the whole include. A template may name, beside `values`, black_pages, channel_count and
 * most_width (of a lamp in the scene), and the parts, which want `reach` of `values`
 *   head, usage, units  what it is, how it is used, its units
 *   begin, end          guard and stamp; the housing's macro. Only the first of two includes of
 *                       one name declares it; the second finds out whether it is the same lamp
 *   image               finds the image and reads it into the pigment @_Sheet, with `mapping`,
 *                       of `values`, in its image_map
 *   checks              macros: @_Text(X) writes a number for a message; @_Size(Scale, Macro)
 *                       is Scale as a positive number, or stops; @_Gain(Gain) is Gain as a
 *                       vector; @_Strength(Colour) stops where POV-Ray's numbers cannot hold a
 *                       lamp whose brightest light has this colour and a fade distance of 1e-3
 *                       aperture widths, @_Fits(Width) where it is wider in the scene than
 *                       most_width; where there are channels, @_Channel_Gain(Number) is the gain
 *                       of one
 *   canned              begins the macro @_Canned(Scale, Gain): declares Size_ and Gain_
 * The caller checks the stream. */
void include_print(const char *template, const struct include_text *text,
                   const struct include_lamp *lamp, const struct include_value *values, FILE *out);

/* `reach`: how far away POV-Ray shows anything of a light of this intensity (radiance times area,
 * of its brightest channel, at Scale 1), in lamp units; 0 beyond 1000 widths of the lamp,
 * too far to matter. Of the brightest lights of the pages, the faintest counts. */
double include_reach(double intensity, double width);

/* Unit vectors along u, v and the normal, and the centre, with `between` between them. */
void include_put_frame(const struct slab *slab, const double center[3], const char *between,
                       FILE *out);

#endif
