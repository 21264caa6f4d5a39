/* Places the particles of wet runs. Each run is divided evenly from its floor to its surface, into the number of
   layers that its volume holds on average. */
#include "geometry/filling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

/* In spacings: no particle starts nearer than `clearance` to a surface; water thinner than `film` gets no particle. */
static const double clearance = 0.3, film = 0.25;

/* Returns the fraction of a layer from which the number of layers of a column is rounded up. The thresholds are
   evenly distributed over the columns and not periodic in them (Roberts's sequence, the golden ratio in 2D), so that
   in any region the rounding up compensates the rounding down. Whole numbers stay whole within a hundredth. */
static double threshold(const sb_columns *c, int64_t i, int64_t j)
{
    double at =
        c->ny > 1 ? 0.7548776662466927 * (double)i + 0.5698402909980532 * (double)j : 0.6180339887498949 * (double)i;
    return 0.01 + 0.98 * (at + 0.5 - floor(at + 0.5));
}

static const int steps[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

/* Returns the wet run of a neighbouring column that overlaps most with this run's height, or NULL. *outside: there
   is no such column. */
static const sb_run *neighbour(const sb_columns *c, int64_t i, int64_t j, const sb_run *run, bool *outside)
{
    *outside = i < 0 || j < 0 || i >= c->nx || j >= c->ny;
    if (*outside) return NULL;
    size_t column = (size_t)(j * c->nx + i);
    const sb_run *found = NULL;
    double best = 0;
    for (size_t r = c->begin[column]; r < c->begin[column + 1]; ++r) {
        const sb_run *other = c->runs + r;
        double shared = fmin(other->high, run->high) - fmax(other->low, run->low);
        if (!other->wet || shared <= best) continue;
        best = shared;
        found = other;
    }
    return found;
}

/* Whether the depth changes gently from column to column. The rounding errors then cancel without a threshold, and
   the particles are more regular. On a level or steep floor the threshold is needed. */
static bool evens_out(const sb_columns *c, int64_t i, int64_t j, const sb_run *run)
{
    double most = 0, height = run->high - run->low;
    for (int s = 0; s < (c->ny > 1 ? 4 : 2); ++s) {
        bool outside;
        const sb_run *other = neighbour(c, i + steps[s][0], j + steps[s][1], run, &outside);
        if (other) most = fmax(most, fabs(other->high - other->low - height));
    }
    return most > 0.04 * c->spacing && most < 0.26 * c->spacing;
}

/* *extent: of a run that is wet. */
static size_t layers_of(const sb_columns *c, int64_t i, int64_t j, const sb_run *run, sb_run_extent *extent)
{
    double height = run->high - run->low, s = c->spacing;
    if (!run->wet || height < film * s) return 0;
    double particles = c->scene->dimensions == 2 ? height * c->dx / (s * s) : height * c->dx * c->dy / (s * s * s);
    *extent = sb_columns_extent(c, i, j, run);
    const bool even = extent->part == 1 && evens_out(c, i, j, run);
    return (size_t)floor(particles * extent->part + (even ? 0.5 : threshold(c, i, j)));
}

/* Finds the part of a run that has open water on all four sides, where particles need no check of their distance to
   surfaces. */
static void open_part(const sb_columns *c, int64_t i, int64_t j, const sb_run *run, double *low, double *high)
{
    *low = run->low;
    *high = run->surface ? (double)INFINITY : run->high;
    for (int32_t k = 0; k < run->count; ++k)
        if (c->cells[run->cell + (size_t)k]) *high = -(double)INFINITY;
    for (int s = 0; s < (c->ny > 1 ? 4 : 2); ++s) {
        bool outside;
        const sb_run *other = neighbour(c, i + steps[s][0], j + steps[s][1], run, &outside);
        if (outside) continue;
        *low = other ? fmax(*low, other->low) : *low;
        *high = !other ? -(double)INFINITY : other->surface ? *high : fmin(*high, other->high);
    }
}

/* Moves a particle away from surfaces that are nearer than `clearance`. */
static sb_vec3 keep_clear(const sb_columns *c, sb_vec3 at)
{
    double least = clearance * c->spacing;
    for (int round = 0; round < 3; ++round) {
        sb_vec3 nearest, normal, push = {0};
        double best = least;
        for (size_t i = 0; i < c->solid_count; ++i) {
            double distance = sb_solid_distance(c->solids[i].solid, at, best, &nearest, &normal);
            if (distance >= best || !(distance > 0)) continue;
            best = distance;
            push = sb_scale(sb_sub(at, nearest), (least * (1 + 1e-6) - distance) / distance);
        }
        if (!(best < least)) break;
        sb_vec3 moved = sb_add(at, push);
        if (c->scene->dimensions == 2) moved.y = 0;
        if (!sb_columns_clear(c, at, moved)) break;
        at = moved;
    }
    return at;
}

static sb_vec3 velocity_at(const sb_columns *c, sb_vec3 at)
{
    const sb_initial_wave *wave = &c->scene->wave;
    double u, w;
    if (!c->waves || wave->kind == SB_INITIAL_NONE || wave->kind == SB_INITIAL_STANDING) return c->velocity;
    sb_initial_velocity(wave, c->scene->fluid.gravity, at.x - wave->position, at.z - (c->level - wave->depth), &u, &w);
    return sb_add(c->velocity, sb_vec(u, 0, w));
}

/* Places the particles of a run that belong to the fluid's part. at: index of the first one. */
static void fill_run(const sb_columns *c, int64_t i, int64_t j, const sb_run *run, size_t layers, sb_vec3 shift,
                     size_t at, sb_fluid *fluid)
{
    double step = (run->high - run->low) / (double)layers, low, high;
    double margin = clearance * c->spacing;
    double weight = c->scene->fluid.density * c->scene->fluid.gravity;
    open_part(c, i, j, run, &low, &high);
    for (size_t k = 0; k < layers; ++k, ++at) {
        if (at < fluid->from || at - fluid->from >= fluid->here) continue;
        sb_vec3 p = sb_add(sb_columns_center(c, i, j, 0), shift);
        p.z = run->low + ((double)k + 0.5) * step;
        if (!(p.z - margin > low && p.z + margin < high)) p = keep_clear(c, p);
        const size_t to = at - fluid->from;
        fluid->position[to] = p;
        fluid->velocity[to] = velocity_at(c, p);
        fluid->pressure[to] = fmax(weight * (sb_columns_surface(c, p.x) - p.z), 0);
    }
}

static int allocate(sb_fluid *fluid)
{
    fluid->position = sb_alloc_untouched(fluid->here, sizeof *fluid->position);
    fluid->velocity = sb_alloc_untouched(fluid->here, sizeof *fluid->velocity);
    fluid->pressure = sb_alloc_untouched(fluid->here, sizeof *fluid->pressure);
    return fluid->position && fluid->velocity && fluid->pressure ? 0 : -1;
}

/* Places the particles of the fluid's part. */
static sb_status place(const sb_columns *c, const size_t *first, sb_fluid *fluid, sb_error *error)
{
    const size_t columns = (size_t)(c->nx * c->ny), end = fluid->from + fluid->here;
#pragma omp parallel for schedule(dynamic, 256)
    for (size_t column = 0; column < columns; ++column) {
        int64_t i = (int64_t)column % c->nx, j = (int64_t)column / c->nx;
        size_t at = first[column];
        if (at >= end || first[column + 1] <= fluid->from) continue;
        for (size_t r = c->begin[column]; r < c->begin[column + 1] && !sb_stop_signal(); ++r) {
            sb_run_extent extent;
            size_t layers = layers_of(c, i, j, c->runs + r, &extent);
            if (layers > 0) fill_run(c, i, j, c->runs + r, layers, extent.shift, at, fluid);
            at += layers;
        }
    }
    return sb_stop_signal() ? sb_stop_fail(error, "while the water was placed") : SB_OK;
}

sb_status sb_columns_count(const sb_columns *c, size_t **first, double *still_depth, sb_error *error)
{
    size_t columns = (size_t)(c->nx * c->ny), count = 0;
    size_t *made = sb_alloc_untouched(columns + 1, sizeof *made);
    if (!made) return sb_fail_memory(error, "water");
    for (size_t column = 0; column < columns && !sb_stop_signal(); ++column) {
        made[column] = count;
        for (size_t r = c->begin[column]; r < c->begin[column + 1]; ++r) {
            const sb_run *run = c->runs + r;
            sb_run_extent extent;
            count += layers_of(c, (int64_t)column % c->nx, (int64_t)column / c->nx, run, &extent);
            if (run->wet) *still_depth = fmax(*still_depth, c->level - run->low);
        }
    }
    made[columns] = count;
    if (sb_stop_signal()) {
        sb_free(made);
        return sb_stop_fail(error, "while the water was placed");
    }
    *first = made;
    return SB_OK;
}

sb_status sb_columns_place(const sb_columns *c, const size_t *first, size_t from, size_t here, sb_fluid *fluid,
                           sb_error *error)
{
    sb_fluid made = {.count = first[c->nx * c->ny], .from = from, .here = here};
    const sb_status status = allocate(&made) ? sb_fail_memory(error, "water") : place(c, first, &made, error);
    if (status != SB_OK) {
        sb_fluid_free(&made);
        return status;
    }
    *fluid = made;
    return SB_OK;
}

sb_status sb_columns_particles(const sb_columns *c, sb_fluid *fluid, sb_error *error)
{
    size_t *first = NULL;
    double still_depth = 0;
    sb_status status = sb_columns_count(c, &first, &still_depth, error);
    if (status == SB_OK) status = sb_columns_place(c, first, 0, first[c->nx * c->ny], fluid, error);
    sb_free(first);
    if (status == SB_OK) fluid->still_depth = still_depth;
    return status;
}
