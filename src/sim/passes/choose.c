#include "sim/passes/passes.h"

#include "sim/passes/cpu/cpu.h"

const sb_passes sb_passes_cpu = {
    .name = "cpu",
    SB_CPU_PASSES,
    .accelerate = sb_cpu_accelerate,
    .diverge = sb_cpu_diverge,
};

const sb_passes *sb_passes_choose(void)
{
    const sb_passes *wide = sb_passes_cpu_wide();
    return wide && sb_cpu_wide_pays() ? wide : &sb_passes_cpu;
}
