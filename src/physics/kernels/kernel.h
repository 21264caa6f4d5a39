/* Smoothing kernels W(r) with support radius h. Each kernel is one row of a table. */
#ifndef SB_PHYSICS_KERNEL_H
#define SB_PHYSICS_KERNEL_H

#include <stddef.h>

/* Shapes in q = r/h on [0, 1]; W = alpha w(q)/h^d, W' = alpha w'(q)/h^(d+1), d the dimension. */
typedef struct sb_kernel {
    const char *name, *summary, *reference;
    double support;            /* recommended ratio of support radius to particle spacing */
    double alpha[4];           /* normalisation in 1D, 2D, 3D at [1], [2], [3] */
    double (*shape)(double q); /* w, dimensionless */
    double (*slope)(double q); /* dw/dq <= 0; (dw/dq)/q is bounded and has its largest magnitude at q = 0 */
} sb_kernel;

/* All kernels; the last entry is NULL. */
extern const sb_kernel *const sb_kernels[];

/* Returns the kernel of that name, or NULL. */
const sb_kernel *sb_kernel_find(const char *name);

/* W in 1/m^d and W' in 1/m^(d+1); 0 for r >= h. */
double sb_kernel_value(const sb_kernel *kernel, int dimension, double h, double r);
double sb_kernel_slope(const sb_kernel *kernel, int dimension, double h, double r);

#endif
