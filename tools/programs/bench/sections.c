#include "sections.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const sb_bench_section sb_bench_sections[] = {
    {"kernels", "each stage and pass of a step, compared with this machine's limits", true, sb_bench_kernels},
    {"scenes", "whole steps of the delivered scenes, stage by stage", true, sb_bench_scenes},
    {"scaling", "cost per particle by number of particles and of threads", true, sb_bench_scaling},
    {"memory", "bytes per particle, array by array, and the cost of dry land", true, sb_bench_memory},
    {"pictures", "pictures of 1280 x 720 px with 200 thousand triangles, PNG file included", true, sb_bench_pictures},
    {"large", "the plant at 1 m: set-up, 20 steps, peak memory (minutes, and about 10 GB)", false, sb_bench_large},
    {"runs",
     "whole runs of the plant at 4 m by the presets default and paper, and of the column at 1 cm (tens of minutes)",
     false, sb_bench_runs},
    {"island", "a whole run of the conical island of the validation (an hour or more)", false, sb_bench_island},
    {.name = NULL},
};

const sb_bench_section *sb_bench_section_find(const char *name)
{
    for (const sb_bench_section *s = sb_bench_sections; s->name; s++)
        if (strcmp(s->name, name) == 0) return s;
    return NULL;
}

void sb_bench_basin(size_t particles, char resolution[32])
{
    const double volume = 4 * 4 * 2; /* m3 of water in benchmark/basin.yaml */
    snprintf(resolution, 32, "%.6g", cbrt(volume / (double)particles));
}
