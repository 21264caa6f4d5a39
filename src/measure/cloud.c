#include "measure/cloud.h"

#include "base/memory.h"
#include "base/sets.h"

#include <stdlib.h>

void sb_cloud_free(sb_cloud *cloud)
{
    sb_free(cloud->samples);
    sb_free(cloud->slots);
    sb_free(cloud->parents);
    sb_free(cloud->sizes);
    sb_free(cloud->marks);
    *cloud = (sb_cloud){0};
}

size_t sb_cloud_bytes(const sb_cloud *cloud)
{
    return cloud->capacity * sizeof *cloud->samples + cloud->slot_capacity * sizeof *cloud->slots +
           cloud->parent_capacity * sizeof *cloud->parents + cloud->size_capacity * sizeof *cloud->sizes +
           cloud->mark_capacity * sizeof *cloud->marks;
}

static bool inside(sb_vec3 p, sb_vec3 min, sb_vec3 max)
{
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
}

sb_status sb_cloud_query(sb_cloud *cloud, const sb_sim *sim, sb_vec3 min, sb_vec3 max, double lag, sb_error *error)
{
    cloud->count = 0;
    return sb_cloud_add(cloud, sim, min, max, lag, error);
}

sb_status sb_cloud_add(sb_cloud *cloud, const sb_sim *sim, sb_vec3 min, sb_vec3 max, double lag, sb_error *error)
{
    const size_t before = cloud->count;
    double range = lag > 0 ? lag * sb_sim_report(sim)->max_speed : 0;
    sb_vec3 wide_min = sb_sub(min, sb_vec(range, range, range));
    sb_vec3 wide_max = sb_add(max, sb_vec(range, range, range));
    size_t found;
    for (;;) {
        sb_fluid_sample *free = cloud->samples ? cloud->samples + before : NULL;
        const size_t more = sb_sim_query(sim, wide_min, wide_max, free, cloud->capacity - before);
        if (more == SIZE_MAX) return sb_fail_memory(error, "measured particles");
        found = before + more;
        if (found <= cloud->capacity) break;
        const int grown = sb_grow((void **)&cloud->samples, &cloud->capacity, found, sizeof *cloud->samples);
        if (sb_ranks_any(sb_sim_ranks(sim), grown != 0)) return sb_fail_memory(error, "measured particles");
    }
    for (size_t i = before; i < found; i++) {
        sb_fluid_sample sample = cloud->samples[i];
        if (lag > 0) sample.position = sb_madd(sample.position, -lag, sample.velocity);
        if (inside(sample.position, min, max)) cloud->samples[cloud->count++] = sample;
    }
    return SB_OK;
}

static int compare_slots(const void *left, const void *right)
{
    const sb_cloud_slot *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

/* First slot whose key is >= key. */
static size_t lower_bound(const sb_cloud_slot *slots, size_t count, uint64_t key)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (slots[middle].key < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

enum { CELL_BITS = 20 };

/* Cells are numbered from 1, so that the index of the cell below never wraps. z runs fastest: three cells above each
   other are one range of keys. */
static uint64_t cell_key(uint64_t x, uint64_t y, uint64_t z)
{
    return x << 2 * CELL_BITS | y << CELL_BITS | z;
}

static uint64_t cell_of(double offset, double link)
{
    double cell = offset / link;
    double last = (double)((1u << CELL_BITS) - 3);
    return 1 + (uint64_t)(cell < last ? cell : last);
}

static sb_status sort_into_cells(sb_cloud *cloud, double link, sb_error *error)
{
    size_t n = cloud->count;
    if (sb_grow((void **)&cloud->slots, &cloud->slot_capacity, n, sizeof *cloud->slots) != 0 ||
        sb_grow((void **)&cloud->parents, &cloud->parent_capacity, n, sizeof *cloud->parents) != 0 ||
        sb_grow((void **)&cloud->sizes, &cloud->size_capacity, n, sizeof *cloud->sizes) != 0)
        return sb_fail_memory(error, "groups of measured particles");
    sb_vec3 low = cloud->samples[0].position;
    for (size_t i = 1; i < n; i++) low = sb_min(low, cloud->samples[i].position);
    for (size_t i = 0; i < n; i++) {
        sb_vec3 offset = sb_sub(cloud->samples[i].position, low);
        cloud->slots[i] = (sb_cloud_slot){
            cell_key(cell_of(offset.x, link), cell_of(offset.y, link), cell_of(offset.z, link)), (uint32_t)i};
        cloud->parents[i] = (uint32_t)i;
        cloud->sizes[i] = 0;
    }
    qsort(cloud->slots, n, sizeof *cloud->slots, compare_slots);
    return SB_OK;
}

/* Joins the particle of slot s with all particles nearer than link in the nine columns of cells around it. Only slots
   before s are visited; later slots join this one themselves. */
static void join_neighbours(sb_cloud *cloud, size_t s, double link)
{
    uint32_t i = cloud->slots[s].index;
    uint64_t key = cloud->slots[s].key, mask = (1u << CELL_BITS) - 1;
    uint64_t x = key >> 2 * CELL_BITS, y = key >> CELL_BITS & mask, z = key & mask;
    for (uint64_t cx = x - 1; cx <= x + 1; cx++)
        for (uint64_t cy = y - 1; cy <= y + 1; cy++) {
            uint64_t first = cell_key(cx, cy, z - 1), last = cell_key(cx, cy, z + 1);
            if (first > key) return;
            for (size_t t = lower_bound(cloud->slots, s, first); t < s && cloud->slots[t].key <= last; t++) {
                uint32_t j = cloud->slots[t].index;
                sb_vec3 d = sb_sub(cloud->samples[i].position, cloud->samples[j].position);
                if (sb_dot(d, d) < link * link) sb_sets_join(cloud->parents, i, j);
            }
        }
}

/* Finds the root of the largest group. Needs at least two samples. */
static sb_status find_largest(sb_cloud *cloud, double link, bool by_weight, uint32_t *found, sb_error *error)
{
    sb_status status = sort_into_cells(cloud, link, error);
    if (status != SB_OK) return status;
    for (size_t s = 1; s < cloud->count; s++) join_neighbours(cloud, s, link);
    uint32_t largest = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        uint32_t root = sb_sets_root(cloud->parents, (uint32_t)i);
        cloud->sizes[root] += by_weight ? cloud->samples[i].density : 1;
        if (cloud->sizes[root] > cloud->sizes[largest]) largest = root;
    }
    *found = largest;
    return SB_OK;
}

sb_status sb_cloud_keep_heaviest(sb_cloud *cloud, double link, sb_error *error)
{
    uint32_t largest;
    if (cloud->count < 2) return SB_OK;
    sb_status status = find_largest(cloud, link, true, &largest, error);
    if (status != SB_OK) return status;
    size_t kept = 0;
    for (size_t i = 0; i < cloud->count; i++)
        if (sb_sets_root(cloud->parents, (uint32_t)i) == largest) cloud->samples[kept++] = cloud->samples[i];
    cloud->count = kept;
    return SB_OK;
}

sb_status sb_cloud_unmark(sb_cloud *cloud, sb_error *error)
{
    if (sb_grow((void **)&cloud->marks, &cloud->mark_capacity, cloud->count, sizeof *cloud->marks) != 0)
        return sb_fail_memory(error, "marks of measured particles");
    for (size_t i = 0; i < cloud->count; i++) cloud->marks[i] = false;
    return SB_OK;
}

sb_status sb_cloud_mark_largest(sb_cloud *cloud, double link, sb_error *error)
{
    uint32_t largest = 0;
    if (cloud->count == 0) return SB_OK;
    sb_status status = find_largest(cloud, link, false, &largest, error);
    for (size_t i = 0; status == SB_OK && i < cloud->count; i++)
        if (sb_sets_root(cloud->parents, (uint32_t)i) == largest) cloud->marks[i] = true;
    return status;
}

/* Counts the other samples nearer than link to the sample of slot s, and stops at `enough`. With a stack, marks all of
   them and pushes the slots of the newly marked ones. */
static size_t visit_near(sb_cloud *cloud, size_t s, double link, size_t enough, uint32_t *stack, size_t *top)
{
    const sb_vec3 at = cloud->samples[cloud->slots[s].index].position;
    const uint64_t key = cloud->slots[s].key, mask = (1u << CELL_BITS) - 1;
    const uint64_t x = key >> 2 * CELL_BITS, y = key >> CELL_BITS & mask, z = key & mask;
    size_t found = 0;
    for (uint64_t column = 0; column < 9; column++) {
        const uint64_t cx = x + column / 3 - 1, cy = y + column % 3 - 1;
        const uint64_t last = cell_key(cx, cy, z + 1);
        size_t t = lower_bound(cloud->slots, cloud->count, cell_key(cx, cy, z - 1));
        for (; t < cloud->count && cloud->slots[t].key <= last; t++) {
            const uint32_t j = cloud->slots[t].index;
            const sb_vec3 d = sb_sub(at, cloud->samples[j].position);
            if (t == s || !(sb_dot(d, d) < link * link)) continue;
            if (++found >= enough) return found;
            if (!stack || cloud->marks[j]) continue;
            cloud->marks[j] = true;
            stack[(*top)++] = (uint32_t)t;
        }
    }
    return found;
}

sb_status sb_cloud_spread(sb_cloud *cloud, double link, size_t least, sb_error *error)
{
    if (cloud->count < 2) return SB_OK;
    sb_status status = sort_into_cells(cloud, link, error);
    if (status != SB_OK) return status;
    /* Each sample is pushed at most once: here if it is marked already, else when it becomes marked. */
    uint32_t *stack = cloud->parents;
    size_t top = 0;
    for (size_t s = 0; s < cloud->count; s++)
        if (cloud->marks[cloud->slots[s].index]) stack[top++] = (uint32_t)s;
    while (top > 0) {
        const size_t s = stack[--top];
        if (least == 0 || visit_near(cloud, s, link, least, NULL, NULL) >= least)
            visit_near(cloud, s, link, SIZE_MAX, stack, &top);
    }
    return SB_OK;
}
