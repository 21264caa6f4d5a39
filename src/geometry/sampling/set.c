/* Implements the set of boundary particles by a hash table of blocks of cells. */
#include "geometry/sampling/set.h"

#include "base/hash.h"
#include "base/memory.h"

#include <string.h>

typedef struct place {
    int64_t x, y, z;
} place;

static place cell_of(const sb_sample_set *set, sb_vec3 at)
{
    return (place){(int64_t)floor((at.x - set->origin.x) / set->cell),
                   (int64_t)floor((at.y - set->origin.y) / set->cell),
                   (int64_t)floor((at.z - set->origin.z) / set->cell)};
}

/* 21 bits per axis: blocks more than 2^21 apart share a key, which costs time but does not change results. */
static uint64_t key_of(int64_t x, int64_t y, int64_t z)
{
    const uint64_t mask = (1u << 21) - 1;
    return ((uint64_t)x & mask) | ((uint64_t)y & mask) << 21 | ((uint64_t)z & mask) << 42;
}

static size_t slot_of(const sb_sample_set *set, uint64_t key)
{
    size_t slot = sb_hash_mix(key) & (set->table_size - 1);
    while (set->value[slot] && set->key[slot] != key) slot = (slot + 1) & (set->table_size - 1);
    return slot;
}

static const uint32_t *find_block(const sb_sample_set *set, int64_t x, int64_t y, int64_t z)
{
    uint32_t value = set->value[slot_of(set, key_of(x, y, z))];
    return value ? set->block[value - 1] : NULL;
}

static size_t local_of(int64_t x, int64_t y, int64_t z)
{
    return (size_t)((x & 3) | (y & 3) << 2 | (z & 3) << 4);
}

void sb_sample_set_free(sb_sample_set *set)
{
    sb_free(set->sample);
    sb_free(set->next);
    sb_free(set->block);
    sb_free(set->key);
    sb_free(set->value);
    *set = (sb_sample_set){.cell = set->cell, .origin = set->origin};
}

/* Doubles the table before it is half full. */
static int make_room(sb_sample_set *set)
{
    if (2 * (set->block_count + 1) <= set->table_size) return 0;
    sb_sample_set grown = *set;
    grown.table_size = set->table_size ? 2 * set->table_size : 64;
    grown.key = sb_alloc_untouched(grown.table_size, sizeof *grown.key);
    grown.value = sb_alloc(grown.table_size, sizeof *grown.value);
    if (!grown.key || !grown.value) {
        sb_free(grown.key);
        sb_free(grown.value);
        return -1;
    }
    for (size_t i = 0; i < set->table_size; ++i) {
        if (!set->value[i]) continue;
        size_t slot = slot_of(&grown, set->key[i]);
        grown.key[slot] = set->key[i];
        grown.value[slot] = set->value[i];
    }
    sb_free(set->key);
    sb_free(set->value);
    *set = grown;
    return 0;
}

int sb_sample_set_add(sb_sample_set *set, const sb_sample *sample)
{
    if (set->count + 1 >= UINT32_MAX || make_room(set) ||
        sb_grow((void **)&set->sample, &set->sample_capacity, set->count + 1, sizeof *set->sample) ||
        sb_grow((void **)&set->next, &set->next_capacity, set->count + 1, sizeof *set->next) ||
        sb_grow((void **)&set->block, &set->block_capacity, set->block_count + 1, sizeof *set->block))
        return -1;
    place at = cell_of(set, sample->at);
    uint64_t key = key_of(at.x >> 2, at.y >> 2, at.z >> 2);
    size_t slot = slot_of(set, key);
    if (!set->value[slot]) {
        memset(set->block[set->block_count], 0, sizeof *set->block);
        set->key[slot] = key;
        set->value[slot] = (uint32_t)++set->block_count;
    }
    uint32_t *head = &set->block[set->value[slot] - 1][local_of(at.x, at.y, at.z)];
    set->sample[set->count] = *sample;
    set->next[set->count] = *head;
    *head = (uint32_t)++set->count;
    return 0;
}

int sb_sample_set_keep(sb_sample_set *set, uint32_t slab)
{
    sb_sample_set kept = {.cell = set->cell, .origin = set->origin};
    for (size_t i = 0; i < set->count; ++i)
        if (set->sample[i].slab >= slab && sb_sample_set_add(&kept, &set->sample[i]) != 0) {
            sb_sample_set_free(&kept);
            return -1;
        }
    sb_sample_set_free(set);
    *set = kept;
    return 0;
}

/* Finds the nearest sample of one cell's list if it is nearer than *best2. */
static void scan_chain(const sb_sample_set *set, uint32_t head, sb_vec3 at, double *best2, size_t *index)
{
    for (; head; head = set->next[head - 1]) {
        sb_vec3 arm = sb_sub(set->sample[head - 1].at, at);
        double distance2 = sb_dot(arm, arm);
        if (distance2 < *best2) {
            *best2 = distance2;
            *index = head - 1;
        }
    }
}

static double search(const sb_sample_set *set, sb_vec3 at, double limit, bool any, size_t *index)
{
    double best2 = limit * limit;
    *index = SIZE_MAX;
    if (set->count == 0) return best2;
    const sb_vec3 margin = {limit, limit, limit};
    const place low = cell_of(set, sb_sub(at, margin)), high = cell_of(set, sb_add(at, margin));
    for (int64_t bz = low.z >> 2; bz <= high.z >> 2; ++bz)
        for (int64_t by = low.y >> 2; by <= high.y >> 2; ++by)
            for (int64_t bx = low.x >> 2; bx <= high.x >> 2; ++bx) {
                const uint32_t *block = find_block(set, bx, by, bz);
                if (!block) continue;
                const place first = {bx * 4 > low.x ? bx * 4 : low.x, by * 4 > low.y ? by * 4 : low.y,
                                     bz * 4 > low.z ? bz * 4 : low.z};
                const place last = {bx * 4 + 3 < high.x ? bx * 4 + 3 : high.x,
                                    by * 4 + 3 < high.y ? by * 4 + 3 : high.y,
                                    bz * 4 + 3 < high.z ? bz * 4 + 3 : high.z};
                for (int64_t z = first.z; z <= last.z; ++z)
                    for (int64_t y = first.y; y <= last.y; ++y)
                        for (int64_t x = first.x; x <= last.x; ++x)
                            scan_chain(set, block[local_of(x, y, z)], at, &best2, index);
                if (any && *index != SIZE_MAX) return best2;
            }
    return best2;
}

double sb_sample_set_nearest(const sb_sample_set *set, sb_vec3 at, double limit, size_t *index)
{
    size_t found;
    double best2 = search(set, at, limit, false, &found);
    if (index && found != SIZE_MAX) *index = found;
    return found == SIZE_MAX ? limit : sqrt(best2);
}

bool sb_sample_set_any(const sb_sample_set *set, sb_vec3 at, double radius)
{
    size_t found;
    search(set, at, radius, true, &found);
    return found != SIZE_MAX;
}
