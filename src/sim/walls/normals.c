#include "sim/walls/normals.h"

#include "base/hash.h"
#include "base/memory.h"

#include <string.h>

static size_t slot_of(const sb_wall_normals *table, const sb_f4 *normal)
{
    return sb_hash(0, normal, sizeof *normal) & (table->slots - 1);
}

/* Enlarges the hash set to four slots per normal at least, after one more. Returns 0, or -1 without memory. */
static int make_room(sb_wall_normals *table)
{
    if (4 * (table->count + 1) <= table->slots) return 0;
    const size_t slots = table->slots > 0 ? 2 * table->slots : 64;
    uint32_t *slot = sb_alloc(slots, sizeof *slot);
    if (!slot) return -1;
    sb_free(table->slot);
    table->slot = slot;
    table->slots = slots;
    for (size_t k = 0; k < table->count; k++) {
        size_t at = slot_of(table, &table->normal[k]);
        while (slot[at] != 0) at = (at + 1) & (slots - 1);
        slot[at] = (uint32_t)k + 1;
    }
    return 0;
}

int sb_wall_normals_index(sb_wall_normals *table, sb_f4 normal, uint32_t *index)
{
    if (make_room(table) != 0) return -1;
    size_t at = slot_of(table, &normal);
    for (; table->slot[at] != 0; at = (at + 1) & (table->slots - 1)) {
        *index = table->slot[at] - 1;
        if (memcmp(&table->normal[*index], &normal, sizeof normal) == 0) return 0;
    }
    if (sb_grow((void **)&table->normal, &table->capacity, table->count + 1, sizeof normal) != 0) return -1;
    table->normal[table->count++] = normal;
    *index = (uint32_t)table->count - 1;
    table->slot[at] = (uint32_t)table->count;
    return 0;
}

void sb_wall_normals_free(sb_wall_normals *table)
{
    sb_free(table->normal);
    sb_free(table->slot);
    *table = (sb_wall_normals){.count = 0};
}

size_t sb_wall_normals_bytes(const sb_wall_normals *table)
{
    return table->capacity * sizeof *table->normal + table->slots * sizeof *table->slot;
}
