#include "offshore/start.h"

#include "base/memory.h"
#include "offshore/paddle.h"
#include "physics/waves/wave_theory.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

void sb_offshore_told_free(sb_offshore_told_list *told)
{
    if (!told) return;
    for (size_t i = 0; i < told->count; i++) sb_free(told->items[i].text);
    for (size_t i = 0; i < told->warning_count; i++) sb_free(told->warnings[i]);
    sb_free(told->items);
    sb_free(told->warnings);
    *told = (sb_offshore_told_list){0};
}

sb_status sb_offshore_warn(sb_offshore_told_list *told, sb_error *error, const char *format, ...)
{
    char text[1000];
    size_t capacity = told->warning_count;
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    if (sb_grow((void **)&told->warnings, &capacity, told->warning_count + 1, sizeof *told->warnings) ||
        !(told->warnings[told->warning_count] = sb_strdup(text)))
        return sb_fail_memory(error, "a warning");
    told->warning_count++;
    return SB_OK;
}

void sb_offshore_start_free(sb_offshore_start *start)
{
    if (!start) return;
    sb_free(start->bed);
    sb_free(start->depth);
    sb_free(start->hu);
    sb_offshore_told_free(&start->told);
    sb_free(start->projection);
    *start = (sb_offshore_start){0};
}

/* Whether the grid ends where the domain does. */
static bool ends_with_domain(const sb_scene *scene, int side)
{
    const sb_offshore_settings *o = &scene->offshore;
    const double at[] = {o->x_min, o->x_max, o->y_min, o->y_max};
    const double domain[] = {scene->domain.min.x, scene->domain.max.x, scene->domain.min.y, scene->domain.max.y};
    return fabs(at[side] - domain[side]) <= 1e-6 * o->cell;
}

static sb_offshore_side side_of(const sb_scene *scene, int side)
{
    switch (scene->offshore.side[side]) {
    case SB_GRID_SIDE_OPEN:
        return SB_OFFSHORE_OPEN;
    case SB_GRID_SIDE_PERIODIC:
        return SB_OFFSHORE_PERIODIC;
    case SB_GRID_SIDE_WALL:
        return SB_OFFSHORE_WALL;
    case SB_GRID_SIDE_PADDLE:
        return SB_OFFSHORE_PADDLE;
    case SB_GRID_SIDE_DOMAIN:
        break;
    }
    if (sb_scene_nested(scene) && !ends_with_domain(scene, side)) return SB_OFFSHORE_OPEN;
    switch (scene->domain.side[side]) {
    case SB_SIDE_OPEN:
    case SB_SIDE_SEA: /* one that only lets waves out */
        return SB_OFFSHORE_OPEN;
    case SB_SIDE_PERIODIC:
        return SB_OFFSHORE_PERIODIC;
    case SB_SIDE_WALL:
        break;
    }
    return SB_OFFSHORE_WALL;
}

sb_offshore_options sb_offshore_options_of(const sb_scene *scene, size_t columns, size_t rows)
{
    const sb_offshore_settings *o = &scene->offshore;
    sb_offshore_options options = {.columns = columns,
                                   .rows = rows,
                                   .x = o->x_min,
                                   .y = scene->dimensions == 2 ? -0.5 * o->cell : o->y_min,
                                   .cell = o->cell,
                                   .gravity = scene->fluid.gravity,
                                   .manning = o->manning,
                                   .level = o->level,
                                   .dispersion = o->dispersion};
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) options.side[s] = side_of(scene, s);
    return options;
}

/* Elevation of the initial wave above the still water, and its velocity along x. */
static double wave_at(const sb_scene *scene, double x, double *u)
{
    const sb_initial_wave *wave = &scene->offshore.wave;
    *u = 0;
    if (wave->kind == SB_INITIAL_STANDING)
        return sb_standing_elevation(wave->height, wave->wavelength, x - wave->position);
    if (wave->kind == SB_INITIAL_NONE) return 0;
    const sb_solitary solitary = {wave->height, wave->depth, scene->fluid.gravity, wave->theory};
    const double eta = sb_solitary_elevation(&solitary, (x - wave->position) * wave->direction);
    /* Continuity of a wave of constant form gives the mean over the depth. */
    *u = wave->direction * sb_solitary_celerity(&solitary) * eta / (wave->depth + eta);
    return eta;
}

/* Part of the water's depth by which that of the wave may differ without a warning, as of water.wave. */
static const double DEPTH_SHARE = 0.05;

/* Warns of a solitary wave whose depth is not that of the still water at its crest: neither the mean one of the wet
   cells there nor the greatest one, nor one between them. */
static sb_status warn_depth(const sb_scene *scene, sb_offshore_start *start, sb_error *error)
{
    const sb_offshore_settings *o = &scene->offshore;
    double deepest = 0, sum = 0;
    size_t cells = 0, wet = 0;
    if (o->wave.kind != SB_INITIAL_SOLITARY) return SB_OK;
    for (size_t k = 0; k < start->columns * start->rows; k++) {
        const double x = o->x_min + ((double)(k % start->columns) + 0.5) * o->cell, still = o->level - start->bed[k];
        if (fabs(x - o->wave.position) > 1.5 * o->cell) continue;
        cells++;
        if (!(still > 0)) continue;
        wet++;
        sum += still;
        deepest = fmax(deepest, still);
    }
    if (cells == 0) return SB_OK; /* it begins outside of the grid, which has a warning of its own */
    if (wet == 0)
        return sb_offshore_warn(&start->told, error, "offshore.wave: no water is at its crest, x = %g m, at t = 0",
                                o->wave.position);
    const double mean = sum / (double)wet, depth = o->wave.depth;
    if (depth >= (1 - DEPTH_SHARE) * mean && depth <= (1 + DEPTH_SHARE) * deepest) return SB_OK;
    return sb_offshore_warn(&start->told, error,
                            "offshore.wave: its depth is %g m, but the still water at its crest, x = %g m, is %.3g m "
                            "deep in the mean and at most %.3g m: the wave will differ from the one requested",
                            depth, o->wave.position, mean, deepest);
}

sb_status sb_offshore_start_water(const sb_scene *scene, sb_offshore_start *start, sb_error *error)
{
    const sb_offshore_settings *o = &scene->offshore;
    start->wet = 0;
    start->deepest = start->fastest = 0;
    start->highest = o->level;
    for (size_t k = 0; k < start->columns * start->rows; k++) {
        const double x = o->x_min + ((double)(k % start->columns) + 0.5) * o->cell;
        const double still = o->level - start->bed[k];
        double u = 0;
        start->depth[k] = still > 0 ? fmax(0, still + start->depth[k] + wave_at(scene, x, &u)) : 0;
        start->hu[k] = start->depth[k] * u;
        if (!(start->depth[k] > 0)) continue;
        start->wet++;
        start->deepest = fmax(start->deepest, start->depth[k]);
        start->highest = fmax(start->highest, start->bed[k] + start->depth[k]);
        start->fastest = fmax(start->fastest, fabs(u));
    }
    if (start->wet > 0) return warn_depth(scene, start, error);
    return sb_fail(error, SB_BAD_INPUT,
                   "offshore.level: %g m is below the whole bed, expected water somewhere; check the level, and "
                   "datum and positive of the terrain",
                   o->level);
}

/* The still depth at the deepest cell of a side. */
static double depth_at(const sb_scene *scene, const sb_offshore_start *start, int side)
{
    const bool along_y = side < SB_OFFSHORE_Y_MIN;
    const size_t count = along_y ? start->rows : start->columns, across = along_y ? start->columns : start->rows;
    const size_t line = side % 2 ? across - 1 : 0;
    double depth = 0;
    for (size_t k = 0; k < count; k++) {
        const size_t at = along_y ? k * start->columns + line : line * start->columns + k;
        depth = fmax(depth, scene->offshore.level - start->bed[at]);
    }
    return depth;
}

static sb_status create_paddle(const sb_scene *scene, const sb_offshore_start *start, sb_offshore_options *options,
                               sb_error *error)
{
    const sb_offshore_settings *o = &scene->offshore;
    const double place[] = {o->x_min, o->x_max, o->y_min, o->y_max};
    for (int side = 0; side < SB_OFFSHORE_SIDES; side++) {
        if (options->side[side] != SB_OFFSHORE_PADDLE) continue;
        const sb_offshore_paddle_options paddle = {.law = o->paddle.law,
                                                   .ahead = (side % 2 ? -1 : 1) * (place[side] - o->paddle_at),
                                                   .depth = depth_at(scene, start, side)};
        if (!(paddle.depth > 0))
            return sb_fail(error, SB_BAD_INPUT,
                           "offshore.sides.%s: paddle, but there is no water, expected water at the side",
                           sb_side_names[side]);
        return sb_offshore_paddle_create(&paddle, &options->paddle, error);
    }
    return SB_OK;
}

sb_status sb_offshore_begin(const sb_scene *scene, const sb_offshore_start *start, sb_offshore **offshore,
                            sb_error *error)
{
    sb_offshore_options options = sb_offshore_options_of(scene, start->columns, start->rows);
    sb_status status = scene->offshore.has_paddle ? create_paddle(scene, start, &options, error) : SB_OK;
    if (status == SB_OK)
        status = sb_offshore_create(&options, start->bed, start->depth, start->hu, NULL, offshore, error);
    if (status != SB_OK) sb_offshore_paddle_destroy(options.paddle);
    return status;
}
