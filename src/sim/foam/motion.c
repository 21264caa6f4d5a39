/* How particles of foam move, and where they end. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/foam/foam.h"
#include "sim/search/around.h"
#include "sim/search/sort.h"
#include "sim/walls/normals.h"
#include "sim/walls/walls.h"

enum { CHUNK = 256 }; /* particles per unit of work */

/* Water in a cell and its neighbours: places in quanta from the cell's corner, velocities at the step's end, m/s. */
typedef struct vicinity {
    size_t count;
    float x[SB_AROUND_MAX], y[SB_AROUND_MAX], z[SB_AROUND_MAX];
    float u[SB_AROUND_MAX], v[SB_AROUND_MAX], w[SB_AROUND_MAX];
} vicinity;

/* Adds a cell of a table whose first record is entry `base`. The neighbour search has fewer than SB_AROUND_MAX around
   any cell. */
static void add_cell(const sb_sim *sim, const sb_cells *cells, uint64_t code, size_t base, sb_record corner,
                     vicinity *to)
{
    const int64_t cell = sb_cells_find(cells, code);
    if (cell < 0) return;
    const size_t end = base + cells->begin[cell + 1];
    for (size_t j = base + cells->begin[cell]; j < end && to->count < SB_AROUND_MAX; j++) {
        const size_t k = to->count++;
        const sb_f4 at = sb_offset(sim->state.position[j], corner);
        const sb_f4 velocity = sim->work.end_velocity[sb_entry_owner(sim, (uint32_t)j)];
        to->x[k] = at[0], to->y[k] = at[1], to->z[k] = at[2];
        to->u[k] = velocity[0], to->v[k] = velocity[1], to->w[k] = velocity[2];
    }
}

/* The corner of a record's cell. */
SB_INLINE sb_record corner_of(const sb_sim *sim, sb_record at)
{
    const uint32_t mask = ~(((uint32_t)1 << sim->space.shift) - 1);
    return at & (sb_record){mask, mask, mask, 0};
}

static void gather(const sb_sim *sim, sb_record at, vicinity *to)
{
    const int layers = sim->constant.dimension == 2 ? 0 : 1;
    const sb_record corner = corner_of(sim, at);
    const uint64_t middle = sb_cell_code(at, sim->space.shift);
    to->count = 0;
    for (int dz = -1; dz <= 1; dz++)
        for (int dy = -layers; dy <= layers; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                const uint64_t code = middle + sb_cell_step(dx, dy, dz);
                add_cell(sim, &sim->cells, code, 0, corner, to);
                if (sim->ghosts.halo > 0) add_cell(sim, &sim->ghosts.halo_cells, code, sim->state.n, corner, to);
                if (sim->ghosts.count > 0) add_cell(sim, &sim->ghosts.cells, code, sb_images_first(sim), corner, to);
            }
}

/* The water around a place in the cell of which this is the vicinity. */
SB_INLINE sb_foam_water look(const sb_sim *sim, const vicinity *near, sb_record at)
{
    const sb_f4 self = sb_offset(at, corner_of(sim, at));
    const float inverse = sim->foam->law.inverse * (float)sim->space.quantum, x = self[0], y = self[1], z = self[2];
    float sum = 0, u = 0, v = 0, w = 0;
#pragma omp simd reduction(+ : sum, u, v, w)
    for (size_t k = 0; k < near->count; k++) {
        const float dx = near->x[k] - x, dy = near->y[k] - y, dz = near->z[k] - z;
        const float left = 1 - sqrtf(dx * dx + dy * dy + dz * dz) * inverse, weight = left > 0 ? left : 0;
        sum += weight;
        u += weight * near->u[k];
        v += weight * near->v[k];
        w += weight * near->w[k];
    }
    if (!(sum > 0)) return (sb_foam_water){0};
    return (sb_foam_water){sum / sim->foam->law.full, {u / sum, v / sum, w / sum, 0}};
}

sb_foam_water sb_foam_look(const sb_sim *sim, sb_record at)
{
    vicinity near;
    gather(sim, at, &near);
    return look(sim, &near, at);
}

/* Whether the nearest boundary particle of a set, if there is one within half of the support radius, faces away. */
SB_APART bool behind(const sb_sim *sim, const sb_wall_set *set, sb_record at)
{
    const uint32_t half = (uint32_t)1 << (sim->space.shift - 1), inside = 2 * half - 1;
    float nearest = (float)half * (float)half;
    bool found = false;
    for (int corner = 0; corner < 8; corner++) {
        int step[3];
        for (int axis = 0; axis < 3; axis++)
            step[axis] = !(corner >> axis & 1) ? 0 : (at[axis] & inside) < half ? -1 : 1;
        const int64_t cell =
            sb_cells_find(&set->cells, sb_cell_code(at, sim->space.shift) + sb_cell_step(step[0], step[1], step[2]));
        for (uint32_t b = cell < 0 ? 0 : set->cells.begin[cell]; cell >= 0 && b < set->cells.begin[cell + 1]; b++) {
            const sb_f4 from = sb_offset(at, set->record[b]);
            const float square = sb_sum3(from * from);
            if (square >= nearest) continue;
            nearest = square;
            found = sb_sum3(from * sb_wall_normal(sim, set, b)) < 0;
        }
    }
    return found;
}

/* The domain in quanta; along periodic axes, and across a 2D scene, it has no ends. */
typedef struct bounds {
    sb_record low, high;
} bounds;

static bounds bounds_of(const sb_sim *sim)
{
    bounds b = {sb_space_record(&sim->space, sim->scene->domain.min),
                sb_space_record(&sim->space, sim->scene->domain.max)};
    for (int axis = 0; axis < 3; axis++)
        if (sim->space.period[axis] > 0 || (sim->constant.dimension == 2 && axis == 1))
            b.low[axis] = 0, b.high[axis] = SB_POSITION_END;
    return b;
}

/* Whether a particle that has moved there ends. */
SB_APART bool ends(const sb_sim *sim, const bounds *b, sb_record at)
{
    for (int axis = 0; axis < 3; axis++)
        if (at[axis] < b->low[axis] || at[axis] > b->high[axis]) return true;
    if (!sb_space_inside(&sim->space, at)) return true;
    for (int set = 0; set < SB_WALL_SETS; set++)
        if (sb_walls_near(&sim->walls.set[set], &sim->space, at) && behind(sim, &sim->walls.set[set], at)) return true;
    return false;
}

/* Moves a particle in this water. */
SB_INLINE void move_one(const sb_sim *sim, const bounds *b, sb_foam_water water, sb_foam_particle *p)
{
    const sb_foam_law *law = &sim->foam->law;
    const float dt = (float)sim->state.time_step, fall = sim->constant.gravity * dt;
    sb_f4 way, v = p->velocity;
    if (water.share < law->air) {
        p->kind = SB_FOAM_SPRAY;
        way = v - (sb_f4){0, 0, 0.5f * fall, 0}; /* mean of the step */
        v[2] -= fall;
    } else {
        const float life = v[3] - dt;
        p->kind = water.share > law->water ? SB_FOAM_BUBBLES : SB_FOAM_FLOATS;
        v = water.velocity;
        v[2] += p->kind == SB_FOAM_BUBBLES ? law->rise : 0;
        way = v;
        v[3] = life;
    }
    p->velocity = v;
    p->position = sb_space_wrap(&sim->space, sb_foam_displaced(sim, p->position, way * sb_splat(dt)));
    if (!(v[3] > 0) || ends(sim, b, p->position)) p->kind = SB_FOAM_KINDS;
}

/* Moves the particles of the words [begin, end), whose cells are complete. */
SB_MULTIVERSION
static void move_words(sb_sim *sim, const bounds *b, const uint64_t *words, size_t begin, size_t end)
{
    vicinity near;
    for (size_t k = begin; k < end; k++) {
        sb_foam_particle *p = &sim->foam->particle[sb_word_index(words[k])];
        if (sim->domains && !sb_domains_owns(sim->domains, sb_word_key(words[k]))) continue;
        if (k == begin || sb_word_key(words[k]) != sb_word_key(words[k - 1])) gather(sim, p->position, &near);
        move_one(sim, b, look(sim, &near, p->position), p);
    }
}

/* The first word from `at` on that begins a cell, or n. */
static size_t cell_from(const uint64_t *words, size_t at, size_t n)
{
    while (at > 0 && at < n && sb_word_key(words[at]) == sb_word_key(words[at - 1])) at++;
    return at < n ? at : n;
}

/* The order in which particles are visited: by cells. NULL without memory. */
static const uint64_t *order(sb_sim *sim)
{
    sb_foam *foam = sim->foam;
    const size_t n = foam->count;
    if (sb_grow((void **)&foam->words, &foam->words_capacity, n, sizeof *foam->words) != 0 ||
        sb_grow((void **)&foam->other, &foam->other_capacity, n, sizeof *foam->other) != 0)
        return NULL;
#pragma omp parallel for schedule(static)
    for (size_t p = 0; p < n; p++)
        foam->words[p] = sb_sort_word(sb_space_key(&sim->space, foam->particle[p].position), p);
    return sb_sort(foam->words, foam->other, n, SB_INDEX_BITS, SB_INDEX_BITS + sim->space.key_bits);
}

/* A particle that this domain has moved. */
typedef struct moved {
    sb_foam_particle particle;
    uint64_t index;
} moved;

/* Gives all domains the particles that each has moved: those of its cells. Returns 0, or -1 without memory in any. */
static int share_moved(sb_sim *sim, const uint64_t *words)
{
    sb_foam *foam = sim->foam;
    sb_ranks *ranks = sim->ranks;
    if (!sb_ranks_several(ranks)) return 0;
    size_t sizes[SB_RANKS_MAX], own = 0, count = 0;
    for (size_t k = 0; k < foam->count; k++) own += sb_domains_owns(sim->domains, sb_word_key(words[k]));
    const size_t length = own * sizeof(moved);
    sb_ranks_gather(ranks, &length, sizeof length, sizes);
    moved *mine = sb_alloc_untouched(own, sizeof *mine), *all = sb_alloc_untouched(foam->count, sizeof *all);
    const bool failed = sb_ranks_any(ranks, !mine || !all);
    for (size_t k = 0; k < foam->count && !failed; k++) {
        const size_t p = sb_word_index(words[k]);
        if (sb_domains_owns(sim->domains, sb_word_key(words[k]))) mine[count++] = (moved){foam->particle[p], p};
    }
    if (!failed) sb_ranks_spread(ranks, mine, all, sizes);
    for (size_t k = 0; k < foam->count && !failed; k++) foam->particle[all[k].index] = all[k].particle;
    sb_free(mine);
    sb_free(all);
    return failed ? -1 : 0;
}

int sb_foam_move(sb_sim *sim)
{
    sb_foam *foam = sim->foam;
    const size_t n = foam->count, chunks = (n + CHUNK - 1) / CHUNK;
    if (n == 0) return 0;
    sb_refresh_owners(sim, sim->work.end_velocity);
    const uint64_t *words = order(sim);
    const bounds b = bounds_of(sim);
    if (sb_ranks_any(sim->ranks, !words)) return -1;
#pragma omp parallel for schedule(dynamic)
    for (size_t c = 0; c < chunks; c++)
        move_words(sim, &b, words, cell_from(words, c * CHUNK, n), cell_from(words, (c + 1) * CHUNK, n));
    if (share_moved(sim, words) != 0) return -1;
    size_t kept = 0;
    for (size_t p = 0; p < n; p++)
        if (foam->particle[p].kind < SB_FOAM_KINDS) foam->particle[kept++] = foam->particle[p];
    foam->count = kept;
    return 0;
}
