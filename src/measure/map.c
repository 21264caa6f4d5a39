/* Maps of greatest depth, speed and momentum flux, and of arrival times. Each particle is a square of
   one spacing in plan, distributed over the cells that it covers. Volume is therefore conserved exactly, and cells may
   be smaller than the spacing.

   All maps are of standing water (standing.h): a reading first finds the heights at which there is water in each cell,
   and then adds up the particles that are connected with the ground or a floor. A particle is at a height in all cells
   within a spacing of it in plan: in disordered water a narrower column of particles has gaps.

   Standing water counts where there is at least half a layer of it within the support radius, as for run-up (runup.c):
   less is drops, or a film that is not resolved. */
#include "base/memory.h"
#include "measure/parts.h"
#include "measure/standing.h"

#include <omp.h>
#include <string.h>

/* Sums over a cell's particles at one instant: volume, and volume times the horizontal velocity and its square. */
typedef struct cell_sum {
    float volume, x, y, square;
} cell_sum;

struct sb_map_field {
    sb_map_record result;
    float *depth, *speed, *flux, *arrival, *start;
    cell_sum *sums;
    sb_standing standing;
    int64_t *near;  /* scratch: of the windows around the cells; after find_flow above 0 where there is a flow */
    float *bare;    /* m, result.ground; NULL: not recorded */
    double support; /* m, h */
    double *widths; /* window_width of each column */
    double spacing, threshold, pause, next;
    double low[2], high[2]; /* m, of the domain along x and y */
    double length[2];       /* m, period of the domain; 0: not periodic */
    bool flat;
};

static size_t cells_between(double min, double max, double cell)
{
    double n = ceil((max - min) / cell - 1e-9);
    return n > 1 ? (size_t)n : 1;
}

void sb_map_destroy(sb_map_field *map)
{
    if (!map) return;
    sb_free(map->depth);
    sb_free(map->speed);
    sb_free(map->flux);
    sb_free(map->arrival);
    sb_free(map->start);
    sb_free(map->sums);
    sb_standing_free(&map->standing);
    sb_free(map->near);
    sb_free(map->widths);
    sb_free(map->bare);
    sb_free(map);
}

/* Cells [from, to) along x and y that one thread sums. Each thread adds the particles in their order, so a cell's sums
   have the same bits for any number of threads. */
typedef struct window {
    double from[2], to[2];
} window;

/* Divides the rows among the threads; in 2D, the columns. */
static window window_of(const sb_map_field *map, int thread, int threads)
{
    const int axis = map->flat ? 0 : 1;
    window w = {.to = {(double)map->result.columns, (double)map->result.rows}};
    const double cells = w.to[axis];
    w.from[axis] = floor(cells * thread / threads);
    w.to[axis] = floor(cells * (thread + 1) / threads);
    return w;
}

static inline double least(double a, double b)
{
    return a < b ? a : b;
}

static inline double most(double a, double b)
{
    return a > b ? a : b;
}

/* What a reading does with a particle in the cells of a window. */
typedef void act(sb_map_field *map, const window *w, const sb_fluid_sample *sample);

/* Half the width in plan over which a particle counts as water at its height, in spacings. */
static const double NEAR = 1;

/* Calls `does` with the height of a particle for each cell of the window near it. */
static inline void visit_near(sb_map_field *map, const window *w, const sb_fluid_sample *sample,
                              void (*does)(sb_map_field *map, size_t cell, double z))
{
    const sb_map_record *grid = &map->result;
    const double near = NEAR * map->spacing, cell = grid->cell;
    const double x0 = (sample->position.x - near - grid->x_min) / cell, x1 = x0 + 2 * near / cell;
    const double y0 = map->flat ? 0 : (sample->position.y - near - grid->y_min) / cell;
    const double y1 = map->flat ? 1 : y0 + 2 * near / cell;
    if (!(x1 > w->from[0] && x0 < w->to[0] && y1 > w->from[1] && y0 < w->to[1])) return;
    const double first = x0 > w->from[0] ? (double)(int64_t)x0 : w->from[0], end = least(x1, w->to[0]);
    for (double j = y0 > w->from[1] ? (double)(int64_t)y0 : w->from[1]; j < y1 && j < w->to[1]; j++)
        for (double i = first; i < end; i++) does(map, (size_t)j * grid->columns + (size_t)i, sample->position.z);
}

static void add_height(sb_map_field *map, size_t cell, double z)
{
    sb_standing_add(&map->standing, cell, z);
}

/* Adds the height of one particle to the cells of the window near it. */
static void mark(sb_map_field *map, const window *w, const sb_fluid_sample *sample)
{
    visit_near(map, w, sample, add_height);
}

static void wet_ground(sb_map_field *map, size_t cell, double z)
{
    if (z >= (double)map->standing.ground[cell] && sb_standing_has(&map->standing, cell, z)) map->bare[cell] = NAN;
}

/* Removes the cells near a particle that stands above their ground from those that are bare. */
static void soak(sb_map_field *map, const window *w, const sb_fluid_sample *sample)
{
    visit_near(map, w, sample, wet_ground);
}

/* Adds one particle to the cells of the window that its square covers and in which it stands. */
static void deposit(sb_map_field *map, const window *w, const sb_fluid_sample *sample)
{
    const sb_map_record *grid = &map->result;
    double s = map->spacing, cell = grid->cell;
    double x0 = (sample->position.x - s / 2 - grid->x_min) / cell, x1 = x0 + s / cell;
    double y0 = (sample->position.y - s / 2 - grid->y_min) / cell, y1 = y0 + s / cell;
    if (map->flat) {
        y0 = 0;
        y1 = 1;
    }
    if (!(x1 > w->from[0] && x0 < w->to[0] && y1 > w->from[1] && y0 < w->to[1])) return;
    double area = (x1 - x0) * (y1 - y0), u = sample->velocity.x, v = sample->velocity.y;
    double volume = map->flat ? s * s : s * s * s;
    const double first = x0 > w->from[0] ? (double)(int64_t)x0 : w->from[0], end = least(x1, w->to[0]);
    for (double j = y0 > w->from[1] ? (double)(int64_t)y0 : w->from[1]; j < y1 && j < w->to[1]; j++)
        for (double i = first; i < end; i++) {
            double fraction = (least(x1, i + 1) - most(x0, i)) * (least(y1, j + 1) - most(y0, j)) / area;
            float part = (float)(fraction * volume);
            const size_t at = (size_t)j * grid->columns + (size_t)i;
            if (!sb_standing_has(&map->standing, at, sample->position.z)) continue;
            cell_sum *sum = &map->sums[at];
            sum->volume += part;
            sum->x += part * (float)u;
            sum->y += part * (float)v;
            sum->square += part * (float)(u * u + v * v);
        }
}

/* Distance from a particle to its periodic image if the image is less than `half` outside of the domain; otherwise 0.
 */
static double image_offset(const sb_map_field *map, int axis, double at, double half)
{
    double length = map->length[axis];
    if (!(length > 0)) return 0;
    return at - half < map->low[axis] ? length : at + half > map->low[axis] + length ? -length : 0;
}

/* Acts on one particle and on those of its periodic images that reach into the domain by `half`. */
static void act_on_all(sb_map_field *map, const window *w, sb_fluid_sample sample, act *does, double half)
{
    double dx = image_offset(map, 0, sample.position.x, half);
    double dy = image_offset(map, 1, sample.position.y, half);
    does(map, w, &sample);
    sample.position.x += dx;
    if (dx != 0) does(map, w, &sample);
    sample.position.y += dy;
    if (dy != 0) does(map, w, &sample);
    sample.position.x -= dx;
    if (dx != 0 && dy != 0) does(map, w, &sample);
}

static void act_on_own(sb_map_field *map, const sb_sim *sim, act *does, double half)
{
    const size_t count = sb_sim_owned(sim);
#pragma omp parallel
    {
        const window w = window_of(map, omp_get_thread_num(), omp_get_num_threads());
        for (size_t i = 0; i < count; i++) act_on_all(map, &w, sb_sim_particle(sim, i), does, half);
    }
}

/* Finds the heights of standing water. After the turns of all ranks each has those of all. */
static void find_standing(sb_map_field *map, const sb_sim *sim)
{
    sb_standing *standing = &map->standing;
    const size_t size = standing->cells * standing->words * sizeof *standing->water;
    sb_ranks *ranks = sb_sim_ranks(sim);
    sb_standing_clear(standing);
    sb_ranks_take_turn(ranks, standing->water, size);
    act_on_own(map, sim, mark, NEAR * map->spacing);
    sb_ranks_end_turn(ranks, standing->water, size);
    sb_standing_connect(standing);
}

/* The ground where nothing stands on it now: neither another body nor water. */
static void find_bare(sb_map_field *map, const sb_sim *sim)
{
    const size_t size = map->standing.cells * sizeof *map->bare;
    sb_ranks *ranks = sb_sim_ranks(sim);
    if (!map->bare) return;
    memcpy(map->bare, map->standing.ground, size);
    sb_ranks_take_turn(ranks, map->bare, size);
    act_on_own(map, sim, soak, NEAR * map->spacing);
    sb_ranks_end_turn(ranks, map->bare, size);
}

/* Volumes are added up as whole numbers, which have no rounding errors: this many per particle. */
static const double UNITS = 65536;

/* Replaces the numbers first[k * step], k < count, by their sums over [k - reach, k + reach]. line: count numbers. */
static void add_around(int64_t *first, size_t step, size_t count, size_t reach, int64_t *line)
{
    int64_t sum = 0;
    for (size_t k = 0; k < count; k++) line[k] = first[k * step];
    for (size_t k = 0; k < count && k < reach; k++) sum += line[k];
    for (size_t k = 0; k < count; k++) {
        if (k + reach < count) sum += line[k + reach];
        first[k * step] = sum;
        if (k >= reach) sum -= line[k - reach];
    }
}

/* The number of cells on each side of one that belong to its window: a support radius, at least one cell. */
static size_t reach_of(const sb_map_field *map)
{
    return (size_t)most(1, least(floor(map->support / map->result.cell + 0.5), 1e6));
}

/* Replaces the numbers of all cells by their sums over the windows. */
static void add_windows(sb_map_field *map)
{
    const size_t columns = map->result.columns, rows = map->result.rows, reach = reach_of(map);
    int64_t *line = map->near + columns * rows;
    for (size_t j = 0; j < rows; j++) add_around(map->near + j * columns, 1, columns, reach, line);
    for (size_t i = 0; i < columns && !map->flat; i++) add_around(map->near + i, columns, rows, reach, line);
}

/* The width (spacings) along an axis of the window around cell i of `count` that lies in the domain and the map. Of
   cells that are not wider than the support radius, at most twice that radius. */
static double window_width(const sb_map_field *map, int axis, double start, size_t i, size_t count)
{
    const size_t reach = reach_of(map), first = i > reach ? i - reach : 0;
    const size_t end = i + reach + 1 < count ? i + reach + 1 : count;
    const double from = most(start + (double)first * map->result.cell, map->low[axis]);
    const double to = least(start + (double)end * map->result.cell, map->high[axis]);
    return most(least(to - from, map->result.cell > map->support ? HUGE_VAL : 2 * map->support), 0) / map->spacing;
}

/* Finds the cells with a flow: there is half a layer of standing water in a window within a support radius, as for the
   particles from which a run-up continues. */
static void find_flow(sb_map_field *map)
{
    const sb_map_record *grid = &map->result;
    const double s = map->spacing, particle = map->flat ? s * s : s * s * s;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < grid->columns * grid->rows; i++)
        map->near[i] = (int64_t)floor((double)map->sums[i].volume / particle * UNITS + 0.5);
    add_windows(map);
#pragma omp parallel for schedule(static)
    for (size_t row = 0; row < grid->rows; row++) {
        const double across = map->flat ? 1 : window_width(map, 1, grid->y_min, row, grid->rows);
        for (size_t column = 0; column < grid->columns; column++) {
            int64_t *near = &map->near[row * grid->columns + column];
            *near = *near > 0 && (double)*near >= 0.5 * (across * map->widths[column]) * UNITS;
        }
    }
    add_windows(map);
}

/* Each rank adds its particles to the sums of the ranks before it, so that the order of all terms is that of one rank.
   The last rank has the sums of all. */
static void gather(sb_map_field *map, const sb_sim *sim)
{
    const size_t size = map->result.columns * map->result.rows * sizeof *map->sums;
    sb_ranks *ranks = sb_sim_ranks(sim);
    find_standing(map, sim);
    memset(map->sums, 0, size);
    sb_ranks_take_turn(ranks, map->sums, size);
    act_on_own(map, sim, deposit, map->spacing / 2);
    sb_ranks_end_turn(ranks, map->sums, size);
    find_flow(map);
}

/* Width of the i-th cell from `start` that lies in the domain, m; the whole cell's width if none of it does. */
static double width_in_domain(const sb_map_field *map, int axis, double start, size_t i)
{
    const double cell = map->result.cell, from = start + (double)i * cell;
    const double width = least(from + cell, map->high[axis]) - most(from, map->low[axis]);
    return width > 1e-6 * cell ? width : cell;
}

/* Plan area of a cell within the domain, m^2 (m in 2D). Bodies are ignored. */
static float area_of(const sb_map_field *map, size_t i)
{
    const sb_map_record *grid = &map->result;
    const double x = width_in_domain(map, 0, grid->x_min, i % grid->columns);
    return (float)(map->flat ? x : x * width_in_domain(map, 1, grid->y_min, i / grid->columns));
}

static void raise(float *value, float to)
{
    if (!(*value >= to)) /* NaN counts as lower */
        *value = to;
}

/* The depth of the water in a cell, m. */
static float depth_of(const sb_map_field *map, size_t i)
{
    return map->near[i] > 0 ? map->sums[i].volume / area_of(map, i) : 0;
}

/* Speeds are recorded only where the water is at least half a spacing deep: a single drop is not a flow. */
static void record(sb_map_field *map, double time)
{
    size_t cells = map->result.columns * map->result.rows;
    const float least = (float)(0.5 * map->spacing);
    for (size_t i = 0; i < cells; i++) {
        const cell_sum *sum = &map->sums[i];
        const float area = area_of(map, i), depth = depth_of(map, i);
        if (depth > 0) raise(&map->depth[i], depth);
        if (depth >= least) {
            raise(&map->speed[i], hypotf(sum->x, sum->y) / sum->volume);
            raise(&map->flux[i], sum->square / area);
        }
        if (isnan(map->arrival[i]) && depth - map->start[i] >= (float)map->threshold) map->arrival[i] = (float)time;
    }
}

static sb_status allocate(sb_map_field *map, sb_error *error)
{
    size_t cells = map->result.columns * map->result.rows;
    float **arrays[] = {&map->depth, &map->speed, &map->flux, &map->arrival, &map->start};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) {
        *arrays[k] = sb_alloc_untouched(cells, sizeof(float));
        if (!*arrays[k]) return sb_fail_memory(error, "measure.map");
        for (size_t i = 0; i < cells; i++) (*arrays[k])[i] = NAN;
    }
    map->sums = sb_alloc(cells, sizeof *map->sums);
    const size_t longer = map->result.columns > map->result.rows ? map->result.columns : map->result.rows;
    map->near = sb_alloc(cells + longer, sizeof *map->near);
    map->widths = sb_alloc(map->result.columns, sizeof *map->widths);
    return map->sums && map->near && map->widths ? SB_OK : sb_fail_memory(error, "measure.map");
}

sb_status sb_map_create(const sb_measure_view *view, const sb_model *model, sb_map_field **map, sb_error *error)
{
    const sb_scene *scene = view->scene;
    const sb_map *request = &scene->measure.map;
    sb_map_field *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "measure.map");
    made->flat = scene->dimensions == 2;
    made->spacing = scene->resolution;
    made->support = scene->numerics.support * scene->resolution;
    made->threshold = request->threshold;
    made->result =
        (sb_map_record){.columns = cells_between(request->x_min, request->x_max, request->cell),
                        .rows = made->flat ? 1 : cells_between(request->y_min, request->y_max, request->cell),
                        .x_min = request->x_min,
                        .y_min = made->flat ? 0 : request->y_min,
                        .cell = request->cell};
    made->low[0] = view->min.x;
    made->low[1] = view->min.y;
    made->high[0] = view->max.x;
    made->high[1] = view->max.y;
    for (int axis = 0; axis < 2; axis++) made->length[axis] = sb_repeat_length(scene, view->min, view->max, axis);
    sb_status status = allocate(made, error);
    if (status == SB_OK) status = sb_standing_create(scene, model, &made->result, &made->standing, error);
    if (status == SB_OK && made->standing.ground) {
        made->bare = sb_alloc(made->standing.cells, sizeof *made->bare);
        if (!made->bare) status = sb_fail_memory(error, "measure.map");
    }
    if (status != SB_OK) {
        sb_map_destroy(made);
        return status;
    }
    made->result.depth = made->depth;
    made->result.speed = made->speed;
    made->result.flux = made->flux;
    made->result.arrival = made->arrival;
    made->result.ground = made->bare;
    /* No wave is faster than sqrt(2 g z) for the domain's height z. The pause is half the time that such a wave takes
       to cross a cell, so that no wave is missed between two readings. */
    double height = view->max.z - view->min.z;
    double fastest = sqrt(2 * scene->fluid.gravity * (height > 0 ? height : made->spacing));
    made->pause = fmax(0.5 * request->cell / fastest, 0);
    for (size_t column = 0; column < made->result.columns; column++)
        made->widths[column] = window_width(made, 0, made->result.x_min, column, made->result.columns);
    double time = sb_sim_report(view->sim)->time;
    gather(made, view->sim);
    for (size_t i = 0; i < made->result.columns * made->result.rows; i++) made->start[i] = depth_of(made, i);
    /* A cell that is wet at the start has the start as its arrival time. */
    for (size_t i = 0; i < made->result.columns * made->result.rows; i++)
        if (made->start[i] >= (float)made->threshold) made->arrival[i] = (float)time;
    find_bare(made, view->sim);
    record(made, time);
    made->next = time + made->pause;
    *map = made;
    return SB_OK;
}

void sb_map_step(sb_map_field *map, const sb_sim *sim)
{
    double time = sb_sim_report(sim)->time;
    if (time < map->next) return;
    gather(map, sim);
    record(map, time);
    map->next = time + map->pause;
}

const sb_map_record *sb_map_result(const sb_map_field *map)
{
    return &map->result;
}

size_t sb_map_bytes(const sb_map_field *map)
{
    return sizeof *map + sb_standing_bytes(&map->standing) + map->result.columns * sizeof *map->widths +
           map->result.columns * map->result.rows *
               ((map->bare ? 6 : 5) * sizeof(float) + sizeof(cell_sum) + sizeof *map->near);
}

void sb_map_save(const sb_map_field *map, sb_archive_out *out)
{
    const float *const arrays[] = {map->depth, map->speed, map->flux, map->arrival, map->start};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
        sb_put_list(out, arrays[k], map->result.columns * map->result.rows, sizeof *arrays[k]);
    if (map->bare) sb_put_list(out, map->bare, map->result.columns * map->result.rows, sizeof *map->bare);
    sb_put_real(out, map->next);
}

void sb_map_load(sb_map_field *map, sb_archive_in *in)
{
    float *const arrays[] = {map->depth, map->speed, map->flux, map->arrival, map->start};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
        sb_take_list(in, arrays[k], map->result.columns * map->result.rows, sizeof *arrays[k]);
    if (map->bare) sb_take_list(in, map->bare, map->result.columns * map->result.rows, sizeof *map->bare);
    map->next = sb_take_real(in);
}
