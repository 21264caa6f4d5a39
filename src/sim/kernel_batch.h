/* Kernel values of a whole list at once; the shapes of src/physics/kernel.h in vector form. */
#ifndef SB_SIM_KERNEL_BATCH_H
#define SB_SIM_KERNEL_BATCH_H

#include "physics/kernel.h"

#include <stddef.h>

/* For i < count: value[i] = w(q), slope[i] = w'(q)/q, both dimensionless, q2[i] = (r/h)^2 < 1. */
typedef void sb_kernel_batch(const sb_kernel *kernel, const float *q2, size_t count, float *value, float *slope);

/* The vector form of a kernel; a slower general form for kernels that have none. */
sb_kernel_batch *sb_kernel_batch_for(const sb_kernel *kernel);

#endif
