#include "surface/level.h"

#include "base/memory.h"
#include "surface/eight.h"

#include <math.h>

double sb_level_kernel(double r)
{
    const double t = 1 - r * r / (SB_LEVEL_REACH * SB_LEVEL_REACH);
    return t > 0 ? SB_LEVEL_NORM * t * t * t : 0;
}

/* With weights of 1, the level 1/2 is half a spacing beyond the last layer of a lattice, as it should be, because there
   the kernels of both halves of space are equal. Where there is less water than half of space, the level must be
   reached with fewer neighbours. The weights of a single particle, of a row, and of a layer at distances a of 1.1 and
   of 1 are those with which the level encloses their own volume: a sphere, a tube (field averaged along the row) and
   plates (averaged over the layer). With W the kernel, G and F its integrals along a line and over a plane,

     sphere  1 / (2 W(r)),                4/3 pi r^3 = 1
     tube    1 / (2 G(r)),                pi r^2 = 1
     plate   a^2 / (2 F(1 / (2 a^2)))

   Between them, and up to the density at the surface of a lattice, the weight is linear in the density.
   tests/surface/test_level.c computes the numbers again. */
static const struct {
    double density, weight;
} knots[] = {
    {0.19583518, 3.45839658}, /* particle */
    {0.36107112, 1.86643132}, /* row */
    {0.50992974, 1.17085035}, /* layer, a = 1.1 */
    {0.62422465, 1.05206920}, /* layer, a = 1 */
    {0.81699991, 1},          /* surface of deep water */
};
enum { KNOTS = sizeof knots / sizeof *knots };

double sb_level_weight(double density)
{
    if (density <= knots[0].density) return knots[0].weight;
    for (int k = 1; k < KNOTS; k++)
        if (density < knots[k].density) {
            const double part = (density - knots[k - 1].density) / (knots[k].density - knots[k - 1].density);
            return knots[k - 1].weight + part * (knots[k].weight - knots[k - 1].weight);
        }
    return 1;
}

/* Sum of the kernel's (1 - r^2 / R^2)^3 at a particle over the particles of the 27 bins around bin (bx, by, bz). */
static float sum_around(const sb_near *near, float scale, uint32_t self, int bx, int by, int bz)
{
    const float at[3] = {near->x[self], near->y[self], near->z[self]};
    sb_eight_floats sum = {0};
    for (int row = 0; row < 9; row++) {
        const int bin = ((bz + row / 3 - 1) * near->bins + by + row % 3 - 1) * near->bins + bx;
        const uint32_t end = near->first[bin + 2];
        for (uint32_t j = near->first[bin - 1]; j < end; j += 8) sum += sb_eight_kernel(near, j, end, at, scale);
    }
    return sb_eight_sum(sum);
}

static void weigh(sb_blocks *blocks, const sb_near *near)
{
    const float scale = 1 / (blocks->reach * blocks->reach);
    for (int i = 0; i < blocks->bins * blocks->bins * blocks->bins; i++) {
        const int bx = i % blocks->bins + 1, by = i / blocks->bins % blocks->bins + 1,
                  bz = i / (blocks->bins * blocks->bins) + 1;
        const int bin = (bz * near->bins + by) * near->bins + bx;
        for (uint32_t p = near->first[bin]; p < near->first[bin + 1]; p++)
            blocks->weight[near->particle[p]] =
                (float)sb_level_weight(SB_LEVEL_NORM * (double)sum_around(near, scale, p, bx, by, bz));
    }
}

/* Adds one particle to the nodes of the block within its reach: a row of 8 nodes is one vector. */
static void splat(float x, float y, float z, float weight, float reach, float *value)
{
    const float scale = 1 / (reach * reach);
    const int low_y = (int)ceilf(fmaxf(y - reach, 0)), high_y = (int)floorf(fminf(y + reach, SB_BLOCK_SIDE - 1)),
              low_z = (int)ceilf(fmaxf(z - reach, 0)), high_z = (int)floorf(fminf(z + reach, SB_BLOCK_SIDE - 1));
    const sb_eight_floats node = {0, 1, 2, 3, 4, 5, 6, 7}, along = (node - x) * (node - x) * scale;
    for (int k = low_z; k <= high_z; k++)
        for (int j = low_y; j <= high_y; j++) {
            const float dy = (float)j - y, dz = (float)k - z, base = 1 - (dy * dy + dz * dz) * scale;
            float *row = value + (k * SB_BLOCK_SIDE + j) * SB_BLOCK_SIDE;
            if (base <= 0) continue;
            const sb_eight_floats sum = sb_eight_at(row) + weight * sb_eight_cube(base - along);
            memcpy(row, &sum, sizeof sum);
        }
}

static void fill(const sb_blocks *blocks, const sb_near *near, float *value)
{
    for (int i = 0; i < SB_BLOCK_NODES; i++) value[i] = 0;
    for (size_t j = 0; j < near->count; j++) {
        const float x = near->x[j], y = near->y[j], z = near->z[j], far = SB_BLOCK_SIDE - 1 + blocks->reach;
        if (x > -blocks->reach && x < far && y > -blocks->reach && y < far && z > -blocks->reach && z < far)
            splat(x, y, z, (float)SB_LEVEL_NORM * near->weight[j], blocks->reach, value);
    }
}

float *sb_level_build(sb_blocks *blocks)
{
    float *value = sb_alloc_untouched(blocks->count, SB_BLOCK_NODES * sizeof *value);
    int failed = value == NULL;
    for (int pass = 0; pass < 2 && !failed; pass++) { /* weights, then the field */
#pragma omp parallel reduction(| : failed)
        {
            sb_near near = {0};
#pragma omp for schedule(dynamic, 16)
            for (size_t block = 0; block < blocks->count; block++) {
                if (failed) continue;
                if (pass == 0 && !sb_blocks_has_particles(blocks, block)) continue;
                failed |= sb_near_fill(blocks, block, NULL, &near) != 0;
                if (failed) continue;
                if (pass == 0)
                    weigh(blocks, &near);
                else
                    fill(blocks, &near, value + block * SB_BLOCK_NODES);
            }
            sb_near_free(&near);
        }
    }
    if (!failed) return value;
    sb_free(value);
    return NULL;
}
