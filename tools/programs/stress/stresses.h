/* The stress cases, each in a file stress_<name>.c. */
#ifndef SB_BATTERY_STRESSES_H
#define SB_BATTERY_STRESSES_H

#include "stress.h"

extern const sb_stress sb_stress_still;
extern const sb_stress sb_stress_plates;
extern const sb_stress sb_stress_drop;
extern const sb_stress sb_stress_jet;
extern const sb_stress sb_stress_flume;
extern const sb_stress sb_stress_film;
extern const sb_stress sb_stress_frame;
extern const sb_stress sb_stress_steps;
extern const sb_stress sb_stress_tolerances;
extern const sb_stress sb_stress_start;
extern const sb_stress sb_stress_sampling;
extern const sb_stress sb_stress_meshes;
extern const sb_stress sb_stress_immersed;
extern const sb_stress sb_stress_paddles;
extern const sb_stress sb_stress_leaving;
extern const sb_stress sb_stress_ends;
extern const sb_stress sb_stress_keys;

#endif
