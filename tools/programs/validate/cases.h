/* The cases, in the order of the report: one row each. To add one, write its sb_case into a file case_<name>.c and add
   its row. */
#ifndef SB_VALIDATE_CASES_H
#define SB_VALIDATE_CASES_H

#include "case.h"

/* clang-format off */
#define SB_CASES(ROW)               \
    ROW(still_water_flat)           \
    ROW(still_water_box)            \
    ROW(still_water_basin)          \
    ROW(standing_wave)              \
    ROW(solitary_wave)              \
    ROW(runup_breaking)             \
    ROW(runup_nonbreaking)          \
    ROW(front_etsin)                \
    ROW(front_martin_moyce)         \
    ROW(front_martin_moyce_small)   \
    ROW(front_koshizuka)            \
    ROW(front_etsin_gate)           \
    ROW(front_koshizuka_gate)       \
    ROW(wall_pressure)              \
    ROW(wall_pressure_gate)         \
    ROW(wall_pressure_3d)           \
    ROW(column)                     \
    ROW(island)                     \
    ROW(energy)                     \
    ROW(regular_half)               \
    ROW(regular_low)                \
    ROW(regular_one)                \
    ROW(regular_fine)               \
    ROW(regular_two)                \
    ROW(regular_three)              \
    ROW(regular_cnoidal)            \
    ROW(paddle_long)                \
    ROW(paddle_middle)              \
    ROW(paddle_short)               \
    ROW(paddle_deep)                \
    ROW(sponge_short)               \
    ROW(sponge_long)                \
    ROW(wave_basin)                 \
    ROW(cylinder_a)                 \
    ROW(cylinder_b)                 \
    ROW(cylinder_chen)              \
    ROW(bar)                        \
    ROW(shoaling)                   \
    ROW(breakwater)                 \
    ROW(jonswap)             \
    ROW(sea_solitary_low)           \
    ROW(sea_solitary)               \
    ROW(sea_solitary_high)          \
    ROW(sea_regular_long)           \
    ROW(sea_regular_middle)         \
    ROW(sea_regular_short)          \
    ROW(sea_tide)                   \
    ROW(sea_rest)                   \
    ROW(sea_nested)                 \
    ROW(sea_two_way)                \
    ROW(sea_two_way_unknown)        \
    ROW(grid_lake)                  \
    ROW(grid_lake_dispersive)       \
    ROW(grid_ritter)                \
    ROW(grid_stoker)                \
    ROW(grid_thacker)
/* clang-format on */

#define SB_CASE_DECLARE(name) extern const sb_case sb_case_##name;
SB_CASES(SB_CASE_DECLARE)

/* All cases, ended by NULL. */
extern const sb_case *const sb_cases[];

/* Name of column k of energy.csv, without its unit, if it is an item of the change of energy: a column in J that is
   neither kinetic nor potential energy. Otherwise false. */
bool sb_energy_item(const sb_sheet *energy, size_t k, char name[SB_FIGURE_TEXT]);

#endif
