/* The cases, each in a file case_<name>.c. To add one, write that file with its sb_case, add its line here and to
   cases.c, and put its scene and reference tables into assets/validation/<folder>/. */
#ifndef SB_VALIDATION_CASES_H
#define SB_VALIDATION_CASES_H

#include "case.h"

/* All cases in the order of the report, ended by NULL. */
extern const sb_case *const sb_cases[];

extern const sb_case sb_case_still_water_flat;
extern const sb_case sb_case_still_water_box;
extern const sb_case sb_case_still_water_basin;
extern const sb_case sb_case_standing_wave;
extern const sb_case sb_case_solitary_wave;
extern const sb_case sb_case_runup_breaking;
extern const sb_case sb_case_runup_nonbreaking;
extern const sb_case sb_case_energy;
extern const sb_case sb_case_front_etsin;
extern const sb_case sb_case_front_martin_moyce;
extern const sb_case sb_case_front_martin_moyce_small;
extern const sb_case sb_case_front_koshizuka;
extern const sb_case sb_case_wall_pressure;
extern const sb_case sb_case_wall_pressure_3d;
extern const sb_case sb_case_column;
extern const sb_case sb_case_island;

#endif
