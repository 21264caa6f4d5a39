/* Loaded before a program with LD_PRELOAD: rank 1 stops where the environment variable STOPPED says so: when it begins
   MPI (begin), after all ranks are at their end (finalize). */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

static void stop_at(const char *place)
{
    const char *rank = getenv("OMPI_COMM_WORLD_RANK"), *stopped = getenv("STOPPED");
    if (rank && stopped && strcmp(rank, "1") == 0 && strcmp(stopped, place) == 0) raise(SIGSTOP);
}

int MPI_Init_thread(int *count, char ***arguments, int required, int *provided)
{
    int (*const next)(int *, char ***, int, int *) = dlsym(RTLD_NEXT, "MPI_Init_thread");
    stop_at("begin");
    return next(count, arguments, required, provided);
}

int MPI_Finalize(void)
{
    int (*const next)(void) = dlsym(RTLD_NEXT, "MPI_Finalize");
    stop_at("finalize");
    return next();
}
