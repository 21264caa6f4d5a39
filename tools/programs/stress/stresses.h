/* The stress cases, in the order of the report: one row each. To add one, write its sb_stress into a file
   stress_<name>.c and add its row. */
#ifndef SB_STRESS_STRESSES_H
#define SB_STRESS_STRESSES_H

#include "stress.h"

/* clang-format off */
#define SB_STRESSES(ROW)    \
    ROW(still)              \
    ROW(plates)             \
    ROW(drop)               \
    ROW(jet)                \
    ROW(flume)              \
    ROW(film)               \
    ROW(frame)              \
    ROW(steps)              \
    ROW(tolerances)         \
    ROW(start)              \
    ROW(sampling)           \
    ROW(meshes)             \
    ROW(paddles)            \
    ROW(immersed)           \
    ROW(leaving)            \
    ROW(ends)               \
    ROW(keys)
/* clang-format on */

#define SB_STRESS_DECLARE(name) extern const sb_stress sb_stress_##name;
SB_STRESSES(SB_STRESS_DECLARE)

#endif
