#include "geometry/facets/cuts.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Cosine above which two outlines are coplanar or parallel. */
static const double PARALLEL = 1 - 1e-9;

/* Part of a line, in m from its origin. */
typedef struct part {
    sb_vec3 origin, along;
    double low, high;
} part;

/* Limits a line to the part in an outline's border, or within `reach` of it. */
static void limit(part *line, const sb_outline *o, double reach)
{
    for (size_t k = 0; k < o->count; k++) {
        const sb_vec3 from = o->corner[k], side = sb_sub(o->corner[(k + 1) % o->count], from);
        const sb_vec3 inward = sb_normalize(o->count == 2 ? side : sb_cross(o->normal, side));
        const double at = sb_dot(inward, sb_sub(line->origin, from)), rate = sb_dot(inward, line->along);
        if (fabs(rate) < 1e-9) {
            if (at < -reach) line->high = -(double)INFINITY;
        } else if (rate > 0)
            line->low = fmax(line->low, -at / rate);
        else
            line->high = fmin(line->high, -at / rate);
    }
}

/* Length of the line in which two outlines cross; in 2D infinite if they cross. Negative: they do not. */
static double crossing(const sb_outline *a, const sb_outline *b, double reach)
{
    const double c = sb_dot(a->normal, b->normal), e = 1 - c * c;
    const double da = sb_dot(a->normal, a->corner[0]), db = sb_dot(b->normal, b->corner[0]);
    part line = {
        .along = sb_normalize(sb_cross(a->normal, b->normal)), .low = -(double)INFINITY, .high = (double)INFINITY};
    line.origin = sb_add(sb_scale(a->normal, (da - c * db) / e), sb_scale(b->normal, (db - c * da) / e));
    limit(&line, a, reach);
    limit(&line, b, reach);
    return line.high - line.low;
}

static double above(const sb_outline *plane, sb_vec3 at)
{
    return sb_dot(plane->normal, sb_sub(at, plane->corner[0]));
}

/* Whether an outline goes on for more than `near` on both sides of a plane. */
static bool straddles(const sb_outline *o, const sb_outline *plane, double near)
{
    double low = 0, high = 0;
    for (size_t k = 0; k < o->count; k++) {
        const double at = above(plane, o->corner[k]);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    return low < -near && high > near;
}

/* Whether an outline crosses a plane, or ends within `reach` before it. */
static bool reaches(const sb_outline *o, const sb_outline *plane, double reach)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t k = 0; k < o->count; k++) {
        const double at = above(plane, o->corner[k]);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    return low < reach && high > reach;
}

/* The part of an outline before (side 1) or behind (side -1) a plane. Corners are NULL without memory. */
static sb_outline part_of(const sb_outline *o, const sb_outline *plane, double side)
{
    sb_outline made = {.normal = o->normal, .corner = sb_alloc(o->count + 2, sizeof *made.corner)};
    const size_t sides = o->count == 2 ? 1 : o->count;
    for (size_t k = 0; k < o->count && made.corner; k++) {
        const sb_vec3 from = o->corner[k], to = o->corner[(k + 1) % o->count];
        const double s = side * above(plane, from), t = side * above(plane, to);
        if (s >= 0) made.corner[made.count++] = from;
        if (k < sides && ((s < 0 && t > 0) || (s > 0 && t < 0)))
            made.corner[made.count++] = sb_madd(from, s / (s - t), sb_sub(to, from));
    }
    return made;
}

static int cut(sb_outlines *outlines, size_t k, const sb_outline *plane)
{
    if (sb_grow((void **)&outlines->outline, &outlines->capacity, outlines->count + 1, sizeof *outlines->outline) != 0)
        return -1;
    sb_outline *o = &outlines->outline[k];
    const sb_outline before = part_of(o, plane, 1), behind = part_of(o, plane, -1);
    if (!before.corner || !behind.corner) {
        sb_free(before.corner);
        sb_free(behind.corner);
        return -1;
    }
    sb_free(o->corner);
    *o = before;
    outlines->outline[outlines->count++] = behind;
    return 0;
}

static void grow(const sb_outline *o, sb_vec3 *min, sb_vec3 *max)
{
    for (size_t k = 0; k < o->count; k++) {
        *min = sb_min(*min, o->corner[k]);
        *max = sb_max(*max, o->corner[k]);
    }
}

/* Whether an outline's box overlaps another box. */
static bool overlaps(const sb_outline *o, sb_vec3 min, sb_vec3 max)
{
    sb_vec3 low = o->corner[0], high = low;
    grow(o, &low, &high);
    return low.x <= max.x && low.y <= max.y && low.z <= max.z && high.x >= min.x && high.y >= min.y && high.z >= min.z;
}

int sb_outlines_cut(sb_outlines *outlines, const sb_outlines *by, double bend, double near, double reach)
{
    sb_vec3 min = {(double)INFINITY, (double)INFINITY, (double)INFINITY}, max = sb_scale(min, -1);
    for (size_t p = 0; p < by->count; p++) grow(&by->outline[p], &min, &max);
    for (size_t k = 0; k < outlines->count; k++) {
        if (!overlaps(&outlines->outline[k], min, max)) continue;
        for (size_t p = 0; p < by->count; p++) {
            const sb_outline *o = &outlines->outline[k], *plane = &by->outline[p];
            const double along = sb_dot(o->normal, plane->normal);
            if (along < bend || along > PARALLEL || !straddles(o, plane, near) || !reaches(plane, o, reach)) continue;
            if (crossing(o, plane, reach) > near && cut(outlines, k, plane) != 0) return -1;
        }
    }
    return 0;
}
