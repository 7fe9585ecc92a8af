/* gl_program.h - shader programs, from the texts in shaders/. */
#ifndef GL_PROGRAM_H
#define GL_PROGRAM_H

#include "base/result.h"

/* The texts, named after their files (flat.mk makes them). */
extern const char gl_all_vert[], gl_sum_frag[], gl_map_vert[], gl_map_frag[], gl_raster_vert[],
    gl_raster_frag[], gl_radiance_frag[], gl_change_frag[], gl_screen_frag[];

/* Compiles and links; `defines` is put before both texts. The program is deleted with
 * glDeleteProgram. */
enum result gl_program_make(const char *vertex, const char *fragment, const char *defines,
                            unsigned *program, struct error *error);

/* Sets uniforms of a program; those that a variant does not have are skipped. */
void gl_set_int(unsigned program, const char *name, int value);
void gl_set_floats(unsigned program, const char *name, int count, const double *values);
void gl_set_frame(unsigned program, const double frame[3][3]);

/* Binds a texture to a unit, and a sampler to that unit. */
void gl_set_texture(unsigned program, const char *name, int unit, unsigned target,
                    unsigned texture);

#endif
