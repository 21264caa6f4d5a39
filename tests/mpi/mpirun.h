/* Runs a program on several ranks of this machine. */
#ifndef SB_TESTS_MPI_MPIRUN_H
#define SB_TESTS_MPI_MPIRUN_H

#include <stdlib.h>

/* The words before the program's: more ranks than cores are allowed, and so is root. `count` is the number of ranks. */
#define MPIRUN_WORDS(count)                                                                                            \
    SB_MPIRUN, "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "--mca",                                 \
        "btl_vader_single_copy_mechanism", "none", "-n", count
enum { MPIRUN_WORD_COUNT = 10 };

/* For sanitizers, of a program that joins MPI. MPI leaves blocks behind; its part in a block is found only if each
   frame is unwound, and a table of such blocks would be mixed with the program's messages. A preloaded library may come
   before the sanitizer's. */
static inline void mpirun_tell_sanitizers(void)
{
    setenv("LSAN_OPTIONS", "print_suppressions=0:suppressions=" SB_SOURCE_DIR "/tests/mpi/leaks.txt", 1);
    setenv("ASAN_OPTIONS", "fast_unwind_on_malloc=0:verify_asan_link_order=0", 1);
}

#endif
