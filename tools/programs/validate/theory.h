/* Theory of the cases, beyond src/physics/wave_theory.h. */
#ifndef SB_VALIDATE_THEORY_H
#define SB_VALIDATE_THEORY_H

#include "scene/scene.h"

/* Effective kinematic viscosity (m^2/s) of a run's viscous terms, docs/method.md (M14), for the still depth D.
   Artificial viscosity acts only on approaching pairs, which do half of the work in a flow of constant volume. The
   lattice sum for the run's kernel and support, (1/d) sum V r^3 |W'|/(r^2 + 0.01 h^2), is the ratio to the continuum's
   value, as a mean over all orientations of the strain. */
double sb_theory_viscosity(const sb_scene *scene, double depth);
/* The lattice sum alone; 1 in the continuum. */
double sb_theory_lattice_share(const sb_kernel *kernel, int dimension, double support);

/* Angular frequency of a standing wave of steepness `steepness` = k a over the linear one, to third
   order (Tadjbakhsh and Keller 1960). kh: wave number times depth. */
double sb_theory_standing_shift(double kh, double steepness);

/* Decay rate (1/s) of the amplitude of a wave of wave number k between free-slip walls, by the viscosity of the
   irrotational flow alone: 2 nu k^2 at any depth (Lamb 1932, art. 348). */
double sb_theory_decay(double viscosity, double k);

/* Linear diffraction of waves by a vertical cylinder that stands on the bed [MacCamy and Fuchs 1954]. */
typedef struct sb_cylinder_load {
    double force, moment; /* N, amplitude; N m about the bed */
    double lead;          /* rad, of the force before the crest of the undisturbed wave at the axis */
} sb_cylinder_load;
/* height: m, crest to trough; number: 1/m; the rest in SI units. */
sb_cylinder_load sb_theory_cylinder(double height, double number, double depth, double radius, double density,
                                    double gravity);

#endif
