#include "sim/passes/cpu/kernel_batch.h"

#include "sim/state/simd.h"

#include <float.h>
#include <math.h>
#include <string.h>

SB_MULTIVERSION
static void cubic(const sb_kernel *kernel, const float *q2, size_t count, float *value, float *slope)
{
    (void)kernel;
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        float q = sqrtf(q2[i]), s = 1.0f - q;
        float inner = 6.0f * q * q * (q - 1.0f) + 1.0f, outer = 2.0f * s * s * s;
        float inner_slope = 18.0f * q - 12.0f, outer_slope = -6.0f * s * s / fmaxf(q, 0.5f);
        value[i] = q < 0.5f ? inner : outer;
        slope[i] = q < 0.5f ? inner_slope : outer_slope;
    }
}

SB_MULTIVERSION
static void wendland_c2(const sb_kernel *kernel, const float *q2, size_t count, float *value, float *slope)
{
    (void)kernel;
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        float q = sqrtf(q2[i]), s = 1.0f - q, cube = s * s * s;
        value[i] = cube * s * (1.0f + 4.0f * q);
        slope[i] = -20.0f * cube;
    }
}

SB_MULTIVERSION
static void wendland_c4(const sb_kernel *kernel, const float *q2, size_t count, float *value, float *slope)
{
    (void)kernel;
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        float q = sqrtf(q2[i]), s = 1.0f - q, square = s * s, fifth = square * square * s;
        value[i] = fifth * s * (1.0f + 6.0f * q + 35.0f / 3.0f * q * q);
        slope[i] = -56.0f / 3.0f * fifth * (1.0f + 5.0f * q);
    }
}

/* slope/q of coincident particles is finite; they exert no pressure on each other, and jitter separates them. */
static void general(const sb_kernel *kernel, const float *q2, size_t count, float *value, float *slope)
{
    for (size_t i = 0; i < count; i++) {
        const double q = fmax(sqrt((double)q2[i]), (double)FLT_MIN);
        value[i] = (float)kernel->shape(q);
        slope[i] = (float)(kernel->slope(q) / q);
    }
}

sb_kernel_batch *sb_kernel_batch_for(const sb_kernel *kernel)
{
    static const struct {
        const char *name;
        sb_kernel_batch *batch;
    } forms[] = {{"cubic", cubic}, {"wendland-c2", wendland_c2}, {"wendland-c4", wendland_c4}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++)
        if (strcmp(forms[i].name, kernel->name) == 0) return forms[i].batch;
    return general;
}
