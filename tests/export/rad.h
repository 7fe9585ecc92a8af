/* rad.h - an exported lamp as Radiance reads it, from the text of its files alone: `colordata`,
 * `glow`, `illum` and `polygon` of a .rad file (Radiance's ray.1), its data files and functions. */
#ifndef RAD_H
#define RAD_H

struct rad;

/* Reads FOLDER/NAME.rad and what it names; fails the test where anything is not as it should be. */
struct rad *rad_read(const char *folder, const char *name);
void rad_free(struct rad *rad);

/* What a ray sees: of the first polygon that it meets the material that its illum shows; black from
 * behind, and where it meets none. */
void rad_ray(struct rad *rad, const double origin[3], const double direction[3], double rgb[3]);

#endif
