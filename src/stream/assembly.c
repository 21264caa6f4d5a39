/* Counts complete and partial frames of a particle stream. */
#include "stream/assembly.h"

#include "base/memory.h"

#include <string.h>

static sb_status begin_frame(sb_assembly *assembly, const sb_particles_message *chunk)
{
    if (assembly->received < assembly->chunk_count) {
        assembly->frames_partial++;
        assembly->chunks_lost += (uint64_t)(assembly->chunk_count - assembly->received);
    }
    assembly->frame = chunk->frame;
    assembly->total = chunk->total;
    assembly->time = chunk->time;
    assembly->received = assembly->chunk_count = 0;
    void *seen = assembly->seen;
    if (sb_grow(&seen, &assembly->seen_capacity, (size_t)chunk->chunk_count, 1) != 0) return SB_FAILED;
    assembly->seen = seen;
    memset(assembly->seen, 0, (size_t)chunk->chunk_count);
    assembly->chunk_count = chunk->chunk_count;
    return SB_OK;
}

sb_status sb_assembly_add(sb_assembly *assembly, const sb_particles_message *chunk)
{
    if (assembly->chunk_count == 0 || chunk->frame != assembly->frame) {
        sb_status status = begin_frame(assembly, chunk);
        if (status != SB_OK) return status;
    }
    if (chunk->chunk_count != assembly->chunk_count || chunk->total != assembly->total ||
        assembly->seen[chunk->chunk]) {
        assembly->chunks_ignored++;
        return SB_OK;
    }
    assembly->seen[chunk->chunk] = 1;
    assembly->chunks++;
    if (++assembly->received == assembly->chunk_count) assembly->frames_complete++;
    return SB_OK;
}

void sb_assembly_free(sb_assembly *assembly)
{
    sb_free(assembly->seen);
    *assembly = (sb_assembly){0};
}
