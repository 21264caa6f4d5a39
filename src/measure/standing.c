#include "measure/standing.h"

#include "base/memory.h"
#include "measure/measure.h"

#include <math.h>
#include <string.h>

/* Words of a cell; a domain of more than 512 spacings has higher levels. */
enum { WORDS_MAX = 16 };

/* A face of a body is a wall, not a floor, if the z component of its normal is less than this: steeper than 89 degrees.
   Water above it then is at most a few spacings from the next floor. */
static const double UPRIGHT = 0.0175;

/* A body stands on the ground if it is higher by this many half spacings, more than rounding of its file. */
static const double ROUNDED = 0.02;

static double step_of(double height, double spacing, size_t *words)
{
    const double least = height / (64.0 * WORDS_MAX - 1), step = fmax(0.5 * spacing, least);
    const double levels = floor(height / step) + 1;
    *words = (size_t)fmin(ceil(levels / 64), WORDS_MAX);
    return step;
}

double sb_measure_cell_bytes(double height, double spacing)
{
    size_t words;
    step_of(height + 2 * spacing, spacing, &words);
    return 2.0 * (double)words * sizeof(uint64_t) + sizeof(float);
}

void sb_standing_free(sb_standing *standing)
{
    sb_free(standing->solid);
    sb_free(standing->water);
    sb_free(standing->ground);
    *standing = (sb_standing){0};
}

size_t sb_standing_bytes(const sb_standing *s)
{
    return s->cells * (2 * s->words * sizeof *s->water + (s->ground ? sizeof *s->ground : 0));
}

void sb_standing_clear(sb_standing *s)
{
    memset(s->water, 0, s->cells * s->words * sizeof *s->water);
}

/* ---- ground and floors ---- */

/* A part of the plan, m. In 2D it is a line along x at y = 0. */
typedef struct area {
    double low[2], high[2];
} area;

static area area_of(const sb_map_record *grid, bool flat, size_t column, size_t row)
{
    const double x = grid->x_min + (double)column * grid->cell, y = flat ? 0 : grid->y_min + (double)row * grid->cell;
    return (area){{x, y}, {x + grid->cell, flat ? 0 : y + grid->cell}};
}

static double cross(double ax, double ay, double bx, double by)
{
    return ax * by - ay * bx;
}

/* Whether a line normal to (nx, ny) separates the triangle from the area, or both only touch by less than `margin`. */
static bool is_apart(const sb_vec3 v[3], const area *a, double nx, double ny, double margin)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        const double at = nx * v[k].x + ny * v[k].y;
        low = fmin(low, at);
        high = fmax(high, at);
    }
    const double from = fmin(nx * a->low[0], nx * a->high[0]) + fmin(ny * a->low[1], ny * a->high[1]);
    const double to = fmax(nx * a->low[0], nx * a->high[0]) + fmax(ny * a->low[1], ny * a->high[1]);
    return high < from + margin || low > to - margin;
}

/* What only touches an area is not in it, except across its line in 2D, on which an edge of the mesh may lie. */
static bool overlaps(const sb_vec3 v[3], const area *a, bool flat, double margin)
{
    const double across = flat ? -margin : margin;
    if (is_apart(v, a, 1, 0, margin) || is_apart(v, a, 0, 1, across)) return false;
    for (int k = 0; k < 3; k++) {
        const sb_vec3 from = v[k], to = v[(k + 1) % 3];
        const double ex = to.x - from.x, ey = to.y - from.y, length = hypot(ex, ey);
        if (length > 0 && is_apart(v, a, ey / length, -ex / length, fabs(ex) > 0 ? across : margin)) return false;
    }
    return true;
}

/* The plane of a triangle, z = z0 + gx (x - x0) + gy (y - y0), and its lowest and highest corner. */
typedef struct slab {
    bool upright; /* the plane is vertical: z is not a function of the place */
    double up;    /* z component of its normal, not negative */
    double x, y, z, gx, gy, low, high;
} slab;

static slab slab_of(const sb_vec3 v[3])
{
    const sb_vec3 a = sb_sub(v[1], v[0]), b = sb_sub(v[2], v[0]);
    const double plan = cross(a.x, a.y, b.x, b.y), nx = a.y * b.z - a.z * b.y, ny = a.z * b.x - a.x * b.z;
    const double length = sqrt(nx * nx + ny * ny + plan * plan);
    slab s = {.x = v[0].x, .y = v[0].y, .z = v[0].z};
    s.low = fmin(v[0].z, fmin(v[1].z, v[2].z));
    s.high = fmax(v[0].z, fmax(v[1].z, v[2].z));
    s.up = length > 0 ? fabs(plan) / length : 0;
    s.upright = !(s.up > 1e-6);
    if (s.upright) return s;
    s.gx = -nx / plan;
    s.gy = -ny / plan;
    return s;
}

static double height_at(const slab *s, double x, double y)
{
    return fmin(fmax(s->z + s->gx * (x - s->x) + s->gy * (y - s->y), s->low), s->high);
}

/* Limits the part [*start, *end] of an edge to what is within [min, max] along one axis. */
static void clip(double from, double to, double min, double max, double *start, double *end)
{
    if (from == to) {
        if (from < min || from > max) *end = -1;
        return;
    }
    const double a = (min - from) / (to - from), b = (max - from) / (to - from);
    *start = fmax(*start, fmin(a, b));
    *end = fmin(*end, fmax(a, b));
}

/* The range of an upright triangle within the area, from its edges. */
static void range_of_edges(const sb_vec3 v[3], const area *a, double *low, double *high)
{
    const double more = 1e-9 * (a->high[0] - a->low[0]);
    for (int k = 0; k < 3; k++) {
        const sb_vec3 from = v[k], to = v[(k + 1) % 3];
        double start = 0, end = 1;
        clip(from.x, to.x, a->low[0] - more, a->high[0] + more, &start, &end);
        clip(from.y, to.y, a->low[1] - more, a->high[1] + more, &start, &end);
        if (!(start <= end)) continue;
        const double first = from.z + start * (to.z - from.z), last = from.z + end * (to.z - from.z);
        *low = fmin(*low, fmin(first, last));
        *high = fmax(*high, fmax(first, last));
    }
}

/* The highest and the lowest z of the plane within the area, between those of the triangle. */
static void range_in(const sb_vec3 v[3], const slab *s, const area *a, double *low, double *high)
{
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (int k = 0; k < 4 && !s->upright; k++) {
        const double z = height_at(s, k & 1 ? a->high[0] : a->low[0], k & 2 ? a->high[1] : a->low[1]);
        *low = fmin(*low, z);
        *high = fmax(*high, z);
    }
    if (s->upright) range_of_edges(v, a, low, high);
}

static bool contains(const sb_vec3 v[3], double x, double y)
{
    bool left = false, right = false;
    for (int k = 0; k < 3; k++) {
        const sb_vec3 from = v[k], to = v[(k + 1) % 3];
        const double side = cross(to.x - from.x, to.y - from.y, x - from.x, y - from.y);
        left = left || side > 0;
        right = right || side < 0;
    }
    return !(left && right);
}

static void fill(sb_standing *s, size_t cell, double from, double to)
{
    const size_t end = sb_standing_level(s, to);
    for (size_t l = sb_standing_level(s, from); l <= end; l++)
        s->solid[cell * s->words + l / 64] |= (uint64_t)1 << l % 64;
}

/* What is known while the bodies are added. */
typedef struct builder {
    sb_standing *standing;
    const sb_map_record *grid;
    const sb_model *model;
    bool flat;
    float *top; /* m, highest ground of each cell */
} builder;

/* The first lowest layer of water may lie this far above its floor: half a spacing more than at rest. */
static void add_ground(const builder *b, size_t cell, const sb_vec3 v[3], const slab *plane, const area *a)
{
    sb_standing *s = b->standing;
    double low, high;
    range_in(v, plane, a, &low, &high);
    if (!(low <= high)) return;
    fill(s, cell, s->low, high + s->half);
    b->top[cell] = fmaxf(b->top[cell], (float)high);
    const double x = 0.5 * (a->low[0] + a->high[0]), y = 0.5 * (a->low[1] + a->high[1]);
    if (plane->upright || !contains(v, x, y)) return;
    const float z = (float)fmax(height_at(plane, x, y), b->model->min.z);
    if (!(s->ground[cell] >= z)) s->ground[cell] = z;
}

/* moves: the levels of the triangle are not known during the run, but what is below it at the start is no bare ground.
 */
static void add_face(const builder *b, size_t cell, const sb_vec3 v[3], const slab *plane, const area *a, bool moves)
{
    sb_standing *s = b->standing;
    double low, high;
    range_in(v, plane, a, &low, &high);
    if (!(low <= high)) return;
    if (!moves && plane->up >= UPRIGHT) fill(s, cell, low, high + s->half);
    if (s->ground && high > (double)b->top[cell] + ROUNDED * s->half) s->ground[cell] = NAN;
}

/* The cells [*from, *end) along an axis that the triangle may touch. */
static void cells_of(const sb_map_record *grid, int axis, const sb_vec3 v[3], size_t *from, size_t *end)
{
    const double at[3] = {axis == 0 ? v[0].x : v[0].y, axis == 0 ? v[1].x : v[1].y, axis == 0 ? v[2].x : v[2].y};
    const double start = axis == 0 ? grid->x_min : grid->y_min;
    const double most = (double)(axis == 0 ? grid->columns : grid->rows);
    const double low = floor((fmin(at[0], fmin(at[1], at[2])) - start) / grid->cell);
    const double high = floor((fmax(at[0], fmax(at[1], at[2])) - start) / grid->cell) + 1;
    *from = (size_t)fmin(fmax(low, 0), most);
    *end = (size_t)fmin(fmax(high, 0), most);
}

static void add_triangle(const builder *b, const sb_vec3 v[3], bool ground, bool moves)
{
    const double margin = 1e-9 * b->grid->cell;
    const slab plane = slab_of(v);
    size_t x0, x1, y0 = 0, y1 = 1;
    cells_of(b->grid, 0, v, &x0, &x1);
    if (!b->flat) cells_of(b->grid, 1, v, &y0, &y1);
    for (size_t row = y0; row < y1; row++)
        for (size_t column = x0; column < x1; column++) {
            const area a = area_of(b->grid, b->flat, column, row);
            const size_t cell = row * b->grid->columns + column;
            if (!overlaps(v, &a, b->flat, margin)) continue;
            if (ground)
                add_ground(b, cell, v, &plane, &a);
            else
                add_face(b, cell, v, &plane, &a, moves);
        }
}

/* The ground comes first: a body is on it where it is higher. */
static void add_bodies(const builder *b, bool ground)
{
    for (size_t i = 0; i < b->model->body_count; i++) {
        const sb_model_body *body = &b->model->bodies[i];
        const bool moves = body->wavemaker >= 0;
        if ((body->role == SB_ROLE_TERRAIN && !moves) != ground) continue;
        for (size_t t = 0; t < body->mesh.triangle_count; t++) {
            const uint32_t *of = body->mesh.triangles[t];
            const sb_vec3 v[3] = {body->mesh.vertices[of[0]], body->mesh.vertices[of[1]], body->mesh.vertices[of[2]]};
            add_triangle(b, v, ground, moves);
        }
    }
}

static bool has_terrain(const sb_model *model)
{
    for (size_t i = 0; i < model->body_count; i++)
        if (model->bodies[i].role == SB_ROLE_TERRAIN && model->bodies[i].mesh.triangle_count > 0) return true;
    return false;
}

sb_status sb_standing_create(const sb_scene *scene, const sb_model *model, const sb_map_record *grid,
                             sb_standing *standing, sb_error *error)
{
    const double spacing = scene->resolution;
    sb_standing s = {.cells = grid->columns * grid->rows, .low = model->min.z - spacing, .half = 0.5 * spacing};
    s.step = step_of(model->max.z - model->min.z + 2 * spacing, spacing, &s.words);
    s.solid = sb_alloc(s.cells, s.words * sizeof *s.solid);
    s.water = sb_alloc(s.cells, s.words * sizeof *s.water);
    float *top = sb_alloc(s.cells, sizeof *top);
    const bool ground = has_terrain(model);
    if (ground) s.ground = sb_alloc(s.cells, sizeof *s.ground);
    if (!s.solid || !s.water || !top || (ground && !s.ground)) {
        sb_free(top);
        sb_standing_free(&s);
        return sb_fail_memory(error, "measure.map");
    }
    for (size_t i = 0; i < s.cells; i++) {
        /* Below all terrain is the domain's floor. */
        fill(&s, i, s.low, model->min.z + s.half);
        top[i] = (float)model->min.z;
        if (ground) s.ground[i] = top[i];
    }
    const builder b = {&s, grid, model, scene->dimensions == 2, top};
    add_bodies(&b, true);
    add_bodies(&b, false);
    sb_free(top);
    *standing = s;
    return SB_OK;
}

/* ---- water ---- */

/* The bits of `all` from the bits of `start`, which are among them, up to the next zero: the sum carries through them.
 */
static uint64_t run_up(uint64_t all, uint64_t start)
{
    return ((all ^ (all + start)) | start) & all;
}

void sb_standing_connect(sb_standing *s)
{
#pragma omp parallel for schedule(static)
    for (size_t cell = 0; cell < s->cells; cell++) {
        uint64_t carry = 0;
        for (size_t w = cell * s->words; w < (cell + 1) * s->words; w++) {
            const uint64_t all = s->water[w] | s->solid[w];
            s->water[w] = run_up(all, s->solid[w] | (carry & all));
            carry = s->water[w] >> 63;
        }
    }
}
