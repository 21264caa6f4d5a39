#include "stream/points.h"

#include "base/hash.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { QUANTA = 65535 }; /* the largest integer of a position */

static float speed_of(const sb_frame *frame, size_t i)
{
    const float *v = frame->velocity + 3 * i;
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static sb_status reserve(sb_points *points, size_t count, sb_error *error)
{
    void *bytes = points->bytes, *chosen = points->chosen;
    const int full = sb_grow(&bytes, &points->byte_capacity, count, SB_STREAM_POINT) != 0 ||
                     sb_grow(&chosen, &points->chosen_capacity, count, sizeof *points->chosen) != 0;
    points->bytes = bytes;
    points->chosen = chosen;
    return full ? sb_fail_memory(error, "the particles of the stream") : SB_OK;
}

typedef struct box {
    float min[3], max[3];
} box;

static void include(box *b, const float *p)
{
    for (int k = 0; k < 3; k++) {
        b->min[k] = p[k] < b->min[k] ? p[k] : b->min[k];
        b->max[k] = p[k] > b->max[k] ? p[k] : b->max[k];
    }
}

static const box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/* One quantum is left for the corner, which is a multiple of the quantum below the box. */
static bool fits(const box *b, double quantum)
{
    for (int k = 0; k < 3; k++)
        if ((double)b->max[k] - (double)b->min[k] > (QUANTA - 1) * quantum) return false;
    return true;
}

/* Chooses the particles; finds their box, and the greatest speed and pressure among them. */
static void choose(sb_points *points, const sb_frame *frame, const sb_points_choice *choice, box *whole)
{
    const double origin[3] = {frame->origin.x, frame->origin.y, frame->origin.z};
    const double min[3] = {choice->min.x - origin[0], choice->min.y - origin[1], choice->min.z - origin[2]};
    const double max[3] = {choice->max.x - origin[0], choice->max.y - origin[1], choice->max.z - origin[2]};
    float fastest = 0;
    points->count = 0;
    points->pressure_max = 0;
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        if (choice->decimation > 1 && sb_hash_mix(frame->id[i]) % choice->decimation != 0) continue;
        const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
        if (!(x >= min[0] && x <= max[0] && y >= min[1] && y <= max[1] && z >= min[2] && z <= max[2])) continue;
        points->chosen[points->count++] = (uint32_t)i;
        include(whole, p);
        const float *v = frame->velocity + 3 * i, square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        fastest = square > fastest ? square : fastest;
        points->pressure_max = frame->pressure[i] > points->pressure_max ? frame->pressure[i] : points->pressure_max;
    }
    points->speed_max = sqrtf(fastest);
}

static sb_status add_part(sb_points *points, size_t first, size_t count, const box *b, sb_error *error)
{
    void *parts = points->parts;
    if (points->part_count == SB_STREAM_PARTS_MAX)
        return sb_fail(error, SB_FAILED, "the frame needs more than %d parts", SB_STREAM_PARTS_MAX);
    if (sb_grow(&parts, &points->part_capacity, points->part_count + 1, sizeof *points->parts) != 0)
        return sb_fail_memory(error, "the parts of a frame");
    points->parts = parts;
    sb_points_part *part = &points->parts[points->part_count++];
    *part = (sb_points_part){.first = first, .count = count};
    for (int k = 0; k < 3 && count > 0; k++)
        part->corner[k] = points->quantum * floor((double)b->min[k] / points->quantum);
    return SB_OK;
}

/* Returns the end of the part that begins at `first`, and its box. */
static size_t find_end(const sb_points *points, const sb_frame *frame, size_t first, box *b)
{
    size_t end = first;
    *b = nothing;
    for (; end < points->count && end - first < SB_STREAM_POINTS; end++) {
        box wider = *b;
        include(&wider, frame->position + 3 * (size_t)points->chosen[end]);
        if (!fits(&wider, points->quantum)) break;
        *b = wider;
    }
    return end;
}

/* Cuts the particles into parts. They have one corner where the whole frame allows it. */
static sb_status cut(sb_points *points, const sb_frame *frame, const box *whole, sb_error *error)
{
    if (points->count == 0) return add_part(points, 0, 0, whole, error);
    const bool one_corner = fits(whole, points->quantum);
    sb_status status = SB_OK;
    for (size_t first = 0, end = 0; first < points->count && status == SB_OK; first = end) {
        box b = *whole;
        end = first + SB_STREAM_POINTS < points->count ? first + SB_STREAM_POINTS : points->count;
        if (!one_corner) end = find_end(points, frame, first, &b);
        status = add_part(points, first, end - first, &b, error);
    }
    return status;
}

/* 255 times the square root of the share: small values are finer than large ones. */
static unsigned char share(float value, float largest)
{
    return largest > 0 && value > 0 ? (unsigned char)(255 * sqrtf(value / largest) + 0.5F) : 0;
}

static void encode_part(sb_points *points, const sb_frame *frame, const sb_points_part *part)
{
    const double inverse = 1 / points->quantum;
    for (size_t i = part->first; i < part->first + part->count; i++) {
        const size_t source = points->chosen[i];
        unsigned char *to = points->bytes + SB_STREAM_POINT * i;
        for (size_t k = 0; k < 3; k++) {
            const double place = ((double)frame->position[3 * source + k] - part->corner[k]) * inverse + 0.5;
            const unsigned integer = (unsigned)place;
            to[2 * k] = (unsigned char)(integer & 0xff);
            to[2 * k + 1] = (unsigned char)(integer >> 8);
        }
        to[6] = share(speed_of(frame, source), points->speed_max);
        to[7] = share(frame->pressure[source], points->pressure_max);
    }
}

sb_status sb_points_encode(sb_points *points, const sb_frame *frame, const sb_points_choice *choice, sb_error *error)
{
    points->part_count = 0;
    points->quantum = frame->spacing / SB_POINTS_PER_SPACING;
    sb_status status = reserve(points, frame->count + 1, error); /* LCM copies from the array also if it is empty */
    if (status != SB_OK) return status;
    box whole = nothing;
    choose(points, frame, choice, &whole);
    if (points->count > SB_STREAM_TOTAL_MAX)
        return sb_fail(error, SB_FAILED, "the frame has %zu particles, expected at most %d", points->count,
                       SB_STREAM_TOTAL_MAX);
    status = cut(points, frame, &whole, error);
    const double origin[3] = {frame->origin.x, frame->origin.y, frame->origin.z};
    for (size_t p = 0; p < points->part_count && status == SB_OK; p++) {
        encode_part(points, frame, &points->parts[p]);
        for (int k = 0; k < 3; k++) points->parts[p].corner[k] += origin[k];
    }
    return status;
}

void sb_points_free(sb_points *points)
{
    sb_free(points->parts);
    sb_free(points->bytes);
    sb_free(points->chosen);
    *points = (sb_points){0};
}

sb_point sb_point_decode(const unsigned char bytes[SB_STREAM_POINT], const double corner[3], double quantum,
                         double speed_max, double pressure_max)
{
    sb_point point;
    for (int k = 0; k < 3; k++)
        point.position[k] = corner[k] + quantum * (double)(bytes[2 * k] | bytes[2 * k + 1] << 8);
    const double speed = bytes[6] / 255.0, pressure = bytes[7] / 255.0;
    point.speed = (float)(speed_max * speed * speed);
    point.pressure = (float)(pressure_max * pressure * pressure);
    return point;
}
