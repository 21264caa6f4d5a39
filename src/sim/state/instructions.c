#include "sim/sim.h"
#include "sim/state/simd.h"

const char *sb_sim_instructions(void)
{
#ifdef SB_INSTRUCTIONS
    return SB_INSTRUCTIONS;
#elif defined(SB_MULTIVERSIONED)
    __builtin_cpu_init();
    return __builtin_cpu_supports("x86-64-v4")   ? "x86-64-v4"
           : __builtin_cpu_supports("x86-64-v3") ? "x86-64-v3"
                                                 : "default";
#else
    return "default";
#endif
}
