/* Flood fill of the sea from its seed, run by run. It spreads to a run of a neighbouring column where some layer is
   free in both runs and no thin wall lies between them. */
#include "geometry/filling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

#include <string.h>

typedef struct front {
    size_t *column, *run; /* columns and runs from which to continue */
    size_t count, column_capacity, run_capacity;
} front;

static int front_push(front *f, size_t column, size_t run)
{
    if (sb_grow((void **)&f->column, &f->column_capacity, f->count + 1, sizeof *f->column) ||
        sb_grow((void **)&f->run, &f->run_capacity, f->count + 1, sizeof *f->run))
        return -1;
    f->column[f->count] = column;
    f->run[f->count++] = run;
    return 0;
}

bool sb_columns_joined(const sb_columns *c, const sb_run *a, const sb_run *b, uint8_t bit)
{
    int32_t low = a->first > b->first ? a->first : b->first;
    int32_t high_a = a->first + a->count, high_b = b->first + b->count;
    int32_t high = high_a < high_b ? high_a : high_b;
    for (int32_t layer = low; layer < high; ++layer)
        if (!(c->cells[a->cell + (size_t)(layer - a->first)] & bit)) return true;
    return false;
}

/* Marks the runs of one neighbouring column that are connected with run `from` as wet. ahead: the neighbour lies
   towards +x or +y. */
static int spread(sb_columns *c, front *f, size_t from, size_t to_column, bool ahead, uint8_t bit)
{
    for (size_t r = c->begin[to_column]; r < c->begin[to_column + 1]; ++r) {
        sb_run *to = c->runs + r;
        const sb_run *a = c->runs + from;
        if (to->wet || !(ahead ? sb_columns_joined(c, a, to, bit) : sb_columns_joined(c, to, a, bit))) continue;
        to->wet = true;
        if (front_push(f, to_column, r)) return -1;
    }
    return 0;
}

static const char *path_of(const sb_columns *c)
{
    return c->scene->path ? c->scene->path : "the scene";
}

static sb_status escapes(const sb_columns *c, sb_vec3 at, int side, sb_error *error)
{
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.300s: domain.sides.%s: the sea escapes through the open side %s at (%g, %g, %g): expected a wall or a "
        "solid that holds it below water.level",
        path_of(c), sb_side_names[side], sb_side_names[side], at.x, at.y, at.z);
}

/* Requires a solid between each layer of a wet run and the open side beside it. */
static sb_status check_side(const sb_columns *c, const sb_run *run, int64_t i, int64_t j, int side, sb_error *error)
{
    static const sb_vec3 out[4] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    double half = 0.5 * (side < SB_Y_MIN ? c->dx : c->dy);
    for (int32_t layer = run->first; layer < run->first + run->count; ++layer) {
        sb_vec3 at = sb_columns_center(c, i, j, layer), end = sb_madd(at, half, out[side]);
        if (sb_columns_clear(c, at, end)) return escapes(c, end, side, error);
    }
    return SB_OK;
}

/* Continues from one run to the four neighbouring columns. */
static sb_status visit(sb_columns *c, front *f, size_t column, size_t run, sb_error *error)
{
    const sb_side_kind *side = c->scene->domain.side;
    int64_t i = (int64_t)column % c->nx, j = (int64_t)column / c->nx;
    const sb_run *from = c->runs + run;
    if (side[SB_Z_MIN] == SB_SIDE_OPEN && from->low <= c->bottom) {
        sb_vec3 at = sb_columns_center(c, i, j, 0);
        return escapes(c, sb_vec(at.x, at.y, c->bottom), SB_Z_MIN, error);
    }
    const int sides = c->scene->dimensions == 2 ? 2 : 4;
    for (int s = 0; s < sides; ++s) {
        bool ahead = s % 2, along_x = s < 2;
        int64_t count = along_x ? c->nx : c->ny;
        int64_t to = (along_x ? i : j) + (ahead ? 1 : -1);
        if (to < 0 || to >= count) {
            sb_status status = side[s] == SB_SIDE_OPEN ? check_side(c, from, i, j, s, error) : SB_OK;
            if (status != SB_OK) return status;
            if (side[s] != SB_SIDE_PERIODIC) continue;
            to = (to + count) % count;
        }
        size_t next = (size_t)(along_x ? j * c->nx + to : to * c->nx + i);
        if (spread(c, f, run, next, ahead, along_x ? SB_CELL_BLOCK_X : SB_CELL_BLOCK_Y))
            return sb_fail_memory(error, "the flood fill of the sea");
    }
    return SB_OK;
}

static sb_status check_seed(const sb_columns *c, sb_vec3 seed, sb_error *error)
{
    for (size_t i = 0; i < c->solid_count; ++i)
        if (sb_solid_contains(c->solids[i].solid, seed))
            return sb_fail(error, SB_BAD_INPUT,
                           "%.300s: water.seed: (%g, %g, %g) is inside the body \"%s\": expected a point in "
                           "the water",
                           path_of(c), seed.x, seed.y, seed.z, c->solids[i].name);
    return SB_OK;
}

/* Finds the cell nearest to the seed, in its own and the surrounding columns, that no surface separates from it.
   Returns false if there is none. */
static bool find_start(const sb_columns *c, sb_vec3 seed, size_t *start_column, size_t *start_run)
{
    int64_t si = (int64_t)floor((seed.x - c->x) / c->dx);
    int64_t sj = c->scene->dimensions == 2 ? 0 : (int64_t)floor((seed.y - c->y) / c->dy);
    double best = HUGE_VAL;
    for (int64_t j = sj - 1; j <= sj + 1; ++j)
        for (int64_t i = si - 1; i <= si + 1; ++i) {
            if (i < 0 || j < 0 || i >= c->nx || j >= c->ny) continue;
            size_t column = (size_t)(j * c->nx + i);
            for (size_t r = c->begin[column]; r < c->begin[column + 1]; ++r)
                for (int32_t k = 0; k < c->runs[r].count; ++k) {
                    sb_vec3 at = sb_columns_center(c, i, j, c->runs[r].first + k);
                    double distance = sb_norm(sb_sub(at, seed));
                    if (distance >= best || distance > 2 * c->spacing || !sb_columns_clear(c, seed, at)) continue;
                    best = distance;
                    *start_column = column;
                    *start_run = r;
                }
        }
    return best < (double)HUGE_VAL;
}

sb_status sb_columns_flood(sb_columns *c, sb_error *error)
{
    sb_vec3 seed = c->scene->sea.seed;
    if (c->scene->dimensions == 2) seed.y = 0;
    sb_status status = check_seed(c, seed, error);
    if (status != SB_OK) return status;
    size_t column = 0, run = 0;
    if (c->nx == 0 || !find_start(c, seed, &column, &run))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.300s: water.seed: (%g, %g, %g) has no room for a particle around it: expected a "
                       "point in open water, or a finer resolution",
                       path_of(c), seed.x, seed.y, seed.z);
    front f = {0};
    c->runs[run].wet = true;
    if (front_push(&f, column, run)) status = sb_fail_memory(error, "the flood fill of the sea");
    while (f.count > 0 && status == SB_OK && !sb_stop_signal()) {
        --f.count;
        status = visit(c, &f, f.column[f.count], f.run[f.count], error);
    }
    if (f.count > 0 && status == SB_OK) status = sb_stop_fail(error, "while the sea was filled");
    sb_free(f.column);
    sb_free(f.run);
    return status;
}
