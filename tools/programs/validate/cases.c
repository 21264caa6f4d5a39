/* The table of cases, in the order of the report. */
#include "cases.h"

/* clang-format off */
const sb_case *const sb_cases[] = {
    &sb_case_still_water_flat,
    &sb_case_still_water_box,
    &sb_case_still_water_basin,
    &sb_case_standing_wave,
    &sb_case_solitary_wave,
    &sb_case_runup_breaking,
    &sb_case_runup_nonbreaking,
    &sb_case_front_etsin,
    &sb_case_front_martin_moyce,
    &sb_case_front_martin_moyce_small,
    &sb_case_front_koshizuka,
    &sb_case_wall_pressure,
    &sb_case_wall_pressure_3d,
    &sb_case_column,
    &sb_case_island,
    &sb_case_energy,
    NULL,
};
/* clang-format on */
