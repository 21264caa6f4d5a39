/* Boundary particles around a particle, by testing all around its cell. */
#include "sim/passes/reference/pairs.h"
#include "sim/walls/normals.h"

#include <math.h>

/* Smallest r/h at which slopes are computed: coincident particles are separated by jitter, not by pressure. */
static const double NEAREST = 1e-4;

sb_plain_kernel sb_plain_kernel_at(const sb_sim *sim, sb_vec3 offset)
{
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    const double h = (double)sim->constant.support, r = sb_norm(offset) * sim->space.quantum,
                 near = fmax(r, NEAREST * h);
    return (sb_plain_kernel){sb_kernel_value(kernel, sim->constant.dimension, h, r),
                             sb_kernel_slope(kernel, sim->constant.dimension, h, near) / near * sim->space.quantum};
}

bool sb_plain_within(const sb_sim *sim, sb_vec3 offset)
{
    return sb_norm(offset) * sim->space.quantum < (double)sim->constant.support;
}

static size_t add_cell(const sb_sim *sim, uint32_t number, uint64_t code, size_t i, size_t count, sb_one_wall *out)
{
    const sb_wall_set *set = &sim->walls.set[number];
    const int64_t cell = sb_cells_find(&set->cells, code);
    for (uint32_t b = cell < 0 ? 0 : set->cells.begin[cell]; cell >= 0 && b < set->cells.begin[cell + 1]; b++) {
        const sb_vec3 d = sb_offset_of(sim->state.position[i], set->record[b]);
        if (!sb_plain_within(sim, d) || count == SB_PLAIN_WALLS_MAX) continue;
        const sb_plain_kernel w = sb_plain_kernel_at(sim, d);
        const double psi = (double)sb_carried_value(set->record[b]);
        const uint32_t entry = sb_wall_entry(number, b);
        out[count++] =
            (sb_one_wall){entry,
                          psi * w.value,
                          psi * w.slope,
                          d,
                          sb_vector_of(sb_wall_normal(sim, set, b)),
                          sb_sub(sb_vector_of(sim->state.velocity[i]), sb_vector_of(sb_wall_velocity(sim, entry)))};
    }
    return count;
}

size_t sb_plain_walls(const sb_sim *sim, size_t i, sb_one_wall out[SB_PLAIN_WALLS_MAX])
{
    const int layers = sim->constant.dimension == 2 ? 0 : 1;
    const uint64_t code = sb_cell_code(sim->state.position[i], sim->space.shift);
    size_t count = 0;
    for (uint32_t set = 0; set < SB_WALL_SETS; set++)
        for (int dz = -1; dz <= 1; dz++)
            for (int dy = -layers; dy <= layers; dy++)
                for (int dx = -1; dx <= 1; dx++)
                    count = add_cell(sim, set, code + sb_cell_step(dx, dy, dz), i, count, out);
    return count;
}
