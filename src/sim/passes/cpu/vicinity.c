#include "sim/passes/cpu/vicinity.h"

/* Finds the range of cells of the group's particles and their neighbour cells. */
static void find_cells(const sb_sim *sim, const sb_group *group, sb_vicinity *v)
{
    const int shift = sim->space.shift;
    uint32_t high[3];
    for (int axis = 0; axis < 3; axis++) {
        v->low[axis] = high[axis] = sim->state.position[group->first][axis] >> shift;
        for (size_t i = group->first + 1; i < group->end; i++) {
            const uint32_t at = sim->state.position[i][axis] >> shift;
            v->low[axis] = at < v->low[axis] ? at : v->low[axis];
            high[axis] = at > high[axis] ? at : high[axis];
        }
        const uint32_t beside = sim->constant.dimension == 2 && axis == 1 ? 0 : 1;
        v->low[axis] -= beside;
        v->cells[axis] = high[axis] - v->low[axis] + 1 + beside;
    }
}

/* Appends the records of one cell: the entries from base + begin on of sim->state.position. Returns whether the table
   has the cell. */
SB_INLINE bool add_cell(const sb_sim *sim, sb_vicinity *v, sb_record corner, const sb_cells *cells, uint64_t code,
                        size_t base)
{
    const int64_t cell = sb_cells_find(cells, code);
    if (cell < 0) return false;
    if (v->count > SB_AROUND_MAX) return true;
    const uint32_t begin = cells->begin[cell] + (uint32_t)base, count = cells->begin[cell + 1] - cells->begin[cell];
    if (v->count + count > SB_AROUND_MAX) {
        v->count = SB_AROUND_MAX + 1;
        return true;
    }
    const sb_record *record = sim->state.position + begin;
    for (uint32_t k = 0; k < count; k++) {
        const sb_f4 offset = sb_offset(record[k], corner);
        v->x[v->count + k] = offset[0];
        v->y[v->count + k] = offset[1];
        v->z[v->count + k] = offset[2];
        v->place[v->count + k] = offset;
    }
    v->count += count;
    sb_run *last = v->runs > 0 ? &v->run[v->runs - 1] : NULL;
    if (last && last->begin + last->count == begin)
        last->count += count;
    else
        v->run[v->runs++] = (sb_run){begin, count};
    return true;
}

/* Appends the cells of a part. A cell of `water` is whole in one domain: owned, or in the halo. */
static void add_part(const sb_sim *sim, sb_vicinity *v, sb_record corner, bool water)
{
    const sb_ghosts *g = &sim->ghosts;
    const sb_cells *cells = water ? &sim->cells : &g->cells;
    const size_t base = water ? 0 : sb_images_first(sim);
    const bool halo = water && g->halo > 0;
    uint32_t *start = v->start[v->parts++];
    for (uint32_t z = 0; z < v->cells[2]; z++)
        for (uint32_t y = 0; y < v->cells[1]; y++)
            for (uint32_t x = 0; x < v->cells[0]; x++) {
                const uint64_t code =
                    (uint64_t)(v->low[0] + x) | (uint64_t)(v->low[1] + y) << 21 | (uint64_t)(v->low[2] + z) << 42;
                *start++ = (uint32_t)v->count;
                if (!add_cell(sim, v, corner, cells, code, base) && halo)
                    add_cell(sim, v, corner, &g->halo_cells, code, sim->state.n);
            }
    *start = (uint32_t)v->count;
}

void sb_vicinity_gather(const sb_sim *sim, sb_group *group, sb_vicinity *v)
{
    const int shift = sim->space.shift;
    bool at_edge = false;
    find_cells(sim, group, v);
    const sb_record corner = {v->low[0] << shift, v->low[1] << shift, v->low[2] << shift, 0};
    v->parts = v->count = v->images = v->runs = 0;
    for (size_t i = group->first; i < group->end; i++)
        at_edge |= sim->ghosts.count > 0 && sb_space_at_edge(&sim->space, sim->state.position[i]);
    add_part(sim, v, corner, true);
    if (at_edge) add_part(sim, v, corner, false);
    group->corner = corner;
}

SB_INLINE size_t index_of(const sb_vicinity *v, const uint32_t cell[3])
{
    return ((size_t)cell[2] * v->cells[1] + cell[1]) * v->cells[0] + cell[0];
}

/* Squared distances along an axis to the previous cell, the own cell and the next cell. in: distance from the lower
   face of the own cell. */
SB_INLINE void find_gaps(float in, float edge, float gap2[3])
{
    gap2[0] = in * in;
    gap2[1] = 0;
    gap2[2] = (edge - in) * (edge - in);
}

SB_MULTIVERSION
size_t sb_vicinity_candidates(const sb_sim *sim, const sb_vicinity *v, size_t part, size_t last, sb_f4 self,
                              sb_candidate_range range[SB_VICINITY_ROWS])
{
    const float edge = (float)((int32_t)1 << sim->space.shift);
    const float reach2 = 1.00001f * edge * edge; /* so that round-off does not exclude a hit */
    const int layers = v->cells[1] > 1 ? 1 : 0;
    uint32_t home[3];
    float gap2[3][3];
    for (int axis = 0; axis < 3; axis++) {
        home[axis] = (uint32_t)(int32_t)self[axis] >> sim->space.shift;
        find_gaps(self[axis] - (float)(int32_t)home[axis] * edge, edge, gap2[axis]);
    }
    const float left = gap2[0][0], right = gap2[0][2];
    const size_t centre = index_of(v, home);
    size_t ranges = 0;
    for (; part < last; part++)
        for (int dz = -1; dz <= 1; dz++)
            for (int dy = -layers; dy <= layers; dy++) {
                const float row2 = gap2[2][1 + dz] + gap2[1][1 + dy];
                const uint32_t *start = v->start[part] + (ptrdiff_t)centre +
                                        ((ptrdiff_t)dz * (ptrdiff_t)v->cells[1] + dy) * (ptrdiff_t)v->cells[0];
                const uint32_t begin = start[-(left + row2 < reach2)], end = start[1 + (right + row2 < reach2)];
                range[ranges] = (sb_candidate_range){begin, end};
                ranges += (row2 < reach2) & (begin < end);
            }
    return ranges;
}

uint32_t sb_vicinity_candidate(const sb_sim *sim, const sb_vicinity *v, size_t i)
{
    const int shift = sim->space.shift;
    const uint64_t code = sb_cell_code(sim->state.position[i], shift);
    uint32_t cell[3], before = 0;
    for (int axis = 0; axis < 3; axis++) cell[axis] = (sim->state.position[i][axis] >> shift) - v->low[axis];
    while (before < i && sb_cell_code(sim->state.position[i - before - 1], shift) == code) before++;
    return v->start[0][index_of(v, cell)] + before;
}
