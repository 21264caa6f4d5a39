#include "base/memory.h"
#include "sim/walls/normals.h"
#include "sim/wcsph/boundary.h"

#include <math.h>

/* Distance between the two layers, in particle spacings. */
static const double BEHIND = 0.5;

/* The second layer's particle of one of the first layer: behind it, and shifted along the wall by half the spacing of
   boundary particles along each direction of the wall's lattice. Of the lattices of axis-parallel walls it takes the
   middles. */
static sb_vec3 staggered(const sb_sim *sim, sb_vec3 at, sb_vec3 normal)
{
    const double spacing = (double)sim->constant.spacing, shift = 0.5 * spacing * sim->scene->numerics.wall_spacing;
    at = sb_madd(at, -BEHIND * spacing, normal);
    if (sim->constant.dimension == 2) return sb_madd(at, shift, sb_vec(-normal.z, 0, normal.x));
    const double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
    const sb_vec3 axis = x <= y && x <= z ? sb_vec(1, 0, 0) : y <= z ? sb_vec(0, 1, 0) : sb_vec(0, 0, 1);
    const sb_vec3 across = sb_cross(normal, axis);
    if (!(sb_norm(across) > 0)) return at;
    const sb_vec3 one = sb_normalize(across), other = sb_cross(normal, one);
    return sb_madd(sb_madd(at, shift, one), shift, other);
}

int sb_boundary_layers(sb_sim *sim, sb_wall_set *set)
{
    const size_t first = set->count;
    const int shift = sim->space.shift;
    if (sb_lengthen((void **)&set->record, first, 2 * first, sizeof *set->record) != 0 ||
        sb_lengthen((void **)&set->body, first, 2 * first, sizeof *set->body) != 0 ||
        sb_lengthen((void **)&set->facing, first, 2 * first, sizeof *set->facing) != 0)
        return -1;
    set->number = sb_alloc_untouched(2 * first, sizeof *set->number);
    if (!set->number) return -1;
    for (size_t i = 0; i < first; i++) {
        const sb_f4 n = sb_wall_normal(sim, set, i);
        const sb_vec3 at = sb_space_position(&sim->space, set->record[i]);
        const sb_vec3 behind = staggered(sim, at, sb_vec((double)n[0], (double)n[1], (double)n[2]));
        const sb_record record = sb_space_wrap(&sim->space, sb_space_record(&sim->space, behind));
        bool on_grid = true; /* as those of the first layer */
        for (int axis = 0; axis < 3; axis++)
            on_grid = on_grid && record[axis] != 0 && record[axis] >> shift >> sim->space.bits[axis] == 0;
        if (!on_grid) continue;
        set->record[set->count] = record;
        set->body[set->count] = set->body[i];
        set->facing[set->count++] = set->facing[i];
    }
    for (size_t i = 0; i < set->count; i++) set->number[i] = (uint32_t)sim->walls.boundary.count++;
    return 0;
}
