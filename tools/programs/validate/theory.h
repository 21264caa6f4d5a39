/* Theory of the cases, beyond src/physics/waves/wave_theory.h. */
#ifndef SB_VALIDATE_THEORY_H
#define SB_VALIDATE_THEORY_H

/* Angular frequency of a standing wave of steepness `steepness` = k a over the linear one, to third
   order (Tadjbakhsh and Keller 1960). kh: wave number times depth. */
double sb_theory_standing_shift(double kh, double steepness);

/* Linear diffraction of waves by a vertical cylinder that stands on the bed [MacCamy and Fuchs 1954]. */
typedef struct sb_cylinder_load {
    double force, moment; /* N, amplitude; N m about the bed */
    double lead;          /* rad, of the force before the crest of the undisturbed wave at the axis */
} sb_cylinder_load;
/* height: m, crest to trough; number: 1/m; the rest in SI units. */
sb_cylinder_load sb_theory_cylinder(double height, double number, double depth, double radius, double density,
                                    double gravity);

#endif
