/* cal.h - Radiance's functional language, as far as exports use it: comments in braces,
 * definitions NAME = EXPRESSION; and NAME(PARAMETERS) = EXPRESSION; with + - * /, numbers, calls,
 * min, max, and if(x, a, b), which is a where x > 0, else b (Radiance's icalc.1 and func.c). */
#ifndef CAL_H
#define CAL_H

struct cal;

struct cal *cal_read(const char *path); /* fails the test where it cannot be read; cal_free */
void cal_free(struct cal *cal);

/* A ray: followed in the unit direction, it meets a surface at `point` (ray.1: Px, Dx, Ts). */
struct cal_ray {
  double point[3], direction[3], length;
};

/* The value of a variable, and of a function of three numbers. Fails the test where it is not
 * defined. */
double cal_variable(struct cal *cal, const char *name, const struct cal_ray *ray);
double cal_function(struct cal *cal, const char *name, const double arguments[3],
                    const struct cal_ray *ray);

#endif
