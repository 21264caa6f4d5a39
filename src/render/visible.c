#include "render/visible.h"

#include "base/memory.h"

#include <string.h>

/* Counts of particles in cells of a box around them, with a margin of one empty cell. */
struct grid {
    unsigned char *cells;
    float min[3], inverse; /* m, 1/m */
    size_t n[3];
    ptrdiff_t step[3];
    unsigned full;         /* a cell of this many hides what is behind it */
    unsigned crowd;        /* particles in a cell and its six neighbours well inside water */
};

static const double cell_spacings = 1.5;
static const double cells_max = 5e7;

/* False for NaN too: a particle lost to infinity must not stretch the grid. */
static int sane(const float *p)
{
    return fabsf(p[0]) < 1e7f && fabsf(p[1]) < 1e7f && fabsf(p[2]) < 1e7f;
}

static int bounds(const sb_frame *frame, float min[3], float max[3])
{
    for (int a = 0; a < 3; a++) {
        min[a] = INFINITY;
        max[a] = -INFINITY;
    }
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        if (!sane(p))
            continue;
        for (int a = 0; a < 3; a++) {
            min[a] = p[a] < min[a] ? p[a] : min[a];
            max[a] = p[a] > max[a] ? p[a] : max[a];
        }
    }
    return min[0] <= max[0];
}

static sb_status lay_grid(sb_visible *visible, struct grid *grid, const float min[3],
                          const float max[3], double spacing, sb_error *error)
{
    double cell = cell_spacings * spacing, total;
    /* One stray particle may stretch the box: larger cells hide less, but stay true. */
    for (;; cell *= 1.3) {
        total = 1;
        for (int a = 0; a < 3; a++)
            total *= floor((double)(max[a] - min[a]) / cell) + 4;
        if (total <= cells_max)
            break;
    }
    for (int a = 0; a < 3; a++) {
        grid->n[a] = (size_t)((double)(max[a] - min[a]) / cell) + 4;
        grid->min[a] = (float)((double)min[a] - cell);
    }
    size_t count = grid->n[0] * grid->n[1] * grid->n[2];
    if (sb_grow((void **)&visible->cells, &visible->cell_capacity, count, 1) != 0)
        return sb_fail_memory(error, "the grid of visible particles");
    memset(visible->cells, 0, count);
    grid->cells = visible->cells;
    grid->inverse = (float)(1 / cell);
    grid->step[0] = 1;
    grid->step[1] = (ptrdiff_t)grid->n[0];
    grid->step[2] = (ptrdiff_t)(grid->n[0] * grid->n[1]);
    double mean = pow(cell / spacing, 3);
    grid->full = mean < 300 ? (unsigned)ceil(0.55 * mean) : 165;
    grid->crowd = mean < 60 ? (unsigned)(3 * mean) : 180;
    return SB_OK;
}

static size_t cell_of(const struct grid *grid, const float *p)
{
    size_t at = 0;
    for (int a = 0; a < 3; a++)
        at += (size_t)((p[a] - grid->min[a]) * grid->inverse) * (size_t)grid->step[a];
    return at;
}

/* All seven neighbours towards the eye's octant are full. */
static int hidden(const struct grid *grid, size_t cell, const float *to_eye)
{
    const unsigned char *at = grid->cells + cell;
    ptrdiff_t x = to_eye[0] < 0 ? -grid->step[0] : grid->step[0];
    ptrdiff_t y = to_eye[1] < 0 ? -grid->step[1] : grid->step[1];
    ptrdiff_t z = to_eye[2] < 0 ? -grid->step[2] : grid->step[2];
    unsigned full = grid->full;
    return at[z] >= full && at[x] >= full && at[y] >= full && at[x + z] >= full &&
           at[y + z] >= full && at[x + y] >= full && at[x + y + z] >= full;
}

static unsigned short size_of(const struct grid *grid, size_t cell)
{
    const unsigned char *at = grid->cells + cell;
    unsigned around = at[0];
    for (int a = 0; a < 3; a++)
        around += (unsigned)at[grid->step[a]] + at[-grid->step[a]];
    double share = around >= grid->crowd ? 1 : (double)around / grid->crowd;
    return (unsigned short)(65535 * (0.45 + 0.55 * share));
}

/* The eye and the side planes of the view, relative to the frame's origin. */
struct lens {
    float eye[3], right[3], up[3], back[3];
    float tangent, aspect, near, margin;
};

static struct lens lens_of(const sb_view *view, sb_vec3 origin, double margin)
{
    sb_vec3 eye = sb_sub(view->eye, origin);
    return (struct lens){
        .eye = {(float)eye.x, (float)eye.y, (float)eye.z},
        .right = {(float)view->right.x, (float)view->right.y, (float)view->right.z},
        .up = {(float)view->up.x, (float)view->up.y, (float)view->up.z},
        .back = {(float)view->back.x, (float)view->back.y, (float)view->back.z},
        .tangent = (float)view->tangent,
        .aspect = (float)view->aspect,
        .near = (float)view->near,
        .margin = (float)margin,
    };
}

static float dot3(const float *a, const float *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int outside(const struct lens *lens, const float *to_eye)
{
    float depth = dot3(to_eye, lens->back);
    float half = depth * lens->tangent;
    return depth < lens->near - lens->margin ||
           fabsf(dot3(to_eye, lens->up)) > half + lens->margin * (1 + lens->tangent) ||
           fabsf(dot3(to_eye, lens->right)) >
               half * lens->aspect + lens->margin * (1 + lens->tangent * lens->aspect);
}

sb_status sb_visible_collect(sb_visible *visible, const sb_frame *frame, const sb_view *view,
                             double speed_max, sb_error *error)
{
    visible->count = 0;
    if (!(frame->spacing > 0) || !(speed_max > 0))
        return sb_fail(error, SB_BAD_INPUT, "frame: spacing %g m and top speed %g m/s, expected > 0",
                       frame->spacing, speed_max);
    float min[3], max[3];
    if (!bounds(frame, min, max))
        return SB_OK;
    struct grid grid = {0};
    sb_status status = lay_grid(visible, &grid, min, max, frame->spacing, error);
    if (status != SB_OK)
        return status;
    if (sb_grow((void **)&visible->points, &visible->point_capacity, frame->count,
                sizeof *visible->points) != 0)
        return sb_fail_memory(error, "the visible particles");
    for (size_t i = 0; i < frame->count; i++) {
        if (!sane(frame->position + 3 * i))
            continue;
        unsigned char *cell = grid.cells + cell_of(&grid, frame->position + 3 * i);
        *cell = (unsigned char)(*cell < 255 ? *cell + 1 : 255);
    }
    struct lens lens = lens_of(view, frame->origin, frame->spacing);
    float to_share = (float)(65535 / speed_max);
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i, *v = frame->velocity + 3 * i;
        float to_eye[3] = {lens.eye[0] - p[0], lens.eye[1] - p[1], lens.eye[2] - p[2]};
        if (!sane(p) || outside(&lens, to_eye))
            continue;
        size_t cell = cell_of(&grid, p);
        if (hidden(&grid, cell, to_eye))
            continue;
        float share = sqrtf(dot3(v, v)) * to_share;
        visible->points[visible->count++] = (sb_visible_point){
            {p[0], p[1], p[2]},
            (unsigned short)(share < 65535 ? share : 65535),
            size_of(&grid, cell)};
    }
    return SB_OK;
}

void sb_visible_free(sb_visible *visible)
{
    sb_free(visible->points);
    sb_free(visible->cells);
    *visible = (sb_visible){0};
}
