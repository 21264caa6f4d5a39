/* Divides the space into vertical columns. Vertical rays through the solids cut each column into runs that are free
   of solids. Horizontal rays along rows of cells find thin walls between two columns. */
#include "geometry/filling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

#include <stdlib.h>

enum { CHUNK = 512 };

/* In spacings: crossings nearer than same_crossing count as one; runs shorter than run_min are dropped. */
static const double same_crossing = 1e-7, run_min = 1e-4;

typedef struct chunk {
    double *hit;
    size_t hit_count, hit_capacity;
    sb_run *run;
    size_t *of_column; /* number of runs of each column */
    size_t run_count, run_capacity;
    int failed;
} chunk;

double sb_columns_surface(const sb_columns *c, double x)
{
    const sb_initial_wave *wave = &c->scene->wave;
    if (!c->waves || wave->kind == SB_INITIAL_NONE) return c->level;
    return c->level + sb_initial_elevation(wave, c->scene->fluid.gravity, x - wave->position);
}

static bool any_contains(const sb_columns *c, sb_vec3 at)
{
    for (size_t i = 0; i < c->solid_count; ++i)
        if (sb_solid_contains(c->solids[i].solid, at)) return true;
    return false;
}

bool sb_columns_clear(const sb_columns *c, sb_vec3 from, sb_vec3 to)
{
    sb_vec3 arm = sb_sub(to, from);
    double length = sb_norm(arm);
    for (size_t i = 0; i < c->solid_count && length > 0; ++i)
        if (sb_solid_raycast(c->solids[i].solid, from, sb_scale(arm, 1 / length), length) > 0) return false;
    return true;
}

/* Finds the sorted distances along a ray to all surfaces. Fails without memory, or when the process is to stop. */
static void find_crossings(const sb_columns *c, sb_vec3 from, sb_vec3 direction, double length, chunk *work)
{
    work->hit_count = 0;
    work->failed = sb_stop_signal();
    for (size_t i = 0; i < c->solid_count; ++i) {
        double at = 0;
        for (;;) {
            double t = sb_solid_raycast(c->solids[i].solid, sb_madd(from, at, direction), direction, length - at);
            if (!(t > 0)) break;
            if (sb_stop_signal() ||
                sb_grow((void **)&work->hit, &work->hit_capacity, work->hit_count + 1, sizeof *work->hit)) {
                work->failed = 1;
                return;
            }
            work->hit[work->hit_count++] = at + t;
            at += t + same_crossing * c->spacing;
        }
    }
    for (size_t i = 1; i < work->hit_count; ++i) {
        double value = work->hit[i];
        size_t k = i;
        for (; k > 0 && work->hit[k - 1] > value; --k) work->hit[k] = work->hit[k - 1];
        work->hit[k] = value;
    }
}

/* Returns the run between two heights. Its layers are those below the water level whose centres lie in it. */
static sb_run make_run(const sb_columns *c, double low, double high, bool surface)
{
    double cap = high < c->level ? high : c->level;
    double first = ceil((low - c->base) / c->spacing - 0.5 + 1e-9);
    double last = floor((cap - c->base) / c->spacing - 0.5 - 1e-9);
    first = first > 0 ? first : 0;
    last = last < c->layers - 1 ? last : c->layers - 1;
    return (sb_run){.low = low,
                    .high = high,
                    .first = (int32_t)first,
                    .count = last >= first ? (int32_t)(last - first) + 1 : 0,
                    .surface = surface};
}

/* Cuts one column into runs, from its bottom upwards. */
static void cut_column(const sb_columns *c, int64_t i, int64_t j, chunk *work)
{
    sb_vec3 from = sb_columns_center(c, i, j, 0);
    double top = sb_columns_surface(c, from.x);
    top = top < c->top ? top : c->top;
    from.z = c->bottom;
    find_crossings(c, from, sb_vec(0, 0, 1), fmax(top - c->bottom, 0), work);
    double low = c->bottom;
    for (size_t k = 0; k <= work->hit_count && !work->failed; ++k) {
        bool last = k == work->hit_count;
        double high = last ? top : c->bottom + work->hit[k];
        sb_vec3 middle = sb_vec(from.x, from.y, 0.5 * (low + high));
        if (high - low > run_min * c->spacing && !any_contains(c, middle)) {
            if (sb_grow((void **)&work->run, &work->run_capacity, work->run_count + 1, sizeof *work->run))
                work->failed = 1;
            else
                work->run[work->run_count++] = make_run(c, low, high, last);
        }
        low = high;
    }
}

static void cut_chunk(const sb_columns *c, size_t begin, size_t end, chunk *work)
{
    work->of_column = sb_stop_signal() ? NULL : sb_alloc(end - begin, sizeof *work->of_column);
    work->failed = !work->of_column;
    for (size_t at = begin; at < end && !work->failed; ++at) {
        size_t before = work->run_count;
        cut_column(c, (int64_t)at % c->nx, (int64_t)at / c->nx, work);
        work->of_column[at - begin] = work->run_count - before;
    }
}

/* Joins the chunks' runs in the order of the columns. */
static int join_chunks(sb_columns *c, const chunk *chunks, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        if (chunks[k].failed) return -1;
        c->run_count += chunks[k].run_count;
    }
    size_t columns = (size_t)(c->nx * c->ny);
    c->begin = sb_alloc_untouched(columns + 1, sizeof *c->begin);
    c->runs = sb_alloc_untouched(c->run_count, sizeof *c->runs);
    if (!c->begin || !c->runs) return -1;
    size_t at = 0, column = 0;
    for (size_t k = 0; k < count; ++k) {
        size_t next = 0;
        for (; column < columns && column < (k + 1) * CHUNK; ++column) {
            c->begin[column] = at;
            for (size_t n = 0; n < chunks[k].of_column[column - k * CHUNK]; ++n) {
                c->runs[at] = chunks[k].run[next++];
                c->runs[at].cell = c->cell_count;
                c->cell_count += (size_t)c->runs[at++].count;
            }
        }
    }
    c->begin[columns] = at;
    c->cells = sb_alloc(c->cell_count, sizeof *c->cells);
    return c->cells ? 0 : -1;
}

static int cut_columns(sb_columns *c)
{
    size_t columns = (size_t)(c->nx * c->ny), count = (columns + CHUNK - 1) / CHUNK;
    chunk *chunks = sb_alloc(count, sizeof *chunks);
    if (!chunks) return -1;
#pragma omp parallel for schedule(dynamic, 1)
    for (size_t k = 0; k < count; ++k) {
        size_t begin = k * CHUNK, end = begin + CHUNK < columns ? begin + CHUNK : columns;
        cut_chunk(c, begin, end, chunks + k);
        sb_free(chunks[k].hit);
        chunks[k].hit = NULL;
    }
    int failed = join_chunks(c, chunks, count);
    for (size_t k = 0; k < count; ++k) {
        sb_free(chunks[k].run);
        sb_free(chunks[k].of_column);
    }
    sb_free(chunks);
    return failed;
}

static void block(sb_columns *c, int64_t i, int64_t j, int64_t layer, uint8_t bit)
{
    size_t column = (size_t)(j * c->nx + i);
    for (size_t r = c->begin[column]; r < c->begin[column + 1]; ++r) {
        const sb_run *run = c->runs + r;
        if (layer >= run->first && layer < run->first + run->count)
            c->cells[run->cell + (size_t)(layer - run->first)] |= bit;
    }
}

/* Marks the crossings along one row of cell centres in x or y. A crossing blocks the step between the two centres
   beside it. */
static void block_row(sb_columns *c, bool along_x, int64_t across, int64_t layer, chunk *work)
{
    int64_t count = along_x ? c->nx : c->ny;
    double step = along_x ? c->dx : c->dy;
    sb_vec3 from = along_x ? sb_columns_center(c, 0, across, layer) : sb_columns_center(c, across, 0, layer);
    sb_vec3 direction = along_x ? sb_vec(1, 0, 0) : sb_vec(0, 1, 0);
    from = sb_madd(from, -0.5 * step, direction);
    find_crossings(c, from, direction, step * (double)count, work);
    for (size_t k = 0; k < work->hit_count && !work->failed; ++k) {
        /* -1 and count - 1: beyond the end of the row, or the step across a periodic side. */
        int64_t at = (int64_t)floor(work->hit[k] / step - 0.5);
        at = at < 0 ? count - 1 : at;
        if (along_x)
            block(c, at, across, layer, SB_CELL_BLOCK_X);
        else
            block(c, across, at, layer, SB_CELL_BLOCK_Y);
    }
}

static int block_rows(sb_columns *c)
{
    int failed = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(|| : failed)
    for (int32_t layer = 0; layer < c->layers; ++layer) {
        chunk work = {0};
        for (int64_t j = 0; j < c->ny && !work.failed; ++j) block_row(c, true, j, layer, &work);
        for (int64_t i = 0; i < c->nx && c->ny > 1 && !work.failed; ++i) block_row(c, false, i, layer, &work);
        failed = failed || work.failed;
        sb_free(work.hit);
    }
    return failed;
}

/* Returns the number of columns across an extent. *step is the width of a column, as near to the spacing as a whole
   number of columns allows. */
static int64_t fit(double extent, double spacing, double *step)
{
    double count = fmax(round(extent / spacing), 1);
    *step = fabs(extent - count * spacing) < 1e-9 * extent ? spacing : extent / count;
    return (int64_t)count;
}

static sb_columns lay_out(const sb_scene *scene, const sb_fluid_box *box)
{
    const sb_domain *domain = &scene->domain;
    sb_vec3 min = domain->min, max = domain->max;
    sb_columns c = {.scene = scene, .spacing = scene->resolution, .level = scene->sea.level};
    if (box) {
        min = sb_max(min, box->min);
        max = sb_min(max, box->max);
        c.level = fmin(box->level, max.z);
        c.velocity = box->velocity;
    }
    c.waves = !box || !scene->sea.present;
    c.sea = !box;
    c.x = min.x;
    c.y = scene->dimensions == 2 ? 0 : min.y;
    c.bottom = min.z;
    c.top = domain->max.z;
    c.level = fmin(c.level, c.top);
    if (!(max.x > min.x && c.level > min.z) || (scene->dimensions == 3 && !(max.y > min.y))) return c;
    c.nx = fit(max.x - min.x, c.spacing, &c.dx);
    c.ny = 1;
    c.dy = c.spacing;
    if (scene->dimensions == 3) c.ny = fit(max.y - min.y, c.spacing, &c.dy);
    c.layers = (int32_t)ceil((c.level - c.bottom) / c.spacing - 1e-9);
    c.base = c.level - c.layers * c.spacing;
    return c;
}

sb_status sb_columns_build(const sb_scene *scene, const sb_fill_solid *solids, size_t solid_count,
                           const sb_fluid_box *box, sb_columns *columns, sb_error *error)
{
    sb_columns made = lay_out(scene, box);
    made.solids = solids;
    made.solid_count = solid_count;
    if (cut_columns(&made) || block_rows(&made)) {
        sb_columns_free(&made);
        return sb_fail_memory(error, "columns of water");
    }
    *columns = made;
    return SB_OK;
}

void sb_columns_free(sb_columns *columns)
{
    sb_free(columns->begin);
    sb_free(columns->runs);
    sb_free(columns->cells);
    *columns = (sb_columns){0};
}

bool sb_columns_hold(const sb_columns *c, sb_vec3 at)
{
    if (c->nx == 0) return false;
    double i = floor((at.x - c->x) / c->dx), j = 0;
    if (c->scene->dimensions == 3) j = floor((at.y - c->y) / c->dy);
    if (!(i >= 0 && j >= 0 && i < (double)c->nx && j < (double)c->ny)) return false;
    size_t column = (size_t)j * (size_t)c->nx + (size_t)i;
    for (size_t r = c->begin[column]; r < c->begin[column + 1]; ++r)
        if (c->runs[r].wet && at.z > c->runs[r].low && at.z < c->runs[r].high) return true;
    return false;
}
