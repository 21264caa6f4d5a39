#include "mpi/starter.h"

#include <stddef.h>
#include <stdlib.h>

int sb_world_started_count(void)
{
    /* Open MPI's mpirun; PMI as of MPICH and srun. A starter by PMIx alone does not state the number. */
    static const char *const sizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const char *text = getenv(sizes[k]);
        if (text && atoi(text) > 0) return atoi(text);
    }
    if (!getenv("PMIX_RANK") && !getenv("PMI_RANK")) return 0;
    /* srun states the number in its own words, also to programs that are not of MPI. */
    const char *slurm = getenv("SLURM_STEP_NUM_TASKS");
    return slurm && atoi(slurm) > 0 ? atoi(slurm) : 1;
}

int sb_world_started_as(void)
{
    static const char *const ranks[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};
    for (size_t k = 0; k < sizeof ranks / sizeof *ranks; k++)
        if (getenv(ranks[k])) return atoi(getenv(ranks[k]));
    return 0;
}

bool sb_world_started(void)
{
    return sb_world_started_count() > 0;
}
