/* The table of cases, in the order of the report. */
#include "cases.h"

/* clang-format off */
const sb_case *const sb_cases[] = {
    &sb_case_still_water_flat,
    &sb_case_still_water_box,
    &sb_case_still_water_basin,
    &sb_case_standing_wave,
    NULL,
};
/* clang-format on */
