#include "sim/search/around.h"

#include "base/memory.h"

/* Cells whose indices differ only in their last bits follow one another in the Z-order. */
static uint64_t block_of(uint64_t code)
{
    return code & ~sb_cell_step(1, 1, 1);
}

int sb_groups_build(sb_sim *sim)
{
    const sb_cells *cells = &sim->cells;
    sb_groups *groups = &sim->groups;
    groups->count = 0;
    for (size_t c = 0; c < cells->count; c++) {
        if (c > 0 && block_of(cells->code[c]) == block_of(cells->code[c - 1])) continue;
        if (sb_grow((void **)&groups->group, &groups->capacity, groups->count + 1, sizeof *groups->group) != 0)
            return -1;
        groups->group[groups->count++] = (sb_group){.first = cells->begin[c], .end = (uint32_t)sim->state.n};
        if (groups->count > 1) groups->group[groups->count - 2].end = cells->begin[c];
    }
    return 0;
}

/* A run may begin with owned particles and go on with ghosts. */
static bool reads_ghosts(const sb_sim *sim, const sb_group *group)
{
    const sb_run *run = sim->groups.run + group->run;
    for (size_t r = 0; r < group->runs; r++)
        if (run[r].begin + run[r].count > sim->state.n) return true;
    return false;
}

int sb_groups_order(sb_sim *sim)
{
    sb_groups *g = &sim->groups;
    if (sb_grow((void **)&g->order, &g->order_capacity, g->count + 1, sizeof *g->order) != 0) return -1;
    size_t inner = 0, outer = g->count;
    for (size_t k = 0; k < g->count; k++) {
        if (reads_ghosts(sim, &g->group[k]))
            g->order[--outer] = (uint32_t)k;
        else
            g->order[inner++] = (uint32_t)k;
    }
    g->inner = inner;
    return 0;
}

void sb_groups_destroy(sb_sim *sim)
{
    sb_free(sim->groups.group);
    sb_free(sim->groups.order);
    sb_free(sim->groups.run);
    sb_free(sim->groups.image);
    sb_free(sim->groups.plane);
}
