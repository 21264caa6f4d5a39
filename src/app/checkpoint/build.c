#include "app/checkpoint/build.h"

#include "sim/sim.h"

#include <gnu/libc-version.h>
#include <stdio.h>

/* Made by cmake/numerics.cmake. */
extern const char sb_build_sources[];

void sb_build_numerics(char text[SB_BUILD_TEXT])
{
    snprintf(text, SB_BUILD_TEXT, "%.400s, glibc %.20s, %.20s", sb_build_sources, gnu_get_libc_version(),
             sb_sim_instructions());
}
