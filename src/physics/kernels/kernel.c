/* The table of smoothing kernels, and their values in SI units. */
#include "physics/kernels/kernel.h"

#include <string.h>

/* To add a kernel, define sb_kernel_<name> in a file of its own and add one ROW here. */
#define ROWS(ROW)                                                                                                      \
    ROW(cubic)                                                                                                         \
    ROW(wendland_c2)                                                                                                   \
    ROW(wendland_c4)

#define DECLARE(name) extern const sb_kernel sb_kernel_##name;
#define POINT(name) &sb_kernel_##name,

ROWS(DECLARE)

const sb_kernel *const sb_kernels[] = {ROWS(POINT) NULL};

const sb_kernel *sb_kernel_find(const char *name)
{
    for (const sb_kernel *const *row = sb_kernels; *row; row++)
        if (strcmp((*row)->name, name) == 0) return *row;
    return NULL;
}

static double power(double h, int exponent)
{
    double product = h;
    while (--exponent > 0) product *= h;
    return product;
}

double sb_kernel_value(const sb_kernel *kernel, int dimension, double h, double r)
{
    return r < h ? kernel->alpha[dimension] * kernel->shape(r / h) / power(h, dimension) : 0;
}

double sb_kernel_slope(const sb_kernel *kernel, int dimension, double h, double r)
{
    return r < h ? kernel->alpha[dimension] * kernel->slope(r / h) / power(h, dimension + 1) : 0;
}
