#include "stream/assembly.h"

#include "base/memory.h"

#include <string.h>

static void end_frame(sb_assembly *assembly)
{
    const int32_t missing = assembly->present.part_count - assembly->received;
    if (missing > 0) {
        assembly->frames_partial++;
        assembly->parts_lost += (uint64_t)missing;
    }
    assembly->present.part_count = assembly->received = 0;
}

/* Makes room for the whole frame. */
static sb_status reserve(sb_live_frame *frame, const sb_frame_message *part)
{
    void *parts = frame->parts, *points = frame->points;
    const int full = sb_grow(&parts, &frame->part_capacity, (size_t)part->part_count, sizeof *frame->parts) != 0 ||
                     sb_grow(&points, &frame->point_capacity, (size_t)part->total + 1, SB_STREAM_POINT) != 0;
    frame->parts = parts;
    frame->points = points;
    return full ? SB_FAILED : SB_OK;
}

static sb_status begin_frame(sb_assembly *assembly, const sb_frame_message *part)
{
    sb_live_frame *frame = &assembly->present;
    end_frame(assembly);
    const sb_status status = reserve(frame, part);
    if (status != SB_OK) return status;
    frame->frame = part->frame;
    frame->step = part->step;
    frame->time = part->time;
    frame->decimation = part->decimation;
    frame->spacing = part->spacing;
    frame->quantum = part->quantum;
    frame->speed_max = part->speed_max;
    frame->pressure_max = part->pressure_max;
    frame->count = part->total;
    frame->part_count = part->part_count;
    frame->moved_count = 0;
    for (int32_t p = 0; p < part->part_count; p++) frame->parts[p].count = -1;
    return SB_OK;
}

static bool agrees(const sb_live_frame *frame, const sb_frame_message *part)
{
    return part->part_count == frame->part_count && part->total == frame->count && part->step == frame->step &&
           part->decimation == frame->decimation && memcmp(&part->time, &frame->time, sizeof part->time) == 0 &&
           memcmp(&part->quantum, &frame->quantum, sizeof part->quantum) == 0 &&
           memcmp(&part->speed_max, &frame->speed_max, sizeof part->speed_max) == 0 &&
           memcmp(&part->pressure_max, &frame->pressure_max, sizeof part->pressure_max) == 0;
}

static sb_status store_moved(sb_live_frame *frame, const sb_frame_message *part)
{
    const size_t count = (size_t)part->moved_count;
    void *moved = frame->moved, *displacement = frame->displacement;
    const int full = sb_grow(&moved, &frame->moved_capacity, count, sizeof *frame->moved) != 0 ||
                     sb_grow(&displacement, &frame->displacement_capacity, 3 * count, sizeof(double)) != 0;
    frame->moved = moved;
    frame->displacement = displacement;
    if (full) return SB_FAILED;
    frame->moved_count = part->moved_count;
    if (count == 0) return SB_OK; /* the arrays may be NULL */
    memcpy(frame->moved, part->moved, count * sizeof *frame->moved);
    memcpy(frame->displacement, part->displacement, 3 * count * sizeof(double));
    return SB_OK;
}

/* Whether the parts are a partition of the frame's particles. Each part alone is valid, but forged ones may overlap. */
static bool parts_follow(const sb_live_frame *frame)
{
    int64_t first = 0;
    for (int32_t p = 0; p < frame->part_count; p++) {
        if (frame->parts[p].first != first) return false;
        first += frame->parts[p].count;
    }
    return first == frame->count;
}

static void finish(sb_assembly *assembly, bool *complete)
{
    sb_live_frame done = assembly->present;
    assembly->present = assembly->newest;
    assembly->newest = done;
    /* Late parts of this frame are duplicates. */
    assembly->present.frame = done.frame;
    assembly->present.part_count = assembly->received = 0;
    assembly->frames_complete++;
    *complete = true;
}

/* Counts a part of the present frame, which may be its last one. */
static void count_part(sb_assembly *assembly, bool *complete)
{
    if (++assembly->received < assembly->present.part_count) return;
    if (parts_follow(&assembly->present))
        finish(assembly, complete);
    else
        end_frame(assembly);
}

sb_status sb_assembly_add(sb_assembly *assembly, const sb_frame_message *part, bool *complete)
{
    sb_live_frame *frame = &assembly->present;
    *complete = false;
    const bool is_present = frame->part_count > 0 && part->frame == frame->frame;
    if (!is_present && part->frame <= frame->frame) {
        assembly->parts_ignored++;
        return SB_OK;
    }
    if (!is_present) {
        const sb_status status = begin_frame(assembly, part);
        if (status != SB_OK) return status;
    }
    if (!agrees(frame, part) || frame->parts[part->part].count >= 0) {
        assembly->parts_ignored++;
        return SB_OK;
    }
    if (assembly->received == 0 && store_moved(frame, part) != SB_OK) return SB_FAILED;
    sb_live_part *to = &frame->parts[part->part];
    *to = (sb_live_part){.first = part->first, .count = part->count};
    memcpy(to->corner, part->corner, sizeof to->corner);
    memcpy(frame->points + SB_STREAM_POINT * part->first, part->points, SB_STREAM_POINT * (size_t)part->count);
    assembly->parts++;
    count_part(assembly, complete);
    return SB_OK;
}

/* The only part of the group that has not arrived; -1: none, or several. *other: one that has arrived, or -1. */
static int32_t find_missing(const sb_live_frame *frame, const sb_parity_message *parity, int32_t *other)
{
    int32_t missing = -1;
    *other = -1;
    for (int32_t p = parity->group; p < frame->part_count; p += parity->group_count) {
        if (frame->parts[p].count >= 0) {
            *other = p;
            continue;
        }
        if (missing >= 0) return -1;
        missing = p;
    }
    return missing;
}

void sb_assembly_repair(sb_assembly *assembly, const sb_parity_message *parity, bool *complete)
{
    sb_live_frame *frame = &assembly->present;
    int32_t other;
    *complete = false;
    if (frame->part_count < 1 || parity->frame != frame->frame || parity->part_count != frame->part_count) return;
    const int32_t missing = find_missing(frame, parity, &other);
    const int64_t full = parity->count / SB_STREAM_POINT, first = missing * full, left = frame->count - first;
    if (missing < 0 || other < 0 || left < 1 || (missing < frame->part_count - 1 && left < full)) return;
    sb_live_part *to = &frame->parts[missing];
    const int64_t count = left < full ? left : full;
    unsigned char *points = frame->points + SB_STREAM_POINT * first;
    memcpy(points, parity->data, SB_STREAM_POINT * (size_t)count);
    for (int32_t p = parity->group; p < frame->part_count; p += parity->group_count) {
        const sb_live_part *part = &frame->parts[p];
        if (p == missing) continue;
        const int64_t shared = part->count < count ? part->count : count;
        const unsigned char *from = frame->points + SB_STREAM_POINT * part->first;
        for (int64_t i = 0; i < SB_STREAM_POINT * shared; i++) points[i] ^= from[i];
    }
    *to = (sb_live_part){.first = first, .count = (int32_t)count};
    memcpy(to->corner, frame->parts[other].corner, sizeof to->corner);
    assembly->parts_repaired++;
    count_part(assembly, complete);
}

void sb_assembly_restart(sb_assembly *assembly)
{
    end_frame(assembly);
    assembly->present.frame = 0;
}

static void free_frame(sb_live_frame *frame)
{
    sb_free(frame->parts);
    sb_free(frame->points);
    sb_free(frame->moved);
    sb_free(frame->displacement);
}

void sb_assembly_free(sb_assembly *assembly)
{
    free_frame(&assembly->present);
    free_frame(&assembly->newest);
    *assembly = (sb_assembly){0};
}
