/* Runs a program on several ranks of this machine. */
#ifndef SB_TESTS_MPI_MPIRUN_H
#define SB_TESTS_MPI_MPIRUN_H

/* The words before the program's: more ranks than cores are allowed, and so is root. `count` is the number of ranks. */
#define MPIRUN_WORDS(count)                                                                                            \
    SB_MPIRUN, "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "--mca",                                 \
        "btl_vader_single_copy_mechanism", "none", "-n", count
enum { MPIRUN_WORD_COUNT = 10 };

#endif
