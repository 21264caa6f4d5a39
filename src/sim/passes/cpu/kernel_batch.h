/* Kernel values of a whole list in one call: vector forms of the kernels of src/physics/kernels/kernel.h. */
#ifndef SB_SIM_KERNEL_BATCH_H
#define SB_SIM_KERNEL_BATCH_H

#include "physics/kernels/kernel.h"

#include <stddef.h>

/* For i < count: value[i] = w(q), slope[i] = w'(q)/q, both dimensionless, q2[i] = (r/h)^2 < 1. */
typedef void sb_kernel_batch(const sb_kernel *kernel, const float *q2, size_t count, float *value, float *slope);

/* The vector form of a kernel, or a slower general form for kernels without one. */
sb_kernel_batch *sb_kernel_batch_for(const sb_kernel *kernel);

#endif
