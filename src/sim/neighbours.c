/* One pass over the cells gives each particle its neighbour lists, density, wall vector and the
   diagonal of the pressure operator: the offsets are at hand once, and all four need them. */
#include "base/memory.h"
#include "sim/kernel_batch.h"
#include "sim/sleep.h"

#include <math.h>
#include <omp.h>
#include <string.h>

#if defined(__x86_64__)
#include <immintrin.h>
#define SB_AVX512
#endif

enum {
    CANDIDATES = 4096,   /* of one cell's surroundings that fit the fast buffer; more are refused */
    LIST_MAX = 1024,     /* neighbours of one particle: 30 are normal */
    LANES = 8,
    SPARE = 16,          /* vector stores may run past the end */
};

/* Particles around one cell as offsets from the cell's corner, in quanta. */
typedef struct surroundings {
    size_t count;
    float x[CANDIDATES + SPARE], y[CANDIDATES + SPARE], z[CANDIDATES + SPARE];
    float weight[CANDIDATES + SPARE];
    uint32_t index[CANDIDATES + SPARE];
} surroundings;

/* The hits of one particle. */
typedef struct hits {
    size_t count, padded; /* padded to LANES by hits at the support radius, where kernels vanish */
    float x[LIST_MAX + SPARE], y[LIST_MAX + SPARE], z[LIST_MAX + SPARE], q2[LIST_MAX + SPARE];
    float weight[LIST_MAX + SPARE], value[LIST_MAX + SPARE], slope[LIST_MAX + SPARE];
    uint32_t index[LIST_MAX + SPARE];
} hits;

typedef size_t find_hits_form(const surroundings *s, hits *h, sb_f4 self, float scale, uint32_t skip);

/* A list under construction for one block, copied to the shared pool when the block is done. */
typedef struct list {
    uint32_t *index;
    float *slope;
    size_t used, capacity_index, capacity_slope;
} list;

typedef struct worker {
    surroundings fluid, wall;
    hits hits;
    list pairs, wall_pairs;
    const sb_kernel *kernel;
    sb_kernel_batch *batch;
    find_hits_form *find_hits;
    float q_scale;        /* (quantum / h)^2 */
    float value_scale;    /* alpha / h^d */
    float slope_scale;    /* alpha quantum / h^(d+2): W'/r per quantum */
    bool full;            /* a limit was hit */
    bool starved;         /* memory ran out */
} worker;

static bool list_reserve(list *l, size_t more)
{
    size_t needed = l->used + more;
    return sb_grow((void **)&l->index, &l->capacity_index, needed, sizeof *l->index) == 0 &&
           sb_grow((void **)&l->slope, &l->capacity_slope, needed, sizeof *l->slope) == 0;
}

SB_INLINE void gather_cell(surroundings *s, const sb_record *record, uint32_t begin, uint32_t end,
                           sb_record corner, uint32_t base)
{
    if (s->count + (end - begin) > CANDIDATES) {
        s->count = CANDIDATES + 1;
        return;
    }
    for (uint32_t k = begin; k < end; k++) {
        sb_f4 d = sb_offset(record[k], corner);
        s->x[s->count] = d[0];
        s->y[s->count] = d[1];
        s->z[s->count] = d[2];
        s->weight[s->count] = sb_carried_value(record[k]);
        s->index[s->count++] = base + k;
    }
}

/* All records of `cells` in the 27 (2D: 9) cells around `code`, in a fixed order, numbered from `base`. */
SB_INLINE void gather(surroundings *s, const sb_cells *cells, const sb_record *record, uint64_t code,
                      sb_record corner, int layers, uint32_t base)
{
    for (int dz = -1; dz <= 1; dz++)
        for (int dy = -layers; dy <= layers; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                int64_t cell = sb_cells_find(cells, code + sb_cell_step(dx, dy, dz));
                if (cell >= 0 && s->count <= CANDIDATES)
                    gather_cell(s, record, cells->begin[cell], cells->begin[cell + 1], corner, base);
            }
}

/* Candidates within the support radius of `self`, as offsets self - candidate; skip: index of self.
   Returns how many; LIST_MAX or more means that some may have been left out. */
SB_MULTIVERSION
static size_t find_hits_portable(const surroundings *s, hits *h, sb_f4 self, float scale, uint32_t skip)
{
    size_t n = 0;
    for (size_t k = 0; k < s->count && n < LIST_MAX; k++) {
        float x = self[0] - s->x[k], y = self[1] - s->y[k], z = self[2] - s->z[k];
        float q2 = fmaf(x, x, fmaf(y, y, z * z)) * scale;
        h->x[n] = x;
        h->y[n] = y;
        h->z[n] = z;
        h->q2[n] = q2;
        h->weight[n] = s->weight[k];
        h->index[n] = s->index[k];
        n += (q2 < 1.0f) & (s->index[k] != skip);
    }
    return n;
}

#ifdef SB_AVX512
/* The same sixteen at a time; equal to the portable form to the bit. */
__attribute__((target("avx512f")))
static size_t find_hits_avx512(const surroundings *s, hits *h, sb_f4 self, float scale, uint32_t skip)
{
    const __m512 sx = _mm512_set1_ps(self[0]), sy = _mm512_set1_ps(self[1]), sz = _mm512_set1_ps(self[2]);
    const __m512 factor = _mm512_set1_ps(scale), one = _mm512_set1_ps(1.0f);
    const __m512i own = _mm512_set1_epi32((int)skip);
    size_t n = 0;
    for (size_t k = 0; k < s->count && n < LIST_MAX; k += 16) {
        size_t left = s->count - k;
        __mmask16 valid = (__mmask16)(left < 16 ? (1u << left) - 1 : 0xffffu);
        __m512 x = _mm512_sub_ps(sx, _mm512_loadu_ps(s->x + k));
        __m512 y = _mm512_sub_ps(sy, _mm512_loadu_ps(s->y + k));
        __m512 z = _mm512_sub_ps(sz, _mm512_loadu_ps(s->z + k));
        __m512 q2 = _mm512_mul_ps(
            _mm512_fmadd_ps(x, x, _mm512_fmadd_ps(y, y, _mm512_mul_ps(z, z))), factor);
        __m512i index = _mm512_loadu_si512(s->index + k);
        __mmask16 near = _mm512_mask_cmp_ps_mask(valid, q2, one, _CMP_LT_OQ);
        near = _mm512_mask_cmpneq_epi32_mask(near, index, own);
        if (!near)
            continue;
        _mm512_storeu_ps(h->x + n, _mm512_maskz_compress_ps(near, x));
        _mm512_storeu_ps(h->y + n, _mm512_maskz_compress_ps(near, y));
        _mm512_storeu_ps(h->z + n, _mm512_maskz_compress_ps(near, z));
        _mm512_storeu_ps(h->q2 + n, _mm512_maskz_compress_ps(near, q2));
        _mm512_storeu_ps(h->weight + n, _mm512_maskz_compress_ps(near, _mm512_loadu_ps(s->weight + k)));
        _mm512_storeu_si512(h->index + n, _mm512_maskz_compress_epi32(near, index));
        n += (size_t)__builtin_popcount(near);
    }
    return n;
}
#endif

static find_hits_form *choose_find_hits(void)
{
#ifdef SB_AVX512
    if (__builtin_cpu_supports("avx512f"))
        return find_hits_avx512;
#endif
    return find_hits_portable;
}

SB_INLINE void find_hits(worker *w, const surroundings *s, sb_f4 self, uint32_t skip)
{
    size_t n = w->find_hits(s, &w->hits, self, w->q_scale, skip);
    w->full |= n >= LIST_MAX;
    hits *h = &w->hits;
    h->count = n < LIST_MAX ? n : LIST_MAX;
    h->padded = (h->count + LANES - 1) / LANES * LANES;
    for (size_t k = h->count; k < h->padded; k++) {
        h->x[k] = h->y[k] = h->z[k] = 0;
        h->q2[k] = 1;
    }
}

/* Appends the hits to a list, padded to four with (filler, 0). */
SB_INLINE void append(worker *w, list *l, uint32_t filler, uint16_t *count)
{
    const hits *h = &w->hits;
    size_t padded = (h->count + 3) / 4 * 4;
    *count = 0;
    if (padded == 0)
        return;
    if (!list_reserve(l, padded)) {
        w->starved = true;
        return;
    }
    memcpy(l->index + l->used, h->index, h->count * sizeof *l->index);
    memcpy(l->slope + l->used, h->slope, h->count * sizeof *l->slope);
    for (size_t k = h->count; k < padded; k++) {
        l->index[l->used + k] = filler;
        l->slope[l->used + k] = 0;
    }
    l->used += padded;
    *count = (uint16_t)padded;
}

/* Fluid neighbours of particle i: density share, S_i and sum |m grad W|^2. */
SB_INLINE void fluid_sums(worker *w, float mass, float *density, sb_f4 *sum, float *squares)
{
    hits *h = &w->hits;
    const float scale = mass * w->slope_scale;
    sb_f8 value = {0}, x = {0}, y = {0}, z = {0}, square = {0};
    w->batch(w->kernel, h->q2, h->padded, h->value, h->slope);
    for (size_t k = 0; k < h->padded; k += LANES) {
        sb_f8 slope = *(sb_f8 *)(h->slope + k) * scale;
        *(sb_f8 *)(h->slope + k) = slope;
        value += *(const sb_f8 *)(h->value + k);
        x += slope * *(const sb_f8 *)(h->x + k);
        y += slope * *(const sb_f8 *)(h->y + k);
        z += slope * *(const sb_f8 *)(h->z + k);
        square += slope * slope * *(const sb_f8 *)(h->q2 + k);
    }
    *density += mass * w->value_scale * sb_sum8(&value);
    *sum += (sb_f4){sb_sum8(&x), sb_sum8(&y), sb_sum8(&z), 0};
    *squares = sb_sum8(&square) / w->q_scale;
}

/* Wall neighbours of particle i: density share and B_i = sum_b psi_b grad W_ib, with the flux
   sum_b psi_b v_b . grad W_ib of moving walls in the last lane. */
SB_INLINE void wall_sums(const sb_sim *sim, worker *w, float *density, sb_f4 *wall)
{
    hits *h = &w->hits;
    float value = 0;
    sb_f4 sum = {0};
    w->batch(w->kernel, h->q2, h->count, h->value, h->slope);
    for (size_t k = 0; k < h->count; k++) {
        float slope = h->slope[k] * h->weight[k] * w->slope_scale;
        sb_f4 gradient = {slope * h->x[k], slope * h->y[k], slope * h->z[k], 0};
        h->slope[k] = slope;
        value += h->weight[k] * h->value[k];
        if (h->index[k] >> 31) {
            const sb_wall_set *set = &sim->walls[SB_MOVING];
            uint32_t body = set->body[h->index[k] & 0x7fffffffu];
            sb_vec3 v = sim->moving[sim->moving_of_body[body]].velocity;
            gradient[3] = (float)v.x * gradient[0] + (float)v.y * gradient[1] + (float)v.z * gradient[2];
        }
        sum += gradient;
    }
    *density += w->value_scale * value;
    *wall = sum;
}

SB_INLINE void one_particle(sb_sim *sim, worker *w, size_t i, sb_record corner, bool near_wall)
{
    const sb_constants *c = &sim->constant;
    float density = c->mass * w->value_scale * (float)sim->scene->numerics.kernel->shape(0);
    float squares = 0;
    sb_f4 sum = {0}, wall = {0}, self = sb_offset(sim->position[i], corner);
    find_hits(w, &w->fluid, self, (uint32_t)i);
    fluid_sums(w, c->mass, &density, &sum, &squares);
    append(w, &w->pairs, (uint32_t)i, &sim->pairs.count[i]);
    sim->wall_pairs.count[i] = 0;
    if (near_wall) {
        find_hits(w, &w->wall, self, UINT32_MAX);
        if (w->hits.count > 0) {
            wall_sums(sim, w, &density, &wall);
            append(w, &w->wall_pairs, w->hits.index[0], &sim->wall_pairs.count[i]);
        }
    }
    float diagonal = squares;
    for (int axis = 0; axis < 3; axis++)
        diagonal += (sum[axis] + wall[axis]) * (sum[axis] + wall[axis]);
    sim->density[i] = density;
    sim->wall[i] = wall;
    sim->diagonal[i] = diagonal > 1e-6f * c->full_diagonal ? diagonal : 0;
}

/* Gathers what lies around the cell of particle i. Returns whether walls may be in reach. */
SB_INLINE bool around(sb_sim *sim, worker *w, size_t i, sb_record *corner)
{
    const int layers = sim->constant.dimension == 2 ? 0 : 1;
    const int shift = sim->space.shift;
    uint64_t code = sb_cell_code(sim->position[i], shift);
    *corner = (sb_record){sim->position[i][0] >> shift << shift, sim->position[i][1] >> shift << shift,
                          sim->position[i][2] >> shift << shift, 0};
    w->fluid.count = w->wall.count = 0;
    gather(&w->fluid, &sim->cells, sim->position, code, *corner, layers, 0);
    if (sim->ghosts.count > 0 && sb_space_at_edge(&sim->space, sim->position[i]))
        gather(&w->fluid, &sim->ghosts.cells, sim->position + sim->n, code, *corner, layers, (uint32_t)sim->n);
    if (sb_fringe_count(sim) > 0 && sim->sleep->tiles.beside[sb_tile_of(sim, &sim->sleep->tiles, sim->position[i])])
        gather(&w->fluid, &sim->sleep->fringe_cells, sim->position + sb_fringe_first(sim), code, *corner, layers,
               (uint32_t)sb_fringe_first(sim));
    for (uint32_t s = 0; s < SB_WALL_SETS; s++)
        if (sb_walls_near(&sim->walls[s], &sim->space, sim->position[i]))
            gather(&w->wall, &sim->walls[s].cells, sim->walls[s].record, code, *corner, layers, s << 31);
    if (w->fluid.count > CANDIDATES || w->wall.count > CANDIDATES) {
        w->full = true;
        w->fluid.count = w->wall.count = 0;
    }
    return w->wall.count > 0;
}

SB_MULTIVERSION
static void do_block(sb_sim *sim, worker *w, size_t block)
{
    uint64_t last = UINT64_MAX;
    sb_record corner = {0};
    bool near_wall = false;
    w->pairs.used = w->wall_pairs.used = 0;
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        uint64_t code = sb_cell_code(sim->position[i], sim->space.shift);
        if (code != last)
            near_wall = around(sim, w, i, &corner);
        last = code;
        sim->pairs.first[i] = (uint32_t)w->pairs.used;
        sim->wall_pairs.first[i] = (uint32_t)w->wall_pairs.used;
        one_particle(sim, w, i, corner, near_wall);
    }
}

/* Takes room in the pool for a finished block; its place depends on timing, its contents do not. */
static bool publish(sb_sim *sim, sb_pairs *pool, const list *l, size_t block)
{
    size_t at = __atomic_fetch_add(&pool->used, l->used, __ATOMIC_RELAXED);
    if (at + l->used > pool->capacity)
        return false;
    if (l->used > 0) {
        memcpy(pool->index + at, l->index, l->used * sizeof *l->index);
        memcpy(pool->slope + at, l->slope, l->used * sizeof *l->slope);
    }
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++)
        pool->first[i] += (uint32_t)at;
    return true;
}

static int pool_resize(sb_pairs *pool, size_t capacity)
{
    sb_free(pool->index);
    sb_free(pool->slope);
    pool->index = sb_alloc_untouched(capacity, sizeof *pool->index);
    pool->slope = sb_alloc_untouched(capacity, sizeof *pool->slope);
    pool->capacity = pool->index && pool->slope ? capacity : 0;
    return pool->capacity ? 0 : -1;
}

static worker *make_worker(const sb_sim *sim)
{
    worker *w = sb_alloc(1, sizeof *w);
    if (!w)
        return NULL;
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    int d = sim->constant.dimension;
    double h = (double)sim->constant.support, quantum = sim->space.quantum;
    w->kernel = kernel;
    w->batch = sb_kernel_batch_for(kernel);
    w->find_hits = choose_find_hits();
    w->q_scale = (float)(quantum / h * (quantum / h));
    w->value_scale = (float)(kernel->alpha[d] / pow(h, d));
    w->slope_scale = (float)(kernel->alpha[d] * quantum / pow(h, d + 2));
    return w;
}

static void free_worker(worker *w)
{
    if (!w)
        return;
    sb_free(w->pairs.index);
    sb_free(w->pairs.slope);
    sb_free(w->wall_pairs.index);
    sb_free(w->wall_pairs.slope);
    sb_free(w);
}

/* One attempt; *full when a particle has more neighbours than lists hold. 0, or -1 without memory. */
static int attempt(sb_sim *sim, bool *too_small, bool *full)
{
    bool small = false, over = false, memory = false;
    size_t blocks = sb_blocks(sim);
    sim->pairs.used = sim->wall_pairs.used = 0;
#pragma omp parallel reduction(| : small, over, memory)
    {
        worker *w = make_worker(sim);
        memory |= !w;
#pragma omp for schedule(dynamic, 1)
        for (size_t b = 0; b < blocks; b++) {
            if (!w)
                continue;
            do_block(sim, w, b);
            small |= !publish(sim, &sim->pairs, &w->pairs, b);
            small |= !publish(sim, &sim->wall_pairs, &w->wall_pairs, b);
        }
        over |= w && w->full;
        memory |= w && w->starved;
        free_worker(w);
    }
    *too_small = small;
    *full = over;
    return memory ? -1 : 0;
}

sb_status sb_stage_neighbours(sb_sim *sim, sb_error *error)
{
    for (;;) {
        bool too_small, full;
        if (attempt(sim, &too_small, &full) != 0)
            return sb_fail_memory(error, "neighbour lists");
        if (full)
            return sb_fail(error, SB_FAILED,
                           "step %llu: more than %d particles around one: the water has collapsed",
                           (unsigned long long)sim->report.step, LIST_MAX);
        if (!too_small)
            return SB_OK;
        size_t pairs = sim->pairs.used + sim->pairs.used / 16 + 4096;
        size_t walls = sim->wall_pairs.used + sim->wall_pairs.used / 8 + 4096;
        if (pairs > UINT32_MAX || walls > UINT32_MAX)
            return sb_fail(error, SB_FAILED, "%zu neighbour pairs: expected fewer than 2^32", pairs);
        if ((sim->pairs.used > sim->pairs.capacity && pool_resize(&sim->pairs, pairs) != 0) ||
            (sim->wall_pairs.used > sim->wall_pairs.capacity && pool_resize(&sim->wall_pairs, walls) != 0))
            return sb_fail_memory(error, "neighbour lists");
    }
}
