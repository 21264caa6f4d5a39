/* Traces streamlines by Runge-Kutta steps of fourth order, and places them evenly. */
#include "render/slice/streamlines.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { POINTS_MAX = 2000000, LINE_POINTS_MAX = 5000 };

static const double end_share = 0.5;     /* of the distance, at which a line ends before another one */
static const double least_length = 1;    /* in distances; shorter lines are left out */
static const double still_share = 0.002; /* of the greatest speed: slower water stands */

/* While lines are traced. */
struct tracing {
    sb_streamlines *lines;
    const sb_plane_field *field;
    double distance, step, still; /* m, m, m/s */
    size_t n[2];                  /* cells with the side `distance` */
};

/* The direction of the velocity. False: there is no water, or it stands. */
static bool direction(const struct tracing *t, double a, double b, double out[2])
{
    const sb_plane_sample sample = sb_plane_field_at(t->field, a, b);
    if (!sb_plane_wet(&sample)) return false;
    const double speed = hypot((double)sample.velocity[0], (double)sample.velocity[1]);
    if (!(speed > t->still)) return false;
    out[0] = (double)sample.velocity[0] / speed;
    out[1] = (double)sample.velocity[1] / speed;
    return true;
}

static bool advance(const struct tracing *t, double sign, double at[2])
{
    const double h = sign * t->step;
    double k1[2], k2[2], k3[2], k4[2];
    if (!direction(t, at[0], at[1], k1)) return false;
    if (!direction(t, at[0] + 0.5 * h * k1[0], at[1] + 0.5 * h * k1[1], k2)) return false;
    if (!direction(t, at[0] + 0.5 * h * k2[0], at[1] + 0.5 * h * k2[1], k3)) return false;
    if (!direction(t, at[0] + h * k3[0], at[1] + h * k3[1], k4)) return false;
    for (int c = 0; c < 2; c++) at[c] += h / 6 * (k1[c] + 2 * k2[c] + 2 * k3[c] + k4[c]);
    return true;
}

/* The cell of a place along one axis. */
static size_t cell_of(const struct tracing *t, int axis, double x)
{
    const double at = (x - t->field->low[axis]) / t->distance;
    return at <= 0 ? 0 : at >= (double)t->n[axis] ? t->n[axis] - 1 : (size_t)at;
}

/* Whether a point of an earlier line is nearer than `reach`, which is at most the distance. */
static bool is_near(const struct tracing *t, const double at[2], double reach)
{
    const size_t column = cell_of(t, 0, at[0]), row = cell_of(t, 1, at[1]);
    for (size_t r = row > 0 ? row - 1 : 0; r <= row + 1 && r < t->n[1]; r++)
        for (size_t c = column > 0 ? column - 1 : 0; c <= column + 1 && c < t->n[0]; c++)
            for (uint32_t k = t->lines->cells[r * t->n[0] + c]; k > 0; k = t->lines->points[k - 1].before) {
                const sb_stream_point *p = &t->lines->points[k - 1];
                if (hypot((double)p->a - at[0], (double)p->b - at[1]) < reach) return true;
            }
    return false;
}

static sb_status append(struct tracing *t, const double at[2], sb_error *error)
{
    sb_streamlines *lines = t->lines;
    if (sb_grow((void **)&lines->points, &lines->point_capacity, lines->point_count + 1, sizeof *lines->points) != 0)
        return sb_fail_memory(error, "the streamlines of a slice");
    lines->points[lines->point_count++] = (sb_stream_point){.a = (float)at[0], .b = (float)at[1]};
    return SB_OK;
}

/* Appends the points from a seed, which is not appended, onwards or backwards. *closed: the line came back to it. */
static sb_status follow(struct tracing *t, const double seed[2], double sign, bool *closed, sb_error *error)
{
    double at[2] = {seed[0], seed[1]}, away = 0;
    sb_status status = SB_OK;
    for (int k = 1; k < LINE_POINTS_MAX && status == SB_OK && t->lines->point_count < POINTS_MAX; k++) {
        if (!advance(t, sign, at) || is_near(t, at, end_share * t->distance)) break;
        const double from = hypot(at[0] - seed[0], at[1] - seed[1]);
        away = from > away ? from : away;
        if (away > 2 * t->step && from < 0.75 * t->step) {
            *closed = true;
            return append(t, seed, error);
        }
        status = append(t, at, error);
    }
    return status;
}

/* Turns the order of points that were traced backwards. */
static void reverse(sb_stream_point *points, size_t count)
{
    for (size_t i = 0; i < count / 2; i++) {
        const sb_stream_point other = points[i];
        points[i] = points[count - 1 - i];
        points[count - 1 - i] = other;
    }
}

/* Ends a line before it comes near to itself, as a spiral does: the first point near one that is more than a turn of a
   circle with the distance as diameter earlier. The line is not in the cells yet. */
static size_t end_of_spiral(const struct tracing *t, size_t first, size_t count)
{
    const size_t turn = (size_t)(3.2 * t->distance / t->step);
    const sb_stream_point *p = t->lines->points + first;
    const float reach = (float)(0.5 * end_share * t->distance);
    /* Every fourth point is compared: points are an eighth of the distance apart, or less. */
    for (size_t i = turn; i < count; i++)
        for (size_t k = 0; k + turn <= i; k += 4)
            if (fabsf(p[i].a - p[k].a) < reach && fabsf(p[i].b - p[k].b) < reach) return i;
    return count;
}

/* Traces the line through a seed both ways. */
static sb_status trace_line(struct tracing *t, const double seed[2], sb_error *error)
{
    sb_streamlines *lines = t->lines;
    const size_t first = lines->point_count;
    bool closed = false;
    sb_status status = follow(t, seed, -1, &closed, error);
    if (status == SB_OK) reverse(lines->points + first, lines->point_count - first);
    if (status == SB_OK) status = append(t, seed, error);
    bool onwards = closed;
    if (status == SB_OK && !closed) status = follow(t, seed, 1, &onwards, error);
    if (status != SB_OK) return status;
    size_t count = lines->point_count - first;
    if (!closed) count = end_of_spiral(t, first, count);
    if (((double)count - 1) * t->step < least_length * t->distance) count = 0;
    lines->point_count = first + count;
    if (count == 0) return SB_OK;
    if (sb_grow((void **)&lines->lines, &lines->line_capacity, lines->line_count + 1, sizeof *lines->lines) != 0)
        return sb_fail_memory(error, "the streamlines of a slice");
    lines->lines[lines->line_count++] = (sb_streamline){first, count, closed};
    for (size_t k = first; k < lines->point_count; k++) {
        sb_stream_point *p = &lines->points[k];
        uint32_t *cell = &lines->cells[cell_of(t, 1, (double)p->b) * t->n[0] + cell_of(t, 0, (double)p->a)];
        p->before = *cell;
        *cell = (uint32_t)k + 1;
    }
    return SB_OK;
}

/* Begins a line at a place that is far enough from all others. */
static sb_status try_seed(struct tracing *t, const double seed[2], sb_error *error)
{
    double unused[2];
    if (t->lines->point_count >= POINTS_MAX || !direction(t, seed[0], seed[1], unused)) return SB_OK;
    if (is_near(t, seed, 0.999 * t->distance)) return SB_OK;
    return trace_line(t, seed, error);
}

/* Begins lines beside the points of a line, on both sides. */
static sb_status seed_beside(struct tracing *t, size_t line, sb_error *error)
{
    const sb_streamline l = t->lines->lines[line];
    sb_status status = SB_OK;
    for (size_t k = l.first; k < l.first + l.count && status == SB_OK; k++)
        for (int side = -1; side <= 1 && status == SB_OK; side += 2) {
            const double a = (double)t->lines->points[k].a, b = (double)t->lines->points[k].b;
            double along[2];
            if (!direction(t, a, b, along)) continue;
            const double seed[2] = {a - side * t->distance * along[1], b + side * t->distance * along[0]};
            status = try_seed(t, seed, error);
        }
    return status;
}

static double greatest_speed(const sb_plane_field *field)
{
    double most = 0;
    for (size_t i = 0; i < field->n[0] * field->n[1]; i++) {
        const sb_plane_sample *node = &field->node[i];
        const double speed = hypot((double)node->velocity[0], (double)node->velocity[1]);
        if (sb_plane_wet(node) && speed > most) most = speed;
    }
    return most;
}

sb_status sb_streamlines_trace(sb_streamlines *lines, const sb_plane_field *field, double distance, sb_error *error)
{
    struct tracing t = {.lines = lines, .field = field, .distance = distance};
    t.step = fmin(0.125 * distance, field->cell);
    t.still = still_share * greatest_speed(field);
    lines->line_count = lines->point_count = 0;
    for (int k = 0; k < 2; k++) t.n[k] = (size_t)((double)field->n[k] * field->cell / distance) + 1;
    const size_t count = t.n[0] * t.n[1];
    if (sb_grow((void **)&lines->cells, &lines->cell_capacity, count, sizeof *lines->cells) != 0)
        return sb_fail_memory(error, "the streamlines of a slice");
    memset(lines->cells, 0, count * sizeof *lines->cells);
    sb_status status = SB_OK;
    size_t next = 0;
    /* Each cell's middle begins lines in water that no other line leads to. */
    for (size_t i = 0; i < count && status == SB_OK; i++) {
        const double seed[2] = {field->low[0] + ((double)(i % t.n[0]) + 0.5) * distance,
                                field->low[1] + ((double)(i / t.n[0]) + 0.5) * distance};
        status = try_seed(&t, seed, error);
        for (; next < lines->line_count && status == SB_OK; next++) status = seed_beside(&t, next, error);
    }
    return status;
}

void sb_streamlines_free(sb_streamlines *lines)
{
    sb_free(lines->lines);
    sb_free(lines->points);
    sb_free(lines->cells);
    *lines = (sb_streamlines){0};
}
