#include "sim/walls/mirrors.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static sb_vec3 to_quanta(const sb_space *space, sb_vec3 at)
{
    return sb_scale(sb_sub(at, space->origin), 1 / space->quantum);
}

/* Adds a facet, moved by `shift` (m). Returns 0, or -1 without memory. */
static int add(sb_sim *sim, const sb_facets *facets, const sb_facet *f, sb_vec3 shift)
{
    sb_mirrors *m = &sim->walls.mirrors;
    if (sb_grow((void **)&m->mirror, &m->capacity, m->count + 1, sizeof *m->mirror) != 0 ||
        sb_grow((void **)&m->edge, &m->edge_capacity, m->edge_count + f->edges, sizeof *m->edge) != 0)
        return -1;
    const sb_vec3 on = sb_add(sb_scale(f->normal, f->distance), shift);
    m->mirror[m->count++] = (sb_mirror){.normal = f->normal,
                                        .distance = sb_dot(f->normal, to_quanta(&sim->space, on)),
                                        .body = f->body,
                                        .edge = (uint32_t)m->edge_count,
                                        .edges = f->edges,
                                        .moving = sim->walls.moving_of_body[f->body],
                                        .both = f->both,
                                        .when = f->when,
                                        .shift = shift};
    for (uint32_t k = 0; k < f->edges; k++) {
        const sb_facet_edge *e = &facets->edges[f->edge + k];
        const sb_vec3 from = to_quanta(&sim->space, sb_add(e->from, shift));
        m->edge[m->edge_count++] = (sb_mirror_edge){
            from, to_quanta(&sim->space, sb_add(e->to, shift)), e->inward, sb_dot(e->inward, from), e->bend, e->wall};
    }
    return 0;
}

double sb_mirrors_from_segment(sb_vec3 a, sb_vec3 b, sb_vec3 at)
{
    const sb_vec3 along = sb_sub(b, a), out = sb_sub(at, a);
    const double length2 = sb_dot(along, along);
    const double share = length2 > 0 ? fmin(fmax(sb_dot(along, out) / length2, 0), 1) : 0;
    return sb_norm(sb_madd(out, -share, along));
}

double sb_mirrors_distance(const sb_mirrors *m, const sb_mirror *mirror, sb_vec3 at)
{
    const double above = fabs(sb_dot(mirror->normal, at) - mirror->distance);
    bool inside = true;
    double nearest = (double)INFINITY;
    for (uint32_t k = mirror->edge; k < mirror->edge + mirror->edges; k++) {
        const sb_mirror_edge *e = &m->edge[k];
        inside &= sb_dot(e->inward, at) >= e->distance;
        nearest = fmin(nearest, sb_mirrors_from_segment(e->from, e->to, at));
    }
    return inside ? above : nearest;
}

/* The range of blocks in which a mirror is within a support radius of a particle. */
static void block_range(const sb_sim *sim, const sb_mirror *mirror, int64_t low[3], int64_t high[3])
{
    const int shift = sim->space.shift;
    const double support = (double)sim->constant.support / sim->space.quantum;
    const double block = (double)((uint64_t)2 << shift);
    const sb_record first = sb_space_record(&sim->space, sim->model->min);
    const sb_record last = sb_space_record(&sim->space, sim->model->max);
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = (first[axis] >> shift >> 1) - 1, high[axis] = (last[axis] >> shift >> 1) + 1;
        double least = (double)INFINITY, most = -(double)INFINITY;
        for (uint32_t k = mirror->edge; k < mirror->edge + mirror->edges; k++) {
            const sb_mirror_edge *e = &sim->walls.mirrors.edge[k];
            const double from = sb_component(e->from, axis), to = sb_component(e->to, axis);
            least = fmin(least, fmin(from, to)), most = fmax(most, fmax(from, to));
        }
        if (mirror->edges == 0 || (sim->constant.dimension == 2 && axis == 1)) continue;
        low[axis] = (int64_t)fmax((double)low[axis], floor((least - support) / block));
        high[axis] = (int64_t)fmin((double)high[axis], floor((most + support) / block));
    }
    for (int axis = 0; axis < 3; axis++) low[axis] = low[axis] < 0 ? 0 : low[axis];
}

static uint64_t block_code(uint64_t x, uint64_t y, uint64_t z)
{
    return x | y << 21 | z << 42;
}

static int enter(sb_sim *sim, uint32_t index)
{
    sb_mirrors *m = &sim->walls.mirrors;
    const sb_mirror *mirror = &m->mirror[index];
    const double support = (double)sim->constant.support / sim->space.quantum;
    const double block = (double)((uint64_t)2 << sim->space.shift);
    const bool flat = sim->constant.dimension == 2;
    const double most = support + 0.5 * block * (flat ? sqrt(2) : sqrt(3));
    const double y_flat = to_quanta(&sim->space, (sb_vec3){0}).y;
    int64_t low[3], high[3];
    block_range(sim, mirror, low, high);
    for (int64_t z = low[2]; z <= high[2]; z++)
        for (int64_t y = low[1]; y <= high[1]; y++)
            for (int64_t x = low[0]; x <= high[0]; x++) {
                const sb_vec3 middle = sb_vec(((double)x + 0.5) * block, flat ? y_flat : ((double)y + 0.5) * block,
                                              ((double)z + 0.5) * block);
                if (fabs(sb_dot(mirror->normal, middle) - mirror->distance) > most ||
                    sb_mirrors_distance(m, mirror, middle) > most)
                    continue;
                if (sb_grow((void **)&m->entry, &m->entries_capacity, m->entries + 1, sizeof *m->entry) != 0) return -1;
                m->entry[m->entries++] = (sb_mirror_entry){block_code((uint64_t)x, (uint64_t)y, (uint64_t)z), index};
            }
    return 0;
}

static int compare(const void *a, const void *b)
{
    const sb_mirror_entry *x = a, *y = b;
    if (x->block != y->block) return x->block < y->block ? -1 : 1;
    return (x->mirror > y->mirror) - (x->mirror < y->mirror);
}

/* Adds a facet and its images beyond periodic sides. A facet without edges has no end: shifts within its plane lead to
   itself. */
static int add_all(sb_sim *sim, const sb_facets *facets, const sb_facet *f)
{
    const double period[3] = {(double)sim->space.period[0] * sim->space.quantum,
                              (double)sim->space.period[1] * sim->space.quantum,
                              (double)sim->space.period[2] * sim->space.quantum};
    const double normal[3] = {f->normal.x, f->normal.y, f->normal.z};
    int along[3];
    for (int axis = 0; axis < 3; axis++) along[axis] = period[axis] > 0 && (f->edges > 0 || normal[axis] != 0);
    for (int z = -along[2]; z <= along[2]; z++)
        for (int y = -along[1]; y <= along[1]; y++)
            for (int x = -along[0]; x <= along[0]; x++)
                if (add(sim, facets, f, sb_vec(x * period[0], y * period[1], z * period[2])) != 0) return -1;
    return 0;
}

sb_status sb_mirrors_create(sb_sim *sim, sb_error *error)
{
    sb_mirrors *m = &sim->walls.mirrors;
    const sb_facets *facets = &sim->model->facets;
    bool enough = true;
    for (size_t f = 0; f < facets->count && enough; f++) enough = add_all(sim, facets, &facets->facets[f]) == 0;
    m->moving = enough ? sb_alloc(m->count, sizeof *m->moving) : NULL;
    enough = m->moving != NULL;
    for (uint32_t k = 0; k < m->count && enough; k++)
        if (m->mirror[k].moving == UINT32_MAX) enough = enter(sim, k) == 0;
    if (!enough) return sb_fail_memory(error, "facets of walls");
    if (m->entries > 0) qsort(m->entry, m->entries, sizeof *m->entry, compare);
    sb_mirrors_list_moving(sim);
    return SB_OK;
}

/* In spacings: a body that has moved by more has left its place at rest. */
static const double LEFT = 0.05;

void sb_mirrors_list_moving(sb_sim *sim)
{
    sb_mirrors *m = &sim->walls.mirrors;
    m->moving_count = 0;
    for (uint32_t k = 0; k < m->count; k++) {
        const sb_mirror *mirror = &m->mirror[k];
        if (mirror->moving == UINT32_MAX) continue;
        const bool away = fabs(sim->walls.moving[mirror->moving].displacement) > LEFT * sim->model->spacing;
        if (mirror->when != (away ? SB_FACET_AT_REST : SB_FACET_AWAY)) m->moving[m->moving_count++] = k;
    }
}

void sb_mirrors_destroy(sb_sim *sim)
{
    sb_mirrors *m = &sim->walls.mirrors;
    sb_free(m->mirror);
    sb_free(m->edge);
    sb_free(m->moving);
    sb_free(m->entry);
}

size_t sb_mirrors_bytes(const sb_sim *sim)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    return m->capacity * sizeof *m->mirror + m->edge_capacity * sizeof *m->edge + m->count * sizeof *m->moving +
           m->entries_capacity * sizeof *m->entry;
}

uint32_t sb_mirror_body(const sb_sim *sim, uint32_t mirror)
{
    return sim->walls.mirrors.mirror[mirror].body;
}

sb_f4 sb_mirror_velocity(const sb_sim *sim, uint32_t mirror)
{
    const uint32_t moving = sim->walls.mirrors.mirror[mirror].moving;
    if (moving == UINT32_MAX) return (sb_f4){0};
    const sb_vec3 v = sim->walls.moving[moving].velocity;
    return (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
}

sb_vec3 sb_mirror_shift(const sb_sim *sim, uint32_t mirror)
{
    return sb_scale(sim->walls.mirrors.mirror[mirror].shift, -1);
}

size_t sb_mirrors_of_block(const sb_sim *sim, sb_record record, size_t *end)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    const int shift = sim->space.shift + 1;
    const uint64_t code = block_code(record[0] >> shift, record[1] >> shift, record[2] >> shift);
    size_t at = 0, above = m->entries;
    while (at < above) {
        const size_t middle = (at + above) / 2;
        if (m->entry[middle].block < code)
            at = middle + 1;
        else
            above = middle;
    }
    for (*end = at; *end < m->entries && m->entry[*end].block == code;) ++*end;
    return at;
}
